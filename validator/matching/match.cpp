// SPDX-License-Identifier: Apache-2.0
#include "validator/matching/match.h"

#include <mutex>

#include <opencv2/flann/miniflann.hpp>
#include <opencv2/flann/random.h>

namespace pfseq {
namespace {

constexpr unsigned kFlannSeed = 2014;

bool Contains(const std::vector<bool>& classes, const ClassedDescriptors& set, size_t row) {
  return classes[set.row_class[row]];
}

cv::Mat FloatRows(const Descriptors& descriptors, const std::vector<int>& rows) {
  cv::Mat floats(static_cast<int>(rows.size()), descriptors.rows.cols, CV_32F);
  for (size_t i = 0; i < rows.size(); ++i) {
    cv::Mat row = floats.row(static_cast<int>(i));
    descriptors.rows.row(rows[i]).convertTo(row, CV_32F);
  }
  return floats;
}

}  // namespace

Nearest SubsetNeighbours::OfFirst(int row) const {
  Nearest nearest;
  for (size_t c = 0; c < second_classes.size(); ++c) {
    if (second_classes[c]) {
      nearest = Merge(nearest, tables->of_first[c][row]);
    }
  }
  return nearest;
}

Nearest SubsetNeighbours::OfSecond(int row) const {
  Nearest nearest;
  for (size_t c = 0; c < first_classes.size(); ++c) {
    if (first_classes[c]) {
      nearest = Merge(nearest, tables->of_second[c][row]);
    }
  }
  return nearest;
}

std::vector<RowMatch> CrossCheckedMatches(const SubsetNeighbours& neighbours) {
  std::vector<RowMatch> matches;
  const std::vector<int>& row_class = neighbours.first->row_class;
  for (size_t i = 0; i < row_class.size(); ++i) {
    if (Contains(neighbours.first_classes, *neighbours.first, i)) {
      const int row = static_cast<int>(i);
      const int second = neighbours.OfFirst(row).idx;
      if (second >= 0 && neighbours.OfSecond(second).idx == row) {
        matches.push_back({row, second});
      }
    }
  }
  return matches;
}

std::vector<RowMatch> RatioMatches(const SubsetNeighbours& neighbours, double ratio) {
  std::vector<RowMatch> matches;
  const std::vector<int>& row_class = neighbours.first->row_class;
  const Descriptors& descriptors = *neighbours.first->descriptors;
  for (size_t i = 0; i < row_class.size(); ++i) {
    if (Contains(neighbours.first_classes, *neighbours.first, i)) {
      const Nearest nearest = neighbours.OfFirst(static_cast<int>(i));
      if (nearest.second_key != std::numeric_limits<int32_t>::max() &&
          DistanceFromKey(descriptors, nearest.key) <
              ratio * DistanceFromKey(descriptors, nearest.second_key)) {
        matches.push_back({static_cast<int>(i), nearest.idx});
      }
    }
  }
  return matches;
}

std::vector<RowMatch> FlannMatches(const Descriptors& first,
                                   const std::vector<int>& first_rows,
                                   const Descriptors& second,
                                   const std::vector<int>& second_rows,
                                   const FlannSetting& setting) {
  std::vector<RowMatch> matches;
  if (first_rows.empty() || second_rows.size() < 2) {
    return matches;
  }
  cv::Mat idx, squared;
  {
    // Its random numbers are the program's: one tree at a time.
    static std::mutex mutex;
    const cv::Mat train = FloatRows(second, second_rows);
    cv::flann::Index index;
    {
      const std::lock_guard lock(mutex);
      cvflann::seed_random(kFlannSeed);
      cv::theRNG().state = kFlannSeed;
      index.build(train, cv::flann::KDTreeIndexParams(setting.trees), cvflann::FLANN_DIST_L2);
    }
    index.knnSearch(
        FloatRows(first, first_rows), idx, squared, 2, cv::flann::SearchParams(setting.checks));
  }
  for (int i = 0; i < idx.rows; ++i) {
    const double nearest = squared.at<float>(i, 0);
    const double second_nearest = squared.at<float>(i, 1);
    if (idx.at<int>(i, 0) >= 0 && idx.at<int>(i, 1) >= 0 &&
        nearest < setting.ratio * setting.ratio * second_nearest) {
      matches.push_back({first_rows[i], second_rows[idx.at<int>(i, 0)]});
    }
  }
  return matches;
}

}  // namespace pfseq
