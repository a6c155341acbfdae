// SPDX-License-Identifier: Apache-2.0
// A small sequence on disk for the checks that look into images.
#pragma once

#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/test_sequence.h"
#include "validator/checks/check_context.h"
#include "validator/checks/completeness_check.h"

#include <functional>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace pfseq {

class ViewFixture : public testing::Test {
 protected:
  static constexpr int kSizePx = 48;

  ViewFixture() : sequence_(TestSequence::Yard(kSizePx)), ray_scene_(sequence_.scene) {
    sequence_.Write(folder_.Path());
  }

  /// Runs one check on what is on disk.
  template <typename CheckFunction>
  CheckReport Check(const CheckFunction& check, int num_threads = 1) const {
    const SequenceReader reader(folder_.Path());
    CheckReport ignored;
    CheckContext context{reader, &ray_scene_, CheckCompleteness(reader, ignored), {}};
    context.options.num_threads = num_threads;
    context.options.quiet = true;
    CheckReport report;
    check(context, report);
    return report;
  }

  std::filesystem::path PathOf(const std::string& lens,
                               const std::string& camera,
                               Output output,
                               int frame) const {
    return ViewPath(folder_.Path(), lens, camera, output, frame);
  }

  void EditDistance(const std::filesystem::path& path,
                    const std::function<void(Image<float>& distance_m)>& change) const {
    Image<float> distance_m = ReadExr(path);
    change(distance_m);
    WriteFileAtomically(path, std::span<const std::byte>(EncodeExrFloat(distance_m)));
  }

  void EditSky(const std::filesystem::path& path,
               const std::function<void(Image<uint8_t>& sky)>& change) const {
    Image<uint8_t> sky = ReadImage8(path);
    change(sky);
    WriteFileAtomically(path, std::span<const std::byte>(EncodePng(sky)));
  }

  TempFolder folder_;
  TestSequence sequence_;
  RayScene ray_scene_;
};

}  // namespace pfseq
