// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/schema_parts.h"

namespace pfseq {

YamlTypePtr<ShutterSpec> ShutterSchema() {
  auto schema = NewMapping<ShutterSpec>();
  schema
      ->Key("exposure_s",
            &ShutterSpec::exposure_s,
            From(0.0, 3600.0),
            "Time for which the shutter is open, in seconds, between half open and half closed; "
            "0: an instant, no motion blur.")
      .Key("ramp",
           &ShutterSpec::ramp,
           From(0.0, 1.0),
           "Time of opening, and of closing, as a share of exposure_s: 0 box, 1 triangle, between "
           "them a trapezoid.")
      .Key("offset_s",
           &ShutterSpec::offset_s,
           From(-3600.0, 3600.0),
           "How long after the frame's pose the middle of the exposure is, in seconds.")
      .Key("readout_s",
           &ShutterSpec::readout_s,
           From(0.0, 3600.0),
           "Rolling shutter: time from the first to the last line in seconds, the middle one at "
           "the frame's time; 0: all at once.")
      .Key("readout",
           &ShutterSpec::readout,
           YamlChoice({"down", "up", "right", "left"}),
           "Way of the rolling shutter in the image.");
  return schema;
}

YamlTypePtr<SensorSpec> SensorSchema() {
  auto schema = NewMapping<SensorSpec>();
  schema
      ->Key("exposure",
            &SensorSpec::exposure,
            YamlWordOr("auto", Above0(1e9)),
            "Multiplies linear radiance before the tone curve, the same for the whole sequence; "
            "auto: as metering says.")
      .Key("metering",
           &SensorSpec::metering,
           YamlChoice({"light", "frame"}),
           "Where `exposure: auto` comes from: the light that falls on the ground, or what the "
           "first camera sees in frame 0.")
      .Key("tone_curve",
           &SensorSpec::tone_curve,
           YamlChoice({"clip", "shoulder"}),
           "clip: linear up to white; shoulder: highlights roll off smoothly.")
      .Key("encoding",
           &SensorSpec::encoding,
           YamlChoice({"srgb", "linear"}),
           "How realistic pictures store what the tone curve gives.")
      .Key("white_electrons",
           &SensorSpec::white_electrons,
           From(0.0, 1e9),
           "Electrons of a pixel at the exposed value 1, which decide the photon noise of "
           "realistic pictures; 0: none.")
      .Key("read_noise_electrons",
           &SensorSpec::read_noise_electrons,
           From(0.0, 1e6),
           "Standard deviation of the noise of reading, in electrons; needs white_electrons.")
      .Key("mosaic",
           &SensorSpec::mosaic,
           YamlChoice({"none", "rggb", "grbg", "gbrg", "bggr"}),
           "Colour filters of the upper left 2 x 2 pixels of realistic pictures, which are "
           "interpolated bilinearly.")
      .Key("color", &SensorSpec::color, YamlChoice({"rgb", "grey"}), "Of realistic pictures.")
      .Key("bits",
           &SensorSpec::bits,
           YamlInteger<int>(8, 16),
           "Of each channel of realistic pictures: 8 or 16.")
      .Key("jpeg_quality",
           &SensorSpec::jpeg_quality,
           YamlInteger<int>(0, 100),
           "1 to 100: realistic pictures are JPEG files of that quality; 0: PNG, without loss.")
      .Finish([](const YamlMappingView& yaml, SensorSpec& sensor) {
        if (sensor.bits != 8 && sensor.bits != 16) {
          yaml.Fail("bits", "expected 8 or 16, got " + std::to_string(sensor.bits));
        }
        if (sensor.bits == 16 && sensor.jpeg_quality > 0) {
          yaml.Fail("jpeg_quality", "expected 0 with 16 bits: JPEG has 8");
        }
        if (sensor.read_noise_electrons > 0.0 && sensor.white_electrons == 0.0) {
          yaml.Fail("read_noise_electrons", "expected 0 without white_electrons");
        }
      });
  return schema;
}

}  // namespace pfseq
