// SPDX-License-Identifier: Apache-2.0
// Whole files, read and written in one go. A reader never sees half a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pfseq {

/// Suffix of the temporary name under which a file is written before it is renamed.
inline constexpr std::string_view kPartialSuffix = ".partial";

/// The file's bytes. InputError when it is missing or cannot be read.
std::string ReadFile(const std::filesystem::path& path);

/// Writes under a temporary name in the same folder, then renames; folders on the way are made. On
/// failure the temporary file is removed, nothing under the final name changes, and SystemError
/// tells path and reason.
void WriteFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

/// SHA-256 as 64 lower-case hexadecimal digits.
std::string Sha256Hex(std::string_view bytes);

/// SHA-256 of a file, read in blocks. InputError when it cannot be read.
std::string Sha256HexOfFile(const std::filesystem::path& path);

}  // namespace pfseq
