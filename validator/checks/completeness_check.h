// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/sequence/sequence_reader.h"
#include "validator/checks/check_context.h"
#include "validator/checks/check_report.h"

#include <vector>

namespace pfseq {

/// The views on disk, by lens, camera and frame. Tells files of lenses, cameras and frames that the
/// sequence does not have (faults), and frames that lack some of the files that others have
/// (notes).
std::vector<CheckedView> CheckCompleteness(const SequenceReader& reader, CheckReport& report);

}  // namespace pfseq
