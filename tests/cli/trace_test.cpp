// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/curve/closest_point.h"
#include "core/exchange/svg/svg_check.h"
#include "core/exchange/text/curve_json.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/stage_id.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using Trace = test::Program;

TEST_F(Trace, WritesSvgJsonReportAndSummary) {
  const auto done = run("trace " + scene() + " --dpi 254 -o " + file("o.svg") + " -o " + file("o.json") + " --report " +
                        file("r.json") + " --report-targets");
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  const json summary = json::parse(done.out);
  EXPECT_EQ(summary["curves"], 1);
  EXPECT_EQ(summary["files"].size(), 3u);
  EXPECT_NE(test::readFile(file("o.svg")).find("width=\"48mm\" height=\"32mm\""), std::string::npos);

  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document) << document.error().message;
  ASSERT_EQ(document->curves.size(), 1u);
  EXPECT_TRUE(document->curves[0].closed);
  EXPECT_EQ(document->dpi, 254.0);
  const NurbsCurve& curve = document->curves[0].pieces[0].curve;
  const auto truth = test::truthShape("ellipse", 480, 320).outline();
  for (std::size_t i = 0; i < truth.size(); i += 97) {
    EXPECT_LT(closestPoint(curve, document->frame.pointToModel(truth[i])).distance, 0.5 * document->frame.mmPerPx);
  }

  const json report = json::parse(test::readFile(file("r.json")));
  EXPECT_GT(report["peak_memory_bytes"].get<double>(), 1e6);
  EXPECT_EQ(report["stages"].size(), kStages.size());
  EXPECT_EQ(report["curves"][0]["targets"].size(), 6u);
  EXPECT_EQ(report["image"]["sha256"], document->imageSha256);
}

TEST_F(Trace, WritesSeveralFormatsInOneRunAndChecksEach) {
  const std::string scan = scene();
  std::string words = "trace " + scan + " --dpi 300 --unit in --preset laser";
  for (const char* ending : {".svg", ".json", ".dxf", ".igs", ".step", ".pdf", ".csv", ".poly.csv"})
    words += " -o '" + file(std::string("a b") + ending) + "'";
  const auto done = run(words);
  ASSERT_EQ(done.code, 0) << done.err;
  const json said = json::parse(done.out);
  EXPECT_EQ(said["files"].size(), 8u);
  ASSERT_EQ(said["checks"].size(), 8u);
  for (const json& check : said["checks"])
    EXPECT_NE(check.get<std::string>().find("read back, largest difference"), std::string::npos) << check;
  const std::string dxf = test::readFile(file("a b.dxf"));
  EXPECT_NE(dxf.find("$INSUNITS\n 70\n1\n"), std::string::npos) << dxf.substr(0, 300);
  EXPECT_NE(said["checks"][2].get<std::string>().find("within"), std::string::npos) << "the laser's cubics approximate";
  EXPECT_NE(test::readFile(file("a b.csv")).find("s_in,x_in,y_in"), std::string::npos);
}

TEST_F(Trace, RefusesWordsOfAnExportThatMakeNoSense) {
  const std::string scan = scene();
  const std::string start = "trace " + scan + " --dpi 300 ";
  expectError(start + "-o " + file("a.dwg"), 2, "must end in one of .svg");
  expectError(start + "--preset paper -o " + file("a.dxf"), 2, "Presets: alias");
  expectError(start + "--preset laser -o " + file("a.step"), 2, "end in .dxf, .svg or .pdf");
  expectError(start + "--unit cm -o " + file("a.dxf"), 2, "mm or in");
  expectError(start + "--scale 0 -o " + file("a.dxf"), 2, "must be from 0.000001 to 1000000");
  expectError(start + "--scale 1e9 -o " + file("a.dxf"), 2, "must be from 0.000001 to 1000000");
  expectError(start + "--tolerance 0 -o " + file("a.svg"), 2, "at least 0.000001 mm");
  expectError(start + "--curves 7 -o " + file("a.svg"), 2, "no curve 7");
  expectError(start + "--curves x -o " + file("a.svg"), 2, "curve numbers such as");
  expectError(start + "--which all -o " + file("a.svg"), 2, "faired, sketched or both");
  EXPECT_FALSE(std::filesystem::exists(file("a.svg")));
}

/// What a first-time user sees: every line of the drawing whole, cut at its nine corners and nowhere else.
TEST_F(Trace, TheSampleGivesItsLinesWhole) {
  const std::string sample = BATTEN_SAMPLE;
  const std::string recipe = sample.substr(0, sample.rfind('.')) + ".recipe.json";
  const auto plain = run("trace " + sample + " -o " + file("p.json"));
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(json::parse(plain.out)["curves"], 7) << "outline, windows, belt line, two wheels of two rings";
  const auto done = run("trace " + sample + " --recipe " + recipe + " -o " + file("o.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(json::parse(done.out)["curves"], 7);
  EXPECT_EQ(json::parse(done.out)["pieces"], 14);
  // Its fairing leaves what is fair already, and that is all there is to say.
  for (const std::string note : json::parse(done.out)["notes"])
    EXPECT_NE(note.find("Unchanged"), std::string::npos) << note;
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  EXPECT_EQ(std::count_if(document->curves.begin(), document->curves.end(), [](const auto& c) { return c.closed; }), 6)
      << "all but the belt line";
}

TEST_F(Trace, NotesNameTheCurvesThatTurnSharplyWithoutAMark) {
  const std::vector<Vec2> corners{{100, 60}, {380, 80}, {360, 260}, {80, 240}};
  const Scan scan = test::renderPage(test::fillCoverage(corners, 480, 320), 480, 320, test::scannedPage(3));
  write("square.png", pngOf(scan.grey));
  const std::string start = "trace " + file("square.png") + " --set corners.auto=false -o " + file("a.json");
  const auto notesOf = [&](const std::string& words) {
    const auto done = run(words);
    EXPECT_EQ(done.code, 0) << done.err;
    std::vector<std::string> sharp;
    const json said = json::parse(done.out);
    for (const json& note : said["notes"]) {
      if (note.get<std::string>().find("sharply") != std::string::npos) sharp.push_back(note);
    }
    return sharp;
  };
  EXPECT_EQ(notesOf(start), std::vector<std::string>{
                                "Curve 1 turns sharply where no corner is marked: add --corner there (suggest lists "
                                "the places); where the line trembles, raise construct.detail instead."});
  EXPECT_EQ(
      notesOf(start + " --corner 100,60 --corner 360,260"),
      std::vector<std::string>{"Curves 1 and 2 turn sharply where no corner is marked: add --corner there (suggest "
                               "lists the places); where the line trembles, raise construct.detail instead."});
  EXPECT_TRUE(notesOf(start + " --corner 100,60 --corner 360,260 --corner 380,80 --corner 80,240").empty());
}

TEST_F(Trace, GivesTheSameBytesWithAnyNumberOfThreads) {
  const std::string start = "trace " + scene("car") + " --set fairing.mode=tolerance ";
  ASSERT_EQ(run(start + "--threads 1 -o " + file("a.svg") + " -o " + file("a.json")).code, 0);
  ASSERT_EQ(run(start + "--threads 2 -o " + file("b.svg") + " -o " + file("b.json")).code, 0);
  ASSERT_EQ(run(start + "--threads 7 -o " + file("c.svg") + " -o " + file("c.json")).code, 0);
  EXPECT_EQ(test::readFile(file("a.json")), test::readFile(file("b.json")));
  EXPECT_EQ(test::readFile(file("a.json")), test::readFile(file("c.json")));
  EXPECT_EQ(test::readFile(file("a.svg")), test::readFile(file("b.svg")));
  EXPECT_FALSE(test::readFile(file("a.json")).empty());
}

TEST_F(Trace, ARegionTracesItsPartAndChoicesComeFromTheRecipe) {
  const std::string scan = scene("ellipse");
  ASSERT_EQ(run("trace " + scan + " --roi 0,0,240,320 -o " + file("a.json") + " --report " + file("r.json") +
                " --save-recipe " + file("recipe.json"))
                .code,
            0);
  const json report = json::parse(test::readFile(file("r.json")));
  ASSERT_EQ(report["curves"].size(), 1u);
  EXPECT_EQ(report["curves"][0]["closed"], false);
  EXPECT_GT(report["curves"][0]["construct"]["noise_um"].get<double>(), 0.0);
  json recipe = json::parse(test::readFile(file("recipe.json")));
  EXPECT_EQ(recipe["regions"], json::parse("[[[0,0],[240,0],[240,320],[0,320]]]"));
  // An extremum that the report names is taken out by the recipe, and the report says whose choice it was.
  json kept;
  for (const json& e : report["curves"][0]["construct"]["extrema"])
    if (e["kept"]) kept = e;
  ASSERT_FALSE(kept.is_null());
  recipe["extrema"] = json::array({{{"at", kept["at_px"]}, {"keep", false}}});
  std::ofstream(file("recipe2.json")) << recipe.dump();
  ASSERT_EQ(run("trace " + scan + " --recipe " + file("recipe2.json") + " -o " + file("b.json") + " --report " +
                file("r2.json"))
                .code,
            0);
  int chosen = 0;
  const json second = json::parse(test::readFile(file("r2.json")));
  for (const json& e : second["curves"][0]["construct"]["extrema"]) {
    if (!e["chosen_by_user"]) continue;
    ++chosen;
    EXPECT_FALSE(e["kept"]);
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_NE(run("trace " + scan + " --roi 0,0,240 -o " + file("c.json")).code, 0);
  EXPECT_NE(run("trace " + scan + " --roi 0,0,240,-3 -o " + file("c.json")).code, 0);
}

TEST_F(Trace, InkIsFollowedInTheWayAskedFor) {
  const std::string middles = "trace " + scene("ellipse") + " --set edges.mode=centreline -o " + file("a.json") +
                              " --report " + file("r.json") + " --save-recipe " + file("way.json");
  EXPECT_EQ(run(middles).code, 4) << "a filled ellipse has no middle";
  ASSERT_EQ(run(middles + " --outline 240,160").code, 0);
  EXPECT_EQ(json::parse(test::readFile(file("r.json")))["curves"][0]["kind"], "outline");
  const json ways = json::parse(test::readFile(file("way.json")))["ways"];
  EXPECT_EQ(ways, json::parse(R"([{"at":[240.0,160.0],"mode":"outline"}])"));
}

TEST_F(Trace, CornersCutTheContourAndTheSavedRecipeRepeatsTheResult) {
  const auto truth = test::truthShape("car", 480, 320);
  std::string corners;
  for (const Vec2& c : truth.corners)
    corners += " --corner " + std::to_string(c.x() + 3) + "," + std::to_string(c.y() - 2);
  const std::string scan = scene("car");
  ASSERT_EQ(run("trace " + scan + corners + " --set segments.spacing=25 -o " + file("a.json") + " --save-recipe " +
                file("r.json"))
                .code,
            0);
  const auto document = readCurveJson(test::readFile(file("a.json")));
  ASSERT_TRUE(document);
  ASSERT_FALSE(document->curves.empty());
  EXPECT_TRUE(document->curves[0].closed);
  EXPECT_EQ(document->curves[0].pieces.size(), truth.corners.size());
  ASSERT_EQ(run("trace " + scan + " --recipe " + file("r.json") + " -o " + file("b.json")).code, 0);
  EXPECT_EQ(test::readFile(file("a.json")), test::readFile(file("b.json")));
}

TEST_F(Trace, CurvesBrokenAtTheirCornersAreWrittenWithTheGaps) {
  const auto truth = test::truthShape("car", 480, 320);
  std::string corners;
  for (const Vec2& c : truth.corners) corners += " --corner " + std::to_string(c.x()) + "," + std::to_string(c.y());
  ASSERT_EQ(run("trace " + scene("car") + corners +
                " --set construct.method=control-polygon --set construct.knots=order -o " + file("a.json") + " -o " +
                file("a.svg"))
                .code,
            0);
  const auto document = readCurveJson(test::readFile(file("a.json")));
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_FALSE(document->curves[0].closed) << "this construction ends before its corners";
  const std::string svg = test::readFile(file("a.svg"));
  const auto check = checkSvg(svg, *document);
  ASSERT_TRUE(check) << check.error().detail;
  EXPECT_LE(check->largestErrorMm, 0.002 * 1.02);
  const std::string says = "lie within ";
  EXPECT_LE(check->largestErrorMm, 1.02 * std::stod(svg.substr(svg.find(says) + says.size())) + 1e-7);
}

TEST_F(Trace, SettingsComeOnTopOfTheRecipeInTheOrderGiven) {
  const std::string scan = scene();
  ASSERT_EQ(
      run("trace " + scan + " --set filter.iterations=3 --set segments.spacing=55 --save-recipe " + file("r.json"))
          .code,
      0);
  const auto done =
      run("trace " + scan + " --recipe " + file("r.json") +
          " --set filter.iterations=4 --set filter.iterations=5 --dpi 200 --save-recipe " + file("s.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json recipe = json::parse(test::readFile(file("s.json")));
  EXPECT_EQ(recipe["parameters"]["filter.iterations"], 5);
  EXPECT_EQ(recipe["parameters"]["segments.spacing"], 55.0);
  EXPECT_EQ(recipe["dpi"], 200.0);
}

TEST_F(Trace, DumpsEveryStageAsPng) {
  std::string words = "trace " + scene("car");
  std::vector<std::string> names{"log", "page", "paper"};
  for (const StageId stage : kStages) names.emplace_back(name(stage));
  for (const std::string& one : names) words += " --dump " + one + "=" + file(one + ".png");
  const auto done = run(words);
  ASSERT_EQ(done.code, 0) << done.err;
  for (const std::string& one : names) {
    const std::string png = test::readFile(file(one + ".png"));
    ASSERT_GT(png.size(), 60u) << one;
    EXPECT_EQ(png.substr(1, 3), "PNG") << one;
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x01\xe0\0\0\x01\x40", 8)) << one;  // 480 x 320
  }
}

TEST_F(Trace, NamesWithBlanksAndOtherScripts) {
  write("süße 漢字.png", test::readFile(scene()));
  const auto done = run("trace '" + file("süße 漢字.png") + "' -o '" + file("läuft gut.svg") + "'");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(test::readFile(file("läuft gut.svg")).find("<title>süße 漢字.png</title>"), std::string::npos);
}

TEST_F(Trace, ListsTheParameters) {
  const auto listed = run("parameters --json");
  ASSERT_EQ(listed.code, 0);
  const json list = json::parse(listed.out);
  ASSERT_EQ(list.size(), parameterTable().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i]["name"], parameterTable()[i].name);
    EXPECT_EQ(list[i]["default"], defaultValue(parameterTable()[i]));
    EXPECT_FALSE(list[i]["help"].get<std::string>().empty());
  }
  const auto text = run("parameters");
  EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), std::ssize(list) + 1);
}

TEST_F(Trace, HelpAndVersionSucceed) {
  for (const char* words : {"--help", "trace --help", "parameters --help", "--version"}) {
    const auto done = run(words);
    EXPECT_EQ(done.code, 0) << words;
    EXPECT_FALSE(done.out.empty()) << words;
    EXPECT_EQ(done.err, "") << words;
  }
  EXPECT_NE(run("--help").out.find("Exit codes"), std::string::npos);
}

TEST_F(Trace, SaysWhatBecameOfMarksAndChoicesThatFoundNothing) {
  const std::string scan = scene("ellipse");
  const auto outline = test::truthShape("ellipse", 480, 320).outline();
  std::size_t near = 0;
  while ((outline[near] - outline[0]).norm() < 4.0) ++near;
  const auto mark = [](const Vec2& at) { return " --corner " + std::to_string(at.x()) + "," + std::to_string(at.y()); };
  const auto notes = [&](const std::string& words) {
    const auto done = run("trace " + scan + words + " -o " + file("o.json"));
    EXPECT_EQ(done.code, 0) << done.err;
    return json::parse(done.out)["notes"].dump();
  };
  const std::string close = notes(mark(outline[0]) + mark(outline[near]));
  EXPECT_NE(close.find("Corners 1 and 2 are 4 px apart"), std::string::npos) << close;
  const std::string same = notes(mark(outline[0]) + mark(outline[0]));
  EXPECT_NE(same.find("Corners 1 and 2"), std::string::npos) << same;
  EXPECT_NE(same.find("same corner"), std::string::npos) << same;
  write("gone.json", R"({"format":"batten-recipe","version":1,"choices":[)"
                     R"({"anchors":[[4,10],[60,10]],"included":false}]})");
  const std::string gone = notes(" --recipe " + file("gone.json"));
  EXPECT_NE(gone.find("kept in the recipe"), std::string::npos) << gone;
}

}  // namespace
}  // namespace batten
