// SPDX-License-Identifier: Apache-2.0
#include "validator/features/censure.h"

#include "renderer/core/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace pfseq {
namespace {

constexpr int kInnerSizes[] = {1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64};
/// Line tests look at (2 k + 1)^2 places.
constexpr int kLineReach = 4;

int DiamondReach(int size) { return size + size / 2; }
/// No star reaches further from its centre.
int StarReach(int size) { return DiamondReach(size); }
int StarArea(int size) {
  const int side = 2 * size + 1;
  const int reach = DiamondReach(size);
  return side * side + 2 * reach * (reach + 1) + 1;
}

/// Sums of an image over squares and diagonals in constant time.
class ImageSums {
 public:
  explicit ImageSums(const cv::Mat& grey) : width_(grey.cols), height_(grey.rows) {
    const size_t size = static_cast<size_t>(width_ + 1) * (height_ + 1);
    box_.assign(size, 0);
    falling_.assign(static_cast<size_t>(width_ + 2) * (height_ + 1), 0);
    rising_.assign(static_cast<size_t>(width_ + 2) * (height_ + 1), 0);
    for (int y = 0; y < height_; ++y) {
      const uint8_t* row = grey.ptr<uint8_t>(y);
      int32_t in_row = 0;
      for (int x = 0; x < width_; ++x) {
        in_row += row[x];
        Box(x + 1, y + 1) = Box(x + 1, y) + in_row;
        Falling(x + 1, y + 1) = Falling(x, y) + row[x];
        Rising(x + 1, y + 1) = Rising(x + 2, y) + row[x];
      }
    }
  }

  int WidthPx() const { return width_; }
  int HeightPx() const { return height_; }

  /// Sums over the stars of a size at all places where the star fits; 0 elsewhere.
  std::vector<int32_t> Stars(int size) const {
    std::vector<int32_t> sums(static_cast<size_t>(width_) * height_, 0);
    const int reach = StarReach(size);
    if (width_ <= 2 * reach || height_ <= 2 * reach) {
      return sums;
    }
    for (int y = reach; y < height_ - reach; ++y) {
      int32_t diamond = FirstDiamond(reach, y, reach);
      for (int x = reach; x < width_ - reach; ++x) {
        const int32_t square = Box(x + size + 1, y + size + 1) - Box(x - size, y + size + 1) -
                               Box(x + size + 1, y - size) + Box(x - size, y - size);
        sums[static_cast<size_t>(y) * width_ + x] = square + diamond;
        if (x + 1 < width_ - reach) {
          diamond += NextDiamond(x, y, reach);
        }
      }
    }
    return sums;
  }

 private:
  int32_t& Box(int x, int y) { return box_[static_cast<size_t>(y) * (width_ + 1) + x]; }
  int32_t Box(int x, int y) const { return box_[static_cast<size_t>(y) * (width_ + 1) + x]; }
  /// Sum of (x - 1, y - 1), (x - 2, y - 2), ...
  int32_t& Falling(int x, int y) { return falling_[static_cast<size_t>(y) * (width_ + 2) + x]; }
  int32_t Falling(int x, int y) const {
    return falling_[static_cast<size_t>(y) * (width_ + 2) + x];
  }
  /// Sum of (x - 1, y - 1), (x, y - 2), (x + 1, y - 3), ...
  int32_t& Rising(int x, int y) { return rising_[static_cast<size_t>(y) * (width_ + 2) + x]; }
  int32_t Rising(int x, int y) const { return rising_[static_cast<size_t>(y) * (width_ + 2) + x]; }

  /// Sum of the pixels with |dx| + |dy| <= reach, row by row.
  int32_t FirstDiamond(int x, int y, int reach) const {
    int32_t sum = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      const int half = reach - std::abs(dy);
      sum += Box(x + half + 1, y + dy + 1) - Box(x - half, y + dy + 1) - Box(x + half + 1, y + dy) +
             Box(x - half, y + dy);
    }
    return sum;
  }

  /// What the diamond at x + 1 has more than that at x: its right edges, less the left ones of the
  /// old.
  int32_t NextDiamond(int x, int y, int reach) const {
    // Pixels of a falling diagonal from (x, y) - (n - 1) (1, 1) to (x, y); rising likewise.
    const auto falling = [&](int to_x, int to_y, int n) {
      return Falling(to_x + 1, to_y + 1) - Falling(to_x + 1 - n, to_y + 1 - n);
    };
    const auto rising = [&](int from_x, int from_y, int n) {
      return Rising(from_x + 1, from_y + 1) - Rising(from_x + 1 + n, from_y + 1 - n);
    };
    const int32_t right = falling(x + reach + 1, y, reach + 1) + rising(x + 1, y + reach, reach);
    const int32_t left = falling(x, y + reach, reach + 1) + rising(x - reach + 1, y - 1, reach);
    return right - left;
  }

  int width_;
  int height_;
  std::vector<int32_t> box_;
  std::vector<int32_t> falling_;
  std::vector<int32_t> rising_;
};

/// The strongest response of each pixel over the scales so far, and at which scale.
struct ResponseMap {
  int width = 0;
  int height = 0;
  std::vector<float> response;
  /// Number of the scale, counted from 1; negative with a negative response; 0: none.
  std::vector<int8_t> scale;

  float Response(int x, int y) const { return response[static_cast<size_t>(y) * width + x]; }
  int Scale(int x, int y) const { return scale[static_cast<size_t>(y) * width + x]; }
};

void AddScale(const std::vector<int32_t>& inner,
              const std::vector<int32_t>& outer,
              int size,
              int scale_number,
              ResponseMap& map) {
  const float inner_weight = 1.0F / static_cast<float>(StarArea(size));
  const float ring_weight = 1.0F / static_cast<float>(StarArea(2 * size) - StarArea(size));
  const int reach = StarReach(2 * size);
  for (int y = reach; y < map.height - reach; ++y) {
    for (int x = reach; x < map.width - reach; ++x) {
      const size_t i = static_cast<size_t>(y) * map.width + x;
      const float response = static_cast<float>(inner[i]) * inner_weight -
                             static_cast<float>(outer[i] - inner[i]) * ring_weight;
      if (std::abs(response) > std::abs(map.response[i])) {
        map.response[i] = response;
        map.scale[i] = static_cast<int8_t>(response > 0.0F ? scale_number : -scale_number);
      }
    }
  }
}

/// The widest window, 2 r + 1 pixels and at most 2 max + 1, in which a pixel is the extremum of its
/// sign; -1 when a direct neighbour outdoes it. Of equal responses the first in the order of rows
/// wins.
int ExtremumReach(const ResponseMap& map, int x, int y, int max_reach) {
  const float response = map.Response(x, y);
  const float sign = response > 0.0F ? 1.0F : -1.0F;
  const float magnitude = std::abs(response);
  const auto beats = [&](int other_x, int other_y) {
    if (other_x < 0 || other_x >= map.width || other_y < 0 || other_y >= map.height) {
      return false;
    }
    const float other = sign * map.Response(other_x, other_y);
    return other > magnitude ||
           (other == magnitude && (other_y < y || (other_y == y && other_x < x)));
  };
  for (int reach = 1; reach <= max_reach; ++reach) {
    for (int i = -reach; i <= reach; ++i) {
      if (beats(x + i, y - reach) || beats(x + i, y + reach) || beats(x - reach, y + i) ||
          beats(x + reach, y + i)) {
        return reach - 1;
      }
    }
  }
  return max_reach;
}

/// A second moment matrix of gradients.
struct SecondMoments {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;

  void Add(double gx, double gy) {
    xx += gx * gx;
    xy += gx * gy;
    yy += gy * gy;
  }

  bool IsLine(int threshold) const {
    const double trace = xx + yy;
    return trace * trace >= threshold * (xx * yy - xy * xy);
  }
};

struct LineMoments {
  SecondMoments projected;
  SecondMoments binarized;
};

LineMoments MomentsAround(const ResponseMap& map, int x, int y, int outer_size) {
  const int step = std::max(1, outer_size / 4);
  const int scale = map.Scale(x, y);
  const auto clamp_x = [&](int value) { return std::clamp(value, 0, map.width - 1); };
  const auto clamp_y = [&](int value) { return std::clamp(value, 0, map.height - 1); };
  LineMoments moments;
  for (int j = -kLineReach; j <= kLineReach; ++j) {
    for (int i = -kLineReach; i <= kLineReach; ++i) {
      const int at_x = x + i * step;
      const int at_y = y + j * step;
      const int left = clamp_x(at_x - step), right = clamp_x(at_x + step);
      const int up = clamp_y(at_y - step), down = clamp_y(at_y + step);
      const int here_x = clamp_x(at_x), here_y = clamp_y(at_y);
      moments.projected.Add(map.Response(right, here_y) - map.Response(left, here_y),
                            map.Response(here_x, down) - map.Response(here_x, up));
      const auto is_same = [&](int px, int py) { return map.Scale(px, py) == scale ? 1 : 0; };
      moments.binarized.Add(is_same(right, here_y) - is_same(left, here_y),
                            is_same(here_x, down) - is_same(here_x, up));
    }
  }
  return moments;
}

/// `num_scales`: how many the map has seen.
KeyPoints PointsOf(const ResponseMap& map, int num_scales, const CensureSetting& setting) {
  KeyPoints points;
  const int reach = setting.suppress_nonmax_size / 2;
  const auto threshold = static_cast<float>(std::max(setting.response_threshold, 0));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float magnitude = std::abs(map.Response(x, y));
      const int scale_number = std::abs(map.Scale(x, y));
      const bool is_inner_scale = scale_number > 1 && scale_number < num_scales;
      if (magnitude < threshold || !is_inner_scale || ExtremumReach(map, x, y, reach) < reach) {
        continue;
      }
      const int outer_size = 2 * kInnerSizes[scale_number - 1];
      const LineMoments moments = MomentsAround(map, x, y, outer_size);
      if (moments.projected.IsLine(setting.line_threshold_projected) ||
          moments.binarized.IsLine(setting.line_threshold_binarized)) {
        continue;
      }
      points.emplace_back(static_cast<float>(x),
                          static_cast<float>(y),
                          static_cast<float>(outer_size),
                          -1.0F,
                          magnitude);
    }
  }
  return points;
}

}  // namespace

KeyPoints DetectCensure(const cv::Mat& grey, const CensureSetting& setting) {
  return DetectCensure(grey, std::vector<CensureSetting>{setting}).front();
}

std::vector<KeyPoints> DetectCensure(const cv::Mat& grey,
                                     const std::vector<CensureSetting>& settings) {
  PFSEQ_CHECK(grey.type() == CV_8UC1, "type {}", grey.type());
  std::vector<KeyPoints> points(settings.size());
  if (grey.empty()) {
    return points;
  }
  int max_size = 0;
  for (const CensureSetting& setting : settings) {
    max_size = std::max(max_size, setting.max_size);
  }
  const ImageSums sums(grey);
  std::map<int, std::vector<int32_t>> stars;
  const auto star = [&](int size) -> const std::vector<int32_t>& {
    auto found = stars.find(size);
    if (found == stars.end()) {
      found = stars.emplace(size, sums.Stars(size)).first;
    }
    return found->second;
  };
  const size_t num_pixels = static_cast<size_t>(grey.cols) * grey.rows;
  ResponseMap map{grey.cols,
                  grey.rows,
                  std::vector<float>(num_pixels, 0.0F),
                  std::vector<int8_t>(num_pixels, 0)};
  // Scales from small to large: a setting's map is complete when the next scale is beyond its size.
  for (int i = 0; i < static_cast<int>(std::size(kInnerSizes)); ++i) {
    const int size = kInnerSizes[i];
    if (2 * size > max_size) {
      break;
    }
    AddScale(star(size), star(2 * size), size, i + 1, map);
    stars.erase(stars.begin(), stars.upper_bound(size));
    const bool is_last = i + 1 == static_cast<int>(std::size(kInnerSizes));
    for (size_t s = 0; s < settings.size(); ++s) {
      if (2 * size <= settings[s].max_size &&
          (is_last || 2 * kInnerSizes[i + 1] > settings[s].max_size)) {
        points[s] = PointsOf(map, i + 1, settings[s]);
      }
    }
  }
  return points;
}

}  // namespace pfseq
