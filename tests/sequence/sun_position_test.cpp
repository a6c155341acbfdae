// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sun_position.h"

#include "renderer/core/units.h"

#include <string>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

struct PositionDeg {
  double elevation_deg;
  double azimuth_deg;
};

PositionDeg SunAtDeg(const std::string& date_time, double latitude_deg, double longitude_deg) {
  const SunPosition position =
      SunAt(ParseDateTime(date_time).value(), RadFromDeg(latitude_deg), RadFromDeg(longitude_deg));
  return {DegFromRad(position.elevation_rad), DegFromRad(position.azimuth_from_north_rad)};
}

TEST(ParseDateTime, CountsSecondsFrom1970InUtc) {
  EXPECT_EQ(ParseDateTime("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(ParseDateTime("1970-01-01T02:30+02:30"), 0.0);
  EXPECT_EQ(ParseDateTime("1970-01-01T00:00:00-01:00"), 3600.0);
  EXPECT_EQ(ParseDateTime("1970-01-02T00:00:01.25+0000"), 86401.25);
  // 2000-02-29 is the day 11016 after 1970-01-01.
  EXPECT_EQ(ParseDateTime("2000-02-29T12:00Z"), 11016 * 86400.0 + 43200.0);
}

TEST(ParseDateTime, RefusesAllElse) {
  for (const char* text : {"",
                           "2014-06-21",
                           "2014-06-21T15:30:00",
                           "2014-06-21 15:30:00+02:00",
                           "2014-6-21T15:30:00Z",
                           "2014-02-29T12:00:00Z",
                           "2014-13-01T12:00:00Z",
                           "2014-00-01T12:00:00Z",
                           "2014-06-31T12:00:00Z",
                           "2014-06-21T24:00:00Z",
                           "2014-06-21T12:60:00Z",
                           "2014-06-21T12:00:60Z",
                           "2014-06-21T12:00:00.Z",
                           "2014-06-21T12:00:00+2",
                           "2014-06-21T12:00:00+15:00",
                           "2014-06-21T12:00:00+02:00x",
                           "2014-06-21T12:00:00Zx",
                           "1899-12-31T12:00:00Z",
                           "2100-01-01T12:00:00Z",
                           "noon"}) {
    EXPECT_FALSE(ParseDateTime(text).has_value()) << text;
  }
}

TEST(SunAt, IsThatOfTheWorkedExampleOfReda) {
  // Reda and Andreas 2004, "Solar position algorithm for solar radiation applications", NREL
  // TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024 degrees, refraction of thinner
  // air.
  const PositionDeg sun = SunAtDeg("2003-10-17T12:30:30-07:00", 39.742476, -105.1786);
  EXPECT_NEAR(90.0 - sun.elevation_deg, 50.11162, 0.006);
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, 0.008);
}

TEST(SunAt, HasThePublishedEquationOfTime) {
  // Apparent minus mean solar time: -14 min 14 s on February 11, +16 min 26 s on November 3 (2014;
  // any almanac). At that local mean time the sun is due south.
  for (const auto& [date_time, latitude_deg] :
       {std::pair{"2014-02-11T12:14:14Z", 50.0}, {"2014-11-03T11:43:34Z", 50.0}}) {
    EXPECT_NEAR(SunAtDeg(date_time, latitude_deg, 0.0).azimuth_deg, 180.0, 0.03) << date_time;
  }
}

TEST(SunAt, StandsOverTheTropicsAtTheSolstices) {
  // Obliquity 23.436 degrees; noon at longitude 0 by the equation of time, -1 min 50 s and +1 min
  // 55 s. 2014-06-21T10:51Z, 2014-12-21T23:03Z.
  EXPECT_NEAR(
      SunAtDeg("2014-06-21T12:01:50Z", 50.0, 0.0).elevation_deg, 90.0 - 50.0 + 23.436, 0.02);
  EXPECT_NEAR(
      SunAtDeg("2014-12-21T11:58:05Z", 50.0, 0.0).elevation_deg, 90.0 - 50.0 - 23.436, 0.06);
  // South of the tropic it is in the north.
  const double azimuth_deg = SunAtDeg("2014-12-21T11:58:05Z", -60.0, 0.0).azimuth_deg;
  EXPECT_LT(std::min(azimuth_deg, 360.0 - azimuth_deg), 0.2);
}

TEST(SunAt, RisesInTheEastAtTheEquinox) {
  // March equinox of 2014: March 20, 16:57 UTC. At the equator the sun rises and sets 6 hours from
  // noon (12:07:30), due east and west, but for refraction (0.5 degrees) at the horizon.
  const PositionDeg morning = SunAtDeg("2014-03-20T06:07:30Z", 0.0, 0.0);
  EXPECT_NEAR(morning.azimuth_deg, 90.0, 0.3);
  EXPECT_NEAR(morning.elevation_deg, 0.5, 0.15);
  EXPECT_NEAR(SunAtDeg("2014-03-20T18:07:30Z", 0.0, 0.0).azimuth_deg, 270.0, 0.3);
}

TEST(SunAt, EastwardPlacesAreAheadInTime) {
  const PositionDeg here = SunAtDeg("2014-06-21T10:00:00Z", 40.0, 0.0);
  const PositionDeg east = SunAtDeg("2014-06-21T09:00:00Z", 40.0, 15.0);
  EXPECT_NEAR(here.elevation_deg, east.elevation_deg, 0.01);
  EXPECT_NEAR(here.azimuth_deg, east.azimuth_deg, 0.01);
  EXPECT_LT(here.azimuth_deg, 180.0);
}

TEST(SunAt, IsBelowTheHorizonAtMidnight) {
  EXPECT_LT(SunAtDeg("2014-06-21T00:00:00Z", 48.0, 0.0).elevation_deg, -15.0);
}

}  // namespace
}  // namespace pfseq
