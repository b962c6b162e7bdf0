// SPDX-License-Identifier: GPL-3.0-or-later
// fuzz_seeds FOLDER: writes valid inputs for every fuzzer, FOLDER/<fuzzer>/<name>, for it to begin with.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/exchange/curve_json.h"
#include "core/exchange/export_file.h"
#include "core/exchange/svg_writer.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace {

using namespace batten;
namespace fs = std::filesystem;

void write(const fs::path& path, std::string_view bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

Recipe fullRecipe() {
  Recipe recipe;
  recipe.dpi = 300.0;
  recipe.cornerMarks = {{Vec2(10.5, 20.25), 0.0}, {Vec2(30, 40), 1.5}};
  recipe.segmentPoints = {{Vec2(5, 6)}};
  recipe.edges.choices = {{Vec2(7, 8), EdgeMode::Outline}};
  recipe.extremumChoices = {{Vec2(1, 2), true}};
  recipe.regions = {rectangleRegion(Vec2(0, 0), Vec2(90, 70))};
  recipe.penStrokes = {{{Vec2(1, 1), Vec2(50, 60), Vec2(70, 20)}, true}};
  recipe.page = BlankPage{200, 160};
  PieceChoice choice;
  choice.anchorsPx = {Vec2(1, 1), Vec2(50, 60)};
  choice.target = 3;
  choice.toleranceMm = 0.4;
  choice.keepPx = {Vec2(9, 9)};
  recipe.choices = {choice};
  return recipe;
}

ExportDocument drawing() {
  ExportDocument document;
  document.frame = {100, 80, 0.1};
  document.dpi = 254.0;
  document.title = "seed.png";
  auto curve = NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{1, 1}, {3, 2}, {5, 2}, {7, 1}}, {});
  document.curves.push_back({"curve-1", false, {{*curve}}, {}});
  return document;
}

/// Valid files for fuzz_import, each behind the byte that selects its kind.
void writeImports(const fs::path& folder) {
  const auto add = [&](char kind, const char* name, const std::string& text) { write(folder / name, kind + text); };
  const std::pair<ExportFormat, const char*> kFormats[] = {{ExportFormat::Dxf, "dxf"},  {ExportFormat::Iges, "igs"},
                                                           {ExportFormat::Step, "stp"}, {ExportFormat::Svg, "svg"},
                                                           {ExportFormat::Csv, "csv"},  {ExportFormat::Json, "json"}};
  char kind = 0;
  for (const auto& [format, name] : kFormats) {
    // A build without Open CASCADE writes neither IGES nor STEP.
    if (const auto file = exportedFile(drawing(), {.format = format})) add(kind, name, file->bytes);
    ++kind;
  }
  add(0, "polyline.dxf",
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n90\n3\n70\n1\n10\n0\n20\n0\n42\n0.5\n10\n9\n20\n0\n10\n9\n20\n9\n"
      "0\nARC\n10\n1\n20\n2\n40\n3\n50\n10\n51\n200\n0\nENDSEC\n0\nEOF\n");
  add(3, "shapes.svg",
      "<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='60mm' viewBox='0 0 90 60'><g transform='rotate(9 "
      "1,2) scale(2)'><path d='M1 2C3 4 5 6 7 8s1-1 2 3q4 5 6-7t1 2a5 3 20 1 0 9 9z'/><rect x='1' y='2' width='9' "
      "height='5' rx='2'/><ellipse cx='20' cy='20' rx='9' ry='4'/><polyline points='1,2 3,4 9,1'/></g></svg>");
  add(4, "points.csv", "curve;x [mm];y [mm]\n1;0,5;1\n1;2;3,5\n1;4;1\n\n2;0;0\n2;9;9\n");
  add(5, "points.json", R"({"unit":"cm","lines":[{"name":"roof","closed":true,"points":[[0,0],[5,1],[3,4]]}]})");
}

void writeScans(const fs::path& folder) {
  cv::Mat grey(40, 60, CV_8UC1, cv::Scalar(230)), colour(40, 60, CV_8UC3, cv::Scalar(230, 235, 225)),
      deep(40, 60, CV_16UC1, cv::Scalar(60000));
  cv::ellipse(grey, {30, 20}, {20, 12}, 0, 0, 360, cv::Scalar(20), 2);
  cv::ellipse(colour, {30, 20}, {20, 12}, 0, 0, 360, cv::Scalar(20, 30, 25), 2);
  cv::ellipse(deep, {30, 20}, {20, 12}, 0, 0, 360, cv::Scalar(5000), 2);
  for (const char* kind : {"png", "jpg", "tiff", "bmp", "webp", "pgm"}) {
    for (const auto& [name, picture] : {std::pair("grey", grey), {"colour", colour}, {"deep", deep}}) {
      std::vector<unsigned char> bytes;
      try {
        if (!cv::imencode(std::string(".") + kind, picture, bytes)) continue;
      } catch (const cv::Exception&) {
        continue;  // no such pixels in that format
      }
      write(folder / (std::string(name) + "." + kind), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "fuzz_seeds FOLDER\n";
    return 2;
  }
  const fs::path folder = argv[1];
  write(folder / "fuzz_recipe" / "default.json", recipeToJson({}));
  write(folder / "fuzz_recipe" / "full.json", recipeToJson(fullRecipe()));
  write(folder / "fuzz_curves" / "curves.json", writeCurveJson(drawing()).value());
  write(folder / "fuzz_svg" / "curves.svg", writeSvg(drawing(), {}).value().text);
  writeScans(folder / "fuzz_scan");
  writeImports(folder / "fuzz_import");
  write(folder / "fuzz_parameters" / "seed", "seed");
  return 0;
}
