// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/export_check.h"

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

bool isFinite(const NurbsCurve& curve) {
  const auto points = curve.controlPoints();
  const auto knots = curve.knots();
  const auto weights = curve.weights();
  const auto finite = [](double v) { return std::isfinite(v); };
  return std::all_of(points.begin(), points.end(), [](const Vec2& p) { return p.allFinite(); }) &&
         std::all_of(knots.begin(), knots.end(), finite) && std::all_of(weights.begin(), weights.end(), finite);
}

std::optional<Error> numerical(std::string message) { return Error{ErrorCode::Numerical, std::move(message), {}}; }

}  // namespace

std::optional<Error> exportProblem(const ExportDocument& document) {
  const PageFrame& frame = document.frame;
  if (document.curves.empty()) {
    return Error{ErrorCode::NoCurve, "There is no curve to export. Include at least one curve.", {}};
  }
  if (frame.widthPx <= 0 || frame.heightPx <= 0 || !std::isfinite(frame.mmPerPx) || frame.mmPerPx <= 0.0) {
    return numerical("The page has no size, so nothing can be exported. Set the resolution.");
  }
  if (document.dpi && !(std::isfinite(*document.dpi) && *document.dpi > 0.0)) {
    return numerical("The resolution is not a positive number. Set it again.");
  }
  for (const ExportCurve& curve : document.curves) {
    if (curve.pieces.empty()) return numerical("The curve " + curve.id + " is empty. Leave it out of the export.");
    for (const ExportPiece& piece : curve.pieces) {
      if (piece.curve.isEmpty() || !isFinite(piece.curve)) {
        return numerical("The curve " + curve.id + " holds a number that is not finite. Leave it out of the export.");
      }
    }
  }
  return std::nullopt;
}

}  // namespace batten
