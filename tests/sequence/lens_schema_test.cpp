// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class LensSchema : public SchemaTest {};

TEST_F(LensSchema, RefusesLensesThatCannotBe) {
  const auto error = [&](const std::string& lens) {
    return ErrorOf("lenses:\n  fish: {" + lens + "}\nrig: {cameras: {front: {}}}\n");
  };
  EXPECT_EQ(error("fov_deg: 100"),
            "demo.yaml:2: lenses.fish.circle_px: expected circle_px or focal_px, got neither");
  EXPECT_EQ(error("circle_px: 100, focal_px: 100"),
            "demo.yaml:2: lenses.fish.focal_px: expected either this or circle_px, got both");
  EXPECT_EQ(error("circle_px: 100, model: orthographic"),
            "demo.yaml:2: lenses.fish.fov_deg: expected > 0 and <= 180 degrees for orthographic, "
            "got 181.8");
  EXPECT_EQ(
      error("circle_px: 100, model: perspective, fov_deg: 180"),
      "demo.yaml:2: lenses.fish.fov_deg: expected > 0 and < 180 degrees for perspective, got 180");
  EXPECT_EQ(error("circle_px: 100, coefficients: [0, 0, 0, 0]"),
            "demo.yaml:2: lenses.fish.coefficients: expected only for kannala_brandt, the model is "
            "equidistant");
  EXPECT_EQ(error("circle_px: 100, model: fisheye"),
            "demo.yaml:2: lenses.fish.model: expected one of equidistant, equisolid, "
            "stereographic, orthographic, "
            "perspective, kannala_brandt, got fisheye");
  EXPECT_EQ(error("circl_px: 100"),
            "demo.yaml:2: lenses.fish.circl_px: unknown key; did you mean circle_px?");
  // The polynomial with k1 = -0.1 turns at sqrt(10 / 3) radians.
  EXPECT_EQ(
      error("circle_px: 100, model: kannala_brandt, coefficients: [-0.1, 0, 0, 0], fov_deg: 210"),
      "demo.yaml:2: lenses.fish.fov_deg: expected > 0 and <= 209.2146059 degrees for "
      "kannala_brandt, got 210");
}

TEST_F(LensSchema, TakesModelsUpToTheirLimit) {
  const auto read = [&](const std::string& lens) {
    return Read("lenses:\n  fish: {" + lens + "}\nrig: {cameras: {front: {}}}\n").lenses[0].value;
  };
  EXPECT_EQ(read("circle_px: 100, model: orthographic, fov_deg: 180").fov_deg, 180.0);
  EXPECT_EQ(read("circle_px: 100, model: equidistant, fov_deg: 360").fov_deg, 360.0);
}

TEST_F(LensSchema, ReadsLensFiles) {
  const SequenceSpec spec = ReadSequenceSpec(kData / "sequences" / "pfseq.yaml");
  EXPECT_EQ(ReadLensSpec(kData / "lenses" / "pfseq-equidistant.yaml"), spec.lenses[0].value);
  EXPECT_EQ(ReadLensSpec(kData / "lenses" / "pfseq-equisolid.yaml"), spec.lenses[1].value);
  for (const std::string name : {"tum-vi-fisheye.yaml", "realsense-t265.yaml"}) {
    EXPECT_EQ(ReadLensSpec(kData / "lenses" / name).model, "kannala_brandt") << name;
  }
  WriteFileAtomically(path_, std::string_view("model: equisolid\nfov_deg: 0\ncircle_px: 10\n"));
  EXPECT_EQ(MessageOf<InputError>([&] { ReadLensSpec(path_); }),
            path_.string() + ":2: fov_deg: expected a number > 0 and <= 360, got 0");
}

}  // namespace
}  // namespace pfseq
