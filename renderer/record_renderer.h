// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "renderer/core/progress.h"
#include "renderer/ground_truth.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/sequence_writer.h"
#include "renderer/sequence_renderer.h"
#include "renderer/studio.h"

#include <vector>

namespace pfseq {

/// Renders the outputs of a record that are not there yet.
class RecordRenderer {
 public:
  /// All must outlive this.
  RecordRenderer(const Studio& studio,
                 const SequenceSpec& spec,
                 const SequenceWriter& writer,
                 const RenderOptions& options)
      : studio_(studio), spec_(spec), writer_(writer), options_(options) {}

  std::vector<Output> Missing(const Record& record) const;

  /// How often the record's pixels are rendered: a realistic frame of a camera that rests has the
  /// samples of the clean one.
  int NumRenderings(const Record& record, const std::vector<Output>& outputs) const;

  /// Whose light will be looked up: the frame's view, and both ends of the exposure.
  std::vector<RasterView> LitViews(const Record& record, const std::vector<Output>& outputs) const;

  /// Advances `progress` by the pixels of each rendering.
  void Render(const Record& record, const std::vector<Output>& outputs, Progress& progress) const;

 private:
  /// What the outputs of a record are made of, as far as they need it.
  struct Pictures {
    GroundTruth truth;
    Image<float> clean;
    Image<float> realistic;
    Image<float> flare;
    Image<float> blur;
  };

  Image<float> RenderView(const Record& record,
                          const View& view,
                          CellFilm* film,
                          Progress& progress) const;
  void RenderColor(const Record& record,
                   const std::vector<Output>& outputs,
                   Progress& progress,
                   Pictures& pictures) const;
  Bytes Encode(const Record& record, Output output, const Pictures& pictures) const;

  const Studio& studio_;
  const SequenceSpec& spec_;
  const SequenceWriter& writer_;
  const RenderOptions& options_;
};

}  // namespace pfseq
