// SPDX-License-Identifier: Apache-2.0
#include "validator/checks/manifest_check.h"

#include "renderer/core/file.h"
#include "renderer/sequence/manifest.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/checks/finding_matchers.h"
#include "tests/validator/test_sequence.h"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr const char* kFrontFile = "equisolid/front/clean/000003.png";
constexpr const char* kRearFile = "equisolid/rear/clean/000003.png";

/// A folder with four files; what they hold is of no matter to this check.
class ManifestCheck : public testing::Test {
 protected:
  ManifestCheck() {
    Put(kFrontFile, "front picture");
    Put(kRearFile, "rear picture");
    Put("rig.yaml", "rig");
    Put("scene.glb", "scene");
    RenewManifest(folder_.Path());
  }

  void Put(const std::string& name, std::string_view text) {
    WriteFileAtomically(folder_ / name, text);
  }

  CheckReport Check(int num_threads = 1) const {
    CheckOptions options;
    options.num_threads = num_threads;
    options.quiet = true;
    CheckReport report;
    CheckManifest(folder_.Path(), options, report);
    return report;
  }

  TempFolder folder_;
};

TEST_F(ManifestCheck, SoundFolderHasNoFindings) {
  const CheckReport report = Check();
  EXPECT_THAT(report.findings, IsEmpty());
  EXPECT_EQ(report.num_files_hashed, 4U);
}

TEST_F(ManifestCheck, NamesAFileWithAFlippedByte) {
  Put(kFrontFile, "front pictUre");
  EXPECT_THAT(Check().findings, ElementsAre(IsFault(kFrontFile, "SHA-256")));
}

TEST_F(ManifestCheck, NamesATruncatedFile) {
  Put(kRearFile, "rear pic");
  EXPECT_THAT(Check().findings, ElementsAre(IsFault(kRearFile, "8 bytes, 12 in the manifest")));
}

TEST_F(ManifestCheck, NamesAMissingFrame) {
  std::filesystem::remove(folder_ / kFrontFile);
  std::filesystem::remove(folder_ / "rig.yaml");
  EXPECT_THAT(
      Check().findings,
      UnorderedElementsAre(IsFault(kFrontFile, "missing frame"), IsFault("rig.yaml", "missing")));
}

TEST_F(ManifestCheck, TellsSwappedFiles) {
  SwapFiles(folder_ / kFrontFile, folder_ / kRearFile);
  EXPECT_THAT(Check(2).findings,
              ElementsAre(IsFault(kFrontFile, kRearFile), IsFault(kRearFile, kFrontFile)));
}

TEST_F(ManifestCheck, MissingManifestMeansUnfinished) {
  std::filesystem::remove(folder_ / std::string(kManifestFile));
  EXPECT_THAT(Check().findings, ElementsAre(IsFault(kManifestFile, "resume")));
}

TEST_F(ManifestCheck, DamagedManifestIsAFault) {
  Put(std::string(kManifestFile), "{ not json");
  EXPECT_THAT(Check().findings, ElementsAre(IsFault(kManifestFile, "expected a manifest")));
}

TEST_F(ManifestCheck, TellsFilesThatTheManifestLacks) {
  Put("equisolid/front/clean/000007.png", "added");
  Put("equisolid/front/clean/000008.png.123.partial", "half");
  Put("readme.txt", "mine");
  EXPECT_THAT(
      Check().findings,
      UnorderedElementsAre(IsFault("equisolid/front/clean/000007.png", "not in the manifest"),
                           IsNote("equisolid/front/clean/000008.png.123.partial", "stopped"),
                           IsNote("readme.txt", "not a file of a sequence")));
}

}  // namespace
}  // namespace pfseq
