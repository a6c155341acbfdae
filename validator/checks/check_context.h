// SPDX-License-Identifier: Apache-2.0
// What the checks of a sequence's content share.
#pragma once

#include "renderer/sequence/layout.h"
#include "renderer/sequence/sequence_reader.h"
#include "renderer/trace/ray_scene.h"

#include <set>
#include <string>
#include <vector>

namespace pfseq {

struct CheckOptions {
  int num_threads = 1;
  /// No progress lines.
  bool quiet = false;
  /// Every how manieth pixel in x and y is cast again and compared between cameras; 0: so that an
  /// image has some 300 in a row. All other checks look at every pixel.
  int stride_px = 0;
};

/// One frame of one camera through one lens, and which of its files are there.
struct CheckedView {
  std::string lens;
  std::string camera;
  int frame = 0;
  std::set<Output> outputs;

  bool Has(Output output) const { return outputs.contains(output); }
  /// Relative to the sequence's folder.
  std::string File(Output output) const {
    return FrameFile{lens, camera, output, frame}.RelativePath().generic_string();
  }
};

struct CheckContext {
  const SequenceReader& reader;
  /// Nothing when scene.glb cannot be read: what needs rays is left out.
  const RayScene* scene = nullptr;
  /// Those whose lens, camera and pose the sequence knows, by lens, camera and frame.
  std::vector<CheckedView> views;
  CheckOptions options;

  int StridePx() const;
};

}  // namespace pfseq
