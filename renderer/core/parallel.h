// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace pfseq {

/// The number of hardware threads, at least 1.
int NumHardwareThreads();

/// Calls body(i) for each i in [0, count) on up to `num_threads` threads, in no particular order;
/// returns when all are done. The first exception thrown by a body is rethrown here, after which no
/// further bodies start. Bodies must not depend on each other: results must be the same for any
/// number of threads.
void ParallelFor(size_t count, int num_threads, const std::function<void(size_t)>& body);

}  // namespace pfseq
