// SPDX-License-Identifier: Apache-2.0
#include "renderer/trace/sampler.h"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace pfseq {
namespace {

/// Dimension 1 by its direction numbers: v_0 = 1/2, v_k = v_(k-1) xor v_(k-1) / 2.
uint32_t SobolByDirectionNumbers(uint32_t index) {
  uint32_t result = 0;
  for (uint32_t direction = 1U << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
    if ((index & 1U) != 0) {
      result ^= direction;
    }
  }
  return result;
}

TEST(Sobol2D, StartsWithTheKnownPoints) {
  const double x[] = {0.0, 0.5, 0.25, 0.75, 0.125};
  const double y[] = {0.0, 0.5, 0.75, 0.25, 0.625};
  for (uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(Sobol2D(i).x * 0x1.0p-32, x[i]) << i;
    EXPECT_EQ(Sobol2D(i).y * 0x1.0p-32, y[i]) << i;
  }
}

TEST(Sobol2D, SecondDimensionFollowsItsDirectionNumbers) {
  for (uint32_t i = 0; i < 5000; ++i) {
    const auto index = static_cast<uint32_t>(HashKey({i}) >> (i % 32));
    ASSERT_EQ(Sobol2D(index).y, SobolByDirectionNumbers(index)) << index;
  }
}

TEST(SobolThird, StartsWithTheKnownPoints) {
  // Those of Joe and Kuo's program, which goes through the indices in the order of Gray's code.
  const double values[] = {0.0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375};
  for (uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(SobolThird(i ^ (i >> 1)) * 0x1.0p-32, values[i]) << i;
  }
}

TEST(NestedUniformScramble, KeepsTheTreeOfIntervals) {
  // Two numbers that agree in just their first n bits agree in just as many after scrambling.
  for (uint64_t i = 0; i < 2000; ++i) {
    const auto bits = static_cast<uint32_t>(HashKey({i, 1}));
    const auto seed = static_cast<uint32_t>(HashKey({i, 2}));
    const int shared = static_cast<int>(i % 32);
    const uint32_t other = bits ^ (static_cast<uint32_t>(HashKey({i, 3}) | 0x80000000U) >> shared);
    const uint32_t difference =
        NestedUniformScramble(bits, seed) ^ NestedUniformScramble(other, seed);
    ASSERT_EQ(__builtin_clz(difference), shared);
  }
}

TEST(PixelSampler, EachPowerOfTwoPrefixIsANet) {
  for (const uint64_t pixel : {0ULL, 7ULL, 1439999ULL}) {
    for (int draw = 0; draw < 3; ++draw) {
      for (int m = 0; m <= 9; ++m) {
        const int count = 1 << m;
        std::vector<Vec2d> points;
        for (int i = 0; i < count; ++i) {
          PixelSampler sampler(1, 24, 0, pixel, static_cast<uint32_t>(i));
          for (int skipped = 0; skipped < draw; ++skipped) {
            sampler.Get1D();
          }
          points.push_back(sampler.Get2D());
        }
        for (int a = 0; a <= m; ++a) {
          std::set<int> cells;
          for (const Vec2d& point : points) {
            const int column = static_cast<int>(point.x() * (1 << a));
            const int row = static_cast<int>(point.y() * (1 << (m - a)));
            cells.insert(column * (1 << (m - a)) + row);
          }
          ASSERT_EQ(cells.size(), static_cast<size_t>(count))
              << "pixel " << pixel << " draw " << draw << " a " << a;
        }
      }
    }
  }
}

/// Correlation of the first coordinates of two lists of points in [0, 1): about 0 +- 1 / sqrt(n)
/// when independent.
template <typename First, typename Second>
double Correlation(int count, const First& first, const Second& second) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    sum +=
        (first(i).x() - 0.5) * (second(i).x() - 0.5) + (first(i).y() - 0.5) * (second(i).y() - 0.5);
  }
  return sum / count * 6.0;
}

TEST(PixelSampler, PixelsFramesCamerasAndSeedsAreIndependent) {
  constexpr int kCount = 10000;
  const auto base = [](int i) {
    return PixelSampler(1, 2, 0, static_cast<uint64_t>(i), 5).Get2D();
  };
  const auto next_pixel = [](int i) {
    return PixelSampler(1, 2, 0, static_cast<uint64_t>(i) + 1, 5).Get2D();
  };
  const auto next_frame = [](int i) {
    return PixelSampler(1, 3, 0, static_cast<uint64_t>(i), 5).Get2D();
  };
  const auto next_camera = [](int i) {
    return PixelSampler(1, 2, 1, static_cast<uint64_t>(i), 5).Get2D();
  };
  const auto next_seed = [](int i) {
    return PixelSampler(2, 2, 0, static_cast<uint64_t>(i), 5).Get2D();
  };
  const auto next_draw = [](int i) {
    PixelSampler sampler(1, 2, 0, static_cast<uint64_t>(i), 5);
    sampler.Get2D();
    return sampler.Get2D();
  };
  EXPECT_NEAR(Correlation(kCount, base, base), 1.0, 0.05);
  EXPECT_NEAR(Correlation(kCount, base, next_pixel), 0.0, 0.04);
  EXPECT_NEAR(Correlation(kCount, base, next_frame), 0.0, 0.04);
  EXPECT_NEAR(Correlation(kCount, base, next_camera), 0.0, 0.04);
  EXPECT_NEAR(Correlation(kCount, base, next_seed), 0.0, 0.04);
  EXPECT_NEAR(Correlation(kCount, base, next_draw), 0.0, 0.04);
}

TEST(PixelSampler, DrawsOfOneSequenceAreIndependent) {
  const auto draw = [](int number) {
    return [number](int i) {
      PixelSampler sampler(1, 0, 0, 99, static_cast<uint32_t>(i));
      for (int skipped = 0; skipped < number; ++skipped) {
        sampler.Get2D();
      }
      return sampler.Get2D();
    };
  };
  for (int number = 1; number < 6; ++number) {
    EXPECT_NEAR(Correlation(4096, draw(0), draw(number)), 0.0, 0.05) << number;
  }
}

TEST(PixelSampler, EachSampleIsUniformOverPixels) {
  constexpr int kCount = 40000;
  std::vector<int> histogram(16, 0);
  for (int pixel = 0; pixel < kCount; ++pixel) {
    const Vec2d point = PixelSampler(3, 0, 0, static_cast<uint64_t>(pixel), 0).Get2D();
    ASSERT_TRUE(point.minCoeff() >= 0.0 && point.maxCoeff() < 1.0);
    ++histogram[static_cast<size_t>(static_cast<int>(point.x() * 4) * 4 +
                                    static_cast<int>(point.y() * 4))];
  }
  double chi_square = 0.0;
  for (const int count : histogram) {
    chi_square += std::pow(count - kCount / 16.0, 2) / (kCount / 16.0);
  }
  EXPECT_LT(chi_square, 37.7);  // the 99.9 % point of 15 degrees of freedom
}

TEST(PixelSampler, ThreeNumbersAreANetTogether) {
  // Of quality 1: each box of volume 2 / 2^m holds two of the first 2^m points.
  constexpr int kLog2Count = 6;
  for (const uint64_t pixel : {0ULL, 7ULL, 1439999ULL}) {
    std::vector<Vec3d> points;
    for (uint32_t i = 0; i < 1U << kLog2Count; ++i) {
      points.push_back(PixelSampler(1, 24, 0, pixel, i).Get3D());
      EXPECT_EQ(points.back().head<2>(), PixelSampler(1, 24, 0, pixel, i).Get2D());
    }
    for (int a = 0; a < kLog2Count; ++a) {
      for (int b = 0; a + b < kLog2Count; ++b) {
        const Vec3d cells(1 << a, 1 << b, 1 << (kLog2Count - 1 - a - b));
        std::multiset<std::array<int, 3>> found;
        for (const Vec3d& point : points) {
          const Vec3d cell = point.cwiseProduct(cells);
          found.insert(
              {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())});
        }
        for (const std::array<int, 3>& cell : found) {
          EXPECT_EQ(found.count(cell), 2U) << a << " " << b;
        }
      }
    }
  }
}

TEST(PixelSampler, VertexDrawsDoNotDependOnWhatWasDrawnBefore) {
  PixelSampler few(1, 2, 3, 4, 5);
  PixelSampler many(1, 2, 3, 4, 5);
  few.StartVertex(2);
  many.Get2D();
  many.StartVertex(1);
  many.Get1D();
  many.Get2D();
  many.StartVertex(2);
  EXPECT_EQ(few.Get2D(), many.Get2D());
  EXPECT_EQ(few.Get1D(), many.Get1D());
}

TEST(PixelSampler, VerticesAndCameraShareNoDraw) {
  std::set<double> seen;
  PixelSampler sampler(1, 2, 3, 4, 5);
  for (int i = 0; i < PixelSampler::kCameraDraws; ++i) {
    EXPECT_TRUE(seen.insert(sampler.Get1D()).second);
  }
  for (int vertex = 0; vertex < 4; ++vertex) {
    sampler.StartVertex(vertex);
    for (int i = 0; i < PixelSampler::kDrawsPerVertex; ++i) {
      EXPECT_TRUE(seen.insert(sampler.Get1D()).second);
    }
  }
}

TEST(PixelSampler, IntegratesBetterThanRandomForCountsThatAreNoPowerOfTwo) {
  constexpr int kNumSamples = 100;
  constexpr int kNumPixels = 200;
  double squared_error = 0.0;
  for (uint64_t pixel = 0; pixel < kNumPixels; ++pixel) {
    double sum = 0.0;
    for (uint32_t i = 0; i < kNumSamples; ++i) {
      const Vec2d point = PixelSampler(1, 0, 0, pixel, i).Get2D();
      sum += point.x() * point.y();
    }
    squared_error += std::pow(sum / kNumSamples - 0.25, 2);
  }
  // Independent points: variance 7 / 144 / n.
  EXPECT_LT(squared_error / kNumPixels, 0.05 * 7.0 / 144.0 / kNumSamples);
}

}  // namespace
}  // namespace pfseq
