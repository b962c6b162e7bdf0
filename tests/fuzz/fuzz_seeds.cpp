// SPDX-License-Identifier: GPL-3.0-or-later
// fuzz_seeds FOLDER: writes valid inputs for every fuzzer, FOLDER/<fuzzer>/<name>, for it to begin with.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/exchange/export_file.h"
#include "core/exchange/svg/svg_writer.h"
#include "core/exchange/text/curve_json.h"
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
  recipe.edges.junctions = {{Vec2(20, 30), {{Vec2(10, 30), Vec2(30, 31)}}}, {Vec2(50, 60), {}}};
  recipe.extremumChoices = {{Vec2(1, 2), true}};
  recipe.regions = {rectangleRegion(Vec2(0, 0), Vec2(90, 70))};
  recipe.penStrokes = {{{Vec2(1, 1), Vec2(50, 60), Vec2(70, 20)}, true}};
  recipe.page = BlankPage{200, 160};
  PieceChoice choice;
  choice.anchorsPx = {Vec2(1, 1), Vec2(50, 60)};
  choice.target = FairingTarget::Degree3;
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

/// A file of every kind, behind the letter by which fuzz_import knows it.
void writeImports(const fs::path& folder) {
  for (const auto& [letter, ending] :
       {std::pair('d', ".dxf"), {'i', ".igs"}, {'s', ".step"}, {'3', ".3dm"}, {'v', ".svg"}}) {
    ExportSettings settings;
    settings.format = *formatOf(std::string("a") + ending);
    const auto file = exportedFile(drawing(), settings);
    if (file) write(folder / (std::string("curves") + ending), letter + file->bytes);
  }
  ExportSettings cnc;
  cnc.format = ExportFormat::Dxf;
  cnc.dxf = DxfProfile::Cnc;
  cnc.arcs = true;
  write(folder / "cnc.dxf", 'd' + exportedFile(drawing(), cnc).value().bytes);
  write(folder / "shapes.svg",
        "g<svg width='100mm' height='50mm' viewBox='0 0 200 100'><g transform='rotate(10)'><path d='M0 0C1 2 3 2 4 "
        "0S7-2 8 0"
        "a3 2 10 1 0 4 4z'/><rect width='5' height='5' rx='1'/><polygon points='1,1 2,2 3,1'/></g></svg>");
  write(folder / "points.csv", "ccurve,x_mm,y_mm\nroof,1,2\nroof,2,2.5\nsill,3,2\nsill,4,9\n");
  write(folder / "points.json",
        R"(j{"unit": "mm", "lines": [{"name": "roof", "closed": false, "points": [[1, 2], [3, 4]]}]})");
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
  writeImports(folder / "fuzz_import");
  writeScans(folder / "fuzz_scan");
  return 0;
}
