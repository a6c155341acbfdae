// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/light_store.h"

#include "tests/trace/stored_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

TEST(LightStore, SerialisedAndLoadedIsTheSame) {
  StoredScene stored(Spacing(0.25F));
  const std::vector<ShadingPoint> points = stored.Points(300);
  stored.ComputeMissing(points, 2);
  const std::string bytes = stored.store.Serialize();

  StoredScene loaded(Spacing(0.25F));
  ASSERT_TRUE(loaded.store.Load(bytes));
  EXPECT_EQ(loaded.store.NumRecords(), stored.store.NumRecords());
  EXPECT_TRUE(loaded.store.Serialize() == bytes);
  for (const ShadingPoint& point : points) {
    ASSERT_TRUE(IsSame(loaded.store.Lookup(point, LightDetail::kSeen),
                       stored.store.Lookup(point, LightDetail::kSeen)));
  }
  EXPECT_EQ(loaded.store.NumRecords(), stored.store.NumRecords());
  EXPECT_TRUE(loaded.Missing(points).empty());
}

TEST(LightStore, LoadsWhatIsThereFromTwoRuns) {
  StoredScene first(Spacing(0.25F));
  const std::vector<ShadingPoint> points = first.Points(300);
  const std::vector<ShadingPoint> half(points.begin(), points.begin() + 150);
  first.Compute(first.Missing(half), 1);
  StoredScene both(Spacing(0.25F));
  both.Compute(both.Missing(points), 1);
  StoredScene second(Spacing(0.25F));
  second.Compute(second.Missing({points.begin() + 100, points.end()}), 1);
  ASSERT_TRUE(second.store.Load(first.store.Serialize()));
  EXPECT_TRUE(second.store.Serialize() == both.store.Serialize());
}

TEST(LightStore, RefusesBytesThatAreNotItsOwnAndLoadsNothing) {
  StoredScene stored(Spacing(0.25F));
  stored.Compute(stored.Missing(stored.Points(200)), 2);
  const std::string bytes = stored.store.Serialize();

  StoredScene loaded(Spacing(0.25F));
  const std::string empty = loaded.store.Serialize();
  const auto expect_refused = [&](std::string_view damaged, const std::string& what) {
    EXPECT_FALSE(loaded.store.Load(damaged)) << what;
    EXPECT_EQ(loaded.store.NumRecords(), 0) << what;
    EXPECT_TRUE(loaded.store.Serialize() == empty) << what;
  };
  // Less than a page's header and a record is lacking.
  for (size_t lacking = 1; lacking <= 24; ++lacking) {
    expect_refused(std::string_view(bytes).substr(0, bytes.size() - lacking), "truncated");
  }
  for (const size_t size : {size_t{0}, size_t{7}, size_t{11}, size_t{19}}) {
    expect_refused(std::string_view(bytes).substr(0, size), "nearly nothing");
  }
  expect_refused(bytes + "x", "a byte too many");
  expect_refused(std::string(5000, '\xA5'), "garbage");
  std::string garbage = bytes;
  for (size_t i = 8; i < garbage.size(); ++i) {
    garbage[i] = static_cast<char>(HashKey({i}));
  }
  expect_refused(garbage, "garbage after the number of triangles");

  Scene smaller = Yard();
  smaller.meshes.pop_back();
  StoredScene other(Spacing(0.25F), smaller);
  EXPECT_FALSE(other.store.Load(bytes));
  EXPECT_EQ(other.store.NumRecords(), 0);
  ASSERT_TRUE(loaded.store.Load(bytes));
}

TEST(LightStore, RefusesRecordsThatAFaceDoesNotHave) {
  // The floor has 25 records a metre apart: three pages of eight and one record on the fourth.
  const auto bytes_with = [](uint32_t face_idx, uint32_t page_idx, uint32_t ready, uint16_t state) {
    std::string bytes;
    const auto append = [&](const auto& value) {
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    append(uint64_t{StoredScene(Spacing(1.0F)).lit.surfaces.NumTriangles()});
    append(std::array<uint32_t, 3>{face_idx, page_idx, ready});
    append(std::array<uint16_t, 12>{0, 0, 0, state});
    return bytes;
  };
  const auto loads = [&](const std::string& bytes) {
    StoredScene stored(Spacing(1.0F));
    const bool is_loaded = stored.store.Load(bytes);
    EXPECT_EQ(stored.store.NumRecords(), is_loaded ? 1 : 0);
    return is_loaded;
  };
  EXPECT_TRUE(loads(bytes_with(0, 3, 1U, 2)));
  EXPECT_FALSE(loads(bytes_with(0, 3, 2U, 2))) << "a 26th record";
  EXPECT_FALSE(loads(bytes_with(0, 8, 1U, 2))) << "a fifth page of the back";
  EXPECT_FALSE(loads(bytes_with(1, 0, 1U, 2))) << "the parallelogram's second triangle";
  EXPECT_FALSE(loads(bytes_with(100000, 0, 1U, 2))) << "a triangle too many";
  EXPECT_FALSE(loads(bytes_with(0, 3, 1U, 1))) << "a record that was wanted alone";
}

}  // namespace
}  // namespace pfseq
