// SPDX-License-Identifier: Apache-2.0
#include "validator/report/report_table.h"

#include "renderer/core/parse_number.h"
#include "validator/report/ranking.h"

#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace pfseq {
namespace {

/// As it stands between braces.
std::string TexEscaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '~':
        escaped += "\\textasciitilde{}";
        break;
      case '^':
        escaped += "\\textasciicircum{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string CellText(double value, bool is_share) {
  return std::isnan(value) ? ""
         : is_share        ? fmt::format("{:.3f}", value)
                           : fmt::format("{:.0f}", value);
}

void MarkBest(const std::vector<double>& values, ReportTable& table) {
  std::optional<size_t> best, second;
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) {
      continue;
    }
    if (!best || values[i] > values[*best]) {
      second = best;
      best = i;
    } else if (!second || values[i] > values[*second]) {
      second = i;
    }
  }
  table.best.push_back(best);
  table.second.push_back(second);
}

ReportTable MakeTable(const ResultSet& results,
                      const SettingGroup& group,
                      const MetricName& metric,
                      size_t case_idx,
                      const std::vector<size_t>& settings) {
  ReportTable table;
  const ReportCase& one = results.cases[case_idx];
  table.name = TableFileName(metric.id + " " + one.label);
  table.caption = fmt::format("{}, {}", metric.title, one.label);
  table.metric = metric;
  for (const size_t i : settings) {
    table.settings.push_back(group.settings[i].name);
  }
  for (size_t t = 0; t < results.tolerances_m.size(); ++t) {
    std::vector<double> values;
    for (const size_t i : settings) {
      values.push_back(group.Value(metric.id, i, case_idx, t));
    }
    table.AddRow(fmt::format("{:g}", results.tolerances_m[t]), values);
  }
  return table;
}

std::vector<std::string> CellTexts(const std::vector<double>& values, bool is_share) {
  std::vector<std::string> texts;
  for (const double value : values) {
    texts.push_back(CellText(value, is_share));
  }
  return texts;
}

/// In quotes where it holds a comma.
std::string CsvField(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

/// " $\pm$ 0.021", nothing without an interval.
std::string HalfIntervalTex(const ReportTable& table, size_t row, size_t i) {
  if (!table.HasIntervals() || table.low[row][i].empty() || table.high[row][i].empty()) {
    return "";
  }
  const double half = 0.5 * (ParseNumber<double>(table.high[row][i]).value_or(0.0) -
                             ParseNumber<double>(table.low[row][i]).value_or(0.0));
  return fmt::format(" {{\\scriptsize$\\pm${}}}", CellText(half, table.metric.is_share));
}

}  // namespace

void ReportTable::AddRow(std::string row,
                         const std::vector<double>& values,
                         const std::vector<double>& low_values,
                         const std::vector<double>& high_values) {
  rows.push_back(std::move(row));
  cells.push_back(CellTexts(values, metric.is_share));
  if (!low_values.empty()) {
    low.push_back(CellTexts(low_values, metric.is_share));
    high.push_back(CellTexts(high_values, metric.is_share));
  }
  MarkBest(values, *this);
}

std::string TableFileName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

const std::vector<MetricName>& TableMetrics() {
  static const std::vector<MetricName> metrics = {
      {"matches", "Number of matches", false},
      {"repeatability", "Repeatability", true},
      {"correct_matches", "Number of correct matches", false},
      {"matching_score", "Matching score", true}};
  return metrics;
}

std::vector<ReportTable> MakeTables(const ResultSet& results) {
  std::vector<ReportTable> tables;
  const size_t num_distances = results.tolerances_m.size();
  for (const bool is_triplets : {false, true}) {
    const SettingGroup& group = is_triplets ? results.triplets : results.detectors;
    const MetricName& count = TableMetrics()[is_triplets ? 2 : 0];
    const MetricName& share = TableMetrics()[is_triplets ? 3 : 1];
    const std::vector<size_t> settings = Highlights(group, count.id, share.id, num_distances);
    if (settings.empty()) {
      continue;
    }
    for (const MetricName& metric : {count, share}) {
      for (size_t case_idx = 0; group.Has(metric.id) && case_idx < results.cases.size();
           ++case_idx) {
        tables.push_back(MakeTable(results, group, metric, case_idx, settings));
      }
    }
  }
  return tables;
}

std::string CsvText(const ReportTable& table) {
  std::string text = table.row_id;
  for (const std::string& setting : table.settings) {
    text += "," + CsvField(setting);
    if (table.HasIntervals()) {
      text += "," + CsvField(setting + " low") + "," + CsvField(setting + " high");
    }
  }
  for (size_t row = 0; row < table.cells.size(); ++row) {
    text += "\n" + CsvField(table.rows[row]);
    for (size_t i = 0; i < table.cells[row].size(); ++i) {
      text += "," + table.cells[row][i];
      if (table.HasIntervals()) {
        text += "," + table.low[row][i] + "," + table.high[row][i];
      }
    }
  }
  return text + "\n";
}

std::string TexText(const ReportTable& table, const std::string& origin) {
  constexpr const char* kHead = R"tex(% Made by: {}
% Needs the packages booktabs and graphicx.
\begin{{table*}}
\centering
\caption{{{}. Bold values are the best of a row, underlined are second best.{}}}
\label{{tab:{}}}
\small
\setlength{{\tabcolsep}}{{4pt}}
% As wide as it is, but not wider than the page.
\resizebox{{\ifdim\width>\textwidth\textwidth\else\width\fi}}{{!}}{{%
\begin{{tabular}}{{r*{{{}}}{{r}}}}
\toprule
\rotatebox{{90}}{{{}}})tex";
  std::string text =
      fmt::format(fmt::runtime(kHead),
                  origin,
                  TexEscaped(table.caption),
                  table.HasIntervals() ? " Behind $\\pm$: half of the 95\\,\\% interval." : "",
                  table.name,
                  table.settings.size(),
                  TexEscaped(table.row_title));
  for (const std::string& setting : table.settings) {
    text += fmt::format(" &\n\\rotatebox{{90}}{{{}}}", TexEscaped(setting));
  }
  text += " \\\\\n\\midrule\n";
  for (size_t t = 0; t < table.cells.size(); ++t) {
    text += TexEscaped(table.rows[t]);
    for (size_t i = 0; i < table.cells[t].size(); ++i) {
      const std::string& cell = table.cells[t][i];
      text += table.best[t] == i     ? fmt::format(" & \\textbf{{{}}}", cell)
              : table.second[t] == i ? fmt::format(" & \\underline{{{}}}", cell)
                                     : " & " + cell;
      text += HalfIntervalTex(table, t, i);
    }
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}}\n\\end{table*}\n";
}

std::string TexDocument(const std::vector<ReportTable>& tables) {
  std::string text =
      "% All tables of the report: pdflatex all.tex\n"
      "\\documentclass{article}\n\\usepackage[margin=2cm]{geometry}\n\\usepackage{booktabs}"
      "\n\\usepackage{graphicx}\n"
      "\\begin{document}\n";
  for (const ReportTable& table : tables) {
    text += fmt::format("\\input{{{}.tex}}\n\\clearpage\n", table.name);
  }
  return text + "\\end{document}\n";
}

}  // namespace pfseq
