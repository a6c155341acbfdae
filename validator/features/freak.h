// SPDX-License-Identifier: Apache-2.0
// FREAK: Alahi, Ortiz, Vandergheynst, "FREAK: Fast retina keypoint" (CVPR 2012).
//
// 43 receptive fields: seven rings of six, each ring turned by 30 degrees against the next, and one
// in the centre. In units of patternScale the rings' radii go from 2/3 down to 1/12 in steps of 6,
// 5, 4, 3, 2 and 1 parts of 21; a field's radius is half its ring's (of the centre as of the
// innermost). A field's value is the image's mean over a square of that radius.
//
// Scale: the pattern grows by 2^(nOctaves i / 64), i = 0 ... 63, with the key point's size; i = 0
// is a size of 7 pixels. Orientation (eq. 3): the sum over 45 symmetric pairs of fields of their
// difference times the unit vector between them; in 256 steps. Descriptor (eq. 1 and 2): 512 bits,
// each tells which of a pair of fields is brighter; the pairs were chosen by variance and
// correlation on images of our own (freak_training.h).
#pragma once

#include "validator/features/features.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfseq {

struct FreakSetting {
  bool orientation_normalized = true;
  /// Without: all points as if of size 21 pixels.
  bool scale_normalized = true;
  double pattern_scale = 22.0;
  int num_octaves = 4;
};

inline constexpr int kNumFreakFields = 43;
inline constexpr int kNumFreakPairs = 512;

/// Two receptive fields, numbered ring by ring from outside, the centre last.
struct FreakPair {
  uint8_t first = 0;
  uint8_t second = 0;
};

/// The chosen pairs, from coarse to fine as their choice made them.
extern const std::array<FreakPair, kNumFreakPairs> kFreakPairs;

/// The values of the 43 fields around each point, and the point's orientation.
class FreakSampler {
 public:
  /// 8-bit grey.
  FreakSampler(const cv::Mat& grey, const FreakSetting& setting);

  /// Whether the pattern around a point lies within the image.
  bool Fits(const cv::KeyPoint& point) const;

  struct Sample {
    std::array<float, kNumFreakFields> fields;
    /// In [0, 360), as OpenCV counts: clockwise in the image from the x axis.
    float angle_deg = 0.0F;
  };
  /// For a point that fits.
  Sample At(const cv::KeyPoint& point) const;

 private:
  int ScaleOf(const cv::KeyPoint& point) const;
  void ReadFields(const cv::KeyPoint& point, int orientation, Sample& sample) const;
  float Field(double x, double y, double radius) const;

  cv::Mat grey_;
  cv::Mat sums_;
  FreakSetting setting_;
  /// [orientation][field], unit pattern.
  std::vector<std::array<cv::Point2d, kNumFreakFields>> turned_;
};

/// Descriptors of 64 bytes; points whose pattern leaves the image are left out.
Descriptors DescribeFreak(const cv::Mat& grey,
                          const KeyPoints& points,
                          const FreakSetting& setting);

}  // namespace pfseq
