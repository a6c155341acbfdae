// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/benchmark/benchmark.h"

#include <vector>

namespace pfseq {

/// The variant asked for or, by default, the best one there is.
std::string ChooseVariant(const ViewSource& source, const std::string& wanted);

/// All frames that the text of --pairs names, ascending. InputError when it is not of that form.
std::vector<int> FramesOfPairs(const std::string& pairs);

/// The pairs of views that the options ask for, lens by lens. InputError when a view has no image.
std::vector<PairOfViews> ChoosePairs(const ViewSource& source,
                                     const std::string& variant,
                                     const BenchmarkOptions& options);

}  // namespace pfseq
