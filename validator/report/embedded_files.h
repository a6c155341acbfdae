// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace pfseq {

/// The text of a file that is part of the program, by its path in the repository; the build puts it
/// there (CMakeLists.txt, pfseq_embed). Asking for another one is a broken invariant.
std::string_view EmbeddedFile(std::string_view path);

}  // namespace pfseq
