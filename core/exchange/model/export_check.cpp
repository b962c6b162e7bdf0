// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/export_check.h"

#include <algorithm>
#include <cmath>

#include "core/curve/curvature.h"

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

/// Whether a curve may jump within, at a knot of multiplicity degree + 1.
bool isBroken(const NurbsCurve& curve) {
  const auto knots = curve.knots();
  const std::vector<double> breaks = curve.breaks();
  return std::any_of(breaks.begin(), breaks.end(), [&](double u) {
    const auto [first, last] = std::equal_range(knots.begin(), knots.end(), u);
    return u > curve.start() && u < curve.end() && last - first > curve.degree();
  });
}

/// Curvature and its slope grow as the curve gets smaller and its control points more: measured against the size.
constexpr double kMeets = 1e-6, kSameDirection = 1e-6, kSameCurvature = 1e-5, kSameSlope = 1e-3;

int continuityAt(const NurbsCurve& before, const NurbsCurve& behind) {
  const auto in = before.derivatives(before.end(), 1), out = behind.derivatives(behind.start(), 1);
  const double lengths = in[1].norm() * out[1].norm();
  if (!(lengths > 0.0) || !(in[1].dot(out[1]) > 0.0) || std::abs(cross(in[1], out[1])) > kSameDirection * lengths)
    return 0;
  const double size = std::max(extent(before), extent(behind));
  const auto differ = [](const std::optional<double>& a, const std::optional<double>& b, double most) {
    return !a || !b || !(std::abs(*a - *b) <= most);
  };
  if (differ(curvature(before, before.end()), curvature(behind, behind.start()), kSameCurvature / size)) return 1;
  const auto slopes = std::pair(curvatureSlope(before, before.end()), curvatureSlope(behind, behind.start()));
  return differ(slopes.first, slopes.second, kSameSlope / (size * size)) ? 2 : 3;
}

std::optional<Error> numerical(std::string message) { return Error{ErrorCode::Numerical, std::move(message), {}}; }

}  // namespace

bool doMeet(const NurbsCurve& before, const NurbsCurve& behind) {
  const double gap = (before.point(before.end()) - behind.point(behind.start())).norm();
  return gap <= kMeets * std::max(extent(before), extent(behind));
}

bool isLoop(const std::vector<ExportPiece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (isBroken(pieces[i].curve)) return false;
    if (!doMeet(pieces[i].curve, pieces[(i + 1) % pieces.size()].curve)) return false;
  }
  return !pieces.empty();
}

int continuityOf(const std::vector<ExportPiece>& pieces) {
  int least = 3;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    least = std::min(least, continuityAt(pieces[i].curve, pieces[(i + 1) % pieces.size()].curve));
  return least;
}

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
    if (curve.pieces.empty()) return numerical("The curve " + curve.id + " is empty. Exclude it from the export.");
    for (const ExportPiece& piece : curve.pieces) {
      if (piece.curve.isEmpty() || !isFinite(piece.curve) || (piece.width && !isValid(*piece.width))) {
        return numerical("The curve " + curve.id +
                         " contains a number that is not finite. Exclude it from the export.");
      }
    }
    if (curve.closed && !isLoop(curve.pieces)) {
      return numerical("The curve " + curve.id +
                       " is marked as closed, but its ends do not meet. Exclude it from the export.");
    }
  }
  return std::nullopt;
}

}  // namespace batten
