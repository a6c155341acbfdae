// SPDX-License-Identifier: Apache-2.0
#include "validator/study/study_plan.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/validator/study/study_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> NamesOf(const std::vector<StudyVariant>& variants) {
  std::vector<std::string> names;
  for (const StudyVariant& variant : variants) {
    names.push_back(variant.name);
  }
  return names;
}

TEST(PlanVariants, OneAtATimeLeavesTheOthersAtTheirBase) {
  const TempFolder folder;
  const std::vector<StudyVariant> variants = PlanVariants(StudyOf(folder, StudyText(kTwoFactors)));
  EXPECT_THAT(NamesOf(variants), ElementsAre("base", "exposure_0", "exposure_0.2", "lens_small"));
  EXPECT_EQ(variants[0].spec.shutter.exposure_s, 0.1);
  EXPECT_EQ(variants[0].spec.image.size_px[0], 96);
  EXPECT_EQ(variants[2].spec.shutter.exposure_s, 0.2);
  EXPECT_EQ(variants[2].spec.image.size_px[0], 96);
  EXPECT_EQ(variants[3].spec.shutter.exposure_s, 0.1);
  EXPECT_EQ(variants[3].spec.image.size_px[0], 64);
  EXPECT_EQ(variants[3].spec.lenses[1].value.circle_px, 600.0);
}

TEST(PlanVariants, AllCombinationsAndRepetitions) {
  const TempFolder folder;
  const StudySpec study =
      StudyOf(folder,
              StudyText(kTwoFactors,
                        "design: all combinations\n"
                        "repetitions: {scene.canyon.seed: [4, 5], render.seed: [8, 9]}\n"));
  const std::vector<StudyVariant> variants = PlanVariants(study);
  ASSERT_EQ(variants.size(), 12U);
  EXPECT_EQ(variants[0].name, "exposure_0__lens_as-it-is__1");
  EXPECT_EQ(variants[11].name, "exposure_0.2__lens_small__2");
  EXPECT_EQ(variants[5].spec.scene.canyon.seed, 4U);
  EXPECT_EQ(variants[6].spec.scene.canyon.seed, 5U);
  EXPECT_EQ(variants[6].spec.render.seed, 9U);
  EXPECT_EQ(PlanSummary(study, variants.size()),
            "2 factors (exposure 3 levels, lens 2 levels), all combinations, 2 repetitions: 12 "
            "variants");
}

TEST(PlanVariants, TakesWholeFilesFromTheStudysFolder) {
  const TempFolder folder;
  WriteFileAtomically(folder / "faults/soft.yaml", "image_width_px: 1200\ndefocus_px: 3\n");
  WriteFileAtomically(folder / "faults/off.yaml", "image_width_px: 1200\n");
  const StudySpec study = StudyOf(
      folder, StudyText("  optics: {key: optics, values: [faults/off.yaml, faults/soft.yaml]}\n"));
  const std::vector<StudyVariant> variants = PlanVariants(study);
  EXPECT_THAT(NamesOf(variants), ElementsAre("base", "optics_soft"));
  EXPECT_EQ(variants[1].spec.optics.defocus_px, 3.0);
  // The study as it was run can be run from anywhere.
  const TempFolder elsewhere;
  const StudySpec again = StudyOf(elsewhere, study.effective_yaml);
  EXPECT_EQ(PlanVariants(again)[1].spec.optics.defocus_px, 3.0);
  EXPECT_EQ(again.effective_yaml, study.effective_yaml);
}

TEST(PlanVariants, TellsWhatASequenceCannotBe) {
  const TempFolder folder;
  const auto plan = [&](const std::string& factors, const std::string& more = "") {
    PlanVariants(StudyOf(folder, StudyText(factors, more)));
  };
  EXPECT_THAT(
      MessageOf<InputError>([&] { plan("  a: {key: shutter.exposur_s, values: [0, 1]}\n"); }),
      HasSubstr("did you mean exposure_s"));
  EXPECT_THAT(
      MessageOf<InputError>([&] { plan("  a: {key: image.size_px, values: [9, -1]}\n"); }),
      testing::AllOf(HasSubstr("study.yaml:5"), HasSubstr("image.size_px"), HasSubstr("-1")));
  EXPECT_THAT(MessageOf<InputError>([&] {
                plan("  a: {key: image.size_px, values: [9, 10]}\n", "lenses: pinhole\n");
              }),
              HasSubstr("pinhole"));
}

}  // namespace
}  // namespace pfseq
