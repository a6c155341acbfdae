// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/report/result_set.h"
#include "validator/study/study_plan.h"

#include <string>
#include <vector>

namespace pfseq {

/// A view at a level of a factor, the others at their base, in the first repetition.
struct StudyPicture {
  size_t factor_idx = 0;
  size_t level_idx = 0;
  /// "front 24", with the lens where there are several.
  std::string view;
  /// The whole image, reduced, and a detail in the image's own pixels, as data: addresses.
  std::string whole;
  std::string detail;
  int detail_px = 0;
};

/// Of the first views of at most three pairs. Details lie where the base's picture has the
/// strongest edges, at the same pixels for all levels. What is missing gets a remark.
std::vector<StudyPicture> MakeStudyPictures(const StudySpec& study,
                                            const std::vector<StudyVariant>& variants,
                                            const ResultSet& results,
                                            std::vector<std::string>& remarks);

}  // namespace pfseq
