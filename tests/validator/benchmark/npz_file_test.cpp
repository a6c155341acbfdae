// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/npz_file.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/benchmark/npz_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::map<std::string, NpzArray> Read(const std::string& bytes) {
  const TempFolder folder;
  WriteFileAtomically(folder / "a.npz", bytes);
  return ReadNpz(folder / "a.npz");
}

TEST(NpzFile, ReadsStoredAndDeflatedArraysOfAllTypes) {
  for (const bool is_deflated : {false, true}) {
    auto arrays = Read(NpzBuilder(is_deflated)
                           .Add<float>("points", "<f4", "(3, 2)", {1, 2, 3, 4, 5, 6.5F})
                           .Add<uint8_t>("bytes", "|u1", "(2,)", {7, 255})
                           .Add<int64_t>("idx", "<i8", "(1, 2)", {-1, 40})
                           .Add<double>("one", "<f8", "()", {0.25})
                           .Bytes());
    EXPECT_EQ(arrays.size(), 4U);
    EXPECT_EQ(arrays["points"].num_rows, 3U);
    EXPECT_EQ(arrays["points"].num_columns, 2U);
    EXPECT_EQ(arrays["points"].At(2, 1), 6.5);
    EXPECT_THAT(arrays["bytes"].values, ElementsAre(7.0, 255.0));
    EXPECT_TRUE(arrays["bytes"].is_bytes);
    EXPECT_THAT(arrays["idx"].values, ElementsAre(-1.0, 40.0));
    EXPECT_THAT(arrays["one"].values, ElementsAre(0.25));
  }
}

TEST(NpzFile, TellsWhatIsWrong) {
  const std::string good =
      NpzBuilder(true).Add<float>("points", "<f4", "(2, 2)", {1, 2, 3, 4}).Bytes();
  const auto refusal = [](const std::string& bytes) {
    return MessageOf<InputError>([&] { Read(bytes); });
  };
  EXPECT_THAT(refusal("no zip at all"), HasSubstr("no zip directory"));
  EXPECT_THAT(refusal(""), HasSubstr("a.npz"));
  for (size_t cut = 0; cut < good.size(); cut += 7) {
    refusal(good.substr(0, cut));
  }
  std::string damaged = good;
  damaged[40] = '\xff';  // The first block has a kind that there is not.
  EXPECT_THROW(Read(damaged), InputError);
  EXPECT_THAT(refusal(NpzBuilder().Add<float>("a", ">f4", "(1,)", {1}).Bytes()),
              HasSubstr("little-endian"));
  EXPECT_THAT(refusal(NpzBuilder().Add<float>("a", "<f4", "(1,)", {1}, true).Bytes()),
              HasSubstr("C order"));
  EXPECT_THAT(refusal(NpzBuilder().Add<float>("a", "<c8", "(1,)", {1}).Bytes()), HasSubstr("c8"));
  EXPECT_THAT(refusal(NpzBuilder().Add<float>("a", "<f4", "(5,)", {1}).Bytes()),
              HasSubstr("shorter"));
  EXPECT_THAT(refusal(NpzBuilder().Add<float>("a", "<f4", "(1, 1, 1)", {1}).Bytes()),
              HasSubstr("dimensions"));
}

}  // namespace
}  // namespace pfseq
