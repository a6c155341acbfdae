// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/sequence_reader.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/units.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/poses_file.h"
#include "renderer/sequence/rig_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SequenceReaderTest : public testing::Test {
 protected:
  SequenceReaderTest() {
    const Lens lens(Equidistant{}, Vec2d(5, 5), Vec2d(8, 6), 1.0);
    const RigFile rig{
        16,
        12,
        400.0,
        {{"b_first", {}}, {"a_second", {Eigen::Quaterniond::Identity(), Vec3d(-2, 0, 0)}}},
        {{"wide", lens}}};
    WriteFileAtomically(folder_ / "rig.yaml", rig.ToYaml());
    const std::vector<StampedPose> poses = {{0.0, PoseFromYaw(Vec3d(0, 0, 1), 0.0)},
                                            {0.5, PoseFromYaw(Vec3d(10, 20, 1), RadFromDeg(90.0))}};
    WriteFileAtomically(folder_ / "poses.csv", PosesCsv(poses));
  }

  void Write(Output output, int frame, const Bytes& bytes) const {
    WriteFileAtomically(folder_.Path() / FrameFile{"wide", "b_first", output, frame}.RelativePath(),
                        bytes);
  }

  TempFolder folder_;
};

TEST_F(SequenceReaderTest, KeepsTheOrderOfCamerasAndComposesPoses) {
  const SequenceReader reader(folder_.Path());
  EXPECT_THAT(reader.Cameras(), ElementsAre("b_first", "a_second"));
  EXPECT_EQ(reader.WidthPx(), 16);
  EXPECT_EQ(reader.MaxDistanceM(), 400.0);
  // Heading +Y, the second camera 2 m behind the first.
  EXPECT_LT((reader.WorldFromCamera("a_second", 1).translation_m - Vec3d(10, 18, 1)).norm(), 1e-12);
}

TEST_F(SequenceReaderTest, ListsFramesInOrderAndReadsThem) {
  Image<float> distance(16, 12, 1, 3.5F);
  Write(Output::kDistance, 10, EncodeExrFloat(distance));
  Write(Output::kDistance, 2, EncodeExrFloat(distance));
  Write(Output::kClean, 0, EncodePng(Image<uint8_t>(16, 12, 3, 9)));
  const SequenceReader reader(folder_.Path());
  EXPECT_THAT(reader.Frames("wide", "b_first", Output::kDistance), ElementsAre(2, 10));
  EXPECT_THAT(reader.Frames("wide", "a_second", Output::kDistance), ElementsAre());
  // Both formats of realistic frames lie in one folder, each file is of one.
  Write(Output::kRealistic, 1, EncodePng(Image<uint8_t>(16, 12, 3, 9)));
  EXPECT_THAT(reader.Frames("wide", "b_first", Output::kRealistic), ElementsAre(1));
  EXPECT_THAT(reader.Frames("wide", "b_first", Output::kRealisticJpeg), ElementsAre());
  EXPECT_EQ(reader.ReadDistance("wide", "b_first", 2), distance);
  EXPECT_EQ(reader.ReadClean("wide", "b_first", 0).At(3, 4, 2), 9);
}

TEST_F(SequenceReaderTest, NamesWhatIsWrong) {
  Write(Output::kSky, 0, EncodePng(Image<uint8_t>(15, 12, 1)));
  Write(Output::kClean, 0, EncodePng(Image<uint8_t>(16, 12, 1)));
  const SequenceReader reader(folder_.Path());
  EXPECT_THAT(MessageOf<InputError>([&] { reader.ReadSky("wide", "b_first", 0); }),
              HasSubstr("sky/000000.png: expected 16 x 12 px with 1 channels, got 15 x 12"));
  EXPECT_THAT(MessageOf<InputError>([&] { reader.ReadClean("wide", "b_first", 0); }),
              HasSubstr("with 3 channels"));
  EXPECT_THAT(MessageOf<InputError>([&] { reader.LensOf("tele"); }),
              HasSubstr("lens 'tele': the sequence has wide"));
  EXPECT_THAT(MessageOf<InputError>([&] { reader.WorldFromCamera("b_first", 2); }),
              HasSubstr("frames 0 to 1"));
  EXPECT_THAT(MessageOf<InputError>([&] { SequenceReader(folder_ / "none"); }),
              HasSubstr("none: expected the folder"));
}

}  // namespace
}  // namespace pfseq
