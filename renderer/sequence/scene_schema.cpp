// SPDX-License-Identifier: Apache-2.0
#include "renderer/sequence/schema_parts.h"

#include <cstdint>

#include <fmt/format.h>

namespace pfseq {
namespace {

void CheckAscending(const YamlMappingView& yaml,
                    const std::string& key,
                    const std::array<double, 2>& range) {
  if (range[0] > range[1]) {
    yaml.Fail(key, fmt::format("expected the least first, got [{}, {}]", range[0], range[1]));
  }
}

YamlTypePtr<CanyonSpec> CanyonSchema() {
  auto schema = NewMapping<CanyonSpec>();
  schema
      ->Key("seed",
            &CanyonSpec::seed,
            YamlInteger<uint64_t>(0, UINT64_MAX),
            "Another seed makes another city.")
      .Key("street_width_m",
           &CanyonSpec::street_width_m,
           YamlArray<2>(From(4.0, 100.0)),
           "Least and greatest distance between opposite facades in metres.")
      .Key("building_height_m",
           &CanyonSpec::building_height_m,
           YamlArray<2>(From(3.0, 300.0)),
           "Least and greatest height of eaves or parapets in metres.")
      .Key("detail",
           &CanyonSpec::detail,
           From(0.0, 2.0),
           "Density of detail: 0 bare walls with windows, 1 normal, 2 the most.")
      .Key("relief",
           &CanyonSpec::relief,
           From(0.05, 1.0),
           "How far windows lie behind walls and sills, mouldings and balconies stand out: 1 as in "
           "old stone houses; "
           "less: flatter, with fewer balconies.")
      .Key(
          "small_panes",
          &CanyonSpec::small_panes,
          From(0.0, 1.0),
          "Share of the buildings whose windows have light glazing bars about small panes: regular "
          "patterns of strong contrast.")
      .Key("rubble",
           &CanyonSpec::rubble,
           From(0.0, 1.0),
           "Share of the buildings whose walls are of rubble, field stones of which one in ten is "
           "black or pale: marks of strong contrast, no two places alike.")
      .Key("street_life",
           &CanyonSpec::street_life,
           From(0.0, 2.0),
           "Cars, people, trees, lamps, signs, wires: 0 none, 1 normal, 2 crowded.")
      .Key("texel_m",
           &CanyonSpec::texel_m,
           From(0.004, 1.0),
           "Size of the texels of walls at street level beside the drive in metres.")
      .Key("pitched_roof_share",
           &CanyonSpec::pitched_roof_share,
           From(0.0, 1.0),
           "Share of the buildings that have a pitched roof.")
      .Key("surrounding_blocks",
           &CanyonSpec::surrounding_blocks,
           YamlInteger<int>(0, 20),
           "Rows of blocks around the U in each direction.")
      .Key("facades",
           &CanyonSpec::facades,
           YamlPath(),
           "A description of facade photographs (data/facades) to take the fronts from.",
           [](const CanyonSpec& canyon) { return !canyon.facades.empty(); })
      .Finish([](const YamlMappingView& yaml, CanyonSpec& canyon) {
        CheckAscending(yaml, "street_width_m", canyon.street_width_m);
        CheckAscending(yaml, "building_height_m", canyon.building_height_m);
      });
  return schema;
}

}  // namespace

YamlTypePtr<SceneSpec> SceneSchema() {
  auto schema = NewMapping<SceneSpec>();
  schema
      ->Key("canyon",
            &SceneSpec::canyon,
            CanyonSchema(),
            "",
            [](const SceneSpec& scene) { return scene.gltf.empty(); })
      .Key("gltf",
           &SceneSpec::gltf,
           YamlPath(),
           "A .glb or .gltf file to use instead of the canyon.")
      .Exclusive({"canyon", "gltf"});
  return schema;
}

}  // namespace pfseq
