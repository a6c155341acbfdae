// SPDX-License-Identifier: Apache-2.0
// Flags that several subcommands share, and what they stand for.
#pragma once

#include "renderer/sequence_renderer.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace pfseq {

/// --threads and --quiet.
struct RunFlags {
  int num_threads = 0;
  bool quiet = false;
};
void AddRunFlags(CLI::App& command, RunFlags& flags);

/// The words that this program was started with, as one would type them; the program by its name.
std::string CommandLine();

/// A selection of frames, cameras and lenses; nothing given means all.
struct SelectionFlags {
  std::string frames;
  std::vector<std::string> cameras;
  std::vector<std::string> lenses;
};
void AddSelectionFlags(CLI::App& command, SelectionFlags& flags);

/// SEQUENCE.yaml and --set.
struct DescriptionFlags {
  std::filesystem::path path;
  std::vector<std::string> overrides;
};
void AddDescriptionFlags(CLI::App& command, DescriptionFlags& flags);

/// "I/N" with 0 <= I < N as (I, N). InputError otherwise.
std::pair<int, int> ParseShard(const std::string& text);

/// --light-cache and --light-memory. By default light is kept where programs keep what they can
/// make again (the XDG Base Directory Specification).
std::string DefaultLightCache();
struct LightFlags {
  std::string cache = DefaultLightCache();
  int memory_mib = 4096;

  LightCacheOptions Options() const;
};
void AddLightFlags(CLI::App& command, LightFlags& flags);

/// "0,24,40", "0:64:2" (start:stop:step, stop not included), or a mixture with commas. InputError
/// otherwise.
std::vector<int> ParseFrames(const std::string& text);

/// Reads the description and all that it refers to, and builds its scene.
SequenceInput LoadSequenceInput(const DescriptionFlags& flags);

}  // namespace pfseq
