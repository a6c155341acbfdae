// SPDX-License-Identifier: Apache-2.0
#include "tests/sequence/schema_fixture.h"

namespace pfseq {
namespace {

class CameraSchema : public SchemaTest {};

TEST_F(CameraSchema, TheExposureIsANumberOrAutomatic) {
  EXPECT_EQ(Read(kSmall).sensor.exposure, std::nullopt);
  EXPECT_EQ(Read(kSmall, {"sensor.exposure=auto"}).sensor.exposure, std::nullopt);
  EXPECT_EQ(Read(kSmall, {"sensor.exposure=0.5"}).sensor.exposure, 0.5);
  EXPECT_EQ(Read(kSmall, {"sensor.metering=frame"}).sensor.metering, "frame");
  EXPECT_FALSE(Read(kSmall, {"sensor.metering=frame"}).sensor.IsRealistic());
  EXPECT_NE(CanonicalYaml(Read(kSmall)).find("\n  exposure: auto\n"), std::string::npos);
  EXPECT_EQ(ErrorOf(kSmall, {"sensor.exposure=0"}),
            "--set sensor.exposure=0: expected a number > 0 and <= 1000000000, got 0");
}

TEST_F(CameraSchema, OpticsAndLensesMayBeFilesOfTheirOwn) {
  WriteFileAtomically(folder_ / "my.yaml", std::string_view("blur: {center_sigma_px: 1.5}\n"));
  WriteFileAtomically(folder_ / "lens.yaml", std::string_view("circle_px: 77\n"));
  const std::string text = std::string(kSmall) + "optics: my.yaml\n";
  EXPECT_EQ(Read(text).optics.blur.center_sigma_px, 1.5);
  // Its keys may be changed one by one, and all of it at once.
  const SequenceSpec changed = Read(text, {"optics.defocus_px=3"});
  EXPECT_EQ(changed.optics.blur.center_sigma_px, 1.5);
  EXPECT_EQ(changed.optics.defocus_px, 3.0);
  const std::string strong = (kData / "optics" / "strong.yaml").string();
  const SequenceSpec other =
      Read(text, {"optics=" + strong, "lenses.fish=" + (folder_ / "lens.yaml").string()});
  EXPECT_EQ(other.optics.blur.center_sigma_px, 0.8);
  EXPECT_EQ(other.lenses[0].value.circle_px, 77.0);
  // The description written with the frames needs no other file.
  EXPECT_EQ(Read(CanonicalYaml(other)), other);
  EXPECT_NE(ErrorOf(text, {"optics=nowhere.yaml"}).find("nowhere.yaml"), std::string::npos);
  WriteFileAtomically(folder_ / "my.yaml", std::string_view("blur: {centre_px: 1}\n"));
  EXPECT_EQ(ErrorOf(text).find("my.yaml:1: optics.blur.centre_px: "), 0U) << ErrorOf(text);
}

TEST_F(CameraSchema, RefusesCamerasThatCannotBe) {
  EXPECT_EQ(ErrorOf(kSmall, {"sensor.bits=12"}), "--set sensor.bits=12: expected 8 or 16, got 12");
  EXPECT_NE(ErrorOf(kSmall, {"sensor.bits=16", "sensor.jpeg_quality=90"}).find("JPEG has 8"),
            std::string::npos);
  EXPECT_NE(ErrorOf(kSmall, {"sensor.read_noise_electrons=2"}).find("without white_electrons"),
            std::string::npos);
  EXPECT_EQ(ErrorOf(kSmall, {"shutter.readout=sideways"})
                .find("--set shutter.readout=sideways: expected "),
            0U);
}

}  // namespace
}  // namespace pfseq
