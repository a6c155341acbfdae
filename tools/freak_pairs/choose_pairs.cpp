// SPDX-License-Identifier: Apache-2.0
// Chooses FREAK's 512 pairs on images and writes validator/features/freak_pairs.cpp to standard
// output.
// Usage: choose_freak_pairs "where the images come from" IMAGE...
#include "renderer/core/image.h"
#include "renderer/sequence/image_io.h"
#include "validator/features/freak_training.h"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <vector>

#include <fmt/format.h>

int main(int argc, char** argv) {
  try {
    std::vector<pfseq::Image<uint8_t>> images;
    for (int i = 2; i < argc; ++i) {
      images.push_back(pfseq::ReadImage8(argv[i]));
    }
    const std::string provenance = argc > 1 ? argv[1] : "";
    fmt::print("{}", pfseq::FreakPairsSource(pfseq::ChooseFreakPairs(images), provenance));
  } catch (const std::exception& error) {
    fmt::print(stderr, "choose_freak_pairs: {}\n", error.what());
    return 2;
  }
  return 0;
}
