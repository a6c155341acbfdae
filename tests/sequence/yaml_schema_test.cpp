// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/yaml_schema.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

struct Wheel {
  double radius_m = 0.3;
};

struct Car {
  int doors = 4;
  double length_m = 4.0;
  double petrol = 0.0;
  double battery = 0.0;
  Wheel wheel;
  std::optional<Wheel> spare;
  std::vector<Named<Wheel>> others;
};

YamlTypePtr<Car> CarSchema() {
  auto wheel = std::make_shared<YamlMapping<Wheel>>();
  wheel->Key("radius_m", &Wheel::radius_m, YamlNumber({0.0, 2.0, true}), "Radius.");
  auto body = std::make_shared<YamlMapping<Car>>();
  body->Key("length_m", &Car::length_m, YamlNumber({1.0, 9.0, false}), "Length.")
      .Finish([](const YamlMappingView& yaml, Car& car) {
        if (car.length_m < car.doors) {
          yaml.Fail("length_m", "too short for the doors");
        }
        if (!yaml.Has("length_m")) {
          car.length_m = 5.0;
        }
      });
  auto car = std::make_shared<YamlMapping<Car>>();
  car->Note("version", "7", "Not looked at.")
      .Key("doors", &Car::doors, YamlInteger<int>(0, 6), "Doors.")
      .Group("body", body)
      .Key("petrol",
           &Car::petrol,
           YamlNumber({}),
           "Litres.",
           [](const Car& c) { return c.petrol != 0.0; })
      .Key("battery",
           &Car::battery,
           YamlNumber({}),
           "Charge.",
           [](const Car& c) { return c.battery != 0.0; })
      .Key("wheel", &Car::wheel, wheel, "")
      .Key("spare", &Car::spare, YamlOptional<Wheel>(wheel), "")
      .Key("others", &Car::others, YamlNamed<Wheel>("wheel", wheel), "")
      .Exclusive({"petrol", "battery"});
  return car;
}

constexpr char kText[] = "others: {a: {radius_m: 0.5}}\n";

Car ReadCar(const std::string& text, const std::vector<std::string>& overrides = {}) {
  YamlValue root = ParseYaml(text, "car.yaml", "");
  for (const std::string& override_text : overrides) {
    ApplyOverride(override_text, root);
  }
  Car car;
  CarSchema()->Read(root, "", car);
  return car;
}

std::string ErrorOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return MessageOf<InputError>([&] { ReadCar(text, overrides); });
}

TEST(YamlMapping, ReadsKeysAndKeepsDefaults) {
  const Car car =
      ReadCar(std::string(kText) + "doors: 2\nbody: {length_m: 3}\nwheel:\n  radius_m: 0.4\n");
  EXPECT_EQ(car.doors, 2);
  EXPECT_EQ(car.length_m, 3.0);
  EXPECT_EQ(car.wheel.radius_m, 0.4);
  EXPECT_FALSE(car.spare);
  ASSERT_EQ(car.others.size(), 1U);
  EXPECT_EQ(car.others[0].value.radius_m, 0.5);
  // An empty optional mapping has the defaults of its keys.
  EXPECT_EQ(ReadCar(std::string(kText) + "spare:\n").spare->radius_m, 0.3);
}

TEST(YamlMapping, NamesPlaceAndKeyOfAFault) {
  EXPECT_EQ(ErrorOf("others:\n  a:\n    radius_m: -3\n"),
            "car.yaml:3: others.a.radius_m: expected a number > 0 and <= 2, got -3");
  EXPECT_EQ(ErrorOf("others:\n  a:\n    radios_m: 1\n"),
            "car.yaml:3: others.a.radios_m: unknown key; did you mean radius_m?");
  EXPECT_EQ(ErrorOf("wheel: 5\n"), "car.yaml:1: wheel: expected a mapping, got 5");
  EXPECT_EQ(ErrorOf("- doors\n"), "car.yaml:1: expected a mapping, got a list of 1");
}

TEST(YamlMapping, TellsWhatIsMissing) {
  EXPECT_EQ(ErrorOf("doors: 3\n"),
            "car.yaml:1: others: expected at least one wheel by name (a-z, 0-9, _), got nothing");
}

TEST(YamlMapping, RunsChecksBetweenKeysAndLateDefaultsEvenWhenTheMappingIsAbsent) {
  EXPECT_EQ(ReadCar(kText).length_m, 5.0);
  EXPECT_EQ(ErrorOf(std::string(kText) + "doors: 6\n"),
            "car.yaml:1: body.length_m: too short for the doors");
  EXPECT_EQ(ErrorOf(std::string(kText) + "doors: 6\nbody: {length_m: 5}\n"),
            "car.yaml:3: body.length_m: too short for the doors");
}

TEST(YamlMapping, TakesOneOfExclusiveKeys) {
  const std::string petrol = std::string(kText) + "petrol: 40\n";
  EXPECT_EQ(ErrorOf(petrol + "battery: 1\n"),
            "car.yaml:3: battery: expected either this or petrol, got both");
  const Car car = ReadCar(petrol, {"battery=70"});
  EXPECT_EQ(car.petrol, 0.0);
  EXPECT_EQ(car.battery, 70.0);
  EXPECT_EQ(ErrorOf(petrol, {"battery=70", "petrol=3"}),
            "--set battery=70: expected either this or petrol, got both");
}

TEST(YamlMapping, TellsFaultsOfOverridesByTheirText) {
  EXPECT_EQ(ErrorOf(kText, {"doors=-1"}),
            "--set doors=-1: expected a whole number from 0 to 6, got -1");
  EXPECT_EQ(ErrorOf(kText, {"dors=1"}), "--set dors=1: unknown key; did you mean doors?");
  EXPECT_EQ(ErrorOf(kText, {"wheel={radius_m: 3}"}),
            "--set wheel={radius_m: 3}: wheel.radius_m: expected a number > 0 and <= 2, got 3");
  EXPECT_EQ(ErrorOf(kText, {"doors.front=1"}),
            "--set doors.front=1: doors: expected a whole number from 0 to 6, got a mapping");
}

TEST(YamlMapping, LetsOverridesReachIntoNamesThatAreThereOnly) {
  EXPECT_EQ(ReadCar(kText, {"others.a.radius_m=1.5"}).others[0].value.radius_m, 1.5);
  EXPECT_EQ(ReadCar(kText, {"others.b={radius_m: 1}"}).others[1].name, "b");
  EXPECT_EQ(ErrorOf(kText, {"others.aa.radius_m=1"}),
            "--set others.aa.radius_m=1: others.aa: there is none of this name; did you mean a?");
}

TEST(YamlMapping, WritesWhatItReads) {
  Car car;
  car.battery = 0.25;
  car.spare = Wheel{0.2};
  car.others = {{"b", {0.5}}, {"a", {0.6}}};
  EXPECT_EQ(
      YamlText(CarSchema()->Write(car)),
      "version: 7\ndoors: 4\nbody:\n  length_m: 4\nbattery: 0.25\nwheel:\n  radius_m: 0.3\nspare:\n"
      "  radius_m: 0.2\nothers:\n  b:\n    radius_m: 0.5\n  a:\n    radius_m: 0.6\n");
  const Car again = ReadCar(YamlText(CarSchema()->Write(car)));
  EXPECT_EQ(YamlText(CarSchema()->Write(again)), YamlText(CarSchema()->Write(car)));
}

TEST(YamlMapping, DescribesEachKeyOnce) {
  std::vector<YamlKeyHelp> help;
  CarSchema()->Describe({}, Car{}, help);
  std::string text;
  for (const YamlKeyHelp& key : help) {
    text += key.key + "|" + key.default_text + "|" + key.expected + "|" + key.meaning + "\n";
  }
  EXPECT_EQ(text,
            "version|7|a line of text|Not looked at.\n"
            "doors|4|a whole number from 0 to 6|Doors.\n"
            "body.length_m|4|a number from 1 to 9|Length.\n"
            "petrol|absent|a number|Litres.\n"
            "battery|absent|a number|Charge.\n"
            "wheel.radius_m|0.3|a number > 0 and <= 2|Radius.\n"
            "spare.radius_m|0.3|a number > 0 and <= 2|Radius.\n"
            "others.NAME.radius_m|0.3|a number > 0 and <= 2|Radius.\n");
}

}  // namespace
}  // namespace pfseq
