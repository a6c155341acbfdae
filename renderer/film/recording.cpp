// SPDX-License-Identifier: Apache-2.0
#include "renderer/film/recording.h"

#include "renderer/core/check.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/trace/color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfseq {
namespace {

/// From here on a Poisson number is as good as normal.
constexpr double kMinNormalMean = 64.0;

/// Normal number of mean 0 and deviation 1 (Box and Muller 1958).
double Normal(RandomStream& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.Uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.Uniform());
}

double Poisson(double mean, RandomStream& random) {
  if (mean >= kMinNormalMean) {
    return std::max(0.0, std::round(mean + std::sqrt(mean) * Normal(random)));
  }
  // Inversion: the first count whose distribution function exceeds a uniform number.
  const double uniform = random.Uniform();
  double probability = std::exp(-mean);
  double below = probability;
  int count = 0;
  constexpr int kMaxCount = 256;
  while (uniform >= below && count < kMaxCount) {
    ++count;
    probability *= mean / count;
    below += probability;
  }
  return count;
}

float MeanColor(const Image<float>& image, int x, int y) {
  return Luminance(Rgb(image.At(x, y, 0), image.At(x, y, 1), image.At(x, y, 2)));
}

/// One channel instead of three.
Image<float> Grey(const Image<float>& image) {
  Image<float> grey(image.WidthPx(), image.HeightPx(), 1);
  for (int y = 0; y < image.HeightPx(); ++y) {
    for (int x = 0; x < image.WidthPx(); ++x) {
      grey.At(x, y) = MeanColor(image, x, y);
    }
  }
  return grey;
}

}  // namespace

Recording::Recording(const SensorSpec& spec) : spec_(spec), sensor_(spec) {}

int Recording::ChannelAt(int x, int y) const {
  const char color = spec_.mosaic[static_cast<size_t>(y % 2 * 2 + x % 2)];
  return color == 'r' ? 0 : color == 'g' ? 1 : 2;
}

float Recording::Photosite(float exposed, uint64_t key) const {
  RandomStream random(key);
  const double mean = std::max(0.0F, exposed) * spec_.white_electrons;
  double electrons = Poisson(mean, random);
  if (spec_.read_noise_electrons > 0.0) {
    electrons += spec_.read_noise_electrons * Normal(random);
  }
  return static_cast<float>(electrons / spec_.white_electrons);
}

void Recording::AddNoise(Image<float>& exposed, uint64_t key, int num_threads) const {
  ParallelFor(static_cast<size_t>(exposed.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < exposed.WidthPx(); ++x) {
      for (int channel = 0; channel < exposed.NumChannels(); ++channel) {
        float& value = exposed.At(x, y, channel);
        value = Photosite(
            value, HashKey({key, row, static_cast<uint64_t>(x), static_cast<uint64_t>(channel)}));
      }
    }
  });
}

Image<float> Recording::Demosaiced(const Image<float>& exposed, int num_threads) const {
  Image<float> full(exposed.WidthPx(), exposed.HeightPx(), 3);
  ParallelFor(static_cast<size_t>(exposed.HeightPx()), num_threads, [&](size_t row) {
    const auto y = static_cast<int>(row);
    for (int x = 0; x < exposed.WidthPx(); ++x) {
      Rgb sum = Rgb::Zero();
      Rgb weights = Rgb::Zero();
      for (int j = std::max(0, y - 1); j <= std::min(exposed.HeightPx() - 1, y + 1); ++j) {
        for (int i = std::max(0, x - 1); i <= std::min(exposed.WidthPx() - 1, x + 1); ++i) {
          const int channel = ChannelAt(i, j);
          const auto weight = static_cast<float>((i == x ? 2 : 1) * (j == y ? 2 : 1));
          sum[channel] += weight * exposed.At(i, j, channel);
          weights[channel] += weight;
        }
      }
      // A photosite's own channel is what it has measured.
      const int own = ChannelAt(x, y);
      for (int channel = 0; channel < 3; ++channel) {
        const float mean = weights[channel] > 0.0F ? sum[channel] / weights[channel] : 0.0F;
        full.At(x, y, channel) = channel == own ? exposed.At(x, y, own) : mean;
      }
    }
  });
  return full;
}

Image<uint16_t> Recording::Record(const Image<float>& radiance,
                                  uint64_t key,
                                  int num_threads) const {
  PFSEQ_CHECK(radiance.NumChannels() == 3, "{} channels", radiance.NumChannels());
  const bool is_grey = spec_.color == "grey";
  const bool has_mosaic = spec_.mosaic != "none";
  Image<float> exposed = is_grey && !has_mosaic ? Grey(radiance) : radiance;
  for (float& value : exposed.Values()) {
    value *= sensor_.Exposure();
  }
  if (spec_.white_electrons > 0.0) {
    AddNoise(exposed, key, num_threads);
  }
  if (has_mosaic) {
    exposed = Demosaiced(exposed, num_threads);
    if (is_grey) {
      exposed = Grey(exposed);
    }
  }
  const float white = spec_.bits == 16 ? 65535.0F : 255.0F;
  const bool is_linear = spec_.encoding == "linear";
  Image<uint16_t> codes(exposed.WidthPx(), exposed.HeightPx(), exposed.NumChannels());
  std::transform(
      exposed.Values().begin(), exposed.Values().end(), codes.Values().begin(), [&](float value) {
        if (!(value > 0.0F)) {
          return uint16_t{0};
        }
        const float toned = sensor_.ToneMap(value);
        return static_cast<uint16_t>(
            std::lround(white * (is_linear ? toned : SrgbFromLinear(toned))));
      });
  return codes;
}

}  // namespace pfseq
