// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/cad_drawing.h"

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cubic_path.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/polyline_fit.h"

namespace batten {
namespace {

constexpr double kGrid = 1e-12;    ///< [unit of the file] To which the handles of cubics are rounded.
constexpr double kMeeting = 1e-6;  ///< Of the size of a curve: gap of pieces that are joined (see doMeet).

/// Pieces to be written as one, with the name of the first.
struct Chain {
  std::vector<NurbsCurve> curves;
  std::string name, layer;
  bool closed = false;
  bool keepsDirection = false;  ///< See ExportPiece.
};

/// The parts of a curve between the knots inside it that are repeated more than `most` times.
Result<std::vector<NurbsCurve>> cutAtKnots(const NurbsCurve& curve, int most) {
  const auto whole = clamped(curve);
  if (!whole) return fail(whole.error());
  const std::vector<double> breaks = curve.breaks();
  const auto knots = curve.knots();
  std::vector<double> places;
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const auto [first, last] = std::equal_range(knots.begin(), knots.end(), breaks[i]);
    if (last - first > most) places.push_back(breaks[i]);
  }
  return splitAtAll(*whole, places);
}

/// One curve of all, of the highest degree among them.
Result<NurbsCurve> joinedCurve(const std::vector<NurbsCurve>& curves) {
  int degree = 1;
  double size = 0.0;
  for (const NurbsCurve& curve : curves) {
    degree = std::max(degree, curve.degree());
    size = std::max(size, extent(curve));
  }
  std::vector<NurbsCurve> raised;
  for (const NurbsCurve& curve : curves) {
    auto same = elevated(curve, degree);
    if (same) same = reparametrized(*same, 0.0, ArcLength(*same).total());
    if (!same) return same;
    raised.push_back(std::move(*same));
  }
  return joinAtCorners(raised, 2.0 * kMeeting * size);
}

/// All cubics of a run as one curve, by the length of its polygon.
Result<NurbsCurve> cubicCurve(const CubicRun& run) {
  std::vector<double> knots(4, 0.0);
  std::vector<Vec2> points = {run.start};
  double at = 0.0;
  for (const auto& cubic : run.cubics) {
    const Vec2 from = points.back();
    at += std::max((cubic[0] - from).norm() + (cubic[1] - cubic[0]).norm() + (cubic[2] - cubic[1]).norm(), kGrid);
    points.insert(points.end(), cubic.begin(), cubic.end());
    knots.insert(knots.end(), 3, at);
  }
  knots.push_back(at);
  return NurbsCurve::make(3, std::move(knots), std::move(points));
}

double distanceFrom(const CadShape& shape, const NurbsCurve& curve) {
  double most = 0.0;
  for (const CurveSample& sample : sampleByArcLength(curve, 65)) {
    if (const auto* line = std::get_if<CadLine>(&shape)) {
      const Vec2 along = line->to - line->from;
      most = std::max(most, std::abs(cross(along, sample.point - line->from)) / along.norm());
    } else if (const auto* arc = std::get_if<CadArc>(&shape)) {
      most = std::max(most, std::abs((sample.point - arc->centre).norm() - arc->radius));
    }
  }
  return most;
}

/// Whether a simple shape starts where the curve does and runs its way. Arcs run counter-clockwise and circles begin at
/// the right, whatever the curve does.
bool runsAs(const CadShape& shape, const NurbsCurve& curve) {
  const double near = kMeeting * extent(curve);
  const auto at = [&](double fraction) {
    return (pointAt(shape, fraction) - curve.point(curve.start() + fraction * (curve.end() - curve.start()))).norm();
  };
  if (const auto* arc = std::get_if<CadArc>(&shape); arc != nullptr && isCircle(*arc)) {
    const Vec2 right = arc->centre + Vec2(arc->radius, 0.0);
    const Vec2 radius = curve.point(curve.start()) - arc->centre;
    return (curve.point(curve.start()) - right).norm() <= near &&
           cross(radius, curve.derivatives(curve.start(), 1)[1]) > 0.0;
  }
  return at(0.0) <= near && at(1.0) <= near;
}

class Builder {
 public:
  Builder(const ExportSettings& settings, CadExport& result)
      : settings_(settings),
        mmPerUnit_(millimetresPer(settings.unit)),
        tolerance_(settings.toleranceMm.value_or(defaultTolerance(settings)) / mmPerUnit_),
        result_(result) {}

  Result<void> add(const Chain& chain) {
    if (settings_.format == ExportFormat::Dxf && settings_.dxf == DxfProfile::Cnc) {
      PolylineFit fit = polylineWithin(chain.curves, chain.closed, tolerance_, settings_.arcs);
      note(fit.largestError, 0.0);
      push(chain, std::move(fit.line));
      return {};
    }
    const bool isCubic = settings_.format == ExportFormat::Dxf ? settings_.dxf == DxfProfile::Laser
                                                               : settings_.flavour == CurveFlavour::Cubic;
    if (chain.curves.size() == 1) return isCubic ? addCubic(chain, chain.curves[0]) : addExact(chain, chain.curves[0]);
    auto whole = joinedCurve(chain.curves);
    if (!whole) return fail(whole.error());
    return isCubic ? addCubic(chain, *whole) : addExact(chain, *whole);
  }

 private:
  void note(double error, double jump) {
    result_.largestErrorMm = std::max(result_.largestErrorMm, error * mmPerUnit_);
    result_.largestJump = std::max(result_.largestJump, jump);
  }
  void push(const Chain& chain, CadShape shape) {
    result_.drawing.entities.push_back({chain.name, chain.layer, std::move(shape)});
  }

  bool addSimple(const Chain& chain, const NurbsCurve& curve) {
    if (settings_.splinesOnly) return false;
    const auto shape = simpleShape(curve);
    if (!shape || (chain.keepsDirection && !runsAs(*shape, curve))) return false;
    note(distanceFrom(*shape, curve), 0.0);
    push(chain, *shape);
    return true;
  }

  Result<void> addExact(const Chain& chain, const NurbsCurve& curve) {
    if (addSimple(chain, curve)) return {};
    const int most = settings_.flavour == CurveFlavour::BezierSegments && settings_.format != ExportFormat::Dxf ? 0
                     : settings_.simpleKnots && settings_.format == ExportFormat::Dxf                           ? 1
                                                                                      : curve.degree();
    auto parts = cutAtKnots(curve, most);
    if (!parts) return fail(parts.error());
    for (const NurbsCurve& part : *parts) {
      if (parts->size() > 1 && addSimple(chain, part)) continue;
      auto byLength = reparametrized(part, 0.0, ArcLength(part).total());
      if (!byLength) return fail(byLength.error());
      push(chain, std::move(*byLength));
    }
    return {};
  }

  Result<void> addCubic(const Chain& chain, const NurbsCurve& curve) {
    if (addSimple(chain, curve)) return {};
    auto path = cubicPath(curve, {tolerance_, kGrid});
    if (!path) return fail(path.error());
    note(path->largestError, path->largestJump);
    for (const CubicRun& run : path->runs) {
      if (settings_.format != ExportFormat::Dxf) {
        auto whole = cubicCurve(run);
        if (!whole) return fail(whole.error());
        push(chain, std::move(*whole));
        continue;
      }
      CubicRun one{run.start, {}};
      for (const auto& cubic : run.cubics) {
        one.cubics = {cubic};
        auto single = cubicCurve(one);
        if (!single) return fail(single.error());
        push(chain, std::move(*single));
        one.start = cubic[2];
      }
    }
    return {};
  }

  const ExportSettings& settings_;
  double mmPerUnit_, tolerance_;
  CadExport& result_;
};

/// The pieces of a line as they are to be written: alone, or joined wherever one goes on where the last one ends.
std::vector<Chain> chainsOf(const ExportCurve& line, const ExportSettings& settings) {
  const double size = settings.scale / millimetresPer(settings.unit);
  const Eigen::Matrix2d linear = size * Eigen::Matrix2d::Identity();
  const bool joined = isJoined(settings);
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < line.pieces.size(); ++i) {
    NurbsCurve curve = line.pieces[i].curve.mapped(linear, Vec2::Zero());
    const bool continues = joined && !chains.empty() && doMeet(chains.back().curves.back(), curve);
    if (!continues) {
      const bool alone = joined || line.pieces.size() == 1;
      const std::string name = alone && !line.name.empty() ? line.name : entityName(line, i);
      chains.push_back({{}, name, line.layer, false});
    }
    chains.back().keepsDirection = chains.back().keepsDirection || line.pieces[i].keepsDirection;
    chains.back().curves.push_back(std::move(curve));
  }
  for (Chain& chain : chains) chain.closed = doMeet(chain.curves.back(), chain.curves.front());
  return chains;
}

}  // namespace

Result<CadExport> cadExport(const ExportDocument& document, const ExportSettings& settings, const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  CadExport result;
  result.drawing.mmPerUnit = millimetresPer(settings.unit);
  Builder builder(settings, result);
  std::size_t done = 0;
  for (const ExportCurve& line : document.curves) {
    for (const Chain& chain : chainsOf(line, settings)) {
      if (context.isCancelled()) return cancelled();
      if (auto added = builder.add(chain); !added) return fail(added.error());
    }
    context.report(static_cast<double>(++done) / static_cast<double>(document.curves.size()));
  }
  return result;
}

ExportDocument scaled(const ExportDocument& document, double scale) {
  ExportDocument result = document;
  result.frame.mmPerPx *= scale;
  result.frame.leftMm *= scale;
  result.frame.bottomMm *= scale;
  if (result.dpi) *result.dpi /= scale;
  const Eigen::Matrix2d linear = scale * Eigen::Matrix2d::Identity();
  for (ExportCurve& curve : result.curves) {
    if (curve.strokeWidthMm) *curve.strokeWidthMm *= scale;
    for (ExportPiece& piece : curve.pieces) {
      piece.curve = piece.curve.mapped(linear, Vec2::Zero());
      if (piece.width) piece.width = scaled(*piece.width, scale);
      if (!piece.figures) continue;
      PieceFigures& figures = *piece.figures;
      for (double* length : {&figures.toleranceMm, &figures.movedMm, &figures.largestOffMm, &figures.typicalOffMm})
        *length *= scale;
    }
  }
  return result;
}

std::string entityName(const ExportCurve& curve, std::size_t piece) {
  if (!curve.pieces[piece].name.empty()) return curve.pieces[piece].name;
  const std::string& whole = curve.name.empty() ? curve.id : curve.name;
  return curve.pieces.size() == 1 ? whole : whole + "." + std::to_string(piece + 1);
}

}  // namespace batten
