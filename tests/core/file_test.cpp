// SPDX-License-Identifier: Apache-2.0
#include "renderer/core/file.h"

#include "renderer/core/error.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;

TEST(WriteFileAtomically, MakesFoldersAndLeavesNothingElse) {
  const TempFolder folder;
  const std::string bytes("a\0b\r\n", 5);
  WriteFileAtomically(folder / "x/y/file.bin", bytes);
  EXPECT_EQ(ReadFile(folder / "x/y/file.bin"), bytes);
  WriteFileAtomically(folder / "x/y/file.bin", "shorter");
  EXPECT_EQ(ReadFile(folder / "x/y/file.bin"), "shorter");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "x/y"), {}), 1);
}

TEST(WriteFileAtomically, FullDiskNamesPathAndReasonAndKeepsTheOldFile) {
  // /dev/full gives "No space left on device" on every write; a link puts it where the temporary
  // file would be.
  const TempFolder folder;
  WriteFileAtomically(folder / "file", "old");
  std::filesystem::create_symlink(
      "/dev/full",
      (folder / "file").string() + "." + std::to_string(getpid()) + std::string(kPartialSuffix));
  const std::string text =
      MessageOf<SystemError>([&] { WriteFileAtomically(folder / "file", "new"); });
  EXPECT_THAT(text, HasSubstr((folder / "file").string()));
  EXPECT_THAT(text, HasSubstr("No space left on device"));
  EXPECT_EQ(ReadFile(folder / "file"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.Path()), {}), 1);
}

TEST(WriteFileAtomically, AFileWhereAFolderShouldBeIsASystemError) {
  const TempFolder folder;
  WriteFileAtomically(folder / "plain", "text");
  EXPECT_THAT(MessageOf<SystemError>([&] { WriteFileAtomically(folder / "plain/file", "new"); }),
              HasSubstr("plain"));
}

TEST(ReadFile, MissingFileAndFolderAreInputErrors) {
  const TempFolder folder;
  EXPECT_THAT(MessageOf<InputError>([&] { ReadFile(folder / "missing"); }),
              HasSubstr("missing: No such file or directory"));
  EXPECT_THAT(MessageOf<InputError>([&] { ReadFile(folder.Path()); }),
              HasSubstr("expected a file"));
}

TEST(Sha256Hex, AgreesWithTheStandardsExamples) {
  // FIPS 180-2, appendix B.1, and the well-known digest of the empty message.
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256Hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256HexOfFile, EqualsTheHashOfItsBytesOverSeveralBlocks) {
  const TempFolder folder;
  std::string bytes((size_t{1} << 20) * 2 + 12345, '\0');
  for (size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(i * 31 % 251);
  }
  WriteFileAtomically(folder / "big", bytes);
  EXPECT_EQ(Sha256HexOfFile(folder / "big"), Sha256Hex(bytes));
}

}  // namespace
}  // namespace pfseq
