// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/page_frame.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/width_profile.h"

namespace batten {

/// What an export holds, independent of the format. Model frame, mm.
/// What the user said about the way a curve is to run.
struct PieceDirection {
  int mark = 0;             ///< Of those in the recipe; the later one of a line counts.
  bool isReversed = false;  ///< The other way than the curve here.
};
/// How a piece was made fair, and how far it lies from what was scanned.
struct PieceFigures {
  std::string fairing;  ///< Mode of fairing: "none", "target" …
  std::optional<int>
      target;  ///< As recipes hold it: degree 1..6 of the target, 0 recommended, 7 drawn, 8 log-aesthetic.
  double toleranceMm = 0.0, movedMm = 0.0;        ///< What fairing was allowed, and how far it moved the curve.
  double largestOffMm = 0.0, typicalOffMm = 0.0;  ///< Largest and rms distance of the scan's points from the curve.
};
struct ExportPiece {
  NurbsCurve curve;
  std::string name = {};                         ///< As the window calls it; empty: named after its line.
  std::optional<int> number = {};                ///< As the window counts it, from 1.
  std::optional<PieceDirection> direction = {};  ///< Wanted; see arrangement.h.
  /// The user said where it starts or which way it runs: no entity may stand for it that runs otherwise.
  bool keepsDirection = false;
  std::optional<PieceFigures> figures = {};
  std::optional<WidthProfile> width = {};  ///< [mm] Of the stroke that it is the middle of, along it.
};
/// All pieces of one line of the drawing, in order of travel; neighbouring pieces meet at corners, but for
/// curves that a construction breaks there.
struct ExportCurve {
  std::string id;       ///< "curve-1" …, unique.
  bool closed = false;  ///< Every piece ends where the next starts, the last one where the first does.
  std::vector<ExportPiece> pieces;
  std::optional<double> strokeWidthMm = {};  ///< [mm] > 0, usual width of the stroke that it is the middle of.
  std::string name = {};                     ///< Of the user's; empty: its id is its name.
  std::string layer = "Faired";              ///< Layer of CAD files and of SVG. Not empty.
  std::optional<Vec2> startMm = {};          ///< Where a closed one is wanted to begin; see arrangement.h.
  bool isSketched = false;                   ///< As it was found on the scan, not as it was made fair.
  bool isImported = false;                   ///< The order and direction of its file say nothing about what follows it.
};
/// All that a line has but its pieces, for parts of it: pieces are large, and a line may have thousands.
inline ExportCurve withoutPieces(ExportCurve line) {
  line.pieces = std::vector<ExportPiece>();
  return line;
}
struct ExportDocument {
  PageFrame frame;
  std::optional<double> dpi;  ///< Absent: the scale is assumed.
  std::string imageSha256;
  std::string title;                                               ///< File name of the scan.
  std::vector<std::pair<std::string, std::string>> settings = {};  ///< All settings: name and value, as in a recipe.
  std::vector<ExportCurve> curves;
};

}  // namespace batten
