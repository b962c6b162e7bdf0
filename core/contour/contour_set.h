// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/edge_choices.h"

namespace batten {

enum class ContourKind {
  Outline,     ///< The border between ink and paper, ink on the right of travel on the screen for outer borders.
  Centreline,  ///< The middle of a pen or pencil stroke.
  Pen,         ///< Drawn in the program (pen_strokes.h), not found on the scan.
};

/// How far the strokes that were merged into a line lie beside its points, at most within a few points of each.
/// [px, never negative]
struct StrokeBand {
  std::vector<float> left;   ///< To the side of leftNormal(direction of travel).
  std::vector<float> right;  ///< To the other side. Same size.
  bool isEmpty() const { return left.empty(); }
};

/// One line of the drawing, ordered, about one point a pixel. Image frame, px.
struct Contour {
  ContourKind kind = ContourKind::Outline;
  bool closed = false;       ///< The last point is followed by the first; the first is not repeated at the end.
  bool hole = false;         ///< An inner border (outline mode with internal contours on).
  std::vector<Vec2> points;  ///< [px] sub-pixel positions where refined, else crack or skeleton positions.
  std::vector<Vec2> chain;   ///< [px] unrefined positions, same size as `points`.
  std::vector<std::uint8_t>
      refined;  ///< 1 = placed on the raw grey values; 0 = fell back. Pen: 1 = drawn, 0 = between. Same size.
  /// [px] > 0. Standard deviations of the points across the line, as the grey values around them tell; same size, or
  /// empty: not measured (pen, pencil, merged strokes).
  std::vector<float> sigmaPx;
  double blurPx = 0.0;         ///< [px] standard deviation of the light's blur along an outline; 0: not measured.
  std::vector<float> widthPx;  ///< [px] stroke width (centre lines); empty for outlines.
  StrokeBand band;             ///< The strokes that were merged into this line; empty where nothing was merged.
  std::vector<std::pair<int, int>> bridges;  ///< Index ranges [first, last] that bridge a gap in the ink.
  std::optional<EdgeChoice> traceMode;       ///< The user's choice about its ink that it follows.
  double lengthPx = 0.0;                     ///< [px] length of the polyline through `points`.
  double areaPx = 0.0;                       ///< [px^2] absolute enclosed area (closed), else 0.
};

/// Where the ink lies that a point of a line was made of: the point itself, and of merged strokes the outermost ones.
/// [px, unrefined]
std::vector<Vec2> inkBeside(const Contour&, std::size_t point);
/// A place on or near the ink of a line, about in its middle; not over a gap. [px] @pre the chain is not empty.
Vec2 placeOnInk(const Contour&);

struct ContourReport {
  int found = 0;            ///< Before any was dropped.
  int droppedShort = 0;     ///< Shorter than the smallest length.
  int droppedHoles = 0;     ///< Inner borders, in outline mode without them.
  int droppedMargins = 0;   ///< Lines along the border of the page: the margin of the scanner.
  double refinedShare = 0;  ///< Part of the points that were placed on the grey values, 0..1.
  double widthPx = 0.0;     ///< [px] What EdgeParams::mergeWidths counts in; 0: no strokes.
  std::string note;
};

/// All lines of the page, longest first (ties: topmost, then leftmost start), so "curve 1" is the longest.
struct ContourSet {
  std::vector<Contour> contours;
  ContourReport report;
};

/// Gaps in the ink that the lines bridge.
int bridgeCount(const ContourSet&);

}  // namespace batten
