// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameters_contours.h"

#include "core/pipeline/recipe/parameter_builders.h"

namespace batten::table {
namespace {

// Once it was a switch: files and commands may still say true and false.
Parameter innerBordersParameter() {
  Parameter inner = choice<InnerBorders>(
      StageId::Contours,
      {"edges.internal", "Inner outlines", "",
       "Whether borders of holes in the ink are traced. Automatic: those of shapes such as "
       "letters, but not where trace mode is Outline."},
      {{"auto", "Automatic", InnerBorders::Automatic},
       {"on", "Always", InnerBorders::On},
       {"off", "Never", InnerBorders::Off}},
      [](auto& r) -> auto& { return r.edges.internal; });
  inner.set = [byWord = inner.set](Recipe& r, std::string_view text) -> Result<void> {
    const std::string_view word = trimmed(text);
    if (word == "true" || word == "yes" || word == "1") return byWord(r, "on");
    if (word == "false" || word == "no" || word == "0") return byWord(r, "off");
    return byWord(r, text);
  };
  return inner;
}

void appendTracing(std::vector<Parameter>& table) {
  constexpr StageId kContours = StageId::Contours;  // a short name for the entries below
  table.push_back(choice<EdgeMode>(
      kContours,
      {"edges.mode", "Trace", "",
       "What is traced: the middle of strokes, the outline of shapes, or whichever suits each piece of ink."},
      {{"auto", "Automatic", EdgeMode::Automatic},
       {"outline", "Outline", EdgeMode::Outline},
       {"centreline", "Centre line", EdgeMode::Centreline}},
      [](auto& r) -> auto& { return r.edges.mode; }));
  table.push_back(innerBordersParameter());
  table.push_back(boolean(
      kContours,
      {"edges.subpixel", "Sub-pixel accuracy", "",
       "Locates the line on the grey values of the scan to a fraction of a pixel. Off: pixel "
       "borders only."},
      [](auto& r) -> auto& { return r.edges.subpixel; }));
  table.push_back(real(
      kContours,
      {"edges.stroke_width", "Stroke limit", "", "No effect; kept so that older recipes remain valid.", true},
      {0.005, 0.1, 0.001, 3, true}, [](auto& r) -> auto& { return r.edges.strokeWidth; }));
}

void appendStrokes(std::vector<Parameter>& table) {
  constexpr StageId kContours = StageId::Contours;  // a short name for the entries below
  table.push_back(real(
      kContours,
      {"edges.gap", "Bridge gaps", "stroke widths",
       "Longest gap between two stroke ends that is bridged; long lines are led on over less of it to a line or corner "
       "they stop short of. Larger joins more; 0 bridges none."},
      {0.0, 20.0, 0.5, 1}, [](auto& r) -> auto& { return r.edges.gapFactor; }));
  table.push_back(real(
      kContours,
      {"edges.merge", "Merge strokes", "stroke widths",
       "Strokes of one intended line that run closer than this become one line. Larger merges more; 0 is off."},
      {0.0, 20.0, 0.5, 1}, [](auto& r) -> auto& { return r.edges.mergeWidths; }));
  table.push_back(boolean(
      kContours,
      {"edges.intent", "Curves that were meant", "",
       "Lines drawn over more than once become the curves that were meant, strokes near and far apart alike. Pages "
       "without such lines stay as they are."},
      [](auto& r) -> auto& { return r.edges.intent; }));
  table.push_back(real(
      kContours,
      {"edges.spur", "Drop side branches", "stroke widths",
       "Side branches of a stroke shorter than this are dropped, unless they stand out of its ink as broad as it is. "
       "Larger drops more.",
       true},
      {0.0, 5.0, 0.1, 1}, [](auto& r) -> auto& { return r.edges.spurFactor; }));
  table.push_back(real(
      kContours,
      {"edges.bend", "Continue through crossings", "°",
       "A stroke that bends by less than this continues through a crossing. Larger joins more.", true},
      {0.0, 90.0, 1.0, 0}, [](auto& r) -> auto& { return r.edges.maxBendDeg; }));
}

void appendLinesKept(std::vector<Parameter>& table) {
  constexpr StageId kContours = StageId::Contours;  // a short name for the entries below
  table.push_back(real(
      kContours,
      {"contours.min_widths", "Shortest line", "stroke widths",
       "Lines shorter than this many widths of their stroke are left out. Larger keeps fewer lines."},
      {0.0, 100.0, 0.5, 1}, [](auto& r) -> auto& { return r.contours.minWidths; }));
  table.push_back(real(
      kContours,
      {"contours.min_length", "Shortest line in pixels", "px",
       "Lines shorter than this are also dropped, whatever their width. Larger keeps fewer "
       "lines; 0 uses the stroke widths only."},
      {0.0, 100000.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.contours.minLengthPx; }));
  Parameter most = integer(
      kContours,
      {"contours.max_count", "Maximum lines", "",
       "Keeps at most this many lines, the longest first; all (0) keeps every line, up to 20000.", true},
      {0, 100000, 1}, [](auto& r) -> auto& { return r.contours.maxCount; });
  most.minimumWord = "all";
  table.push_back(std::move(most));
}

void appendCornersAndSegments(std::vector<Parameter>& table) {
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.auto", "Certain corners", "",
       "Uses corners that are certain even if unmarked. Off: only marked corners."},
      [](auto& r) -> auto& { return r.corners.automatic; }));
  table.push_back(real(
      StageId::Pieces,
      {"corners.snap", "Corner reach", "px",
       "Largest distance of a corner mark from its line. Larger reaches farther."},
      {1.0, 200.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.corners.snapDistancePx; }));
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.exact", "Exact corners", "",
       "Places the corner where its two sides meet when extended. Off: at the nearest point of "
       "the line."},
      [](auto& r) -> auto& { return r.corners.exact; }));
  constexpr StageId kSegments = StageId::Segments;  // a short name for the entries below
  table.push_back(choice<SegmentMode>(
      kSegments,
      {"segments.mode", "Segments", "",
       "How a line is divided: stations at equal distance, Sturges' rule, a fixed count, or by accuracy."},
      {{"stations", "Equal stations", SegmentMode::Stations},
       {"sturges", "Sturges (paper)", SegmentMode::Sturges},
       {"count", "Fixed count", SegmentMode::Count},
       {"adaptive", "Adaptive", SegmentMode::Adaptive}},
      [](auto& r) -> auto& { return r.segments.mode; }));
  Parameter count = integer(
      kSegments,
      {"segments.count", "Number of segments", "",
       "Segments per line; auto (0) derives the number from the length, otherwise at least 2, and "
       "one for every two points of the line at most. More segments follow the line more closely."},
      {0, 2000, 1}, [](auto& r) -> auto& { return r.segments.count; });
  count.set = [inRange = count.set, name = count.name](Recipe& r, std::string_view text) -> Result<void> {
    const auto value = integerFromText(text);
    if (value && *value == 1) return refuse(name, text, "it must be 0 (from the length) or 2 to 2000");
    return inRange(r, text);
  };
  count.minimumWord = "auto";
  count.leastAbove = 2.0;
  table.push_back(std::move(count));
  table.push_back(real(
      kSegments,
      {"segments.spacing", "Spacing", "px",
       "Distance of the stations along the line. Larger: fewer control points and a smoother curve."},
      {8.0, 400.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.segments.spacingPx; }));
  table.push_back(real(
      kSegments,
      {"segments.tolerance", "Segment accuracy", "px",
       "Adaptive: largest distance of the line from its segments. Larger: fewer segments."},
      {0.02, 5.0, 0.01, 2, true}, [](auto& r) -> auto& { return r.segments.tolerancePx; }));
}

}  // namespace

std::vector<Parameter> contourParameters() {
  std::vector<Parameter> table;
  appendTracing(table);
  appendStrokes(table);
  appendLinesKept(table);
  appendCornersAndSegments(table);
  return table;
}

}  // namespace batten::table
