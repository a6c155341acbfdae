// SPDX-License-Identifier: Apache-2.0
#include "validator/report/figures.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/core/parse_number.h"

#include <algorithm>
#include <numeric>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pfseq {
namespace {

constexpr const char* kHead = R"gp(# {0}
# Draws {1}.svg and {1}.png. Run beside this file: gnuplot {1}.gp
reset
set datafile separator ","
set xlabel "{5}"
set ylabel "{2}"
set xrange [{6}]
set yrange [0:*]
set grid linecolor "#cccccc" linewidth 0.5
set border 3
set tics nomirror out font ",12"
set tmargin 1
set bmargin at screen {3:.3f}
set key at screen 0.03, screen {4:.3f} left top Left reverse vertical maxcols 1 samplen 2 spacing 1.0 font ",12"
)gp";
/// The second drawing is the first one again, on another terminal.
constexpr const char* kSvg =
    R"gp(set terminal svg noenhanced size 480,{1} dynamic font "Helvetica,14" linewidth 1.5
set output "{0}.svg"
plot \
)gp";
constexpr const char* kPng =
    R"gp(set terminal pngcairo noenhanced size 1440,{1} font "Helvetica,14" fontscale 3 linewidth 4 pointscale 2.5
set output "{0}.png"
replot
unset output
)gp";
/// Heights in pixels of the SVG: the axes, the numbers and name of the lower one, a line of the
/// key.
constexpr size_t kAxesPx = 260;
constexpr size_t kLabelsPx = 84;
constexpr size_t kKeyLinePx = 19;

struct CurveStyle {
  const char* color;
  int mark;
};
/// Okabe and Ito's colours, the clearest on white first; gnuplot's filled and open marks.
constexpr CurveStyle kStyles[kMaxCurves] = {{"#0072B2", 7},
                                            {"#D55E00", 5},
                                            {"#009E73", 9},
                                            {"#CC79A7", 11},
                                            {"#E69F00", 13},
                                            {"#56B4E9", 6},
                                            {"#000000", 4},
                                            {"#F0E442", 15}};

std::vector<size_t> BestColumns(const ReportTable& table) {
  std::vector<double> sums(table.settings.size(), 0.0);
  for (const std::vector<std::string>& row : table.cells) {
    for (size_t i = 0; i < row.size(); ++i) {
      sums[i] += ParseNumber<double>(row[i]).value_or(0.0);
    }
  }
  std::vector<size_t> columns(sums.size());
  std::iota(columns.begin(), columns.end(), size_t{0});
  std::stable_sort(
      columns.begin(), columns.end(), [&](size_t a, size_t b) { return sums[a] > sums[b]; });
  columns.resize(std::min(columns.size(), kMaxCurves));
  return columns;
}

/// As it stands in gnuplot's double quotes.
std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  return quoted;
}

/// What gnuplot takes from the CSV for the curve'th of so many curves. Words stand at whole
/// numbers, the curves a little apart.
std::string Columns(const ReportTable& table, size_t column, size_t curve, size_t num_curves) {
  const size_t first = 2 + column * (table.HasIntervals() ? 3 : 1);
  const std::string limits =
      table.HasIntervals() ? fmt::format(":{}:{}", first + 1, first + 2) : "";
  if (table.has_numbers) {
    return fmt::format("({:g} * $1):{}{}", table.axis_scale, first, limits);
  }
  const double apart =
      0.08 * (static_cast<double>(curve) - 0.5 * static_cast<double>(num_curves - 1));
  return fmt::format("($0 + {:.2f}):{}{}", apart, first, limits);
}

/// Tolerances start at 0; levels where they do, with room for their bars.
std::string XRange(const ReportTable& table) {
  if (!table.has_numbers) {
    return fmt::format("-0.5:{}.5", table.rows.size() - 1);
  }
  return table.HasIntervals() ? "*:*" : "0:*";
}

}  // namespace

std::string GnuplotScript(const ReportTable& table) {
  const std::vector<size_t> columns = BestColumns(table);
  const size_t key_px = kKeyLinePx * (columns.size() + 1);
  const size_t height_px = kAxesPx + kLabelsPx + key_px;
  std::string text =
      fmt::format(fmt::runtime(kHead),
                  table.caption,
                  table.name,
                  table.metric.title,
                  static_cast<double>(kLabelsPx + key_px) / static_cast<double>(height_px),
                  static_cast<double>(key_px) / static_cast<double>(height_px),
                  Quoted(table.axis_title),
                  XRange(table));
  if (table.has_numbers && table.HasIntervals()) {
    text += "set offsets graph 0.03, graph 0.03, 0, 0\n";
  }
  if (!table.has_numbers) {
    std::string labels;
    for (size_t row = 0; row < table.rows.size(); ++row) {
      labels += fmt::format("{}\"{}\" {}", row > 0 ? ", " : "", Quoted(table.rows[row]), row);
    }
    text += fmt::format("set xtics rotate by -30 ({})\n", labels);
  }
  text += fmt::format(fmt::runtime(kSvg), table.name, height_px);
  for (size_t i = 0; i < columns.size(); ++i) {
    text += fmt::format(
        "  \"../tables/{}.csv\" every ::1 using {} with {} linecolor \"{}\" pointtype {} title "
        "\"{}\"{}\n",
        table.name,
        Columns(table, columns[i], i, columns.size()),
        table.HasIntervals() ? (table.has_numbers ? "yerrorlines" : "yerrorbars") : "linespoints",
        kStyles[i].color,
        kStyles[i].mark,
        Quoted(table.settings[columns[i]]),
        i + 1 < columns.size() ? ", \\" : "");
  }
  return text + fmt::format(fmt::runtime(kPng), table.name, 3 * height_px);
}

bool DrawFigures(const std::vector<ReportTable>& tables, const std::filesystem::path& folder) {
  std::vector<std::string> words = {"gnuplot"};
  for (const ReportTable& table : tables) {
    words.push_back(table.name + ".gp");
    WriteFileAtomically(folder / words.back(), GnuplotScript(table));
  }
  if (tables.empty()) {
    return true;
  }
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t child = 0;
  const int failure = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) {
    return false;
  }
  int status = failure;
  if (failure != 0 || waitpid(child, &status, 0) != child || status != 0) {
    throw SystemError(
        "gnuplot could not draw the figures in {} (status {})", folder.string(), status);
  }
  return true;
}

bool WriteTables(const std::vector<ReportTable>& tables,
                 const std::filesystem::path& out,
                 const std::string& command) {
  for (const ReportTable& table : tables) {
    WriteFileAtomically(out / "tables" / (table.name + ".csv"), CsvText(table));
    WriteFileAtomically(out / "tables" / (table.name + ".tex"), TexText(table, command));
  }
  WriteFileAtomically(out / "tables" / "all.tex", TexDocument(tables));
  return DrawFigures(tables, out / "figures");
}

}  // namespace pfseq
