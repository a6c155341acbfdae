// SPDX-License-Identifier: Apache-2.0
#include "scenes/gltf/gltf_json.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <string>

namespace pfseq {
namespace {

using Json = nlohmann::json;

const Json& Document() {
  static const Json root = Json::parse(R"({
    "things": [{"count": 3, "name": "a", "on": true, "weight": 0.5, "of": 1, "numbers": [1, 2.5]}, {}],
    "extensions": {"EXT_x": {"level": 4000000000}},
    "odd": {"count": -1, "name": 7, "on": "yes", "weight": "heavy", "of": 2, "numbers": [1, "b"], "extensions": []}})");
  return root;
}

class JsonCheckerTest : public testing::Test {
 protected:
  std::string Fault(const std::function<void()>& action) const {
    return MessageOf<InputError>(action);
  }

  const std::string origin_ = "file";
  const JsonChecker checker_{Document(), origin_};
  const JsonPlace good_{&Document()["things"][0], "things[0]"};
  const JsonPlace odd_{&Document()["odd"], "odd"};
};

TEST_F(JsonCheckerTest, GivesWhatIsThere) {
  EXPECT_EQ(checker_.Unsigned(good_, "count", 0, 3), 3U);
  EXPECT_EQ(*checker_.String(good_, "name"), "a");
  EXPECT_EQ(checker_.Index(good_, "of", "things"), 1U);
  EXPECT_TRUE(checker_.Numbers(good_, "numbers", 2));
  EXPECT_NO_THROW(checker_.Boolean(good_, "on"));
  EXPECT_NO_THROW(checker_.Number(good_, "weight", 0.5));
  EXPECT_TRUE(checker_.Extension(checker_.Document(), "EXT_x").has_value());
}

TEST_F(JsonCheckerTest, GivesNothingForWhatIsNotThere) {
  EXPECT_EQ(checker_.Unsigned(good_, "none", 0, 3), std::nullopt);
  EXPECT_EQ(checker_.String(good_, "none"), nullptr);
  EXPECT_EQ(checker_.Index(good_, "none", "things"), std::nullopt);
  EXPECT_FALSE(checker_.Numbers(good_, "none", 2));
  EXPECT_FALSE(checker_.Extension(good_, "EXT_x").has_value());
  EXPECT_EQ(checker_.NumEntries("none"), 0U);
}

TEST_F(JsonCheckerTest, TellsWhereAndWhatIsWrong) {
  EXPECT_EQ(Fault([&] { checker_.Unsigned(odd_, "count", 0, 9); }),
            "file: odd.count: expected an integer from 0 to 9, got -1");
  EXPECT_EQ(Fault([&] { checker_.String(odd_, "name"); }),
            "file: odd.name: expected a string, got 7");
  EXPECT_EQ(Fault([&] { checker_.Boolean(odd_, "on"); }),
            "file: odd.on: expected true or false, got string");
  EXPECT_EQ(Fault([&] { checker_.Number(odd_, "weight"); }),
            "file: odd.weight: expected a number, got string");
  EXPECT_EQ(Fault([&] { checker_.Index(odd_, "of", "things"); }),
            "file: odd.of: 2, expected less than 2 (the number of things)");
  EXPECT_EQ(Fault([&] { checker_.Numbers(odd_, "numbers", 2); }),
            "file: odd.numbers: expected a number, got string");
  EXPECT_EQ(Fault([&] { checker_.Numbers(good_, "numbers", 3); }),
            "file: things[0].numbers: 2 numbers, expected 3");
  EXPECT_EQ(Fault([&] { checker_.Extension(odd_, "EXT_x"); }),
            "file: odd.extensions: expected an object, got array");
  EXPECT_EQ(Fault([&] { checker_.Member(odd_, "none", true); }), "file: odd: 'none' is missing");
  EXPECT_EQ(Fault([&] { checker_.Array(checker_.Document(), "odd"); }),
            "file: odd: expected an array, got object");
}

TEST_F(JsonCheckerTest, RefusesNumbersThatDoNotFit) {
  const JsonPlace extension = *checker_.Extension(checker_.Document(), "EXT_x");
  EXPECT_EQ(Fault([&] { checker_.Number(extension, "level"); }),
            "file: extensions.EXT_x.level: 4000000000 is out of range");
  EXPECT_EQ(Fault([&] { checker_.Number(good_, "weight", 0.6); }),
            "file: things[0].weight: 0.5 is out of range");
  const Json huge = Json::parse(R"({"x": 1e31, "y": -1e31})");
  const JsonPlace place{&huge, "huge"};
  EXPECT_EQ(Fault([&] { checker_.Number(place, "x"); }), "file: huge.x: 1e+31 is out of range");
  EXPECT_EQ(Fault([&] { checker_.Number(place, "y"); }), "file: huge.y: -1e+31 is out of range");
}

TEST_F(JsonCheckerTest, RefusesADocumentThatIsNoObject) {
  const Json list = Json::array();
  EXPECT_EQ(Fault([&] { JsonChecker(list, origin_); }), "file: expected a JSON object, got array");
}

}  // namespace
}  // namespace pfseq
