// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/edge_choices.h"

namespace batten {

enum class ContourKind {
  Outline,     ///< The border between ink and paper, ink on the right of travel on the screen for outer borders.
  Centreline,  ///< The middle of a pen or pencil stroke.
  Pen,         ///< Drawn in the program (pen_strokes.h), not found on the scan.
  Imported,    ///< Made by another program (core/curve/imported_line.h).
};

/// Whether the points of such a line are exact, not measured on a scan.
constexpr bool isDrawn(ContourKind kind) { return kind == ContourKind::Pen || kind == ContourKind::Imported; }

/// Distance from a point of a merged line to the outermost strokes that were merged there. [px] >= 0
struct BundleWidths {
  float left = 0.0f;   ///< To the side of leftNormal(direction of travel).
  float right = 0.0f;  ///< To the other side.
  bool operator==(const BundleWidths&) const = default;
};

/// A point of a line. A value that was not measured is absent; along one line it is present at every point or at none.
struct ContourPoint {
  Vec2 at = Vec2::Zero();         ///< [px] sub-pixel position where refined, else that of the crack or the skeleton.
  Vec2 unrefined = Vec2::Zero();  ///< [px] of the crack or the skeleton.
  bool refined = false;           ///< Placed on the raw grey values. Pen: drawn, not laid between drawn points.
  /// [px] > 0. Standard deviation of the point across the line, estimated from the grey values around it. Absent for
  /// pen, pencil and merged strokes.
  std::optional<float> sigmaPx = {};
  std::optional<float> widthPx = {};  ///< [px] stroke width (centre lines); absent on outlines.
  /// How far the strokes lie off that were merged into the line; absent where nothing was merged.
  std::optional<BundleWidths> bundle = {};
  bool operator==(const ContourPoint& p) const {
    return at == p.at && unrefined == p.unrefined && refined == p.refined && sigmaPx == p.sigmaPx &&
           widthPx == p.widthPx && bundle == p.bundle;
  }
};

/// One line of the drawing, ordered, about one point a pixel. Image frame, px.
struct Contour {
  ContourKind kind = ContourKind::Outline;
  bool closed = false;  ///< The last point is followed by the first; the first is not repeated at the end.
  bool hole = false;    ///< An inner border (outline mode with internal contours on).
  std::vector<ContourPoint> points;
  std::optional<double> blurPx;    ///< [px] standard deviation of the optical blur along an outline, where measured.
  std::optional<double> pencilPx;  ///< [px] width of the pencil that filled what an outline encloses; absent: no grain.
  bool isUneven = false;           ///< An outline of uneven ink (uneven_ink.h).
  /// Whether the start, the end of a centre line lies in the ink of another line or of a shape: it is no free end.
  std::array<bool, 2> endsInInk = {false, false};
  std::vector<std::pair<int, int>> bridges;  ///< Index ranges [first, last] that bridge a gap in the ink.
  std::optional<EdgeChoice> traceMode;       ///< The user's choice for its ink, if there is one.
  std::vector<int> joints;                   ///< Imported: points that are corners whatever the user marks, ascending.
  std::optional<int> imported;               ///< Imported: which line of the recipe's, counted through all its files.
  double lengthPx = 0.0;                     ///< [px] length of the polyline through `points`.
  double areaPx = 0.0;                       ///< [px^2] absolute enclosed area (closed), else 0.
};

/// Points whose refined and unrefined positions are the same.
std::vector<ContourPoint> contourPoints(std::span<const Vec2> positionsPx, bool refined);
/// Copies of the positions, for the functions of core/polyline. [px]
std::vector<Vec2> positionsOf(std::span<const ContourPoint>);
std::vector<Vec2> unrefinedPositionsOf(std::span<const ContourPoint>);
/// [px] The stroke widths that are known; none on outlines.
std::vector<float> strokeWidthsOf(std::span<const ContourPoint>);
/// Whether any is known.
bool hasStrokeWidths(std::span<const ContourPoint>);
/// Sets length and area from the positions of the points.
void measureContour(Contour&);

/// Places of the ink that a point of a line stands for: the point itself and, on a merged line, the outermost strokes
/// beside it. [px, unrefined]
std::vector<Vec2> inkBeside(const Contour&, int point);
/// A place on the ink of a line, near the middle of the line and not on a bridge. [px] @pre the line has a point.
Vec2 placeOnInk(const Contour&);

/// Pairs of indices, the lower one first, in ascending order; no index twice.
using EndPairs = std::vector<std::pair<int, int>>;

/// A place where three or more branches of strokes meet.
struct StrokeJunction {
  Vec2 positionPx = Vec2::Zero();  ///< [px] Middle of the place.
  double radiusPx = 0.0;           ///< Of the ink of all its strokes.
  std::vector<Vec2> branchesPx;    ///< A place on every branch, where it has a middle of its own.
  EndPairs pairs;                  ///< Branches that are one stroke; a branch in no pair ends here.
  std::vector<EndPairs> pairings;  ///< The rule's own first, then the next best; the last pairs none.
  bool isDoubtful =
      false;  ///< The next best pairing is hardly worse, or two strokes may share a stretch that ends here.
  std::optional<int> choice;  ///< Index of the user's choice that it follows.
};

struct ContourReport {
  int found = 0;                  ///< Before any was dropped.
  int droppedShort = 0;           ///< Shorter than the smallest length.
  int droppedHoles = 0;           ///< Inner borders, in outline mode without them.
  double droppedHolesPx = 0.0;    ///< [px^2] Area of inner borders that were dropped as short.
  int droppedMargins = 0;         ///< Lines along the border of the page: margins of the scanner, edges of a sheet.
  int droppedFaint = 0;           ///< Specks much fainter than the strokes around.
  int droppedGrain = 0;           ///< Short lines that are the grain of a tone.
  double refinedShare = 0;        ///< Part of the points that were placed on the grey values, 0..1.
  std::optional<double> widthPx;  ///< [px] Stroke width, the unit of EdgeParams::mergeWidths; absent: no strokes.
  bool isGrouped = false;         ///< The lines are intended curves of lines drawn over more than once.
  std::string note;
};

/// All lines of the page, longest first (ties: topmost, then leftmost start), so "curve 1" is the longest.
struct ContourSet {
  std::vector<Contour> contours;
  std::vector<StrokeJunction> junctions;  ///< Of the strokes; none where lines were made of several.
  std::vector<Contour> sheetEdges;        ///< Lines that are the edge of a sheet in the picture: left out.
  ContourReport report;
};

/// Number of gaps in the ink that the lines bridge.
int bridgeCount(const ContourSet&);
/// Number of junctions whose strokes the rule pairs with doubt and the user has not paired.
int doubtfulCount(const ContourSet&);

}  // namespace batten
