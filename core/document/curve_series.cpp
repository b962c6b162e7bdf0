// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/curve_series.h"

#include <cmath>
#include <vector>

#include "core/base/conventions.h"
#include "core/curve/arc_length.h"
#include "core/curve/bezier_powers.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

using SeriesJson = nlohmann::ordered_json;
constexpr int kSeriesSamples = 201;  // along a curve

SeriesJson finiteOrNull(double value) { return std::isfinite(value) ? SeriesJson(value) : SeriesJson(nullptr); }

SeriesJson polynomialsOf(const NurbsCurve& curve) {
  SeriesJson list = SeriesJson::array();
  const auto pieces = bezierPieces(curve);
  if (!pieces) return list;
  for (const BezierPiece& piece : *pieces) {
    SeriesJson x = SeriesJson::array(), y = SeriesJson::array();
    for (const Vec2& power : powersOfBezier(piece.controlPoints)) {
      x.push_back(finiteOrNull(power.x()));
      y.push_back(finiteOrNull(power.y()));
    }
    list.push_back({{"start", piece.start}, {"end", piece.end}, {"x", std::move(x)}, {"y", std::move(y)}});
  }
  return list;
}

SeriesJson seriesOf(const NurbsCurve& curve) {
  SeriesJson u = SeriesJson::array(), s = u, radius = u, kappa = u, slope = u, speed = u;
  const double straight = kStraightCurvature / extent(curve);
  for (const CurveSample& sample : sampleByArcLength(curve, kSeriesSamples)) {
    u.push_back(finiteOrNull(sample.u));
    s.push_back(finiteOrNull(sample.s));
    radius.push_back(std::abs(sample.kappa) > straight ? finiteOrNull(1.0 / sample.kappa) : SeriesJson(nullptr));
    kappa.push_back(finiteOrNull(sample.kappa));
    const auto at = curvatureSlope(curve, sample.u);
    slope.push_back(at ? finiteOrNull(*at) : SeriesJson(nullptr));
    speed.push_back(finiteOrNull(sample.speed));
  }
  return {{"u", std::move(u)},
          {"s_mm", std::move(s)},
          {"radius_mm", std::move(radius)},
          {"curvature_per_mm", std::move(kappa)},
          {"curvature_slope_per_mm2", std::move(slope)},
          {"derivative_mm", std::move(speed)}};
}

}  // namespace

nlohmann::ordered_json curveSeriesToJson(const NurbsCurve& curve) {
  SeriesJson json;
  if (curve.isEmpty()) return json;
  json["degree"] = curve.degree();
  json["knots"] = std::vector<double>(curve.knots().begin(), curve.knots().end());
  SeriesJson points = SeriesJson::array();
  for (const Vec2& p : curve.controlPoints()) points.push_back({p.x(), p.y()});
  json["control_points_mm"] = std::move(points);
  if (curve.isRational())
    json["weights"] = std::vector<double>(curve.weights().begin(), curve.weights().end());
  else
    json["polynomials"] = polynomialsOf(curve);
  json["series"] = seriesOf(curve);
  return json;
}

}  // namespace batten
