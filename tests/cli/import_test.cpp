// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/exchange/import_file.h"
#include "core/exchange/text/curve_json.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using CommandLineImport = test::Program;
using CommandLinePages = test::Program;

constexpr const char* kDxf =
    "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
    "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n4\n21\n1\n0\nCIRCLE\n8\nA\n10\n10\n20\n0\n40\n2\n0\nENDSEC\n0\nEOF\n";

TEST_F(CommandLineImport, CurvesOfOthersAreTracedWithoutAScan) {
  write("in Süße 漢.dxf", kDxf);
  const auto done = run("trace '" + file("in Süße 漢.dxf") + "' -o " + file("o.json") + " -o " + file("o.dxf") +
                        " --save-recipe " + file("r.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  ASSERT_EQ(document->curves.size(), 2u);
  const NurbsCurve& line = document->curves[0].pieces[0].curve;
  EXPECT_LT((line.point(line.end()) - Vec2(101.6, 25.4)).norm(), 1e-12) << "inches are 25.4 mm";
  EXPECT_THAT(test::readFile(file("o.dxf")), HasSubstr("CIRCLE"));
  // What was imported lies in the recipe, with its source: the file is not needed again.
  const auto again = run("trace --recipe " + file("r.json") + " -o " + file("again.json"));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(test::readFile(file("again.json")), test::readFile(file("o.json")));
  const auto recipe = recipeFromJson(test::readFile(file("r.json")));
  ASSERT_TRUE(recipe);
  ASSERT_EQ(recipe->imports.size(), 1u);
  EXPECT_EQ(recipe->imports[0].source, "in Süße 漢.dxf");
  EXPECT_EQ(recipe->imports[0].unit, "in");
}

TEST_F(CommandLineImport, OnlySpansThatBendOneWayHaveALambda) {
  const auto spansOf = [&](const std::function<double(double)>& y) {
    std::string points = "x_mm,y_mm\n";
    for (int i = 0; i <= 200; ++i) {
      const double x = 0.5 * i;
      points += std::to_string(x) + "," + std::to_string(y(x)) + "\n";
    }
    write("line.csv", points);
    const auto done = run("trace " + file("line.csv") + " -o " + file("o.svg") + " --report " + file("r.json") +
                          " --set fairing.mode=target --set fairing.target=log-aesthetic --set fairing.spans=whole" +
                          " --set fairing.tolerance=2");
    EXPECT_EQ(done.code, 0) << done.err;
    return json::parse(test::readFile(file("r.json")))["curves"][0]["fairing"]["log_aesthetic"];
  };
  // The curvature grows from -0.012 to 0.012.
  const json both = spansOf([](double x) { return 5e-5 * std::pow(x - 50.0, 3); });
  ASSERT_EQ(both.size(), 1u) << both;
  EXPECT_TRUE(both[0]["lambda"].is_null()) << both;
  EXPECT_EQ(both[0]["alpha"], -1.0);
  const json one = spansOf([](double x) { return 0.003 * x * x; });
  ASSERT_EQ(one.size(), 1u) << one;
  EXPECT_TRUE(one[0]["lambda"].is_number()) << one;
}

TEST_F(CommandLineImport, LinesLieOverAScan) {
  write("points.csv", "x_mm,y_mm\n5,5\n10,8\n15,9\n20,8\n25,5\n");
  const auto done = run("trace " + scene() + " --dpi 254 --import " + file("points.csv") + " -o " + file("o.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  ASSERT_EQ(document->curves.size(), 2u);
  const NurbsCurve& wave = document->curves[1].pieces[0].curve;
  EXPECT_LT((wave.point(wave.start()) - Vec2(5, 5)).norm(), 0.2);
}

TEST_F(CommandLineImport, SaysWhatIsAssumedAndWhatIsWrong) {
  write("bare.csv", "0,0\n1,1\n2,1\n");
  const auto done = run("trace " + file("bare.csv") + " -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("states no unit"));
  ASSERT_EQ(run("trace " + file("bare.csv") + " --import-unit in -o " + file("o.json")).code, 0);
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  ASSERT_EQ(document->curves[0].pieces.size(), 2u) << "a corner in the middle";
  const NurbsCurve& last = document->curves[0].pieces[1].curve;
  EXPECT_NEAR(last.point(last.end()).x(), 50.8, 1e-9);
  write("bad.dxf", "0\nSECTION\n");
  write("bad.step", "hello");
  expectError("trace " + file("bad.dxf") + " -o " + file("x.svg"), 3, "bad.dxf");
  expectError("trace " + file("bad.step") + " -o " + file("x.svg"), 3, "bad.step");
  expectError("trace " + file("none.igs") + " -o " + file("x.svg"), 3, "does not exist");
  expectError("trace " + file("bare.csv") + " --import-unit ell -o " + file("x.svg"), 2, "--import-unit");
  expectError("trace " + file("bare.csv") + " -o " + file("bare.csv"), 2, "imported");
  expectError("trace --import-unit in --recipe none -o " + file("x.svg"), 2, "none");
}

/// Grey PGM pages one behind the other make no file; a TIFF of two strips does.
std::string twoPageTiff(const GreyImage& first, const GreyImage& second) {
  const auto n = [](std::size_t value, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
    return text;
  };
  std::string bytes = "II" + n(42, 2) + n(8, 4);
  for (const GreyImage* page : {&first, &second}) {
    const auto entry = [&](std::size_t tag, std::size_t value) { return n(tag, 2) + n(4, 2) + n(1, 4) + n(value, 4); };
    const std::size_t data = bytes.size() + 2 + 8 * 12 + 4, size = page->pixels.size();
    const std::size_t width = page->width, height = page->height;
    bytes += n(8, 2) + entry(256, width) + entry(257, height) + entry(258, 8) + entry(259, 1) + entry(262, 1) +
             entry(273, data) + entry(278, height) + entry(279, size) +
             n(page == &first ? data + size + size % 2 : 0, 4);
    for (const auto pixel : page->pixels) bytes.push_back(static_cast<char>(pixel / 257));
    if (size % 2 != 0) bytes.push_back(' ');
  }
  return bytes;
}

GreyImage pageOf(const std::string& shape) {
  const auto truth = test::truthShape(shape, 480, 320);
  return test::renderPage(test::fillCoverage(truth.outline(), 480, 320), 480, 320, test::scannedPage(3)).grey;
}

TEST_F(CommandLinePages, EveryPageOfAStackIsTracedWhenAsked) {
  write("stack.tif", twoPageTiff(pageOf("ellipse"), pageOf("circle")));
  const std::string stack = file("stack.tif");
  const auto first = run("trace " + stack + " --dpi 254 -o " + file("o.json"));
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("The file holds 2 pages; page 1 was traced"));
  const auto advice = run("suggest " + stack);
  ASSERT_EQ(advice.code, 0) << advice.err;
  EXPECT_THAT(advice.out, HasSubstr("The file holds 2 pages; page 1 was looked at"));
  EXPECT_THAT(run("suggest " + stack + " --page 2").out, testing::Not(HasSubstr("The file holds")));
  for (const int page : {1, 2}) {
    const auto chosen = run("trace " + stack + " --dpi 254 --page " + std::to_string(page) + " -o " + file("two.json"));
    ASSERT_EQ(chosen.code, 0);
    EXPECT_THAT(chosen.out, testing::Not(HasSubstr("The file holds"))) << "the page was chosen";
  }
  const auto all =
      run("trace " + stack + " --dpi 254 --page all -o " + file("o.json") + " -o " + file("o.poly.csv") + " -o " +
          file("o.report.html") + " --report " + file("rep.json") + " --save-recipe " + file("r.recipe.json"));
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(std::count(all.out.begin(), all.out.end(), '\n'), 2);
  EXPECT_EQ(test::readFile(file("o-p1.json")), test::readFile(file("o.json")));
  EXPECT_EQ(test::readFile(file("o-p2.json")), test::readFile(file("two.json")));
  EXPECT_NE(test::readFile(file("o-p1.json")), test::readFile(file("o-p2.json")));
  for (const char* name : {"o-p2.poly.csv", "o-p1.report.html", "rep-p1.json", "r-p2.recipe.json"})
    EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
  const auto recipe = recipeFromJson(test::readFile(file("r-p2.recipe.json")));
  ASSERT_TRUE(recipe);
  EXPECT_EQ(recipe->scanPage.number, 2);
  // The recipe knows its page.
  ASSERT_EQ(run("trace " + stack + " --recipe " + file("r-p2.recipe.json") + " -o " + file("again.json")).code, 0);
  EXPECT_EQ(test::readFile(file("again.json")), test::readFile(file("two.json")));
  expectError("trace " + stack + " --page 3 -o " + file("x.svg"), 3, "has 2 pages");
  expectError("trace " + stack + " --page none -o " + file("x.svg"), 2, "--page");
}

TEST_F(CommandLinePages, EachLineStatesTheTimeOfItsPage) {
  const GreyImage shape = pageOf("car");
  GreyImage large(3 * shape.width, 3 * shape.height);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.row(y)[x] = shape.row(y % shape.height)[x % shape.width];
  }
  write("stack.tif", twoPageTiff(large, pageOf("ellipse")));
  const auto done = run("trace " + file("stack.tif") + " --dpi 254 --page all -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  const auto end = done.out.find('\n');
  const auto took = [](const std::string& line) { return json::parse(line)["processor_milliseconds"].get<double>(); };
  EXPECT_LT(took(done.out.substr(end)), took(done.out.substr(0, end)));
}

TEST_F(CommandLinePages, ABlankPageDoesNotKeepTheOthers) {
  GreyImage blank(100, 80);
  std::fill(blank.pixels.begin(), blank.pixels.end(), std::uint16_t{65535});
  write("stack.tif", twoPageTiff(blank, pageOf("ellipse")));
  const auto done = run("trace " + file("stack.tif") + " --page all -o " + file("o.svg"));
  EXPECT_EQ(done.code, 4);
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
  EXPECT_THAT(done.err, HasSubstr("batten-cli: Page 1: "));
  const json blankPage = json::parse(done.out.substr(0, done.out.find('\n')));
  EXPECT_EQ(blankPage["page"], 1);
  EXPECT_EQ(blankPage["exit"], 4);
  EXPECT_FALSE(blankPage["error"].get<std::string>().empty());
  EXPECT_EQ(json::parse(done.out.substr(done.out.find('\n')))["page"], 2);
  EXPECT_FALSE(std::filesystem::exists(file("o-p1.svg")));
  EXPECT_TRUE(std::filesystem::exists(file("o-p2.svg")));
}

TEST_F(CommandLinePages, ABatchTakesThePageOfItsManifest) {
  write("stack.tif", twoPageTiff(pageOf("ellipse"), pageOf("circle")));
  const auto line = [&](int page, const std::string& out) {
    return json{{"scan", file("stack.tif")}, {"outputs", {file(out)}}, {"dpi", 254}, {"page", page}}.dump() + "\n";
  };
  write("m.jsonl", line(1, "a.json") + line(2, "b.json"));
  const auto done = run("batch " + file("m.jsonl"));
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_EQ(run("trace " + file("stack.tif") + " --dpi 254 --page 2 -o " + file("c.json")).code, 0);
  EXPECT_EQ(test::readFile(file("b.json")), test::readFile(file("c.json")));
  EXPECT_NE(test::readFile(file("a.json")), test::readFile(file("b.json")));
  write("n.jsonl", line(0, "d.json"));
  expectError("batch " + file("n.jsonl"), 2, "page");
}

}  // namespace
}  // namespace batten
