// SPDX-License-Identifier: Apache-2.0
#include "renderer/record_renderer.h"

#include "renderer/blur_vectors.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/film/recording.h"
#include "renderer/film/sensor.h"

#include <algorithm>
#include <optional>

namespace pfseq {
namespace {

bool Wants(const std::vector<Output>& outputs, std::initializer_list<Output> any_of) {
  return std::any_of(any_of.begin(), any_of.end(), [&](Output output) {
    return std::find(outputs.begin(), outputs.end(), output) != outputs.end();
  });
}

bool WantsClean(const std::vector<Output>& outputs) {
  return Wants(outputs, {Output::kClean, Output::kLinear});
}

bool WantsRealistic(const std::vector<Output>& outputs) {
  return Wants(outputs, {Output::kRealistic, Output::kRealisticJpeg, Output::kRealisticLinear});
}

/// The noise of the sensor has nothing to do with that of the samples.
constexpr uint64_t kSensorNoiseKey = 0x73656e736f72ULL;

}  // namespace

std::vector<Output> RecordRenderer::Missing(const Record& record) const {
  std::vector<Output> missing;
  for (const Output output : options_.outputs) {
    if (!writer_.Has(studio_.FileOf(record, output))) {
      missing.push_back(output);
    }
  }
  return missing;
}

int RecordRenderer::NumRenderings(const Record& record, const std::vector<Output>& outputs) const {
  const bool clean = WantsClean(outputs);
  const bool realistic = WantsRealistic(outputs);
  const bool is_shared = clean && realistic && studio_.ExposureOf(record).IsStill();
  return (clean ? 1 : 0) + (realistic && !is_shared ? 1 : 0);
}

std::vector<RasterView> RecordRenderer::LitViews(const Record& record,
                                                 const std::vector<Output>& outputs) const {
  std::vector<RasterView> views;
  if (NumRenderings(record, outputs) == 0) {
    return views;
  }
  views.push_back({&studio_.RasterOf(record), studio_.ViewOf(record)});
  if (WantsRealistic(outputs) && !studio_.ExposureOf(record).IsStill()) {
    const Vec2d span_s = Shutter(spec_.shutter).SpanS();
    for (const double end_s : {span_s.x(), span_s.y()}) {
      views.push_back(views.front());
      views.back().view.world_from_camera = studio_.WorldFromCamera(record, end_s);
    }
  }
  return views;
}

Image<float> RecordRenderer::RenderView(const Record& record,
                                        const View& view,
                                        CellFilm* film,
                                        Progress& progress) const {
  const FrameFile file = studio_.FileOf(record, Output::kClean);
  const auto describe_pixel = [&](int x, int y) {
    return fmt::format(
        "to repeat: pfseq render {} --frames {} --cameras {} --lenses {} --pixel {},{}",
        (options_.folder / kSequenceFile).string(),
        file.frame,
        file.camera,
        file.lens,
        x,
        y);
  };
  return studio_.UsesCachedLight() ? RenderCachedRadiance(studio_.Light().Tracer(),
                                                          studio_.RasterOf(record),
                                                          view,
                                                          studio_.Sampling(),
                                                          options_.num_threads,
                                                          &progress,
                                                          describe_pixel,
                                                          film)
                                   : RenderRadiance(studio_.Tracer(),
                                                    view,
                                                    spec_.render.samples,
                                                    options_.num_threads,
                                                    &progress,
                                                    describe_pixel,
                                                    film);
}

void RecordRenderer::RenderColor(const Record& record,
                                 const std::vector<Output>& outputs,
                                 Progress& progress,
                                 Pictures& pictures) const {
  View view = studio_.ViewOf(record);
  const Optics& optics = studio_.OpticsOf(record);
  const ExposurePoses exposure = studio_.ExposureOf(record);
  const bool realistic = WantsRealistic(outputs);
  std::vector<SunImage> sun;
  if (studio_.Sun() != nullptr && optics.Spec().HasFlare() &&
      (realistic || Wants(outputs, {Output::kFlare}))) {
    sun = SeenSun(
        studio_.Rays(), *studio_.Sun(), *view.lens, Vec2d(view.width_px, view.height_px), exposure);
  }
  if (Wants(outputs, {Output::kFlare})) {
    pictures.flare = optics.FlareAlone(sun, view.width_px, view.height_px, options_.num_threads);
  }
  std::optional<CellFilm> film;
  if (realistic && optics.Spec().HasPointSpread()) {
    film.emplace(view.width_px, view.height_px);
  }
  CellFilm* film_or_null = film.has_value() ? &*film : nullptr;
  if (WantsClean(outputs)) {
    const bool is_shared = exposure.IsStill();
    pictures.clean = RenderView(record, view, is_shared ? film_or_null : nullptr, progress);
  }
  if (!realistic) {
    return;
  }
  if (exposure.IsStill() && WantsClean(outputs)) {
    pictures.realistic = pictures.clean;
  } else {
    view.exposure = &exposure;
    pictures.realistic = RenderView(record, view, film_or_null, progress);
  }
  if (film.has_value()) {
    pictures.realistic = optics.Spread(*film, options_.num_threads);
  }
  optics.Finish(sun, pictures.realistic, options_.num_threads);
}

void RecordRenderer::Render(const Record& record,
                            const std::vector<Output>& outputs,
                            Progress& progress) const {
  const View view = studio_.ViewOf(record);
  Pictures pictures;
  if (Wants(outputs, {Output::kDistance, Output::kSky})) {
    pictures.truth = RenderGroundTruth(studio_.Rays(),
                                       studio_.RasterOf(record),
                                       view.world_from_camera,
                                       spec_.ground_truth.max_distance_m,
                                       options_.num_threads);
  }
  if (Wants(outputs, {Output::kBlur})) {
    pictures.blur = RenderBlurVectors(
        studio_.Rays(),
        studio_.RasterOf(record),
        [&](double after_s) { return studio_.WorldFromCamera(record, after_s); },
        spec_.shutter.exposure_s,
        options_.num_threads);
  }
  RenderColor(record, outputs, progress, pictures);
  ParallelFor(outputs.size(), options_.num_threads, [&](size_t i) {
    writer_.WriteFrameFile(studio_.FileOf(record, outputs[i]),
                           Encode(record, outputs[i], pictures));
  });
}

Bytes RecordRenderer::Encode(const Record& record, Output output, const Pictures& pictures) const {
  switch (output) {
    case Output::kClean:
      return EncodePng(Sensor(spec_.sensor).Encode(pictures.clean));
    case Output::kRealistic:
    case Output::kRealisticJpeg: {
      const View view = studio_.ViewOf(record);
      const uint64_t key = HashKey({kSensorNoiseKey, view.seed, view.frame, view.view_idx});
      const Image<uint16_t> codes =
          Recording(spec_.sensor).Record(pictures.realistic, key, options_.num_threads);
      if (spec_.sensor.bits == 16) {
        return EncodePng16(codes);
      }
      Image<uint8_t> picture(codes.WidthPx(), codes.HeightPx(), codes.NumChannels());
      std::transform(codes.Values().begin(),
                     codes.Values().end(),
                     picture.Values().begin(),
                     [](uint16_t code) { return static_cast<uint8_t>(code); });
      return output == Output::kRealistic ? EncodePng(picture)
                                          : EncodeJpeg(picture, spec_.sensor.jpeg_quality);
    }
    case Output::kLinear:
      return EncodeExrHalf(pictures.clean);
    case Output::kRealisticLinear:
      return EncodeExrHalf(pictures.realistic);
    case Output::kFlare:
      return EncodeExrHalf(pictures.flare);
    case Output::kBlur:
      return EncodeExrFloat(pictures.blur);
    case Output::kDistance:
      return EncodeExrFloat(pictures.truth.distance_m);
    case Output::kSky:
      return EncodePng(pictures.truth.sky);
  }
  PFSEQ_CHECK(false, "output {}", static_cast<int>(output));
}

}  // namespace pfseq
