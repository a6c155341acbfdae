// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/sequence/sequence_model.h"
#include "renderer/sequence/sequence_schema.h"
#include "tools/commands.h"
#include "tools/common_options.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr const char* kFooter = R"(
--project reads lines "x y z" (a direction in the camera frame: x right and y down in the image, z along the optical
axis) on standard input and writes "u v" (pixels, origin at the image's outer upper-left corner). --unproject does the
reverse; directions have unit length. What the lens does not see is written as nan.

Examples:
  pfseq lens data/lenses/pfseq-equisolid.yaml
  pfseq lens data/sequences/pfseq.yaml --set image.size_px=300
  echo "1 0 0" | pfseq lens data/sequences/pfseq.yaml --lens equisolid --project
  echo "600.5 20" | pfseq lens data/lenses/pfseq-equidistant.yaml --unproject)";

struct LensFlags {
  DescriptionFlags description;
  std::string lens;
  bool project = false;
  bool unproject = false;
};

struct SizedLens {
  std::string name;
  Lens lens;
  std::array<int, 2> image_size_px;
};

std::vector<SizedLens> LoadLenses(const LensFlags& flags) {
  std::vector<SizedLens> lenses;
  if (IsSequenceFile(flags.description.path)) {
    const SequenceSpec spec = ReadSequenceSpec(flags.description.path, flags.description.overrides);
    for (const Named<Lens>& lens : MakeLenses(spec)) {
      if (flags.lens.empty() || lens.name == flags.lens) {
        lenses.push_back({lens.name, lens.value, spec.image.size_px});
      }
    }
    if (lenses.empty()) {
      throw InputError(
          "--lens {}: {} has no such lens", flags.lens, flags.description.path.string());
    }
  } else {
    if (!flags.lens.empty() || !flags.description.overrides.empty()) {
      throw InputError("{}: is a lens; --lens and --set go with a sequence",
                       flags.description.path.string());
    }
    const LensSpec spec = ReadLensSpec(flags.description.path);
    const std::array<int, 2> size_px = ImageSizePxOfLens(spec);
    lenses.push_back({flags.description.path.stem().string(), MakeLens(spec, size_px), size_px});
  }
  return lenses;
}

void PrintIntrinsics(const SizedLens& sized) {
  const Lens& lens = sized.lens;
  fmt::print("{}:\n  model: {}\n  image_size_px: [{}, {}]\n",
             sized.name,
             lens.ModelName(),
             sized.image_size_px[0],
             sized.image_size_px[1]);
  fmt::print("  focal_px: [{}, {}]\n", lens.FocalPx().x(), lens.FocalPx().y());
  fmt::print("  principal_point_px: [{}, {}]  # from the image's outer corner; OpenCV: [{}, {}]\n",
             lens.PrincipalPointPx().x(),
             lens.PrincipalPointPx().y(),
             lens.PrincipalPointPx().x() - 0.5,
             lens.PrincipalPointPx().y() - 0.5);
  fmt::print("  fov_deg: {:.10g}\n  circle_px: {:.10g}\n",
             2.0 * DegFromRad(lens.MaxAngleRad()),
             lens.CirclePx());
  if (const auto* model = std::get_if<KannalaBrandt>(&lens.Model())) {
    const std::array<double, 4>& k = model->Coefficients();
    fmt::print("  coefficients: [{}, {}, {}, {}]\n", k[0], k[1], k[2], k[3]);
  }
}

/// Maps each line of numbers on standard input; `num_in` numbers a line.
template <typename MapLine>
void MapStandardInput(size_t num_in, const MapLine& map_line) {
  std::string line;
  for (size_t line_number = 1; std::getline(std::cin, line); ++line_number) {
    std::istringstream stream(line);
    std::vector<double> values;
    for (double value = 0.0; stream >> value;) {
      values.push_back(value);
    }
    if (values.empty() && stream.eof()) {
      continue;
    }
    if (values.size() != num_in || !stream.eof()) {
      throw InputError(
          "standard input:{}: expected {} numbers, got '{}'", line_number, num_in, line);
    }
    map_line(values);
  }
}

void RunLens(const LensFlags& flags) {
  const std::vector<SizedLens> lenses = LoadLenses(flags);
  if (!flags.project && !flags.unproject) {
    for (const SizedLens& lens : lenses) {
      PrintIntrinsics(lens);
    }
    return;
  }
  if (lenses.size() != 1) {
    throw InputError("{}: holds {} lenses; choose one with --lens",
                     flags.description.path.string(),
                     lenses.size());
  }
  const Lens& lens = lenses.front().lens;
  if (flags.project) {
    MapStandardInput(3, [&](const std::vector<double>& v) {
      const Vec3d direction(v[0], v[1], v[2]);
      const auto pixel = direction.norm() > 0.0 ? lens.Project(direction) : std::nullopt;
      fmt::print("{} {}\n", pixel ? pixel->x() : NAN, pixel ? pixel->y() : NAN);
    });
  } else {
    MapStandardInput(2, [&](const std::vector<double>& v) {
      const auto direction = lens.Unproject(Vec2d(v[0], v[1]));
      fmt::print("{} {} {}\n",
                 direction ? direction->x() : NAN,
                 direction ? direction->y() : NAN,
                 direction ? direction->z() : NAN);
    });
  }
}

}  // namespace

void AddLensCommand(CLI::App& app) {
  auto flags = std::make_shared<LensFlags>();
  CLI::App* command =
      app.add_subcommand("lens", "Prints intrinsics, projects directions, unprojects pixels");
  command->footer(kFooter);
  command->add_option("FILE.yaml", flags->description.path, "A lens or a sequence")->required();
  command->add_option("--set", flags->description.overrides, "Sets a key of a sequence; repeatable")
      ->type_name("KEY=VALUE")
      ->take_all();
  command->add_option("--lens", flags->lens, "Which lens of a sequence");
  CLI::Option* project =
      command->add_flag("--project", flags->project, "Directions on standard input to pixels");
  command->add_flag("--unproject", flags->unproject, "Pixels on standard input to directions")
      ->excludes(project);
  command->callback([flags] { RunLens(*flags); });
}

}  // namespace pfseq
