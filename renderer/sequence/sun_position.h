// SPDX-License-Identifier: Apache-2.0
// Where the sun stands, by date, time and place.
#pragma once

#include <optional>
#include <string_view>

namespace pfseq {

/// Seconds since 1970-01-01T00:00Z without leap seconds, of an ISO 8601 date and time with its
/// offset from UTC: "2014-06-21T15:30:00+02:00", or with Z for UTC; seconds may have a fraction or
/// be left out. Nothing when the text is not of that form, there is no such day or time, or the
/// year is not from 1900 to 2099, for which the formulas below are meant.
std::optional<double> ParseDateTime(std::string_view text);

struct SunPosition {
  double elevation_rad = 0.0;
  /// Clockwise from north, seen from above; in [0, 2 pi).
  double azimuth_from_north_rad = 0.0;
};

/// The sun as it is seen from a place, latitude positive to the north and longitude to the east, to
/// 0.01 degrees: the low-accuracy position of Meeus 1998, "Astronomical Algorithms", chapter 25,
/// with sidereal time (chapter 12), parallax, and refraction in a standard atmosphere (Saemundsson
/// 1986, equation 16.4 there).
SunPosition SunAt(double unix_time_s, double latitude_rad, double longitude_rad);

}  // namespace pfseq
