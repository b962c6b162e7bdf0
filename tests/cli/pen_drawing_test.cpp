// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/nurbs_curve.h"
#include "core/exchange/text/curve_json.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using PenDrawing = test::Program;

Recipe drawing() {
  Recipe recipe;
  recipe.page = BlankPage{300, 200};
  recipe.dpi = 254.0;
  recipe.penStrokes = {{{{20, 30}, {60, 30}, {100, 30}, {140, 30}, {140, 70}, {140, 110}, {140, 150}}, false}};
  recipe.cornerMarks = {{{137, 33}}};
  recipe.construct.method = ConstructMethod::ControlPolygon;
  recipe.construct.removalStepPx = 0.0;
  return recipe;
}

TEST_F(PenDrawing, ARecipeDrawnOnAnEmptyPageNeedsNoScan) {
  write("r.json", recipeToJson(drawing()));
  const auto done = run("trace --recipe " + file("r.json") + " -o " + file("o.json") + " -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  ASSERT_EQ(document->curves.size(), 1u);
  ASSERT_EQ(document->curves[0].pieces.size(), 2u) << "cut at the sharp point";
  EXPECT_LT((document->curves[0].pieces[0].curve.point(1e9) - Vec2(14.0, 17.0)).norm(), 1e-9);
  EXPECT_NE(test::readFile(file("o.svg")).find("width=\"30mm\" height=\"20mm\""), std::string::npos);
}

TEST_F(PenDrawing, StrokesAreDrawnOverAScanToo) {
  Recipe recipe = drawing();
  recipe.page.reset();
  recipe.construct = {};
  write("r.json", recipeToJson(recipe));
  ASSERT_EQ(run("trace " + scene() + " --recipe " + file("r.json") + " -o " + file("o.json")).code, 0);
  const auto document = readCurveJson(test::readFile(file("o.json")));
  ASSERT_TRUE(document);
  EXPECT_EQ(document->curves.size(), 2u);
  expectError("trace --recipe " + file("r.json") + " -o " + file("p.json"), 2, "scan");
}

}  // namespace
}  // namespace batten
