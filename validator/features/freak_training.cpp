// SPDX-License-Identifier: Apache-2.0
#include "validator/features/freak_training.h"

#include "renderer/core/error.h"
#include "validator/features/detect.h"
#include "validator/features/freak.h"
#include "validator/features/work_image.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr size_t kMinPoints = 1000;
constexpr double kFirstCorrelation = 0.2;
constexpr double kCorrelationStep = 0.02;

/// One pair of fields over all key points, as a string of bits.
struct Column {
  std::array<int, 2> pair = {};
  std::vector<uint64_t> bits;
  double mean = 0.0;
};

std::vector<Column> AllPairs() {
  std::vector<Column> columns;
  for (int first = 1; first < kNumFreakFields; ++first) {
    for (int second = 0; second < first; ++second) {
      columns.push_back({{first, second}, {}, 0.0});
    }
  }
  return columns;
}

void AddPoint(const FreakSampler::Sample& sample, size_t point, std::vector<Column>& columns) {
  for (Column& column : columns) {
    if (point % 64 == 0) {
      column.bits.push_back(0);
    }
    const uint64_t bit =
        sample.fields[column.pair[0]] > sample.fields[column.pair[1]] ? uint64_t{1} : uint64_t{0};
    column.bits.back() |= bit << (point % 64);
    column.mean += static_cast<double>(bit);
  }
}

/// Pearson's correlation of two columns of bits.
double Correlation(const Column& a, const Column& b, size_t num_points) {
  size_t both = 0;
  for (size_t i = 0; i < a.bits.size(); ++i) {
    both += static_cast<size_t>(std::popcount(a.bits[i] & b.bits[i]));
  }
  const double covariance =
      static_cast<double>(both) / static_cast<double>(num_points) - a.mean * b.mean;
  const double variances = a.mean * (1.0 - a.mean) * b.mean * (1.0 - b.mean);
  return variances > 0.0 ? covariance / std::sqrt(variances) : 1.0;
}

std::vector<std::array<int, 2>> Choose(const std::vector<Column>& columns,
                                       size_t num_points,
                                       double max_correlation) {
  std::vector<const Column*> chosen;
  for (const Column& column : columns) {
    if (chosen.size() == kNumFreakPairs) {
      break;
    }
    if (std::all_of(chosen.begin(), chosen.end(), [&](const Column* other) {
          return std::abs(Correlation(column, *other, num_points)) < max_correlation;
        })) {
      chosen.push_back(&column);
    }
  }
  std::vector<std::array<int, 2>> pairs;
  for (const Column* column : chosen) {
    pairs.push_back(column->pair);
  }
  return pairs;
}

}  // namespace

FreakTraining ChooseFreakPairs(const std::vector<Image<uint8_t>>& images) {
  std::vector<Column> columns = AllPairs();
  FreakTraining training;
  for (const Image<uint8_t>& image : images) {
    const cv::Mat grey = GreyOf(image);
    const FreakSampler sampler(grey, {});
    for (const char* name : {"SIFT nopol 0.04 10.0 1.6", "FAST nopol 20"}) {
      for (const cv::KeyPoint& point : Detect(grey, ParseName(name).detector.setting)) {
        if (sampler.Fits(point)) {
          AddPoint(sampler.At(point), training.num_points++, columns);
        }
      }
    }
  }
  if (training.num_points < kMinPoints) {
    throw InputError("FREAK's pairs: expected at least {} key points in the images, got {}",
                     kMinPoints,
                     training.num_points);
  }
  for (Column& column : columns) {
    column.mean /= static_cast<double>(training.num_points);
  }
  std::stable_sort(columns.begin(), columns.end(), [](const Column& a, const Column& b) {
    return std::abs(a.mean - 0.5) < std::abs(b.mean - 0.5);
  });
  for (training.max_correlation = kFirstCorrelation; training.pairs.size() < kNumFreakPairs;
       training.max_correlation += kCorrelationStep) {
    training.pairs = Choose(columns, training.num_points, training.max_correlation);
    if (training.pairs.size() == kNumFreakPairs) {
      break;
    }
  }
  return training;
}

std::string FreakPairsSource(const FreakTraining& training, const std::string& provenance) {
  std::string text = fmt::format(
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// Written by choose_freak_pairs (tools/freak_pairs): {} key points, correlation below {:.2f}.\n"
      "// Images: {}\n"
      "#include \"validator/features/freak.h\"\n\nnamespace pfseq {{\n\n// clang-format off\n"
      "const std::array<FreakPair, kNumFreakPairs> kFreakPairs = {{{{\n",
      training.num_points,
      training.max_correlation,
      provenance);
  for (size_t i = 0; i < training.pairs.size(); ++i) {
    text += fmt::format("{}{{{}, {}}},{}",
                        i % 10 == 0 ? "    " : " ",
                        training.pairs[i][0],
                        training.pairs[i][1],
                        i % 10 == 9 || i + 1 == training.pairs.size() ? "\n" : "");
  }
  return text + "}};\n// clang-format on\n\n}  // namespace pfseq\n";
}

}  // namespace pfseq
