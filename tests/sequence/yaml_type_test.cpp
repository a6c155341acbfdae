// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/yaml_type.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

template <typename T>
T ReadAs(const YamlTypePtr<T>& type, const std::string& text) {
  T value{};
  type->Read(ParseYaml(text, "demo.yaml", "/folder"), "key", value);
  return value;
}

template <typename T>
std::string ErrorOf(const YamlTypePtr<T>& type, const std::string& text) {
  return MessageOf<InputError>([&] { ReadAs(type, text); });
}

TEST(YamlNumber, ReadsNumbersInItsRange) {
  const auto type = YamlNumber({0.0, 2.0, false});
  EXPECT_EQ(ReadAs(type, "0"), 0.0);
  EXPECT_EQ(ReadAs(type, "2.0"), 2.0);
  EXPECT_EQ(ReadAs(type, "+1.5e-1"), 0.15);
  EXPECT_EQ(ErrorOf(type, "-0.1"), "demo.yaml:1: key: expected a number from 0 to 2, got -0.1");
  EXPECT_EQ(ErrorOf(type, "2.1"), "demo.yaml:1: key: expected a number from 0 to 2, got 2.1");
}

TEST(YamlNumber, RefusesWhatIsNoFiniteNumber) {
  const auto type = YamlNumber({});
  for (const std::string text :
       {".inf", ".nan", "inf", "nan", "1e999", "1,5", "1.5 m", "true", "0x10"}) {
    EXPECT_EQ(ErrorOf(type, text), "demo.yaml:1: key: expected a number, got " + text);
  }
  EXPECT_EQ(ErrorOf(type, "'1'"), "demo.yaml:1: key: expected a number, got \"1\"");
  EXPECT_EQ(ErrorOf(type, "[1]"), "demo.yaml:1: key: expected a number, got a list of 1");
  EXPECT_EQ(ErrorOf(type, "{a: 1}"), "demo.yaml:1: key: expected a number, got a mapping");
  EXPECT_EQ(ErrorOf(type, "~"), "demo.yaml:1: key: expected a number, got nothing");
}

TEST(YamlNumber, TellsItsRange) {
  EXPECT_EQ(YamlNumber({0.0, 5.0, true})->Expected(), "a number > 0 and <= 5");
  YamlRange range;
  range.least = 1.5;
  EXPECT_EQ(YamlNumber(range)->Expected(), "a number >= 1.5");
  range.is_least_excluded = true;
  EXPECT_EQ(YamlNumber(range)->Expected(), "a number > 1.5");
  EXPECT_EQ(ErrorOf(YamlNumber(range), "1.5"),
            "demo.yaml:1: key: expected a number > 1.5, got 1.5");
  EXPECT_EQ(YamlNumber({-INFINITY, 7.0, false})->Expected(), "a number <= 7");
}

TEST(YamlNumber, WritesTheShortestTextThatIsReadAsTheSameNumber) {
  const auto type = YamlNumber({});
  EXPECT_EQ(type->Write(181.8).text, "181.8");
  EXPECT_EQ(type->Write(9.0).text, "9");
  for (const double value : {0.1 + 0.2, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -1e-7, 1e21}) {
    EXPECT_EQ(ReadAs(type, type->Write(value).text), value);
  }
}

TEST(YamlInteger, ReadsWholeNumbersInItsRange) {
  const auto type = YamlInteger<int>(1, 100);
  EXPECT_EQ(ReadAs(type, "100"), 100);
  for (const std::string text : {"0", "101", "1.0", "1e1", "99999999999999999999", "x"}) {
    EXPECT_EQ(ErrorOf(type, text),
              "demo.yaml:1: key: expected a whole number from 1 to 100, got " + text);
  }
  const auto seed = YamlInteger<uint64_t>(0, UINT64_MAX);
  EXPECT_EQ(ReadAs(seed, "18446744073709551615"), UINT64_MAX);
  EXPECT_EQ(seed->Write(UINT64_MAX).text, "18446744073709551615");
  EXPECT_THROW(ReadAs(seed, "-1"), InputError);
}

TEST(YamlChoice, TakesOneOfItsWords) {
  const auto type = YamlChoice({"left", "right"});
  EXPECT_EQ(ReadAs(type, "right"), "right");
  EXPECT_EQ(ErrorOf(type, "Left"), "demo.yaml:1: key: expected one of left, right, got Left");
  EXPECT_EQ(ErrorOf(type, "[left]"),
            "demo.yaml:1: key: expected one of left, right, got a list of 1");
}

TEST(YamlLine, TakesOneLineOfText) {
  EXPECT_EQ(ReadAs(YamlLine(), "any text"), "any text");
  EXPECT_EQ(ReadAs(YamlLine(), "12"), "12");
  EXPECT_EQ(ErrorOf(YamlLine(), "''"), "demo.yaml:1: key: expected a line of text, got \"\"");
  EXPECT_EQ(ErrorOf(YamlLine(), "\"a\\nb\""),
            "demo.yaml:1: key: expected a line of text, got \"a?b\"");
}

TEST(YamlPath, StartsAtTheFilesFolder) {
  EXPECT_EQ(ReadAs(YamlPath(), "a/../b.glb"), "/folder/b.glb");
  EXPECT_EQ(ReadAs(YamlPath(), "../b.glb"), "/b.glb");
  EXPECT_EQ(ReadAs(YamlPath(), "/c/d.glb"), "/c/d.glb");
  EXPECT_EQ(ErrorOf(YamlPath(), "''"), "demo.yaml:1: key: expected the path of a file, got \"\"");
  EXPECT_EQ(YamlPath()->Write("").kind, YamlValue::Kind::kNothing);
}

TEST(YamlPath, OfAnOverrideStartsAtTheWorkingDirectory) {
  YamlValue root = ParseYaml("a: 1\n", "demo.yaml", "/folder");
  ApplyOverride("gltf=x.glb", root);
  std::string path;
  YamlPath()->Read(*root.Find("gltf"), "gltf", path);
  EXPECT_EQ(path, (std::filesystem::current_path() / "x.glb").string());
}

TEST(YamlArray, TakesAListOfItsLength) {
  const auto type = YamlArray<2>(YamlNumber({0.0, 9.0, false}));
  EXPECT_EQ(ReadAs(type, "[1, 2.5]"), (std::array{1.0, 2.5}));
  EXPECT_EQ(ReadAs(type, "- 1\n- 2"), (std::array{1.0, 2.0}));
  EXPECT_EQ(ErrorOf(type, "[1]"),
            "demo.yaml:1: key: expected a list of 2 (each a number from 0 to 9), got a list of 1");
  EXPECT_EQ(ErrorOf(type, "1"),
            "demo.yaml:1: key: expected a list of 2 (each a number from 0 to 9), got 1");
  EXPECT_EQ(ErrorOf(type, "[1, -1]"), "demo.yaml:1: key: expected a number from 0 to 9, got -1");
  EXPECT_EQ(InlineYamlText(type->Write({1.0, 0.5})), "[1, 0.5]");
}

TEST(YamlArray, LetsOneStandForAllWhereThatIsAllowed) {
  const auto type = YamlArray<2>(YamlInteger<int>(1, 9), true);
  EXPECT_EQ(ReadAs(type, "7"), (std::array{7, 7}));
  EXPECT_EQ(ErrorOf(type, "10"), "demo.yaml:1: key: expected a whole number from 1 to 9, got 10");
  EXPECT_EQ(type->Expected(), "a list of 2 (each a whole number from 1 to 9), or one for all");
}

TEST(YamlOptional, IsAbsentUntilRead) {
  const auto type = YamlOptional(YamlInteger<int>(1, 9));
  EXPECT_EQ(ReadAs(type, "7"), std::optional<int>(7));
  EXPECT_EQ(type->Write(std::nullopt).kind, YamlValue::Kind::kNothing);
  EXPECT_EQ(type->Write(5).text, "5");
  std::vector<YamlKeyHelp> help;
  type->Describe({"key", "", "", "meaning"}, std::nullopt, help);
  ASSERT_EQ(help.size(), 1U);
  EXPECT_EQ(help[0].default_text, "absent");
  EXPECT_EQ(help[0].expected, "a whole number from 1 to 9");
}

TEST(YamlNamed, KeepsTheOrderOfTheFile) {
  const auto type = YamlNamed("number", YamlInteger<int>(1, 9));
  const std::vector<Named<int>> value = ReadAs(type, "rear: 2\nfront_1: 1\n");
  EXPECT_EQ(value, (std::vector<Named<int>>{{"rear", 2}, {"front_1", 1}}));
  EXPECT_EQ(YamlText(type->Write(value)), "rear: 2\nfront_1: 1\n");
}

TEST(YamlNamed, RefusesBadNamesAndNone) {
  const auto type = YamlNamed("number", YamlInteger<int>(1, 9));
  EXPECT_EQ(ErrorOf(type, "{}"),
            "demo.yaml:1: key: expected at least one number by name (a-z, 0-9, _), got a mapping");
  EXPECT_EQ(ErrorOf(type, "7"), "demo.yaml:1: key: expected a mapping, got 7");
  for (const std::string name : {"Front", "a b", "a/b", "..", "a-b", "\xC3\xA4"}) {
    EXPECT_EQ(ErrorOf(type, "ok: 1\n" + name + ": 2\n"),
              "demo.yaml:2: key." + name + ": expected a name of up to 64 of a-z, 0-9 and _");
  }
  EXPECT_EQ(ErrorOf(type, "a: 10"),
            "demo.yaml:1: key.a: expected a whole number from 1 to 9, got 10");
}

TEST(CheckKnownKeys, NamesTheNearestKey) {
  const auto error = [](const std::string& key) {
    return MessageOf<InputError>([&] {
      CheckKnownKeys(
          ParseYaml(key + ": 1", "demo.yaml", ""), "lens", {"circle_px", "focal_px", "model"});
    });
  };
  EXPECT_EQ(error("circl_px"), "demo.yaml:1: lens.circl_px: unknown key; did you mean circle_px?");
  EXPECT_EQ(error("focal"),
            "demo.yaml:1: lens.focal: unknown key; known here: circle_px, focal_px, model");
  EXPECT_EQ(error("mdoel"), "demo.yaml:1: lens.mdoel: unknown key; did you mean model?");
  EXPECT_EQ(error("zzz"),
            "demo.yaml:1: lens.zzz: unknown key; known here: circle_px, focal_px, model");
}

}  // namespace
}  // namespace pfseq
