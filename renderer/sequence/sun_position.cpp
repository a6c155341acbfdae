// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sun_position.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

constexpr int kFirstYear = 1900;
constexpr int kLastYear = 2099;
/// Terrestrial minus universal time, as in the years about 2020. A minute more or less moves the
/// sun by less than 0.001 degrees among the stars.
constexpr double kTerrestrialLeadS = 69.0;
constexpr double kSecondsPerDay = 86400.0;

/// Takes a number of `num_digits` digits off the front of a text.
std::optional<int> TakeDigits(std::string_view& text, size_t num_digits) {
  if (text.size() < num_digits) {
    return std::nullopt;
  }
  int value = 0;
  for (const char digit : text.substr(0, num_digits)) {
    if (digit < '0' || digit > '9') {
      return std::nullopt;
    }
    value = value * 10 + (digit - '0');
  }
  text.remove_prefix(num_digits);
  return value;
}

/// As TakeDigits, with a sign before the number.
std::optional<int> TakeAfter(char sign, std::string_view& text, size_t num_digits) {
  if (!text.starts_with(sign)) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  return TakeDigits(text, num_digits);
}

/// Seconds and their fraction, 0 when they are left out.
std::optional<double> TakeSeconds(std::string_view& text) {
  if (!text.starts_with(':')) {
    return 0.0;
  }
  const std::optional<int> whole = TakeAfter(':', text, 2);
  if (!whole || *whole > 59) {
    return std::nullopt;
  }
  double seconds = *whole;
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    double digit_value = 0.1;
    size_t num_digits = 0;
    for (; num_digits < text.size() && text[num_digits] >= '0' && text[num_digits] <= '9';
         ++num_digits) {
      seconds += digit_value * (text[num_digits] - '0');
      digit_value *= 0.1;
    }
    if (num_digits == 0) {
      return std::nullopt;
    }
    text.remove_prefix(num_digits);
  }
  return seconds;
}

/// The offset from UTC, which must be all that is left.
std::optional<double> OffsetS(std::string_view text) {
  if (text == "Z") {
    return 0.0;
  }
  const double sign = text.starts_with('-') ? -1.0 : 1.0;
  const std::optional<int> hours = TakeAfter(sign < 0.0 ? '-' : '+', text, 2);
  if (text.starts_with(':')) {
    text.remove_prefix(1);
  }
  const std::optional<int> minutes = TakeDigits(text, 2);
  if (!hours || !minutes || *hours > 14 || *minutes > 59 || !text.empty()) {
    return std::nullopt;
  }
  return sign * (*hours * 3600.0 + *minutes * 60.0);
}

}  // namespace

std::optional<double> ParseDateTime(std::string_view text) {
  const std::optional<int> year = TakeDigits(text, 4);
  const std::optional<int> month = TakeAfter('-', text, 2);
  const std::optional<int> day = TakeAfter('-', text, 2);
  const std::optional<int> hour = TakeAfter('T', text, 2);
  const std::optional<int> minute = TakeAfter(':', text, 2);
  if (!year || !month || !day || !hour || !minute || *hour > 23 || *minute > 59 ||
      *year < kFirstYear || *year > kLastYear) {
    return std::nullopt;
  }
  const std::optional<double> seconds = TakeSeconds(text);
  const std::optional<double> offset_s = OffsetS(text);
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  if (!seconds || !offset_s || !date.ok()) {
    return std::nullopt;
  }
  const auto num_days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<double>(num_days) * kSecondsPerDay + *hour * 3600.0 + *minute * 60.0 +
         *seconds - *offset_s;
}

SunPosition SunAt(double unix_time_s, double latitude_rad, double longitude_rad) {
  // Days and Julian centuries since 2000-01-01 12:00.
  const double universal_days = unix_time_s / kSecondsPerDay - 10957.5;
  const double t = (universal_days + kTerrestrialLeadS / kSecondsPerDay) / 36525.0;

  // Meeus, chapter 25; angles in degrees until the end of this block.
  const double mean_longitude_deg = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly_rad = RadFromDeg(357.52911 + t * (35999.05029 - t * 0.0001537));
  const double centre_deg = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly_rad) +
                            (0.019993 - t * 0.000101) * std::sin(2.0 * anomaly_rad) +
                            0.000289 * std::sin(3.0 * anomaly_rad);
  const double node_rad = RadFromDeg(125.04 - 1934.136 * t);
  const double nutation_deg = -0.00478 * std::sin(node_rad);
  const double longitude_of_sun_rad =
      RadFromDeg(mean_longitude_deg + centre_deg - 0.00569 + nutation_deg);
  const double obliquity_rad = RadFromDeg(23.439291 - 0.0130042 * t + 0.00256 * std::cos(node_rad));
  const double right_ascension_rad = std::atan2(
      std::cos(obliquity_rad) * std::sin(longitude_of_sun_rad), std::cos(longitude_of_sun_rad));
  const double declination_rad =
      std::asin(std::sin(obliquity_rad) * std::sin(longitude_of_sun_rad));

  // Meeus, equation 12.4, with the nutation; chapter 13.
  const double sidereal_rad =
      RadFromDeg(280.46061837 + std::fmod(360.98564736629 * universal_days, 360.0) +
                 0.000387933 * t * t + nutation_deg * std::cos(obliquity_rad));
  const double hour_angle_rad = sidereal_rad + longitude_rad - right_ascension_rad;
  const double true_elevation_rad =
      std::asin(std::sin(latitude_rad) * std::sin(declination_rad) +
                std::cos(latitude_rad) * std::cos(declination_rad) * std::cos(hour_angle_rad));
  const double azimuth_from_south_rad =
      std::atan2(std::sin(hour_angle_rad) * std::cos(declination_rad),
                 std::cos(hour_angle_rad) * std::sin(latitude_rad) * std::cos(declination_rad) -
                     std::sin(declination_rad) * std::cos(latitude_rad));

  // The sun's parallax is 8.794 seconds of arc. Refraction is good down to just below the horizon.
  const double elevation_deg =
      DegFromRad(true_elevation_rad) - 8.794 / 3600.0 * std::cos(true_elevation_rad);
  const double refraction_deg =
      elevation_deg < -1.0
          ? 0.0
          : std::max(
                0.0,
                1.02 / 60.0 / std::tan(RadFromDeg(elevation_deg + 10.3 / (elevation_deg + 5.11))));
  const double turn = 0.5 + 0.5 * std::numbers::inv_pi * azimuth_from_south_rad;
  return {RadFromDeg(elevation_deg + refraction_deg),
          2.0 * std::numbers::pi * (turn - std::floor(turn))};
}

}  // namespace pfseq
