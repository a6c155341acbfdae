// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/cached_light.h"
#include "renderer/lens/camera_rig.h"
#include "renderer/sequence/rig_file.h"
#include "renderer/sequence/sequence_spec.h"
#include "renderer/sequence/sequence_writer.h"
#include "renderer/trace/lighting.h"
#include "renderer/trace/scene.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pfseq {

class LitScene;

/// What to render of a sequence and how. Empty selections mean all.
struct RenderOptions {
  std::filesystem::path folder;
  std::vector<int> frames;
  std::vector<std::string> cameras;
  std::vector<std::string> lenses;
  /// Empty: clean, distance and sky, and realistic where the description turns on a shutter,
  /// optics or a sensor.
  std::vector<Output> outputs;
  OnExisting on_existing = OnExisting::kRefuse;
  /// This run takes each num_shards-th record (frame, camera, lens), starting with shard_idx.
  int shard_idx = 0;
  int num_shards = 1;
  int num_threads = 1;
  bool quiet = false;
  LightCacheOptions light_cache;
  /// A finished sequence of which these outputs would be the same bytes, and perhaps the scene:
  /// they are linked (copied where the disk has no links), not rendered.
  std::filesystem::path sibling;
  std::vector<Output> sibling_outputs;
};

/// A description with all that it refers to.
struct SequenceInput {
  SequenceSpec spec;
  std::shared_ptr<const Scene> scene;
  /// The description's light in the scene.
  std::shared_ptr<const Lighting> lighting;
  /// Files of the description, written first: sequence.yaml, scene.glb, copies of input files.
  std::vector<DescriptionFile> files;
  /// That of another input with the same LitSceneKey, or null: one is made for the run.
  std::shared_ptr<LitScene> lit_scene;
};

struct RenderSummary {
  int num_records = 0;
  int num_files_written = 0;
  int num_files_kept = 0;
  bool is_complete = false;
};

/// The calibration that a description stands for.
RigFile MakeRigFile(const SequenceSpec& spec);

/// Renders into the folder, record by record; memory does not grow with the number of records. The
/// same description and selection give the same bytes for any number of threads, any split into
/// shards and runs. InputError for a selection that the sequence does not have and for a folder
/// that cannot be used; SystemError when the disk fails.
RenderSummary RenderSequence(const SequenceInput& input, const RenderOptions& options);

/// One pixel of one record as text: radiance with each sample count up to the description's,
/// distance, what it meets.
std::string DescribePixel(const SequenceInput& input, const FrameFile& record, int x, int y);

}  // namespace pfseq
