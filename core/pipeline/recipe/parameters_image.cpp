// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameters_image.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/pipeline/recipe/parameter_builders.h"

namespace batten::table {
namespace {

using Grid = std::array<std::optional<double>, kRegions>;

std::string gridToText(const Grid& grid) {
  if (std::none_of(grid.begin(), grid.end(), [](const auto& cell) { return cell.has_value(); })) return "auto";
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (i != 0) text += ',';
    text += grid[i] ? numberToText(*grid[i]) : "a";
  }
  return text;
}

Result<Grid> gridFromText(const std::string& name, std::string_view text) {
  Grid grid{};
  if (trimmed(text) == "auto") return grid;
  std::size_t cell = 0;
  for (std::string_view rest = text;; ++cell) {
    const std::size_t comma = rest.find(',');
    const std::string_view entry = trimmed(rest.substr(0, comma));
    if (cell >= grid.size()) {
      return refuse(name, "…", "it must be \"auto\" or 64 entries separated by commas, and there are more");
    }
    if (entry != "a" && entry != "auto") {
      const auto level = numberFromText(entry);
      if (!level || *level < 0.0 || *level > 255.0) {
        return refuse(name, entry,
                      "entry " + std::to_string(cell + 1) + " must be \"a\" or a grey level from 0 to 255");
      }
      grid[cell] = *level;
    }
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (cell + 1 != grid.size()) {
    return refuse(name, text,
                  "it must be \"auto\" or 64 entries separated by commas, and there are " + std::to_string(cell + 1));
  }
  return grid;
}

Parameter gridParameter() {
  Parameter p =
      described(StageId::Thresholds,
                {"threshold.grid", "Region thresholds", "grey",
                 "The 64 thresholds row by row from the top left: \"auto\", or 64 entries separated by commas, each a "
                 "grey level or \"a\" for automatic. A larger level takes more of the picture as ink."},
                ParameterType::Text);
  p.get = [](const Recipe& r) { return gridToText(r.threshold.grid); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    auto grid = gridFromText(name, text);
    if (!grid) return fail(std::move(grid).error());
    r.threshold.grid = *grid;
    return {};
  };
  return p;
}

/// Inks as people call them.
constexpr std::array<std::pair<std::string_view, double>, 9> kInkNames = {{{"red", 0.0},
                                                                           {"orange", 30.0},
                                                                           {"yellow", 60.0},
                                                                           {"green", 120.0},
                                                                           {"turquoise", 180.0},
                                                                           {"blue", 225.0},
                                                                           {"violet", 265.0},
                                                                           {"magenta", 300.0},
                                                                           {"pink", 340.0}}};

std::string inksToText(const std::vector<InkColour>& inks, const std::string& none) {
  std::string text;
  for (const InkColour& ink : inks) {
    if (!text.empty()) text.push_back(',');
    text.append(ink.hueDeg ? numberToText(*ink.hueDeg) : "black");
  }
  return text.empty() ? none : text;
}

Result<std::vector<InkColour>> inksFromText(const std::string& name, std::string_view text, const std::string& none) {
  std::vector<InkColour> inks;
  if (trimmed(text) == none) return inks;
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view entry = trimmed(rest.substr(0, comma));
    const auto known =
        std::find_if(kInkNames.begin(), kInkNames.end(), [&](const auto& n) { return n.first == entry; });
    InkColour ink;
    if (known != kInkNames.end())
      ink.hueDeg = known->second;
    else if (entry != "black") {
      const auto hue = numberFromText(entry);
      if (!hue || *hue < 0.0 || *hue > 360.0)
        return refuse(name, entry,
                      "it must be \"" + none +
                          "\" or colours separated by commas: black, red, orange, "
                          "yellow, green, turquoise, blue, violet, magenta, pink or a hue from 0 to 360");
      ink.hueDeg = *hue;
    }
    inks.push_back(ink);
    if (comma == std::string_view::npos) return inks;
    rest.remove_prefix(comma + 1);
  }
}

template <class Field>
Parameter inkList(Words words, const std::string& none, Field field) {
  Parameter p = described(StageId::Thresholds, std::move(words), ParameterType::Text);
  p.get = [field, none](const Recipe& r) { return inksToText(field(r), none); };
  p.set = [field, none, name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    auto inks = inksFromText(name, text, none);
    if (!inks) return fail(std::move(inks).error());
    field(r) = std::move(*inks);
    return {};
  };
  return p;
}

void appendInks(std::vector<Parameter>& table) {
  table.push_back(inkList(
      {"inks.keep", "Inks kept", "",
       "\"all\", or the inks to trace: colour names or hues in degrees, separated by commas; "
       "black includes grey and pencil."},
      "all", [](auto& r) -> auto& { return r.preparation.inks.keep; }));
  table.push_back(inkList(
      {"inks.drop", "Inks dropped", "", "\"none\", or the inks to remove before tracing, given as for inks.keep."},
      "none", [](auto& r) -> auto& { return r.preparation.inks.drop; }));
  table.push_back(real(
      StageId::Thresholds,
      {"inks.range", "Range of hues", "°",
       "Largest difference in hue from a chosen ink. Larger treats more hues as the same ink.", true},
      {5.0, 90.0, 1.0, 0}, [](auto& r) -> auto& { return r.preparation.inks.rangeDeg; }));
}

/// Commas or blanks between the numbers.
std::optional<SheetCorners> sheetCornersFromText(std::string_view text) {
  std::array<double, 8> values{};
  std::size_t count = 0;
  for (std::string_view rest = text; !trimmed(rest).empty();) {
    rest = trimmed(rest);
    const std::size_t end = std::min(rest.find_first_of(", ;"), rest.size());
    const auto value = numberFromText(rest.substr(0, end));
    if (!value || count == values.size()) return std::nullopt;
    values[count++] = *value;
    rest = trimmed(rest.substr(end));
    if (rest.starts_with(',') || rest.starts_with(';')) rest.remove_prefix(1);
  }
  if (count != values.size()) return std::nullopt;
  SheetCorners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = Vec2(values[2 * i], values[2 * i + 1]);
  return corners;
}

std::string sheetToText(const RectifyParams& params) {
  if (params.use == RectifyUse::Off) return "off";
  if (params.use == RectifyUse::Automatic) return "auto";
  std::string text;
  for (const Vec2& corner : params.cornersPx) {
    if (!text.empty()) text += ',';
    text += numberToText(corner.x()) + ',' + numberToText(corner.y());
  }
  return text;
}

Parameter rectifyParameter() {
  Parameter p = described(StageId::Thresholds,
                          {"paper.rectify", "Rectify", "",
                           "Makes a sheet photographed at an angle a rectangle: \"off\", \"auto\" to find its corners, "
                           "or the corners as eight numbers X,Y,X,Y,X,Y,X,Y in px of the picture, clockwise from the "
                           "upper left. All other places are then px of the rectified page."},
                          ParameterType::Text);
  p.get = [](const Recipe& r) { return sheetToText(r.preparation.rectify); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    RectifyParams& params = r.preparation.rectify;
    RectifyParams after{RectifyUse::Off, {Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()}, params.format};
    if (trimmed(text) == "auto") {
      after.use = RectifyUse::Automatic;
    } else if (trimmed(text) != "off") {
      const auto corners = sheetCornersFromText(text);
      if (!corners)
        return refuse(name, text, "it must be \"off\", \"auto\", or the eight numbers X,Y,X,Y,X,Y,X,Y of four corners");
      after.use = RectifyUse::Corners;
      after.cornersPx = *corners;
    }
    params = after;
    return {};
  };
  return p;
}

Parameter formatParameter() {
  std::vector<Word<PaperFormat>> words = {{"auto", "Estimated", PaperFormat::Unknown}};
  for (const PaperSize& paper : paperSizes())
    words.push_back({std::string(paper.word), std::string(paper.name), paper.format});
  return choice<PaperFormat>(
      StageId::Thresholds,
      {"paper.format", "Sheet", "",
       "Format of a rectified sheet: sets its aspect ratio and resolution. auto: the aspect ratio is estimated from "
       "the "
       "perspective. No effect on a page that is not rectified."},
      std::move(words), [](auto& r) -> auto& { return r.preparation.rectify.format; });
}

void appendLog(std::vector<Parameter>& table) {
  constexpr StageId kThresholds = StageId::Thresholds;  // a short name for the entries below
  table.push_back(boolean(
      kThresholds,
      {"log.enabled", "Log picture", "",
       "Shows the scan after the log transform, which brings out faint lines on dark paper. "
       "Display only."},
      [](auto& r) -> auto& { return r.log.enabled; }));
  table.back().isForDisplay = true;
  table.push_back(real(
      kThresholds,
      {"log.factor", "Log factor", "",
       "Slope of the log transform. Larger stretches the dark tones more and compresses the "
       "bright ones."},
      {10.0, 150.0, 1.0, 1, true}, [](auto& r) -> auto& { return r.log.factor; }));
  table.back().isForDisplay = true;
}

// What is kept of the page before thresholds are looked for.
void appendPage(std::vector<Parameter>& table) {
  constexpr StageId kThresholds = StageId::Thresholds;  // a short name for the entries below
  table.push_back(choice<LineTone>(
      kThresholds,
      {"paper.lines", "Lines", "",
       "Whether the lines are darker than the paper, or brighter, as chalk on a blackboard and the lines of a "
       "blueprint: then the page is inverted. Automatic: found by the page."},
      {{"auto", "Automatic", LineTone::Auto},
       {"darker", "Darker than the paper", LineTone::Darker},
       {"brighter", "Brighter than the paper", LineTone::Brighter}},
      [](auto& r) -> auto& { return r.preparation.lines; }));
  table.push_back(choice<ColourUse>(
      kThresholds,
      {"paper.colour", "Coloured ink", "",
       "Uses the darkest colour channel of coloured ink where that increases contrast, so that "
       "yellow marker is found. Brightness: brightness only."},
      {{"darkest", "Darkest channel", ColourUse::Darkest}, {"grey", "Brightness", ColourUse::Grey}},
      [](auto& r) -> auto& { return r.preparation.colour; }));
  table.push_back(choice<RulingUse>(
      kThresholds,
      {"paper.rulings", "Ruled lines", "",
       "Detects printed rulings, grids and dots by their even spacing and removes them, and the margin of ruled "
       "paper; strokes across them are kept."},
      {{"leave-out", "Remove", RulingUse::LeaveOut}, {"keep", "Keep", RulingUse::Keep}},
      [](auto& r) -> auto& { return r.preparation.rulings; }));
  table.push_back(choice<SheetUse>(
      kThresholds,
      {"paper.sheet", "Outside the sheet", "",
       "Cuts off the surroundings of the sheet in a photograph, where the sheet is detected, or a blank page around a "
       "pasted scan, and removes the holes of a spiral binding."},
      {{"cut-off", "Cut off", SheetUse::CutOff}, {"off", "Keep", SheetUse::Off}},
      [](auto& r) -> auto& { return r.preparation.sheet; }));
  table.push_back(choice<ShadingUse>(
      kThresholds,
      {"paper.shading", "Drawn shading", "",
       "Areas of tone, as the shading of marker, airbrush or pencil, count as paper where lines are drawn on and "
       "around them, so that the lines are found. Keep: they are ink, and their borders are traced."},
      {{"leave-out", "Remove", ShadingUse::LeaveOut}, {"keep", "Keep", ShadingUse::Keep}},
      [](auto& r) -> auto& { return r.preparation.shading; }));
  table.push_back(rectifyParameter());
  table.push_back(formatParameter());
  appendInks(table);
  table.push_back(boolean(
      kThresholds,
      {"paper.flatten", "Flatten paper", "", "Removes shading and shadows of the paper before thresholding."},
      [](auto& r) -> auto& { return r.paper.flatten; }));
  table.push_back(boolean(
      kThresholds,
      {"paper.folds", "Remove folds", "",
       "Also removes straight steps in paper brightness that run from border to border: folds "
       "and shadow edges."},
      [](auto& r) -> auto& { return r.paper.folds; }));
}

void appendThresholds(std::vector<Parameter>& table) {
  constexpr StageId kThresholds = StageId::Thresholds;  // a short name for the entries below
  table.push_back(choice<ThresholdMode>(
      kThresholds,
      {"threshold.mode", "Thresholds", "",
       "Whether regions without a threshold of your own find one automatically or use the "
       "common level."},
      {{"auto", "Automatic", ThresholdMode::Automatic}, {"manual", "Manual", ThresholdMode::Manual}},
      [](auto& r) -> auto& { return r.threshold.mode; }));
  table.push_back(gridParameter());
  table.push_back(real(
      kThresholds,
      {"threshold.level", "Common level", "grey",
       "Threshold of all regions in manual mode. Larger takes more of the picture as ink."},
      {0.0, 255.0, 1.0, 1}, [](auto& r) -> auto& { return r.threshold.manualLevel; }));
  table.push_back(real(
      kThresholds,
      {"threshold.strength", "Minimum ink contrast", "",
       "How much darker than paper ink must be in automatic mode. Larger keeps only the darker lines."},
      {0.2, 3.0, 0.05, 2, true}, [](auto& r) -> auto& { return r.threshold.strength; }));
}

void appendBinary(std::vector<Parameter>& table) {
  constexpr StageId kBinary = StageId::Binary;  // a short name for the entries below
  table.push_back(boolean(
      kBinary,
      {"threshold.interpolate", "Blend regions", "",
       "Thresholds change smoothly from region to region, without seams. Off: blocks, as in the paper."},
      [](auto& r) -> auto& { return r.threshold.interpolate; }));
  table.push_back(boolean(
      kBinary,
      {"threshold.smooth", "Smooth first", "",
       "Smooths scan noise before thresholding. Off: raw grey values, as in the papers.", true},
      [](auto& r) -> auto& { return r.threshold.smooth; }));
  Parameter reach = real(
      kBinary,
      {"threshold.reach", "Faint ink from", "",
       "Faint parts of thin lines count as ink from this fraction of the ink contrast on. "
       "Smaller finds fainter parts; 1 finds none; 0 is automatic."},
      {0.0, 1.0, 0.05, 2}, [](auto& r) -> auto& { return r.threshold.reach; });
  reach.minimumWord = "auto";
  table.push_back(std::move(reach));
  table.push_back(integer(
      kBinary,
      {"threshold.speck_area", "Drop specks below", "px²",
       "Ink components with a smaller area are dropped as dirt, but for dashes and dots in a row. Larger drops more; "
       "0 keeps all."},
      {0, 100000, 1, 0, true}, [](auto& r) -> auto& { return r.threshold.speckArea; }));
  table.push_back(integer(
      kBinary,
      {"threshold.hole_area", "Fill holes below", "px²",
       "Holes in the ink with a smaller area are filled. Larger fills more; 0 keeps all."},
      {0, 100000, 1, 0, true}, [](auto& r) -> auto& { return r.threshold.holeArea; }));
}

void appendFilter(std::vector<Parameter>& table) {
  constexpr StageId kFiltered = StageId::Filtered;  // a short name for the entries below
  table.push_back(integer(
      kFiltered,
      {"filter.coefficient", "Neighbourhood coefficient", "",
       "A pixel changes when more than this many of its 8 neighbours disagree. Larger keeps finer detail."},
      {0, 4, 1}, [](auto& r) -> auto& { return r.filter.coefficient; }));
  table.push_back(integer(
      kFiltered,
      {"filter.iterations", "Iterations", "",
       "Rounds of erosion and dilation. More smooths more, until nothing changes; 0 leaves the mask as it is."},
      {0, 100, 1}, [](auto& r) -> auto& { return r.filter.iterations; }));
  table.push_back(choice<FilterOrder>(
      kFiltered, {"filter.order", "Order", "", "Erosion first removes specks, dilation first closes gaps."},
      {{"erosion-first", "Erosion first", FilterOrder::ErosionFirst},
       {"dilation-first", "Dilation first", FilterOrder::DilationFirst}},
      [](auto& r) -> auto& { return r.filter.order; }));
  table.push_back(choice<FilterBorder>(
      kFiltered,
      {"filter.border", "Page border", "",
       "What is assumed outside the scan: paper, or repeated border pixels for cropped drawings.", true},
      {{"paper", "Paper", FilterBorder::Paper}, {"replicate", "Border repeated", FilterBorder::Replicate}},
      [](auto& r) -> auto& { return r.filter.border; }));
  table.push_back(integer(
      kFiltered,
      {"filter.max_change", "Largest change", "px²",
       "Connected changes with a larger area are undone, so that thin strokes, tips and narrow "
       "gaps survive. 0 = no limit, as in the paper."},
      {0, 100000, 1, 0, true}, [](auto& r) -> auto& { return r.filter.maxChangePx; }));
}

}  // namespace

std::vector<Parameter> imageParameters() {
  std::vector<Parameter> table;
  appendLog(table);
  appendPage(table);
  appendThresholds(table);
  appendBinary(table);
  appendFilter(table);
  return table;
}

}  // namespace batten::table
