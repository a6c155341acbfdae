// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validator/report/report_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace pfseq {

/// As many curves as there are colours that everybody can tell apart.
inline constexpr size_t kMaxCurves = 8;

/// A gnuplot script that draws a table's best kMaxCurves columns (by their mean) over its rows,
/// with their intervals, as NAME.svg and NAME.png for a column of a paper (8.5 cm); it reads
/// ../tables/NAME.csv. Colours are those of Okabe and Ito (2008), each with a mark of its own.
std::string GnuplotScript(const ReportTable& table);

/// Writes the scripts into `folder` and lets gnuplot draw them. False, with the scripts alone, when
/// there is no gnuplot; SystemError when it fails.
bool DrawFigures(const std::vector<ReportTable>& tables, const std::filesystem::path& folder);

/// Writes the tables into out/tables (NAME.csv, NAME.tex, all.tex) and draws them in out/figures,
/// as above. `command` is what made them.
bool WriteTables(const std::vector<ReportTable>& tables,
                 const std::filesystem::path& out,
                 const std::string& command);

}  // namespace pfseq
