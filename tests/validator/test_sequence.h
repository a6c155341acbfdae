// SPDX-License-Identifier: Apache-2.0
// A small sequence on disk that needs no renderer: a yard with open sky and a beam above two
// cameras, cast ray by ray.
#pragma once

#include "renderer/lens/camera_rig.h"
#include "renderer/lens/trajectory.h"
#include "renderer/sequence/layout.h"
#include "renderer/sequence/named.h"
#include "renderer/sequence/rig_file.h"
#include "renderer/trace/ray_scene.h"
#include "renderer/trace/scene.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pfseq {

/// The sequence as values; change them, then write.
struct TestSequence {
  RigFile rig;
  std::vector<StampedPose> poses;
  std::shared_ptr<const Scene> scene;
  /// Frames that get files.
  std::vector<int> frames;
  /// Distances of the pixels are taken here; (0.5, 0.5) is the centre.
  Vec2d sample_px = {0.5, 0.5};

  /// Two cameras and two lenses of DESIGN's rig, four poses that all differ, frames 1 and 3.
  static TestSequence Yard(int size_px);

  /// Writes all files of a finished sequence.
  void Write(const std::filesystem::path& folder) const;

  /// Writes the frame files of one view: a clean image with a texture that sticks to the surfaces,
  /// distances and sky.
  void WriteView(const std::filesystem::path& folder,
                 const RayScene& ray_scene,
                 const RigCamera& camera,
                 const Named<Lens>& lens,
                 int frame) const;
};

/// Makes the manifest fit what is on disk, so that a damage is not noticed by its checksum.
void RenewManifest(const std::filesystem::path& folder);

/// Path of a view's file in a folder.
std::filesystem::path ViewPath(const std::filesystem::path& folder,
                               const std::string& lens,
                               const std::string& camera,
                               Output output,
                               int frame);

/// Replaces a text file by what `change` makes of its lines.
void EditLines(const std::filesystem::path& path,
               const std::function<void(std::vector<std::string>& lines)>& change);

/// Exchanges two files.
void SwapFiles(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace pfseq
