// SPDX-License-Identifier: Apache-2.0
// Pages of one file that need nothing else: template, styles, charts library, scripts and data.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace pfseq {

/// As text that is safe within a script element. What is not UTF-8 is shown as well as can be.
std::string ScriptJson(const nlohmann::ordered_json& json);

/// `page` is a template with a place for each part; it and the scripts, in their order, are
/// embedded files (validator/*/page). Styles and charts library are those of all pages.
std::string AssemblePage(const std::string& page,
                         const std::vector<std::string>& scripts,
                         const std::string& data);

}  // namespace pfseq
