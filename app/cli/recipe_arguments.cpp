// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/recipe_arguments.h"

#include <utility>

#include "app/cli/wrong_words.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/image/file/pdf_scan.h"
#include "core/pipeline/recipe/paper_presets.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten::cli {
namespace {

/// Whether the file begins as a PDF does: of those --dpi is how finely they are drawn.
bool isPdfFile(const std::string& path) {
  const auto file = RegularFile::open(path);
  return file && isPdf(*file);
}

/// --dpi and --page.
Result<void> applyPage(const TraceArguments& arguments, Recipe& recipe) {
  if (arguments.dpi) {
    const bool isDrawn = !arguments.scan.empty() && isPdfFile(arguments.scan);
    const auto dpi = numberFromText(*arguments.dpi);
    if (!dpi || (isDrawn && (*dpi < kCoarsestPdfDpi || *dpi > kFinestPdfDpi)))
      return wrong(std::string("--dpi takes a number from ") + (isDrawn ? "20 to 4800 for a PDF" : "1 to 100000") +
                   ", not " + quotedText(*arguments.dpi) + ".");
    if (isDrawn) {
      recipe.scanPage.pdfDpi = *dpi;
    } else {
      setResolution(recipe, dpi);
    }
  }
  if (!arguments.page) return {};
  const auto page = integerFromText(*arguments.page);
  if (!page || *page < 1 || *page > kMostPages)
    return wrong("--page takes the number of a page, 1 to 100000" +
                 std::string(arguments.takesAllPages ? ", or all" : "") + ", not " + quotedText(*arguments.page) + ".");
  if (arguments.scan.empty()) return wrong("--page needs a scan: name the file.");
  recipe.scanPage.number = *page;
  return {};
}

Result<Recipe> readRecipe(const std::string& path) {
  if (path.empty()) return Recipe{};
  const auto text = readWhole(path, kLargestRecipeBytes);
  if (!text) return wrong("The recipe " + path + " cannot be read: it " + describe(text.error()) + ". Check its name.");
  return recipeFromJson(*text);
}

Result<void> applySetting(const std::string& setting, Recipe& recipe) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos) return wrong("--set takes stage.parameter=value, not " + quotedText(setting) + ".");
  return setParameter(recipe, trimmed(std::string_view(setting).substr(0, equals)),
                      std::string_view(setting).substr(equals + 1));
}

/// Numbers between commas, or nothing.
std::optional<std::vector<double>> numbersOf(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const auto comma = text.find(',');
    const auto value = numberFromText(text.substr(0, comma));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

/// X,Y[,MM|,rMM][,g1|,g2|,g3]
std::optional<CornerMark> cornerMarkOf(std::string text) {
  CornerMark mark;
  for (const auto& [ending, joint] : {std::pair{",g1", RoundingJoint::Tangent},
                                      {",g2", RoundingJoint::Curvature},
                                      {",g3", RoundingJoint::CurvatureSlope}}) {
    if (!text.ends_with(ending)) continue;
    mark.joint = joint;
    text.resize(text.size() - 3);
    break;
  }
  if (const auto radius = text.rfind(",r"); radius != std::string::npos) {
    mark.roundBy = RoundingSize::Radius;
    text.erase(radius + 1, 1);
  }
  const auto values = numbersOf(text);
  if (!values || values->size() < 2 || values->size() > 3) return std::nullopt;
  if (mark.roundBy == RoundingSize::Radius && values->size() < 3) return std::nullopt;
  mark.positionPx = Vec2((*values)[0], (*values)[1]);
  if (values->size() == 3) mark.roundMm = (*values)[2];
  return mark;
}

Result<void> applyCorner(const std::string& corner, Recipe& recipe) {
  const auto mark = cornerMarkOf(corner);
  if (!mark) {
    return wrong(
        "--corner takes X,Y in px from the upper left corner, or X,Y,MM to round it from this distance on, or "
        "X,Y,rMM to round it by this radius, each with ,g1 ,g2 or ,g3 behind it, not " +
        quotedText(corner) + ".");
  }
  recipe.cornerMarks.push_back(*mark);
  return {};
}

/// X,Y of an option, in px.
Result<Vec2> placeOf(const char* option, const std::string& text) {
  const auto values = numbersOf(text);
  if (!values || values->size() != 2) {
    return wrong(std::string(option) + " takes X,Y in px from the upper left corner, not " + quotedText(text) + ".");
  }
  return Vec2((*values)[0], (*values)[1]);
}

Result<void> applySegmentPoint(const std::string& point, Recipe& recipe) {
  const auto place = placeOf("--segment-point", point);
  if (!place) return fail(place.error());
  recipe.segmentPoints.push_back({*place});
  return {};
}

/// "100mm", "10 cm", "4in" as millimetres; nothing without a unit, since nobody could say which was meant.
std::optional<double> lengthOf(std::string_view text) {
  constexpr double kMillimetresPerCentimetre = 10.0;  // by definition
  std::optional<double> unit;
  for (const auto& [word, mm] :
       {std::pair{"mm", 1.0}, {"cm", kMillimetresPerCentimetre}, {"in", kMillimetresPerInch}}) {
    if (!text.ends_with(word)) continue;
    text.remove_suffix(2);
    unit = mm;
    break;
  }
  const auto value = numberFromText(text);
  return value && unit ? std::optional(*value * *unit) : std::nullopt;
}

Result<void> applyKnownLength(const std::string& line, Recipe& recipe) {
  const auto comma = line.rfind(',');
  const auto places = numbersOf(std::string_view(line).substr(0, comma));
  const auto length = comma == std::string::npos ? std::nullopt : lengthOf(std::string_view(line).substr(comma + 1));
  const bool isWhole = places && places->size() == 4 && length;
  const ScaleLine scale =
      isWhole ? ScaleLine{Vec2((*places)[0], (*places)[1]), Vec2((*places)[2], (*places)[3]), *length} : ScaleLine{};
  if (!isWhole || !resolutionOf(scale)) {
    return wrong(
        "--known-length takes X,Y,X,Y,LENGTH: two places in px from the upper left corner and their distance "
        "with its unit, as 100mm, 10cm or 4in, not " +
        quotedText(line) + ".");
  }
  setScaleLine(recipe, scale);
  return {};
}

Result<void> applyDirection(const std::string& direction, Recipe& recipe) {
  const auto values = numbersOf(direction);
  if (!values || values->size() != 4) {
    return wrong(
        "--direction takes X,Y,X,Y in px from the upper left corner, a point on a curve and one "
        "that the curve should run towards, not " +
        quotedText(direction) + ".");
  }
  recipe.directions.push_back({Vec2((*values)[0], (*values)[1]), Vec2((*values)[2], (*values)[3])});
  return {};
}

Result<void> applyStart(const std::string& start, Recipe& recipe) {
  const auto place = placeOf("--start", start);
  if (!place) return fail(place.error());
  recipe.starts.push_back({*place});
  return {};
}

Result<void> applyTraceMode(const std::string& region, EdgeMode mode, Recipe& recipe) {
  const auto place = placeOf(mode == EdgeMode::Outline ? "--outline" : "--centreline", region);
  if (!place) return fail(place.error());
  recipe.edges.choices.push_back({*place, mode});
  return {};
}

/// The place of a junction, then two places for every pair of branches that are one stroke.
Result<void> applyPairing(const std::string& pairing, Recipe& recipe) {
  const auto values = numbersOf(pairing);
  if (!values || values->size() % 4 != 2) {
    return wrong(
        "--pair takes X,Y of a junction and behind it, for every two branches that are one stroke, X,Y,X,Y: a point on "
        "each, all in px from the upper left corner; without them every stroke ends there. Not " +
        quotedText(pairing) + ".");
  }
  const auto place = [&](std::size_t i) { return Vec2((*values)[i], (*values)[i + 1]); };
  JunctionChoice choice{place(0), {}};
  for (std::size_t i = 2; i < values->size(); i += 4) choice.pairs.push_back({place(i), place(i + 2)});
  recipe.edges.junctions.push_back(std::move(choice));
  return {};
}

Result<void> applyRegion(const std::string& region, Recipe& recipe) {
  const auto numbers = numbersOf(region);
  if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0.0) || !((*numbers)[3] > 0.0)) {
    return wrong("--roi takes X,Y,WIDTH,HEIGHT in px from the upper left corner, not " + quotedText(region) + ".");
  }
  const Vec2 corner((*numbers)[0], (*numbers)[1]);
  recipe.regions.push_back(rectangleRegion(corner, corner + Vec2((*numbers)[2], (*numbers)[3])));
  return {};
}

}  // namespace

Result<Recipe> recipeOf(const TraceArguments& arguments) {
  auto recipe = readRecipe(arguments.recipe);
  if (!recipe) return recipe;
  if (!arguments.asIn.empty()) {
    const PaperPreset* paper = findPaperPreset(arguments.asIn);
    if (paper == nullptr)
      return wrong("There is no paper " + quotedText(arguments.asIn) + ". --as-in takes " + paperPresetNames() + ".");
    if (auto set = applyPaperPreset(*paper, *recipe); !set) return fail(set.error());
  }
  for (const std::string& setting : arguments.settings) {
    if (auto set = applySetting(setting, *recipe); !set) return fail(set.error());
  }
  for (const std::string& corner : arguments.corners) {
    if (auto set = applyCorner(corner, *recipe); !set) return fail(set.error());
  }
  for (const std::string& point : arguments.segmentPoints) {
    if (auto set = applySegmentPoint(point, *recipe); !set) return fail(set.error());
  }
  for (const std::string& place : arguments.outlines) {
    if (auto set = applyTraceMode(place, EdgeMode::Outline, *recipe); !set) return fail(set.error());
  }
  for (const std::string& place : arguments.centrelines) {
    if (auto set = applyTraceMode(place, EdgeMode::Centreline, *recipe); !set) return fail(set.error());
  }
  for (const std::string& pairing : arguments.pairings) {
    if (auto set = applyPairing(pairing, *recipe); !set) return fail(set.error());
  }
  for (const std::string& region : arguments.regions) {
    if (auto set = applyRegion(region, *recipe); !set) return fail(set.error());
  }
  if (auto set = applyPage(arguments, *recipe); !set) return fail(set.error());
  for (const std::string& direction : arguments.directions) {
    if (auto set = applyDirection(direction, *recipe); !set) return fail(set.error());
  }
  for (const std::string& start : arguments.starts) {
    if (auto set = applyStart(start, *recipe); !set) return fail(set.error());
  }
  if (arguments.dpi && arguments.knownLength)
    return wrong("--dpi and --known-length both set the resolution. Give one of them.");
  if (arguments.knownLength && arguments.scan.empty() && !recipe->page)
    return wrong(
        "--known-length sets the resolution of a scan, and none is named. Imported curves have their unit: "
        "use --import-unit or --scale.");
  if (arguments.knownLength) {
    if (auto set = applyKnownLength(*arguments.knownLength, *recipe); !set) return fail(set.error());
  }
  if (arguments.scan.empty() && !recipe->page && arguments.imports.empty()) {
    return wrong("Name a scan. Only a recipe drawn on an empty page needs none.");
  }
  if (auto problem = validate(*recipe)) return fail(std::move(*problem));
  return recipe;
}

std::optional<std::string> otherPagesNote(const TraceArguments& arguments, const Recipe& recipe, const Scan& scan) {
  const bool isPageChosen = arguments.page || recipe.scanPage.number != PageChoice{}.number;
  if (scan.pages < 2 || isPageChosen) return std::nullopt;
  return "The file holds " + std::to_string(scan.pages) + " pages; page " + std::to_string(scan.page.number) +
         (arguments.takesAllPages ? " was traced. Use --page N for another page or --page all for all."
                                  : " was looked at. Use --page N for another page.");
}

}  // namespace batten::cli
