// SPDX-License-Identifier: Apache-2.0
#include "validator/report/report.h"

#include "renderer/core/error.h"
#include "renderer/core/file.h"
#include "renderer/sequence/image_io.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"
#include "tests/validator/report/report_fixture.h"
#include "tests/validator/test_sequence.h"
#include "validator/benchmark/benchmark.h"
#include "validator/benchmark/results_writer.h"
#include "validator/report/csv_line.h"
#include "validator/report/data_uri.h"
#include "validator/report/figures.h"
#include "validator/report/report_table.h"

#include <cstdlib>
#include <regex>
#include <set>
#include <span>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pfseq {
namespace {

using testing::HasSubstr;
using testing::Not;

const FakeSetting kBest = {"SIFT nopol 0.04 5.0 1.6 SIFT BruteForce", {0.5, 0.4}, {500, 400}};
const FakeSetting kOdd = {"Odd_net 50%, new & {1} BruteForce", {0.4, 0.5}, {600, 300}};
const FakeSetting kFew = {"ORB nopol 500 ORB 2 BruteForce", {0.9, 0.9}, {50, 40}};

ReportOptions Options(const TempFolder& folder) {
  ReportOptions options;
  options.results = {folder / "results"};
  options.out = folder / "report";
  options.command = "pfseq report";
  options.quiet = true;
  return options;
}

std::vector<std::vector<std::string>> CsvCells(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.push_back(SplitCsvLine(line));
  }
  return rows;
}

/// The numbers of a LaTeX table's body, without their marks.
std::vector<std::vector<std::string>> TexCells(const std::string& text) {
  const size_t begin = text.find("\\midrule\n") + 9;
  std::istringstream lines(text.substr(begin, text.find("\\bottomrule") - begin));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(line, std::regex(R"(\\(textbf|underline)\{([^}]*)\})"), "$2");
    line = std::regex_replace(line, std::regex(R"( \\\\$)"), "");
    rows.push_back(SplitCsvLine(std::regex_replace(line, std::regex(" & "), ",")));
  }
  return rows;
}

TEST(ReportTable, LatexHasTheNumbersOfTheCsv) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), {kBest, kOdd, kFew});
  const std::vector<ReportTable> tables = MakeTables(ReadResults({folder.Path()}));
  ASSERT_EQ(tables.size(), 4u);
  for (const ReportTable& table : tables) {
    std::vector<std::vector<std::string>> csv = CsvCells(CsvText(table));
    ASSERT_EQ(csv.size(), 13u);
    EXPECT_THAT(csv[0], testing::ElementsAre("tolerance_m", kBest.name, kOdd.name));
    csv.erase(csv.begin());
    EXPECT_EQ(csv, TexCells(TexText(table, "pfseq report")));
  }
}

TEST(ReportTable, BestIsBoldSecondUnderlined) {
  const TempFolder folder;
  WriteFakeResults(folder.Path(), {kBest, kOdd});
  const std::string tex = TexText(MakeTables(ReadResults({folder.Path()})).at(3), "pfseq report");
  EXPECT_THAT(tex, HasSubstr("0.04 & \\underline{0.400} & \\textbf{0.500}"));
  EXPECT_THAT(tex, HasSubstr(R"(Odd\_net 50\%, new \& \{1\} BruteForce)"));
}

TEST(ReportTable, LatexCompiles) {
  if (std::system("command -v pdflatex >/dev/null && kpsewhich booktabs.sty >/dev/null") != 0) {
    GTEST_SKIP() << "pdflatex with booktabs is missing (texlive-latex-recommended)";
  }
  const TempFolder folder;
  WriteFakeResults(folder / "results", {kBest, kOdd});
  WriteReport(Options(folder));
  const std::string command = "cd '" + (folder / "report/tables").string() +
                              "' && pdflatex -halt-on-error all.tex >all.out";
  EXPECT_EQ(std::system(command.c_str()), 0) << ReadFile(folder / "report/tables/all.out");
}

TEST(Figures, ScriptDrawsTheBestColumnsInColoursOfTheirOwn) {
  ReportTable table;
  table.name = "score";
  for (const char* value : {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9"}) {
    table.settings.push_back(std::string("setting ") + value);
    table.cells.resize(1);
    table.cells[0].emplace_back(value);
  }
  const std::string script = GnuplotScript(table);
  EXPECT_THAT(script, HasSubstr("using (100 * $1):10 with linespoints linecolor \"#0072B2\""));
  EXPECT_THAT(script, Not(HasSubstr("using (100 * $1):2 ")));  // The least of nine is left out.
  const std::regex color("linecolor \"(#[0-9A-F]{6})\"");
  std::set<std::string> colors;
  for (std::sregex_iterator i(script.begin(), script.end(), color), end; i != end; ++i) {
    EXPECT_TRUE(colors.insert((*i)[1]).second) << (*i)[1];
  }
  EXPECT_EQ(colors.size(), kMaxCurves);
}

TEST(Figures, GnuplotDrawsThemForPapers) {
  if (std::system("command -v gnuplot >/dev/null") != 0) {
    GTEST_SKIP() << "gnuplot is missing (tools/setup.sh installs it)";
  }
  const TempFolder folder;
  WriteFakeResults(folder / "results", {kBest, kOdd});
  EXPECT_TRUE(WriteReport(Options(folder)).has_figures);
  const std::string svg = ReadFile(folder / "report/figures/matching_score_pair_0.svg");
  EXPECT_NE(svg.find(kBest.name), std::string::npos);
  EXPECT_NE(svg.find("Odd_net 50%, new &amp; {1} BruteForce"), std::string::npos);
  const Image<uint8_t> png = ReadImage8(folder / "report/figures/matching_score_pair_0.png");
  EXPECT_EQ(png.WidthPx(), 1440);  // 8.5 cm at 430 dots an inch.
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(Base64(std::as_bytes(std::span("foobar", 6))), "Zm9vYmFy");
  EXPECT_EQ(Base64(std::as_bytes(std::span("fo", 2))), "Zm8=");
  EXPECT_EQ(Base64({}), "");
}

TEST(Report, SameResultsGiveTheSameBytes) {
  const TempFolder folder;
  WriteFakeResults(folder / "results", {kBest, kOdd});
  WriteReport(Options(folder));
  const std::string first = ReadFile(folder / "report/report.html");
  std::filesystem::remove_all(folder / "report");
  WriteReport(Options(folder));
  EXPECT_EQ(ReadFile(folder / "report/report.html"), first);
}

TEST(Report, SaysWhatTheResultsLack) {
  const TempFolder folder;
  WriteFakeResults(folder / "results", {});
  const ReportSummary summary = WriteReport(Options(folder));
  EXPECT_EQ(summary.num_tables, 0u);
  ASSERT_EQ(summary.remarks.size(), 1u);
  EXPECT_THAT(summary.remarks[0], HasSubstr("--sequence"));
  EXPECT_THAT(ReadFile(summary.page), HasSubstr("the folder of its sequence 'fake' is not known"));
}

TEST(Report, NamesCannotEndTheScript) {
  const TempFolder folder;
  WriteFakeResults(folder / "results", {{"Net</script><b> BruteForce", {0.5}, {500}}});
  WriteReport(Options(folder));
  EXPECT_THAT(ReadFile(folder / "report/report.html"), HasSubstr("Net\\u003c/script>"));
  EXPECT_THAT(ReadFile(folder / "report/report.html"), Not(HasSubstr("Net</script>")));
}

TEST(Report, ShowsTheSequenceThatTheRunTellsOf) {
  const TempFolder folder;
  TestSequence sequence = TestSequence::Yard(120);
  sequence.rig.lenses.pop_back();
  sequence.frames = {1};
  sequence.Write(folder / "yard");
  BenchmarkOptions options;
  options.quiet = true;
  const BenchmarkResults results =
      RunBenchmark(*OpenViews(folder / "yard"),
                   Grid::FromNames({"SIFT nopol 0.02 10.0 1.6 SIFT BruteForce"}),
                   options);
  WriteResults(results, folder / "results");
  WriteRun({"pfseq bench yard", folder / "yard", 1.5}, folder / "results");
  const ReportSummary summary = WriteReport(Options(folder));
  EXPECT_THAT(summary.remarks, testing::IsEmpty());
  const std::string page = ReadFile(summary.page);
  EXPECT_THAT(page, HasSubstr("pfseq bench yard"));
  for (const char* picture :
       {"\"Key points\"", "\"Matches\"", "\"Distance and sky\"", "data:image/jpeg;base64,/9j/"}) {
    EXPECT_THAT(page, HasSubstr(picture)) << picture;
  }
}

TEST(Report, RefusesSequencesThatDoNotFit) {
  const TempFolder folder;
  WriteFakeResults(folder / "results", {kBest});
  ReportOptions options = Options(folder);
  options.sequences = {folder / "nowhere"};
  EXPECT_THAT(MessageOf<InputError>([&] { WriteReport(options); }), HasSubstr("nowhere"));
  options.sequences = {folder.Path(), folder.Path()};
  EXPECT_THAT(MessageOf<InputError>([&] { WriteReport(options); }), HasSubstr("--sequence"));
  EXPECT_FALSE(std::filesystem::exists(folder / "report"));
}

}  // namespace
}  // namespace pfseq
