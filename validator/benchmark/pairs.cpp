// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/pairs.h"

#include "renderer/core/error.h"
#include "renderer/core/parse_number.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pfseq {
namespace {

constexpr int kMaxFrame = 1'000'000;

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

[[noreturn]] void FailPairs(const std::string& item) {
  throw InputError(
      "--pairs {}: expected FRAME, START:STOP[:STEP] or CAMERA:FRAME-CAMERA:FRAME, "
      "separated by commas",
      item);
}

int FrameOf(const std::string& text, const std::string& item) {
  const std::optional<int> frame = ParseNumber<int>(text);
  if (!frame || *frame < 0 || *frame > kMaxFrame) {
    FailPairs(item);
  }
  return *frame;
}

/// START:STOP[:STEP] or a single frame.
std::vector<int> FramesOf(const std::string& item) {
  const std::vector<std::string> parts = Split(item, ':');
  const int start = FrameOf(parts[0], item);
  const int stop = parts.size() > 1 ? FrameOf(parts[1], item) : start + 1;
  const int step = parts.size() > 2 ? FrameOf(parts[2], item) : 1;
  if (parts.size() > 3 || step < 1 || stop <= start) {
    FailPairs(item);
  }
  std::vector<int> frames;
  for (int frame = start; frame < stop; frame += step) {
    frames.push_back(frame);
  }
  return frames;
}

ViewName ViewOf(const std::string& text, const std::string& item) {
  const std::vector<std::string> parts = Split(text, ':');
  if (parts.size() != 2 || parts[0].empty()) {
    FailPairs(item);
  }
  return {parts[0], FrameOf(parts[1], item)};
}

std::string LabelOf(const ViewName& first, const ViewName& second) {
  return fmt::format("{}:{}-{}:{}", first.camera, first.frame, second.camera, second.frame);
}

std::array<std::string, 2> ChooseCameras(const ViewSource& source,
                                         const std::array<std::string, 2>& wanted) {
  const std::vector<std::string> cameras = source.Cameras();
  if (wanted[0].empty() && wanted[1].empty()) {
    if (cameras.size() < 2) {
      throw InputError(
          "{}: a pair needs two cameras, got {}; see --successive", source.Name(), cameras.size());
    }
    return {cameras[0], cameras[1]};
  }
  for (const std::string& camera : wanted) {
    if (std::find(cameras.begin(), cameras.end(), camera) == cameras.end()) {
      throw InputError("camera '{}': the sequence has {}", camera, fmt::join(cameras, ", "));
    }
  }
  if (wanted[0] == wanted[1]) {
    throw InputError("--cameras: expected two different ones, got '{}' twice", wanted[0]);
  }
  return wanted;
}

/// All pairs of one lens.
class PairsOfLens {
 public:
  PairsOfLens(const ViewSource& source, const std::string& variant, const std::string& lens)
      : source_(source), variant_(variant), lens_(lens) {}

  void Frames(const std::array<std::string, 2>& cameras, const std::vector<int>& frames) {
    for (const int frame : frames) {
      Add({cameras[0], frame}, {cameras[1], frame}, fmt::format("{}", frame));
    }
  }

  void All(const std::array<std::string, 2>& cameras) {
    const std::vector<int> first = source_.Frames(lens_, cameras[0], variant_);
    const std::vector<int> second = source_.Frames(lens_, cameras[1], variant_);
    std::vector<int> both;
    std::set_intersection(
        first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(both));
    Frames(cameras, both);
  }

  void Successive(int step) {
    for (const std::string& camera : source_.Cameras()) {
      const std::vector<int> frames = source_.Frames(lens_, camera, variant_);
      for (const int frame : frames) {
        if (std::binary_search(frames.begin(), frames.end(), frame + step)) {
          const ViewName first = {camera, frame};
          const ViewName second = {camera, frame + step};
          Add(first, second, LabelOf(first, second));
        }
      }
    }
  }

  void Add(const ViewName& first, const ViewName& second, const std::string& label) {
    for (const ViewName& view : {first, second}) {
      const std::vector<int> frames = source_.Frames(lens_, view.camera, variant_);
      if (!std::binary_search(frames.begin(), frames.end(), view.frame)) {
        throw InputError("{}: {}: frame {}: expected a {} image of camera '{}'",
                         source_.Name(),
                         lens_,
                         view.frame,
                         variant_,
                         view.camera);
      }
      source_.WorldFromCamera(view);  // Throws when there is no pose.
    }
    if (std::none_of(pairs_.begin(), pairs_.end(), [&](const PairOfViews& known) {
          return known.first == first && known.second == second;
        })) {
      pairs_.push_back({lens_, first, second, label});
    }
  }

  const std::vector<PairOfViews>& Result() const { return pairs_; }

 private:
  const ViewSource& source_;
  std::string variant_;
  std::string lens_;
  std::vector<PairOfViews> pairs_;
};

/// A sequence need not be rendered with all of its lenses.
std::vector<std::string> LensesWithImages(const ViewSource& source, const std::string& variant) {
  std::vector<std::string> lenses;
  for (const std::string& lens : source.Lenses()) {
    const std::vector<std::string> cameras = source.Cameras();
    if (std::any_of(cameras.begin(), cameras.end(), [&](const std::string& camera) {
          return !source.Frames(lens, camera, variant).empty();
        })) {
      lenses.push_back(lens);
    }
  }
  return lenses;
}

}  // namespace

std::string ChooseVariant(const ViewSource& source, const std::string& wanted) {
  const std::vector<std::string> variants = source.Variants();
  if (variants.empty()) {
    throw InputError("{}: expected realistic or clean images, got none", source.Name());
  }
  if (wanted.empty()) {
    return variants.front();
  }
  if (std::find(variants.begin(), variants.end(), wanted) == variants.end()) {
    throw InputError(
        "--variant {}: {} has {} images only", wanted, source.Name(), fmt::join(variants, " and "));
  }
  return wanted;
}

std::vector<int> FramesOfPairs(const std::string& pairs) {
  std::set<int> frames;
  for (const std::string& item : Split(pairs, ',')) {
    const std::vector<std::string> views = Split(item, '-');
    if (views.size() == 2) {
      frames.insert(ViewOf(views[0], item).frame);
      frames.insert(ViewOf(views[1], item).frame);
    } else {
      const std::vector<int> some = FramesOf(item);
      frames.insert(some.begin(), some.end());
    }
  }
  return {frames.begin(), frames.end()};
}

std::vector<PairOfViews> ChoosePairs(const ViewSource& source,
                                     const std::string& variant,
                                     const BenchmarkOptions& options) {
  std::vector<PairOfViews> pairs;
  for (const std::string& lens :
       options.lenses.empty() ? LensesWithImages(source, variant) : options.lenses) {
    source.LensOf(lens);  // Throws for an unknown name.
    PairsOfLens of_lens(source, variant, lens);
    if (options.successive > 0) {
      of_lens.Successive(options.successive);
    } else if (options.pairs.empty()) {
      of_lens.All(ChooseCameras(source, options.cameras));
    } else {
      for (const std::string& item : Split(options.pairs, ',')) {
        const std::vector<std::string> views = Split(item, '-');
        if (views.size() == 2) {
          const ViewName first = ViewOf(views[0], item);
          const ViewName second = ViewOf(views[1], item);
          of_lens.Add(first, second, LabelOf(first, second));
        } else {
          of_lens.Frames(ChooseCameras(source, options.cameras), FramesOf(item));
        }
      }
    }
    pairs.insert(pairs.end(), of_lens.Result().begin(), of_lens.Result().end());
  }
  if (pairs.empty()) {
    throw InputError("{}: no pair of {} images of two views", source.Name(), variant);
  }
  return pairs;
}

}  // namespace pfseq
