// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/yaml_value.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

using Kind = YamlValue::Kind;

YamlValue Parse(const std::string& text) { return ParseYaml(text, "demo.yaml", "folder"); }

std::string ParseError(const std::string& text) {
  return MessageOf<InputError>([&] { Parse(text); });
}

YamlValue Overridden(const std::string& text, const std::string& override_text) {
  YamlValue root = Parse(text);
  ApplyOverride(override_text, root);
  return root;
}

TEST(ParseYaml, RemembersWhereEachValueIs) {
  const YamlValue root = Parse("# a comment\na: 1\nb:\n  c: [x, 'y']\n  d:\n");
  ASSERT_EQ(root.kind, Kind::kMapping);
  EXPECT_EQ(root.Find("a")->text, "1");
  EXPECT_EQ(root.Find("a")->origin.where, "demo.yaml:2");
  EXPECT_EQ(root.Find("a")->origin.folder, "folder");
  EXPECT_FALSE(root.Find("a")->origin.IsOverride());
  const YamlValue& b = *root.Find("b");
  // A block starts where its key is.
  EXPECT_EQ(b.origin.where, "demo.yaml:3");
  ASSERT_EQ(b.Find("c")->items.size(), 2U);
  EXPECT_EQ(b.Find("c")->items[1].origin.where, "demo.yaml:4");
  EXPECT_FALSE(b.Find("c")->items[0].is_quoted);
  EXPECT_TRUE(b.Find("c")->items[1].is_quoted);
  EXPECT_EQ(b.Find("d")->kind, Kind::kNothing);
  EXPECT_EQ(b.Find("d")->origin.where, "demo.yaml:5");
  EXPECT_EQ(b.Find("e"), nullptr);
}

TEST(ParseYaml, KeepsTheOrderOfTheFile) {
  const YamlValue root = Parse("z: 1\na: 2\nm: 3\n");
  ASSERT_EQ(root.entries.size(), 3U);
  EXPECT_EQ(root.entries[0].key, "z");
  EXPECT_EQ(root.entries[1].key, "a");
  EXPECT_EQ(root.entries[2].key, "m");
}

TEST(ParseYaml, OfAnEmptyTextIsNothing) {
  EXPECT_EQ(Parse("").kind, Kind::kNothing);
  EXPECT_EQ(Parse("# only a comment\n").kind, Kind::kNothing);
  EXPECT_EQ(Parse("").origin.where, "demo.yaml");
}

TEST(ParseYaml, RefusesWhatIsNoPlainTree) {
  EXPECT_EQ(ParseError("a: 1\nb: 2\na: 3\n"),
            "demo.yaml:3: a: key given twice (first at demo.yaml:1)");
  EXPECT_EQ(ParseError("a: &x 1\nb: 2\n"),
            "demo.yaml:1: anchors and aliases (& and *) are not supported");
  EXPECT_EQ(ParseError("a: 1\n---\nb: 2\n"),
            "demo.yaml:3: expected one YAML document, got several");
  EXPECT_EQ(ParseError("a: 1\n? [1, 2]\n: 3\n"),
            "demo.yaml:2: expected a key, got a list or mapping (is a bracket left open?)");
  EXPECT_EQ(ParseError("~: 3\n"), "demo.yaml:1: expected a key, got nothing");
  EXPECT_EQ(ParseError("a: " + std::string(40, '[') + std::string(40, ']')),
            "demo.yaml:1: nested too deeply");
}

TEST(ParseYaml, NamesTheLineThatIsNotYaml) {
  EXPECT_EQ(ParseError("a: 1\nb: [1, 2\n").find("demo.yaml:3: not YAML: "), 0U);
  EXPECT_EQ(ParseError("a: 1\nb: \"open").find("demo.yaml:2: not YAML: "), 0U);
  EXPECT_EQ(ParseError("a: 1\n b: 2\n").find("demo.yaml:2: not YAML: "), 0U);
}

TEST(ParseYaml, SurvivesDamageOfAnyByte) {
  const std::string text =
      "name: x\nlenses: {a: {fov_deg: 181.8, focal_px: [1, 2]}}\nscene:\n  gltf: 'a b.glb'\n";
  for (size_t i = 0; i < text.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string damaged = text;
      damaged[i] = static_cast<char>(byte);
      try {
        Parse(damaged);
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find("demo.yaml:"), 0U) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
}

TEST(ReadYaml, KnowsTheFilesFolder) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.yaml", "a: 1\n");
  const YamlValue root = ReadYaml(folder / "a.yaml");
  EXPECT_EQ(root.Find("a")->origin.folder, folder.Path());
  EXPECT_EQ(root.Find("a")->origin.where, (folder / "a.yaml").string() + ":1");
  EXPECT_THROW(ReadYaml(folder / "b.yaml"), InputError);
}

TEST(ApplyOverride, ReplacesAndAddsValues) {
  const YamlValue root = Overridden("a: {b: 1, c: 2}\n", "a.b=[3, x]");
  EXPECT_EQ(YamlText(root), "a:\n  b: [3, x]\n  c: 2\n");
  EXPECT_EQ(YamlText(Overridden("a: 1\n", "b.c.d={e: 5}")), "a: 1\nb:\n  c:\n    d:\n      e: 5\n");
  EXPECT_EQ(YamlText(Overridden("a: 1\n", "a=x=y")), "a: x=y\n");
}

TEST(ApplyOverride, MarksWhatItSetsAndWhatItImplies) {
  const YamlValue root = Overridden("a: 1\n", "b.c={d: 5}");
  const YamlValue& b = *root.Find("b");
  EXPECT_TRUE(b.origin.is_implied);
  const YamlValue& d = *b.Find("c")->Find("d");
  EXPECT_FALSE(d.origin.is_implied);
  EXPECT_TRUE(d.origin.IsOverride());
  EXPECT_EQ(d.origin.where, "--set b.c={d: 5}");
  EXPECT_EQ(d.origin.override_key, "b.c");
  EXPECT_EQ(d.origin.folder, "");
  EXPECT_FALSE(root.Find("a")->origin.IsOverride());
}

TEST(ApplyOverride, RefusesWhatHasNotItsForm) {
  const auto error = [](const std::string& text) {
    return MessageOf<InputError>([&] { Overridden("a: 1\n", text); });
  };
  EXPECT_EQ(error("a"), "--set a: expected KEY=VALUE");
  EXPECT_EQ(error("=1"), "--set =1: expected KEY=VALUE with a key such as image.size_px");
  EXPECT_EQ(error("a..b=1"), "--set a..b=1: expected KEY=VALUE with a key such as image.size_px");
  EXPECT_EQ(error("a.=1"), "--set a.=1: expected KEY=VALUE with a key such as image.size_px");
  EXPECT_EQ(error("a=[1"),
            "--set a=[1: expected a key, got a list or mapping (is a bracket left open?)");
  EXPECT_EQ(error("a='x").find("--set a='x: not YAML: "), 0U);
}

TEST(YamlText, IsReadBackUnchanged) {
  YamlValue root;
  root.kind = Kind::kMapping;
  for (const std::string text : {"plain",
                                 "",
                                 " padded ",
                                 "a: b",
                                 "# no comment",
                                 "null",
                                 "~",
                                 "-3",
                                 "1e-09",
                                 "- x",
                                 "two\nlines",
                                 "tab\t",
                                 "\"quoted\"",
                                 "it's",
                                 "[x",
                                 "{x",
                                 "*x",
                                 "&x",
                                 "!x",
                                 "%x",
                                 "@x",
                                 "gr\xC3\xBC\xC3\x9F",
                                 "C:\\path",
                                 "x, y"}) {
    root.entries.push_back({"k" + std::to_string(root.entries.size()), YamlValue::Scalar(text)});
    root.entries.push_back({"l" + std::to_string(root.entries.size()), {}});
    root.entries.back().value.kind = Kind::kList;
    root.entries.back().value.items = {YamlValue::Scalar(text), YamlValue::Scalar("1")};
  }
  const std::string text = YamlText(root);
  const YamlValue again = Parse(text);
  ASSERT_EQ(again.entries.size(), root.entries.size());
  for (size_t i = 0; i < root.entries.size(); i += 2) {
    EXPECT_EQ(again.entries[i].value.text, root.entries[i].value.text);
    ASSERT_EQ(again.entries[i + 1].value.items.size(), 2U) << text;
    EXPECT_EQ(again.entries[i + 1].value.items[0].text, root.entries[i].value.text);
  }
}

TEST(DescribeYaml, IsShortAndOnOneLine) {
  EXPECT_EQ(DescribeYaml(Parse("a: 1")), "a mapping");
  EXPECT_EQ(DescribeYaml(Parse("[1, 2, 3]")), "a list of 3");
  EXPECT_EQ(DescribeYaml(Parse("")), "nothing");
  EXPECT_EQ(DescribeYaml(Parse("x")), "x");
  EXPECT_EQ(DescribeYaml(Parse("'5'")), "\"5\"");
  EXPECT_EQ(DescribeYaml(YamlValue::Scalar("a\nb")), "a?b");
  EXPECT_EQ(DescribeYaml(YamlValue::Scalar(std::string(100, 'x'))), std::string(60, 'x') + "...");
}

TEST(FailAtYaml, NamesTheKeyUnlessTheOverrideDoes) {
  const YamlValue root = Overridden("a:\n  b: 1\n", "c.d=2");
  const auto message = [](const YamlValue& value, const std::string& key) {
    return MessageOf<InputError>([&] { FailAtYaml(value, key, "fault"); });
  };
  EXPECT_EQ(message(*root.Find("a")->Find("b"), "a.b"), "demo.yaml:2: a.b: fault");
  EXPECT_EQ(message(*root.Find("c")->Find("d"), "c.d"), "--set c.d=2: fault");
  EXPECT_EQ(message(*root.Find("c"), "c"), "--set c.d=2: c: fault");
  EXPECT_EQ(message(root, ""), "demo.yaml:1: fault");
}

}  // namespace
}  // namespace pfseq
