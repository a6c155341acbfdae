// SPDX-License-Identifier: Apache-2.0
// The description of a sequence as a YAML file: the one place that knows its keys, their ranges and
// what they mean.
#pragma once

#include "renderer/sequence/sequence_spec.h"
#include "renderer/sequence/yaml_value.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// Reads a sequence's description. Overrides have the form "image.size_px=300", reach every key
/// (the value is YAML) and are carried out in their order before anything is read; gltf replaces
/// canyon, and likewise tum and csv, circle_px and focal_px. Relative paths start at the file's
/// folder, those of overrides at the working directory; they become absolute. InputError
/// "FILE:LINE: KEY: expected ..., got ..." or "--set KEY=VALUE: expected ..., got ...".
SequenceSpec ReadSequenceSpec(const std::filesystem::path& path,
                              const std::vector<std::string>& overrides = {});

/// A key of a description, set from another file; the value knows its place and folder.
struct SpecChange {
  std::string key;
  YamlValue value;
};

/// The same with keys that another file sets, where its relative paths start. InputError
/// "OTHER FILE:LINE: KEY: expected ..., got ...".
SequenceSpec ReadChangedSequenceSpec(const std::filesystem::path& path,
                                     const std::vector<SpecChange>& changes);

/// The description with all defaults written out, in the order of the schema, and the program's
/// version. Reading it gives the same spec, and that the same text.
std::string CanonicalYaml(const SequenceSpec& spec);

/// The part `light` alone.
std::string CanonicalYaml(const LightSpec& light);

/// Reads a file that describes one lens, with the same keys as below lenses.NAME. InputError as
/// above.
LensSpec ReadLensSpec(const std::filesystem::path& path);

/// Whether a YAML file is a sequence's description rather than a lens's: it has a key `lenses`.
/// InputError when it is no YAML mapping.
bool IsSequenceFile(const std::filesystem::path& path);

/// All keys with default, range and meaning, as a text for people.
std::string SchemaHelp();

}  // namespace pfseq
