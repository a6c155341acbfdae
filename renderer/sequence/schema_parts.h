// SPDX-License-Identifier: Apache-2.0
// The parts of a sequence's schema, one file each: keys, ranges and meanings of the members of
// sequence_spec.h.
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "renderer/sequence/yaml_schema.h"

#include <memory>

namespace pfseq {

YamlTypePtr<LensSpec> LensSchema();
YamlTypePtr<TrajectorySpec> TrajectorySchema();
YamlTypePtr<SceneSpec> SceneSchema();
YamlTypePtr<LightSpec> LightSchema();
YamlTypePtr<ShutterSpec> ShutterSchema();
YamlTypePtr<OpticsSpec> OpticsSchema();
YamlTypePtr<SensorSpec> SensorSchema();

/// Numbers in (0, most].
inline YamlTypePtr<double> Above0(double most) { return YamlNumber({0.0, most, true}); }
/// Numbers in [least, most].
inline YamlTypePtr<double> From(double least, double most) {
  return YamlNumber({least, most, false});
}

template <typename T>
std::shared_ptr<YamlMapping<T>> NewMapping() {
  return std::make_shared<YamlMapping<T>>();
}

}  // namespace pfseq
