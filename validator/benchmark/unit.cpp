// SPDX-License-Identifier: Apache-2.0
#include "validator/benchmark/unit.h"

#include "renderer/core/check.h"
#include "renderer/core/error.h"
#include "validator/features/describe.h"
#include "validator/match_picture.h"
#include "validator/matching/match.h"

#include <algorithm>
#include <ctime>
#include <map>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr size_t kMaxMembers = 64;

/// CPU seconds of the calling thread.
double ThreadCpuS() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string LensText(const Lens& lens) {
  std::string text = fmt::format("{} {} {} {} {} {}",
                                 lens.ModelName(),
                                 lens.FocalPx().x(),
                                 lens.FocalPx().y(),
                                 lens.PrincipalPointPx().x(),
                                 lens.PrincipalPointPx().y(),
                                 lens.MaxAngleRad());
  if (const auto* model = std::get_if<KannalaBrandt>(&lens.Model())) {
    for (const double coefficient : model->Coefficients()) {
      text += fmt::format(" {}", coefficient);
    }
  }
  return text;
}

/// A setting with all of its values: what a stage depends on.
std::string FullText(const Setting& setting) {
  std::string text = setting.Kind().name;
  for (const Parameter& parameter : setting.Kind().parameters) {
    const std::optional<double> value = setting.Value(parameter.name);
    text += fmt::format(
        " {}={}", parameter.name, value ? fmt::format("{}", *value) : std::string("auto"));
  }
  return text;
}

bool IsPolar(const BenchmarkContext& context, const Family& family) {
  return context.OwnGrid().detectors[family.front()].detector.is_polar;
}

std::vector<Setting> MembersOf(const BenchmarkContext& context, const Family& family) {
  std::vector<Setting> members;
  for (const size_t detector : family) {
    members.push_back(context.OwnGrid().detectors[detector].detector.setting);
  }
  return members;
}

/// Classes of points: those that the same members have.
struct Classes {
  std::vector<int> of_point;
  std::vector<uint64_t> members_of_class;

  explicit Classes(const std::vector<uint64_t>& members) {
    std::map<uint64_t, int> known;
    for (const uint64_t mask : members) {
      const auto [found, is_new] = known.emplace(mask, static_cast<int>(known.size()));
      if (is_new) {
        members_of_class.push_back(mask);
      }
      of_point.push_back(found->second);
    }
  }

  ClassedDescriptors Of(const Descriptors& descriptors) const {
    ClassedDescriptors classed{&descriptors, {}, static_cast<int>(members_of_class.size())};
    for (const int point : descriptors.key_point_idx) {
      classed.row_class.push_back(of_point[point]);
    }
    return classed;
  }

  std::vector<bool> OfMember(size_t member) const {
    std::vector<bool> has;
    for (const uint64_t mask : members_of_class) {
      has.push_back(((mask >> member) & 1U) != 0);
    }
    return has;
  }
};

/// Rows whose point a member has.
std::vector<int> RowsOfMember(const Descriptors& descriptors,
                              const FamilyKeyPoints& family,
                              size_t member) {
  std::vector<int> rows;
  for (size_t row = 0; row < descriptors.key_point_idx.size(); ++row) {
    if (((family.members[descriptors.key_point_idx[row]] >> member) & 1U) != 0) {
      rows.push_back(static_cast<int>(row));
    }
  }
  return rows;
}

/// A descriptor of the family with the members that want it, each with its matchers.
struct DescriptorWork {
  Setting descriptor;
  std::vector<std::pair<size_t, std::vector<Setting>>> members;
};

std::vector<DescriptorWork> DescriptorsOf(const BenchmarkContext& context, const Family& family) {
  std::vector<DescriptorWork> work;
  for (size_t member = 0; member < family.size(); ++member) {
    for (const auto& wanted : context.OwnGrid().detectors[family[member]].descriptors) {
      auto found = std::find_if(work.begin(), work.end(), [&](const DescriptorWork& known) {
        return known.descriptor == wanted.descriptor;
      });
      if (found == work.end()) {
        found = work.insert(work.end(), {wanted.descriptor, {}});
      }
      found->members.emplace_back(member, wanted.matchers);
    }
  }
  return work;
}

/// Runs one unit.
class Unit {
 public:
  Unit(const BenchmarkContext& context,
       const PairOfViews& pair,
       size_t pair_idx,
       const Family& family)
      : context_(context), pair_(pair), pair_idx_(pair_idx), family_(family) {}

  UnitResult Run() {
    Timed("detect", [&] {
      first_ = DetectView(context_, pair_.lens, pair_.first, family_);
      second_ = DetectView(context_, pair_.lens, pair_.second, family_);
    });
    Timed("judge", [&] { JudgeMembers(); });
    for (const DescriptorWork& work : DescriptorsOf(context_, family_)) {
      const MatchLists lists = Matches(work);
      Timed("judge", [&] { JudgeLists(work, lists); });
    }
    return std::move(result_);
  }

 private:
  template <typename Body>
  void Timed(const std::string& stage, const Body& body) {
    const double start_s = ThreadCpuS();
    body();
    const double cpu_s = ThreadCpuS() - start_s;
    auto known = std::find_if(result_.times.begin(),
                              result_.times.end(),
                              [&](const StageTime& time) { return time.stage == stage; });
    if (known == result_.times.end()) {
      result_.times.push_back({pair_idx_, UnitName(), stage, cpu_s});
    } else {
      known->cpu_s += cpu_s;
    }
  }

  std::string UnitName() const {
    const std::string name = DetectorName(0);
    return family_.size() == 1 ? name : fmt::format("{} and {} more", name, family_.size() - 1);
  }
  std::string DetectorName(size_t member) const {
    return context_.OwnGrid().detectors[family_[member]].detector.Name();
  }

  void JudgeMembers() {
    const ScenePoints first_m = context_.Lift(pair_.lens, pair_.first, first_.judged.pixels_px);
    const ScenePoints second_m = context_.Lift(pair_.lens, pair_.second, second_.judged.pixels_px);
    for (size_t member = 0; member < family_.size(); ++member) {
      Member& own = members_.emplace_back();
      own.first_points = PointsOfMember(first_.family, member);
      own.second_points = PointsOfMember(second_.family, member);
      own.first_place = Places(own.first_points, first_m.size());
      own.second_place = Places(own.second_points, second_m.size());
      own.pair.first = Subset(first_.judged, own.first_points);
      own.pair.second = Subset(second_.judged, own.second_points);
      for (const int i : own.first_points) {
        own.pair.points.first_m.push_back(first_m[i]);
      }
      for (const int i : own.second_points) {
        own.pair.points.second_m.push_back(second_m[i]);
      }
      own.pair.points.first_centre_m = context_.Source().WorldFromCamera(pair_.first).translation_m;
      own.pair.points.second_centre_m =
          context_.Source().WorldFromCamera(pair_.second).translation_m;
      own.detections = JudgeDetections(own.pair, context_.Judging(), context_.Draws());
      own.detections.result.setup = DetectorName(member);
      own.detections.result.pair_idx = pair_idx_;
      result_.of_members.push_back({own.detections.result});
    }
  }

  /// The lists of each member and matcher, loaded or made.
  MatchLists Matches(const DescriptorWork& work) {
    std::vector<std::string> inputs = {
        "matches", first_.key, second_.key, FullText(work.descriptor)};
    for (const auto& [member, matchers] : work.members) {
      inputs.push_back(fmt::format("member {}", member));
      for (const Setting& matcher : matchers) {
        inputs.push_back(FullText(matcher));
      }
    }
    const std::string key = StageStore::KeyOf(inputs);
    if (std::optional<MatchLists> lists = context_.Store().LoadMatches(key)) {
      return std::move(*lists);
    }
    Descriptors first, second;
    Timed("describe " + DescriptorName(work.descriptor), [&] {
      first = DescribeView(pair_.first, first_, work.descriptor);
      second = DescribeView(pair_.second, second_, work.descriptor);
    });
    MatchLists lists = MatchAll(work, first, second);
    context_.Store().SaveMatches(key, lists);
    return lists;
  }

  Descriptors DescribeView(const ViewName& view,
                           const DetectedView& detected,
                           const Setting& descriptor) const {
    const cv::Mat grey = IsPolar(context_, family_)
                             ? context_.PolarOf(pair_.lens, view)->grey
                             : context_.ImageOf(pair_.lens, view)->fisheye.grey;
    const Setting& detector = context_.OwnGrid().detectors[family_.front()].detector.setting;
    return Describe(grey, detected.family.points, detector, descriptor);
  }

  MatchLists MatchAll(const DescriptorWork& work,
                      const Descriptors& first,
                      const Descriptors& second) {
    const Classes first_classes(first_.family.members);
    const Classes second_classes(second_.family.members);
    const ClassedDescriptors classed_first = first_classes.Of(first);
    const ClassedDescriptors classed_second = second_classes.Of(second);
    NearestTables tables;
    const std::string name = DescriptorName(work.descriptor);
    Timed("match " + name, [&] { tables = FindNearest(classed_first, classed_second, 1); });
    MatchLists lists;
    for (const auto& [member, matchers] : work.members) {
      const SubsetNeighbours neighbours = {&tables,
                                           &classed_first,
                                           &classed_second,
                                           first_classes.OfMember(member),
                                           second_classes.OfMember(member)};
      for (const Setting& matcher : matchers) {
        std::vector<RowMatch> matches;
        const std::string stage = matcher.Is("FLANN") ? "FLANN " + name : "match " + name;
        Timed(stage, [&, member_idx = member] {
          if (matcher.Is("BruteForce")) {
            matches = CrossCheckedMatches(neighbours);
          } else if (matcher.Is("RatioTest")) {
            matches = RatioMatches(neighbours, matcher.Number("ratio"));
          } else {
            matches = FlannMatches(
                first,
                RowsOfMember(first, first_.family, member_idx),
                second,
                RowsOfMember(second, second_.family, member_idx),
                {matcher.Integer("trees"), matcher.Integer("checks"), matcher.Number("ratio")});
          }
        });
        auto& list = lists.emplace_back();
        for (const RowMatch& match : matches) {
          list.emplace_back(first.key_point_idx[match.first], second.key_point_idx[match.second]);
        }
      }
    }
    return lists;
  }

  void JudgeLists(const DescriptorWork& work, const MatchLists& lists) {
    size_t next = 0;
    for (const auto& [member, matchers] : work.members) {
      const Member& own = members_[member];
      for (const Setting& matcher : matchers) {
        std::vector<std::pair<int, int>> attempted;
        for (const auto& [first, second] : lists.at(next++)) {
          attempted.emplace_back(own.first_place[first], own.second_place[second]);
        }
        SettingResult result =
            JudgeMatches(own.pair, attempted, own.detections, context_.Judging(), context_.Draws());
        result.setup = TripletName(
            context_.OwnGrid().detectors[family_[member]].detector, work.descriptor, matcher);
        result.pair_idx = pair_idx_;
        Show(own, attempted, result.setup);
        result_.of_members[member].push_back(std::move(result));
      }
    }
  }

  struct Member {
    /// Its points among the family's, and back (-1: not its own).
    std::vector<int> first_points;
    std::vector<int> second_points;
    std::vector<int> first_place;
    std::vector<int> second_place;
    JudgedPair pair;
    DetectionJudgement detections;
  };

  /// Pictures of matches, and whoever else wants to see them.
  void Show(const Member& own,
            const std::vector<std::pair<int, int>>& attempted,
            const std::string& setup) const {
    const BenchmarkOptions& options = context_.Options();
    if (options.pictures.empty() && !options.observer) {
      return;
    }
    const TripletMatches matches = {setup,
                                    pair_,
                                    {own.pair.first.pixels_px, own.pair.second.pixels_px},
                                    own.pair.points,
                                    attempted};
    if (options.observer) {
      options.observer(matches);
    }
    if (!options.pictures.empty()) {
      const ViewSource& source = context_.Source();
      WriteMatchPicture(source.ReadImage(pair_.lens, pair_.first, context_.Variant()),
                        source.ReadImage(pair_.lens, pair_.second, context_.Variant()),
                        matches.Judged(),
                        fmt::format("{}, {}, pair {}", setup, pair_.lens, pair_.label),
                        options.pictures);
    }
  }

  static std::vector<int> PointsOfMember(const FamilyKeyPoints& family, size_t member) {
    std::vector<int> points;
    for (size_t i = 0; i < family.members.size(); ++i) {
      if (((family.members[i] >> member) & 1U) != 0) {
        points.push_back(static_cast<int>(i));
      }
    }
    return points;
  }

  static std::vector<int> Places(const std::vector<int>& points, size_t num_all) {
    std::vector<int> places(num_all, -1);
    for (size_t i = 0; i < points.size(); ++i) {
      places[points[i]] = static_cast<int>(i);
    }
    return places;
  }

  const BenchmarkContext& context_;
  const PairOfViews& pair_;
  size_t pair_idx_;
  const Family& family_;
  DetectedView first_;
  DetectedView second_;
  std::vector<Member> members_;
  UnitResult result_;
};

}  // namespace

std::vector<Family> FamiliesOf(const Grid& grid) {
  std::vector<Family> families;
  for (size_t i = 0; i < grid.detectors.size(); ++i) {
    const DetectorSetting& detector = grid.detectors[i].detector;
    auto found = std::find_if(families.begin(), families.end(), [&](const Family& family) {
      const DetectorSetting& known = grid.detectors[family.front()].detector;
      return family.size() < kMaxMembers && known.is_polar == detector.is_polar &&
             SameFamily(known.setting, detector.setting);
    });
    if (found == families.end()) {
      found = families.insert(families.end(), Family());
    }
    found->push_back(i);
  }
  return families;
}

void PlaceInDisc(const Lens& lens, JudgedView& view) {
  view.in_disc.clear();
  for (const Vec2d& pixel_px : view.pixels_px) {
    view.in_disc.push_back((pixel_px - lens.PrincipalPointPx()) / (0.5 * lens.CirclePx()));
  }
}

JudgedView Subset(const JudgedView& view, const std::vector<int>& points) {
  JudgedView subset{{}, {}, {}, {}, view.width_px, view.height_px};
  for (const int i : points) {
    subset.pixels_px.push_back(view.pixels_px[i]);
    subset.in_disc.push_back(view.in_disc[i]);
    subset.sizes_px.push_back(view.sizes_px[i]);
    subset.responses.push_back(view.responses[i]);
  }
  return subset;
}

DetectedView DetectView(const BenchmarkContext& context,
                        const std::string& lens_name,
                        const ViewName& view,
                        const Family& family) {
  const std::shared_ptr<const LoadedImage> image = context.ImageOf(lens_name, view);
  const Lens& lens = context.Source().LensOf(lens_name);
  const bool is_polar = IsPolar(context, family);
  const std::vector<Setting> members = MembersOf(context, family);
  std::vector<std::string> inputs = {
      "key points", image->hash, LensText(lens), is_polar ? "pol" : "nopol"};
  for (const Setting& member : members) {
    inputs.push_back(FullText(member));
  }
  DetectedView detected;
  detected.key = StageStore::KeyOf(inputs);
  const std::shared_ptr<const WorkImage> polar =
      is_polar ? context.PolarOf(lens_name, view) : nullptr;
  const WorkImage& work = is_polar ? *polar : image->fisheye;
  if (std::optional<FamilyKeyPoints> stored = context.Store().LoadKeyPoints(detected.key)) {
    detected.family = std::move(*stored);
  } else {
    const FamilyKeyPoints all = DetectFamily(work.grey, members);
    for (size_t i = 0; i < all.points.size(); ++i) {
      const std::optional<Vec2d> pixel_px = work.FisheyePixel(all.points[i]);
      if (work.Owns(all.points[i]) && pixel_px && lens.Unproject(*pixel_px)) {
        detected.family.points.push_back(all.points[i]);
        detected.family.members.push_back(all.members[i]);
      }
    }
    context.Store().SaveKeyPoints(detected.key, detected.family);
  }
  detected.judged.width_px = image->width_px;
  detected.judged.height_px = image->height_px;
  for (const cv::KeyPoint& point : detected.family.points) {
    detected.judged.pixels_px.push_back(*work.FisheyePixel(point));
    detected.judged.sizes_px.push_back(point.size);
    detected.judged.responses.push_back(point.response);
  }
  PlaceInDisc(lens, detected.judged);
  return detected;
}

UnitResult RunUnit(const BenchmarkContext& context,
                   const PairOfViews& pair,
                   size_t pair_idx,
                   const Family& family) {
  return Unit(context, pair, pair_idx, family).Run();
}

}  // namespace pfseq
