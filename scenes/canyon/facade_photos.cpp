// SPDX-License-Identifier: Apache-2.0
#include "scenes/canyon/facade_photos.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/sequence/image_io.h"
#include "renderer/sequence/yaml_schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace pfseq {
namespace {

constexpr double kGreatestStretch = 1.34;
constexpr int kGreatest_px = 1 << 15;

/// [left, top, width, height], and as a grid: steps and counts to the right and down.
using WindowGrid = std::array<double, 8>;

/// A list of 4 or 8 numbers.
class WindowType : public YamlType<WindowGrid> {
 public:
  void Read(const YamlValue& yaml, const std::string& key, WindowGrid& value) const override {
    if (yaml.kind != YamlValue::Kind::kList || (yaml.items.size() != 4 && yaml.items.size() != 8)) {
      FailExpected(yaml, key, Expected());
    }
    value = {0, 0, 0, 0, 0, 1, 0, 1};
    for (size_t i = 0; i < yaml.items.size(); ++i) {
      number_->Read(yaml.items[i], key, value[i]);
    }
  }

  YamlValue Write(const WindowGrid& value) const override {
    YamlValue list;
    list.kind = YamlValue::Kind::kList;
    for (const double number : value) {
      list.items.push_back(number_->Write(number));
    }
    return list;
  }

  std::string Expected() const override {
    return "a list of 4 or 8 numbers (left, top, width, height, step right, columns, step down, "
           "rows)";
  }

 private:
  YamlTypePtr<double> number_ = YamlNumber({0.0, kGreatest_px});
};

struct PhotoSpec {
  std::string file;
  std::string normal;
  std::string roughness;
  double width_m = 10.0;
  double height_m = 10.0;
  int floors = 1;
  double recess_m = 0.15;
  std::optional<std::array<int, 4>> crop_px;
  std::optional<std::vector<Named<WindowGrid>>> windows_px;
};

struct PhotosSpec {
  std::string source;
  std::string credit;
  std::string licence;
  std::vector<Named<PhotoSpec>> facades;
};

YamlTypePtr<PhotosSpec> PhotosSchema() {
  const YamlRange size_m{0.0, 500.0, true};
  auto photo = std::make_shared<YamlMapping<PhotoSpec>>();
  photo->Key("file", &PhotoSpec::file, YamlPath(), "The photograph.")
      .Key("normal", &PhotoSpec::normal, YamlPath(), "Its normal map.")
      .Key("roughness", &PhotoSpec::roughness, YamlPath(), "Its roughness map.")
      .Key("width_m", &PhotoSpec::width_m, YamlNumber(size_m), "")
      .Key("height_m", &PhotoSpec::height_m, YamlNumber(size_m), "")
      .Key("floors", &PhotoSpec::floors, YamlInteger<int>(1, 100), "")
      .Key("recess_m", &PhotoSpec::recess_m, YamlNumber({0.0, 1.0}), "")
      .Key("crop_px",
           &PhotoSpec::crop_px,
           YamlOptional(YamlArray<4>(YamlInteger<int>(0, kGreatest_px))),
           "")
      .Key("windows_px",
           &PhotoSpec::windows_px,
           YamlOptional(YamlNamed<WindowGrid>("window", std::make_shared<WindowType>())),
           "")
      .Finish([](const YamlMappingView& yaml, PhotoSpec& /*spec*/) {
        for (const char* key : {"file", "width_m", "height_m", "floors"}) {
          if (!yaml.Has(key)) {
            yaml.Fail(key, fmt::format("expected the key {}", key));
          }
        }
      });
  auto schema = std::make_shared<YamlMapping<PhotosSpec>>();
  schema->Key("source", &PhotosSpec::source, YamlLine(), "")
      .Key("credit", &PhotosSpec::credit, YamlLine(), "")
      .Key("licence", &PhotosSpec::licence, YamlLine(), "")
      .Key("facades", &PhotosSpec::facades, YamlNamed<PhotoSpec>("facade", photo), "")
      .Finish([](const YamlMappingView& yaml, PhotosSpec& /*spec*/) {
        for (const char* key : {"source", "credit", "licence", "facades"}) {
          if (!yaml.Has(key)) {
            yaml.Fail(key, fmt::format("expected the key {}", key));
          }
        }
      });
  return schema;
}

PhotosSpec ReadSpec(const std::filesystem::path& path) {
  PhotosSpec spec;
  PhotosSchema()->Read(ReadYaml(path), "", spec);
  return spec;
}

std::string CreditsOf(const PhotosSpec& spec) {
  return fmt::format("facade photographs: {}; {}; {}", spec.source, spec.credit, spec.licence);
}

Image<uint8_t> Cropped(const Image<uint8_t>& image, const std::array<int, 4>& crop_px) {
  const auto [left, top, right, bottom] = crop_px;
  Image<uint8_t> part(right - left, bottom - top, 4, uint8_t{255});
  for (int y = 0; y < part.HeightPx(); ++y) {
    for (int x = 0; x < part.WidthPx(); ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        part.At(x, y, channel) =
            image.At(left + x, top + y, image.NumChannels() >= 3 ? channel : 0);
      }
    }
  }
  return part;
}

FacadePhoto ReadPhoto(const std::filesystem::path& path, const Named<PhotoSpec>& named) {
  const PhotoSpec& spec = named.value;
  const Image<uint8_t> image = ReadImage8(spec.file);
  const std::array<int, 4> crop_px =
      spec.crop_px.value_or(std::array<int, 4>{0, 0, image.WidthPx(), image.HeightPx()});
  const auto [left, top, right, bottom] = crop_px;
  if (left >= right || top >= bottom || right > image.WidthPx() || bottom > image.HeightPx()) {
    throw InputError(
        "{}: facades.{}.crop_px: expected left < right <= {} and top < bottom <= {}, got {} {} {} "
        "{}",
        path.string(),
        named.name,
        image.WidthPx(),
        image.HeightPx(),
        left,
        top,
        right,
        bottom);
  }
  FacadePhoto photo;
  photo.name = named.name;
  photo.image = std::make_shared<const Image<uint8_t>>(Cropped(image, crop_px));
  const auto read_map = [&](const std::string& key,
                            const std::string& file) -> std::shared_ptr<const Image<uint8_t>> {
    if (file.empty()) {
      return nullptr;
    }
    const Image<uint8_t> map = ReadImage8(file);
    if (map.WidthPx() != image.WidthPx() || map.HeightPx() != image.HeightPx()) {
      throw InputError("{}: facades.{}.{}: expected the photograph's size, {} x {} px, got {} x {}",
                       path.string(),
                       named.name,
                       key,
                       image.WidthPx(),
                       image.HeightPx(),
                       map.WidthPx(),
                       map.HeightPx());
    }
    return std::make_shared<const Image<uint8_t>>(Cropped(map, crop_px));
  };
  photo.normal = read_map("normal", spec.normal);
  photo.roughness = read_map("roughness", spec.roughness);
  photo.size_m = {spec.width_m, spec.height_m};
  photo.num_floors = spec.floors;
  photo.recess_m = spec.recess_m;
  const Vec2d m_per_px(spec.width_m / (right - left), spec.height_m / (bottom - top));
  for (const auto& [name, grid] : spec.windows_px.value_or(std::vector<Named<WindowGrid>>())) {
    for (int row = 0; row < static_cast<int>(grid[7]); ++row) {
      for (int column = 0; column < static_cast<int>(grid[5]); ++column) {
        const Vec2d from_px(grid[0] + column * grid[4] - left, bottom - grid[1] - row * grid[6]);
        const Vec2d low_px(from_px.x(), from_px.y() - grid[3]);
        const Vec2d high_px(from_px.x() + grid[2], from_px.y());
        photo.windows.push_back({low_px.cwiseProduct(m_per_px), high_px.cwiseProduct(m_per_px)});
      }
    }
  }
  return photo;
}

}  // namespace

FacadePhotos ReadFacadePhotos(const std::filesystem::path& path) {
  const PhotosSpec spec = ReadSpec(path);
  FacadePhotos photos;
  photos.credits = CreditsOf(spec);
  for (const Named<PhotoSpec>& named : spec.facades) {
    photos.photos.push_back(std::make_shared<const FacadePhoto>(ReadPhoto(path, named)));
  }
  return photos;
}

std::string ReadFacadeCredits(const std::filesystem::path& path) {
  return CreditsOf(ReadSpec(path));
}

std::shared_ptr<const FacadePhoto> ChoosePhoto(const FacadePhotos& photos,
                                               double height_m,
                                               uint64_t seed) {
  std::vector<std::shared_ptr<const FacadePhoto>> fitting;
  for (const auto& photo : photos.photos) {
    if (std::abs(std::log(height_m / photo->size_m.y())) < std::log(kGreatestStretch)) {
      fitting.push_back(photo);
    }
  }
  if (fitting.empty()) {
    return nullptr;
  }
  RandomStream random({seed, 45});
  return fitting[static_cast<size_t>(random.Integer(0, static_cast<int>(fitting.size()) - 1))];
}

}  // namespace pfseq
