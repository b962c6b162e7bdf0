// SPDX-License-Identifier: GPL-3.0-or-later
// What Batten wrote itself comes back with the same numbers, names, parts and layers.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/exchange/curve_file.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using OwnFiles = test::Program;

/// The names of curve and piece of every run of rows of a CSV.
std::vector<std::string> runsOf(const std::string& csv) {
  std::vector<std::string> runs;
  std::istringstream rows(csv);
  for (std::string row; std::getline(rows, row);) {
    const std::string names = row.substr(0, row.find(',', row.find(',') + 1));
    if (row.front() != '#' && (runs.empty() || runs.back() != names)) runs.push_back(names);
  }
  return runs;
}

std::string sampleWords(const std::string& more) {
  const std::string sample = BATTEN_SAMPLE;
  return "trace " + sample + " --recipe " + sample.substr(0, sample.rfind('.')) + ".recipe.json " + more;
}

TEST_F(OwnFiles, KeepNumbersNamesAndPartsAlsoWithGaps) {
  std::string words = sampleWords("--curves 2,4-6,9,14");
  for (const char* ending : {"csv", "json", "svg", "dxf", "igs", "step"})
    words += " -o " + file(std::string("a.") + ending);
  ASSERT_EQ(run(words).code, 0) << run(words).err;
  const auto written = runsOf(test::readFile(file("a.csv")));
  EXPECT_EQ(written.size(), 7u) << "the names of the columns, and six pieces";
  for (const char* ending : {"csv", "json", "svg", "dxf", "igs", "step"}) {
    const auto back = run("trace " + file(std::string("a.") + ending) + " -o " + file("b.csv"));
    ASSERT_EQ(back.code, 0) << ending << back.err;
    EXPECT_EQ(runsOf(test::readFile(file("b.csv"))), written) << ending;
  }
}

TEST_F(OwnFiles, ACsvHasCornersOnlyWhereItSaysSo) {
  // One piece that turns sharply half way, and a line of two pieces; the second line begins at the end of the first.
  std::string rows;
  int count = 0;
  const auto add = [&](const char* names, double s, double x, double y) {
    std::ostringstream row;
    row << names << ',' << s << ',' << x << ',' << y << ",0,0,\n";
    rows += row.str();
    ++count;
  };
  for (int i = 0; i <= 10; ++i) add("curve-3,Curve 3", i, i < 5 ? i : 5, i < 5 ? 0 : i - 5);
  for (int i = 0; i <= 6; ++i) add("curve-7,Curve 7", i, 10 + i, 0.1 * i * i);
  for (int i = 0; i <= 6; ++i) add("curve-7,Curve 9", i, 16 + i, 3.6 - 0.2 * i * i);
  const std::string head = "curve,piece,s_mm,x_mm,y_mm,tangent_deg,kappa_per_mm,radius_mm\n";
  write("a.csv", "# Rows: " + std::to_string(count) + ".\n" + head + rows);
  const auto back = run("trace " + file("a.csv") + " -o " + file("b.csv"));
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_EQ(runsOf(test::readFile(file("b.csv"))),
            (std::vector<std::string>{"curve,piece", "curve-3,Curve 3", "curve-7,Curve 7", "curve-7,Curve 9"}));
  EXPECT_THAT(back.out, testing::Not(HasSubstr("incomplete")));
  // A line that is called like the one before it begins anew with its arc length.
  write("twice.csv", head + "roof,roof,0,0,0,0,0,\nroof,roof,5,5,0,0,0,\nroof,roof,0,0,3,0,0,\nroof,roof,5,5,3,0,0,\n");
  ASSERT_EQ(run("trace " + file("twice.csv") + " -o " + file("twice.json")).code, 0);
  EXPECT_EQ(readCurveFile(file("twice.json"))->curves.size(), 2u);
}

TEST_F(OwnFiles, ACsvThatWasCutIsRefusedOrSaidToBe) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o " + file("a.csv")).code, 0);
  const std::string whole = test::readFile(file("a.csv"));
  for (const std::size_t less : {1u, 4u, 20u, 60u}) {
    write("cut.csv", whole.substr(0, whole.size() - less));
    expectError("trace " + file("cut.csv") + " -o " + file("o.svg"), 3, "incomplete");
  }
  const std::string rows = whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1);
  write("rows.csv", rows);
  const auto done = run("trace " + file("rows.csv") + " -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("it may be incomplete"));
  EXPECT_THAT(run("trace " + file("a.csv") + " -o " + file("o.svg")).out, testing::Not(HasSubstr("incomplete")));
  // Tables of others, too: every row is as wide as the first.
  write("other.csv", "x,y,z\n0,0,0\n1,1,0\n2,1");
  expectError("trace " + file("other.csv") + " -o " + file("o.svg"), 3, "row 4 holds 2 of 3 fields");
}

/// Two layers with the same curve on each: neither is a duplicate of the other.
TEST_F(OwnFiles, SketchedAndFairedStayOnTheirLayers) {
  std::string words = "trace " + scene() + " --dpi 254 --which both";
  for (const char* ending : {"csv", "json", "svg", "dxf", "igs", "step"})
    words += " -o " + file(std::string("a.") + ending);
  ASSERT_EQ(run(words).code, 0);
  for (const char* ending : {"csv", "json", "svg", "dxf", "igs", "step"}) {
    const auto back = run("trace " + file(std::string("a.") + ending) + " -o " + file("b.json"));
    ASSERT_EQ(back.code, 0) << ending << back.err;
    EXPECT_THAT(back.out, testing::Not(HasSubstr("left out"))) << ending;
    const auto document = readCurveFile(file("b.json"));
    ASSERT_TRUE(document) << ending;
    ASSERT_EQ(document->curves.size(), 2u) << ending;
    EXPECT_EQ(document->curves[0].layer, "Sketched") << ending;
    EXPECT_EQ(document->curves[1].layer, "Faired") << ending;
  }
  // On one layer the second one is left out, and that is said.
  const std::string line = "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n40\n21\n10\n",
                    other = "0\nLINE\n8\nB\n10\n0\n20\n0\n11\n40\n21\n10\n";
  write("twice.dxf", "0\nSECTION\n2\nENTITIES\n" + line + line + other + "0\nENDSEC\n0\nEOF\n");
  const auto done = run("trace " + file("twice.dxf") + " -o " + file("o.dxf"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("1 piece on top of another left out"));
  EXPECT_EQ(json::parse(done.out)["files"].size(), 1u);
  EXPECT_EQ(readCurveFile(file("o.dxf"))->curves.size(), 2u);
}

}  // namespace
}  // namespace batten
