// SPDX-License-Identifier: Apache-2.0
#include "validator/report/html_page.h"

#include "renderer/core/check.h"
#include "validator/report/embedded_files.h"

#include <string_view>

namespace pfseq {
namespace {

/// Puts `content` in the place of the one occurrence of `mark`.
void Fill(std::string& page, std::string_view mark, std::string_view content) {
  const size_t place = page.find(mark);
  PFSEQ_CHECK(place != std::string::npos, "the page has no place for {}", mark);
  page.replace(place, mark.size(), content);
}

}  // namespace

std::string ScriptJson(const nlohmann::ordered_json& json) {
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  // "</script>" in a name must not end the script element.
  for (size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string AssemblePage(const std::string& page,
                         const std::vector<std::string>& scripts,
                         const std::string& data) {
  std::string text(EmbeddedFile(page));
  Fill(text, "/* STYLES */", EmbeddedFile("validator/report/page/report.css"));
  Fill(text, "/* CHARTS LIBRARY */", EmbeddedFile("third_party/echarts/echarts.common.min.js"));
  std::string all;
  for (const std::string& script : scripts) {
    all += EmbeddedFile(script);
  }
  Fill(text, "/* SCRIPTS */", all);
  Fill(text, "/* DATA */", data);
  return text;
}

}  // namespace pfseq
