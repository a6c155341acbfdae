// SPDX-License-Identifier: Apache-2.0
// How long a study takes.
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "validator/study/study_spec.h"

#include <deque>
#include <filesystem>
#include <string>

namespace pfseq {

/// CPU seconds that parts of the work take on the machine that the rates were measured on: scene
/// and light, images, features. Within a factor of two or so: what a scene's light and an image's
/// key points cost is only known when they are there.
struct StudyEffort {
  double scene_s = 0.0;
  double images_s = 0.0;
  double features_s = 0.0;

  double SumS() const { return scene_s + images_s + features_s; }
};

/// The stored rates, times this machine's speed in a short trial (rays at random triangles on all
/// threads, against the same on the machine of the rates); once variants are finished, times what
/// they took instead.
class StudyForecast {
 public:
  StudyForecast(const StudySpec& study, int num_threads);

  /// A variant that will be done after those added before.
  void Add(const SequenceSpec& spec);
  /// A variant is finished: takes it from what is left, and notes its time in its folder.
  void Finish(double wall_s, const std::filesystem::path& variant_folder);
  /// From the note of an earlier run; nothing where there is none.
  void LearnFrom(const std::filesystem::path& variant_folder);

  double LeftS() const;
  /// "13 min 20 s (scenes and light 2 min, ...), from ..." of all that is left.
  std::string Text() const;

 private:
  StudyEffort EffortOf(const SequenceSpec& spec, bool has_scene) const;
  double SecondsPerEffort() const;

  const StudySpec& study_;
  int num_frames_ = 0;
  /// Seconds here for a CPU second there.
  double trial_ = 1.0;
  std::deque<StudyEffort> left_;
  std::string last_scene_;
  double done_effort_s_ = 0.0;
  double done_wall_s_ = 0.0;
};

}  // namespace pfseq
