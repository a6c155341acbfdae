// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/image_check.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/progress.h"
#include "renderer/sequence/image_io.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace pfseq {
namespace {

/// Pixels with one kind of fault, for one line of the report.
class PixelFault {
 public:
  explicit PixelFault(std::string what) : what_(std::move(what)) {}

  void Count(int x, int y) {
    if (num_pixels_++ == 0) {
      first_ = fmt::format("({}, {})", x, y);
    }
  }

  void Report(const std::string& file, CheckReport& report) const {
    if (num_pixels_ > 0) {
      report.AddFault(
          file,
          fmt::format(
              "{} pixel{} {}, first {}", num_pixels_, num_pixels_ == 1 ? "" : "s", what_, first_));
    }
  }

 private:
  std::string what_;
  size_t num_pixels_ = 0;
  std::string first_;
};

/// What the file's header must say.
struct ExpectedImage {
  int num_channels = 0;
  OIIO::TypeDesc type;
  std::string first_channel;
};

ExpectedImage Expected(Output output) {
  switch (output) {
    case Output::kLinear:
    case Output::kRealisticLinear:
    case Output::kFlare:
      return {3, OIIO::TypeDesc::HALF, "R"};
    case Output::kBlur:
      return {2, OIIO::TypeDesc::FLOAT, "X"};
    case Output::kDistance:
      return {1, OIIO::TypeDesc::FLOAT, "Y"};
    case Output::kSky:
      return {1, OIIO::TypeDesc::UINT8, ""};
    default:  // Pictures.
      return {3, OIIO::TypeDesc::UINT8, ""};
  }
}

/// Checks one view; its findings go to a report of its own.
class ViewCheck {
 public:
  ViewCheck(const CheckContext& context, const CheckedView& view, CheckReport& report)
      : context_(context), view_(view), lens_(context.reader.LensOf(view.lens)), report_(report) {}

  void Run() {
    std::optional<Image<float>> distance_m;
    std::optional<Image<uint8_t>> sky;
    for (const Output output : view_.outputs) {
      ++report_.num_images;
      switch (output) {
        case Output::kDistance:
          distance_m = Read<float>(output);
          break;
        case Output::kSky:
          sky = Read<uint8_t>(output);
          break;
        case Output::kLinear:
        case Output::kRealisticLinear:
        case Output::kFlare:
          CheckRadiance(output, Read<float>(output));
          break;
        case Output::kBlur:
          Read<float>(output);
          break;
        default:
          Read<uint8_t>(output);
      }
    }
    if (distance_m) {
      CheckDistances(*distance_m);
    }
    if (sky) {
      CheckSkyValues(*sky);
    }
    if (distance_m && sky) {
      CheckSkyAgainstDistance(*sky, *distance_m);
    }
  }

 private:
  /// The image; nothing, and a finding, when it is not as its kind must be.
  template <typename T>
  std::optional<Image<T>> Read(Output output) {
    const std::string file = view_.File(output);
    const std::filesystem::path path = context_.reader.Folder() / file;
    try {
      Image<T> image;
      if constexpr (std::is_same_v<T, float>) {
        image = ReadExr(path);
      } else {
        image = ReadPicture8(path);
      }
      const std::string fault = FaultOfHeader(path, Expected(output));
      if (!fault.empty()) {
        report_.AddFault(file, fault);
        return std::nullopt;
      }
      return image;
    } catch (const InputError& fault) {
      report_.AddFault(file, WithoutPath(fault.what(), path));
      return std::nullopt;
    }
  }

  std::string FaultOfHeader(const std::filesystem::path& path,
                            const ExpectedImage& expected) const {
    const auto input = OIIO::ImageInput::open(path.string());
    if (input == nullptr) {
      return "cannot be opened";
    }
    const OIIO::ImageSpec& spec = input->spec();
    const int width_px = context_.reader.WidthPx();
    const int height_px = context_.reader.HeightPx();
    if (spec.width != width_px || spec.height != height_px) {
      return fmt::format(
          "{} x {} px, {} x {} in {}", spec.width, spec.height, width_px, height_px, kRigFile);
    }
    // A realistic picture may be grey and of 16 bits, as its sensor has it.
    const bool is_realistic =
        path.parent_path().filename() == std::string(OutputName(Output::kRealistic));
    const bool is_other_sensor =
        is_realistic && (spec.nchannels == 1 || spec.nchannels == 3) &&
        (spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16);
    if ((spec.nchannels != expected.num_channels || spec.format != expected.type) &&
        !is_other_sensor) {
      return fmt::format("expected {} channel(s) of {}, got {} of {}",
                         expected.num_channels,
                         expected.type.c_str(),
                         spec.nchannels,
                         spec.format.c_str());
    }
    if (!expected.first_channel.empty() && spec.channelnames[0] != expected.first_channel) {
      return fmt::format("expected a first channel named {}, got {}",
                         expected.first_channel,
                         spec.channelnames[0]);
    }
    return "";
  }

  void CheckRadiance(Output output, const std::optional<Image<float>>& radiance) {
    PixelFault bad("negative or not finite");
    if (!radiance) {
      return;
    }
    ForEachPixel([&](int x, int y) {
      for (int channel = 0; channel < radiance->NumChannels(); ++channel) {
        const float value = radiance->At(x, y, channel);
        if (!(value >= 0.0F && std::isfinite(value))) {
          bad.Count(x, y);
          return;
        }
      }
    });
    bad.Report(view_.File(output), report_);
  }

  void CheckDistances(const Image<float>& distance_m) {
    PixelFault not_a_number("not a number");
    PixelFault not_positive("inside the image circle not positive");
    PixelFault not_zero("outside the image circle not 0");
    PixelFault too_far(
        fmt::format("finite beyond the maximum of {} m", context_.reader.MaxDistanceM()));
    const auto max_distance_m = static_cast<float>(context_.reader.MaxDistanceM());
    ForEachPixel([&](int x, int y) {
      const float value_m = distance_m.At(x, y);
      if (std::isnan(value_m)) {
        not_a_number.Count(x, y);
      } else if (!IsInside(x, y)) {
        if (value_m != 0.0F) {
          not_zero.Count(x, y);
        }
      } else if (value_m <= 0.0F) {
        not_positive.Count(x, y);
      } else if (std::isfinite(value_m) && value_m > max_distance_m) {
        too_far.Count(x, y);
      }
    });
    for (const PixelFault* fault : {&not_a_number, &not_positive, &not_zero, &too_far}) {
      fault->Report(view_.File(Output::kDistance), report_);
    }
  }

  void CheckSkyValues(const Image<uint8_t>& sky) {
    PixelFault between("neither 0 nor 255");
    PixelFault outside("outside the image circle not 0");
    ForEachPixel([&](int x, int y) {
      const uint8_t value = sky.At(x, y);
      if (value != 0 && value != 255) {
        between.Count(x, y);
      } else if (value != 0 && !IsInside(x, y)) {
        outside.Count(x, y);
      }
    });
    between.Report(view_.File(Output::kSky), report_);
    outside.Report(view_.File(Output::kSky), report_);
  }

  void CheckSkyAgainstDistance(const Image<uint8_t>& sky, const Image<float>& distance_m) {
    PixelFault sky_at_surface(
        fmt::format("sky, but at finite distance in {}", view_.File(Output::kDistance)));
    PixelFault nothing_there(
        fmt::format("not sky, but at infinite distance in {} and nothing beyond {} m is there",
                    view_.File(Output::kDistance),
                    context_.reader.MaxDistanceM()));
    const RigidTransform world_from_camera =
        context_.reader.WorldFromCamera(view_.camera, view_.frame);
    ForEachPixel([&](int x, int y) {
      const bool is_infinite = std::isinf(distance_m.At(x, y));
      if (sky.At(x, y) == 255 && !is_infinite) {
        sky_at_surface.Count(x, y);
      } else if (sky.At(x, y) == 0 && is_infinite && !IsFarGeometry(world_from_camera, x, y)) {
        nothing_there.Count(x, y);
      }
    });
    sky_at_surface.Report(view_.File(Output::kSky), report_);
    nothing_there.Report(view_.File(Output::kSky), report_);
  }

  /// True where geometry beyond the maximum explains an infinite distance, and when there is no
  /// scene to ask.
  bool IsFarGeometry(const RigidTransform& world_from_camera, int x, int y) const {
    const std::optional<Vec3d> direction_camera = lens_.Unproject(Vec2d(x + 0.5, y + 0.5));
    if (context_.scene == nullptr || !direction_camera) {
      return true;
    }
    const std::optional<RayHit> hit = context_.scene->Intersect(
        world_from_camera.translation_m, world_from_camera.Direction(*direction_camera));
    constexpr double kRelativeTolerance = 1e-5;
    return hit && hit->distance_m > context_.reader.MaxDistanceM() * (1.0 - kRelativeTolerance);
  }

  bool IsInside(int x, int y) const { return lens_.Unproject(Vec2d(x + 0.5, y + 0.5)).has_value(); }

  template <typename Body>
  void ForEachPixel(const Body& body) const {
    for (int y = 0; y < context_.reader.HeightPx(); ++y) {
      for (int x = 0; x < context_.reader.WidthPx(); ++x) {
        body(x, y);
      }
    }
  }

  const CheckContext& context_;
  const CheckedView& view_;
  const Lens& lens_;
  CheckReport& report_;
};

}  // namespace

void CheckImages(const CheckContext& context, CheckReport& report) {
  std::vector<CheckReport> reports(context.views.size());
  Progress progress("images", context.views.size(), context.options.quiet);
  ParallelFor(context.views.size(), context.options.num_threads, [&](size_t i) {
    ViewCheck(context, context.views[i], reports[i]).Run();
    progress.Advance();
  });
  progress.Finish();
  for (const CheckReport& one : reports) {
    report.Add(one.findings);
    report.num_images += one.num_images;
  }
}

}  // namespace pfseq
