// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/units.h"
#include "renderer/sequence/schema_parts.h"
#include "renderer/sequence/sequence_model.h"

#include <fmt/format.h>

namespace pfseq {
namespace {

void FinishLens(const YamlMappingView& yaml, LensSpec& lens) {
  if (lens.circle_px == 0.0 && lens.focal_px[0] == 0.0) {
    yaml.Fail("circle_px", "expected circle_px or focal_px, got neither");
  }
  const bool has_polynomial = lens.model == KannalaBrandt::kName;
  if (!has_polynomial && yaml.Has("coefficients")) {
    yaml.Fail(
        "coefficients",
        fmt::format("expected only for {}, the model is {}", KannalaBrandt::kName, lens.model));
  }
  const LensModel model = MakeLensModel(lens);
  if (!LensModelCovers(model, 0.5 * RadFromDeg(lens.fov_deg))) {
    yaml.Fail("fov_deg",
              fmt::format("expected {}, got {}", LensModelFieldText(model), lens.fov_deg));
  }
}

}  // namespace

YamlTypePtr<LensSpec> LensSchema() {
  auto schema = NewMapping<LensSpec>();
  schema
      ->Key("model",
            &LensSpec::model,
            YamlChoice(LensModelNames()),
            "Projection: image height r of a ray at the incidence angle t to the optical axis. "
            "equidistant f t, "
            "equisolid 2 f sin(t/2), stereographic 2 f tan(t/2), orthographic f sin(t), "
            "perspective f tan(t), "
            "kannala_brandt f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9).")
      .Key("fov_deg",
           &LensSpec::fov_deg,
           Above0(360.0),
           "Full field of view in degrees; rays beyond do not reach the image.")
      .Key("circle_px",
           &LensSpec::circle_px,
           Above0(1e6),
           "Diameter of the image circle, to which the field of view maps, in pixels; or give "
           "focal_px.",
           [](const LensSpec& lens) { return lens.circle_px != 0.0; })
      .Key("focal_px",
           &LensSpec::focal_px,
           YamlArray<2>(Above0(1e6), true),
           "Focal length along x and y in pixels; or give circle_px.",
           [](const LensSpec& lens) { return lens.focal_px[0] != 0.0; })
      .Key("principal_point_px",
           &LensSpec::principal_point_px,
           YamlOptional(YamlArray<2>(From(-1e6, 1e6))),
           "Where the optical axis meets the image, from its outer upper-left corner, in pixels "
           "(the first pixel's "
           "centre is 0.5, 0.5); absent: the image's centre.")
      .Key("image_width_px",
           &LensSpec::image_width_px,
           YamlInteger<int>(0, 1000000),
           "Image width for which the pixel figures above are meant; at another width they scale "
           "with it. 0: they "
           "are meant as they are.")
      .Key("coefficients",
           &LensSpec::coefficients,
           YamlArray<4>(YamlNumber({})),
           "k1 to k4 of kannala_brandt.",
           [](const LensSpec& lens) { return lens.model == KannalaBrandt::kName; })
      .Exclusive({"circle_px", "focal_px"})
      .Finish(FinishLens);
  return schema;
}

}  // namespace pfseq
