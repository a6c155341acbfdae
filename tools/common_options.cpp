// SPDX-License-Identifier: Apache-2.0
#include "tools/common_options.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/parse_number.h"
#include "renderer/sequence/sequence_schema.h"
#include "tools/sequence_input.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr int kMaxThreads = 1024;

[[noreturn]] void FailFrames(const std::string& text) {
  throw InputError("--frames {}: expected numbers or START:STOP[:STEP], separated by commas", text);
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const size_t position = text.find(separator);
    parts.push_back(text.substr(0, position));
    if (position == std::string_view::npos) {
      return parts;
    }
    text.remove_prefix(position + 1);
  }
}

}  // namespace

std::string CommandLine() {
  // Words end with zero bytes (proc(5)).
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(file, word, '\0');) {
    if (text.empty()) {
      text = std::filesystem::path(word).filename().string();
      continue;
    }
    const bool is_plain =
        !word.empty() && word.find_first_of(" \t\n\"'\\$&;|<>()*?#") == std::string::npos;
    text += is_plain ? " " + word : fmt::format(" '{}'", word);
  }
  return text;
}

void AddRunFlags(CLI::App& command, RunFlags& flags) {
  flags.num_threads = NumHardwareThreads();
  command
      .add_option("--threads", flags.num_threads, "Number of threads; results do not depend on it")
      ->check(CLI::Range(1, kMaxThreads))
      ->capture_default_str();
  command.add_flag("--quiet", flags.quiet, "No progress");
}

void AddSelectionFlags(CLI::App& command, SelectionFlags& flags) {
  command.add_option("--frames",
                     flags.frames,
                     "Frames: 0,24,40 or START:STOP[:STEP], STOP not included (default: all)");
  command.add_option("--cameras", flags.cameras, "Cameras, separated by commas (default: all)")
      ->delimiter(',');
  command.add_option("--lenses", flags.lenses, "Lenses, separated by commas (default: all)")
      ->delimiter(',');
}

void AddDescriptionFlags(CLI::App& command, DescriptionFlags& flags) {
  command.add_option("SEQUENCE.yaml", flags.path, "Description of the sequence")->required();
  command
      .add_option("--set",
                  flags.overrides,
                  "Sets a key of the description, for example image.size_px=300; repeatable")
      ->type_name("KEY=VALUE")
      ->take_all();
}

std::vector<int> ParseFrames(const std::string& text) {
  std::vector<int> frames;
  if (text.empty()) {
    return frames;
  }
  constexpr int kMaxFrame = 1'000'000;
  const auto number = [&](std::string_view part) {
    int value = -1;
    const auto [last, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || last != part.data() + part.size() || value < 0 ||
        value > kMaxFrame) {
      FailFrames(text);
    }
    return value;
  };
  for (const std::string_view item : Split(text, ',')) {
    const std::vector<std::string_view> parts = Split(item, ':');
    if (parts.size() > 3) {
      FailFrames(text);
    }
    const int start = number(parts[0]);
    const int stop = parts.size() > 1 ? number(parts[1]) : start + 1;
    const int step = parts.size() > 2 ? number(parts[2]) : 1;
    if (step < 1 || stop <= start) {
      FailFrames(text);
    }
    for (int frame = start; frame < stop; frame += step) {
      frames.push_back(frame);
    }
  }
  return frames;
}

SequenceInput LoadSequenceInput(const DescriptionFlags& flags) {
  return LoadSequenceInput(ReadSequenceSpec(flags.path, flags.overrides));
}

std::pair<int, int> ParseShard(const std::string& text) {
  const size_t slash = std::min(text.find('/'), text.size());
  const int shard = ParseNumber<int>(text.substr(0, slash)).value_or(-1);
  const int count = ParseNumber<int>(text.substr(std::min(slash + 1, text.size()))).value_or(0);
  if (shard < 0 || count <= shard) {
    throw InputError("--shard {}: expected I/N with I from 0 to N - 1", text);
  }
  return {shard, count};
}

std::string DefaultLightCache() {
  for (const auto& [variable, below] :
       {std::pair("XDG_CACHE_HOME", "pfseq/light"), std::pair("HOME", ".cache/pfseq/light")}) {
    const char* folder = std::getenv(variable);
    if (folder != nullptr && *folder != '\0') {
      return (std::filesystem::path(folder) / below).string();
    }
  }
  return {};
}

void AddLightFlags(CLI::App& command, LightFlags& flags) {
  command
      .add_option("--light-cache",
                  flags.cache,
                  "Folder where computed light is kept for later runs; none: keep it nowhere")
      ->capture_default_str();
  command
      .add_option("--light-memory",
                  flags.memory_mib,
                  "Memory for computed light in MiB; what does not fit is computed again and again")
      ->check(CLI::Range(16, 1 << 20))
      ->capture_default_str();
}

LightCacheOptions LightFlags::Options() const {
  return {cache == "none" ? "" : cache, int64_t{memory_mib} << 20};
}

}  // namespace pfseq
