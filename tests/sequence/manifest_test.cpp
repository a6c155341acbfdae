// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/manifest.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(Manifest, HoldsSizeAndHashOfEachFileAndReadsBack) {
  const TempFolder folder;
  WriteFileAtomically(folder / "sequence.yaml", "abc");
  WriteFileAtomically(folder / "l/c/sky/000003.png", "not really an image");
  Manifest::OfFolder(folder.Path(), 2).Write(folder.Path());
  const Manifest manifest = Manifest::Read(folder.Path());
  ASSERT_EQ(manifest.files.size(), 2U);
  EXPECT_EQ(manifest.files.at("sequence.yaml").size_bytes, 3U);
  EXPECT_EQ(manifest.files.at("sequence.yaml").sha256, Sha256Hex("abc"));
  EXPECT_EQ(manifest.files.at("l/c/sky/000003.png").size_bytes, 19U);
}

TEST(Manifest, BytesDoNotDependOnThreads) {
  const TempFolder folder;
  for (int i = 0; i < 20; ++i) {
    WriteFileAtomically(folder / ("l/c/sky/00001" + std::to_string(i % 10) + ".png"),
                        std::to_string(i));
  }
  Manifest::OfFolder(folder.Path(), 1).Write(folder.Path());
  const std::string one = ReadFile(folder / "manifest.json");
  Manifest::OfFolder(folder.Path(), 4).Write(folder.Path());
  EXPECT_EQ(ReadFile(folder / "manifest.json"), one);
}

TEST(Manifest, OtherFilesAreRefused) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf<InputError>([&] { Manifest::Read(folder.Path()); }),
              testing::HasSubstr("manifest.json"));
  for (const char* text :
       {"{",
        "[]",
        "{\"format\": \"other\", \"files\": {}}",
        "{\"format\": \"pfseq sequence 1\", \"files\": {\"a\": {\"size_bytes\": \"x\"}}}"}) {
    WriteFileAtomically(folder / "manifest.json", text);
    EXPECT_THAT(MessageOf<InputError>([&] { Manifest::Read(folder.Path()); }),
                testing::HasSubstr("manifest.json"))
        << text;
  }
}

}  // namespace
}  // namespace pfseq
