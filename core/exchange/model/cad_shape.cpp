// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/cad_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/read_back.h"

namespace batten {
namespace {

constexpr int kCompared = 200;  ///< Places at which two shapes are compared.
/// Of the size of a curve: farther off it is no line or arc. Circles found in a scan are splines exact to 1e-8.
constexpr double kExact = 2e-8;
constexpr double kFlattest = 1e4;  ///< [sizes of the curve] Arcs of larger radius have no certain centre.

/// Places of each polynomial piece, more than a conic's equation along it has roots.
std::vector<Vec2> placesAlong(const NurbsCurve& curve) {
  std::vector<Vec2> places = {curve.point(curve.start())};
  const std::vector<double> breaks = curve.breaks();
  const int count = 2 * curve.degree() + 2;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    for (int k = 1; k <= count; ++k)
      places.push_back(curve.point(breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / count));
  }
  return places;
}

std::optional<CadShape> lineOf(const NurbsCurve& curve, double size) {
  const auto points = curve.controlPoints();
  const Vec2 from = curve.point(curve.start()), to = curve.point(curve.end());
  const double length = (to - from).norm();
  if (!(length > 0.5 * size)) return std::nullopt;
  const Vec2 along = (to - from) / length;
  double before = -kExact * size;
  for (const Vec2& p : points) {
    const double at = along.dot(p - from);
    if (std::abs(cross(along, p - from)) > kExact * size || at < before) return std::nullopt;
    before = at - kExact * size;
  }
  return CadLine{from, to};
}

std::optional<Vec2> centreThrough(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double twice = 2.0 * cross(u, v);
  if (twice == 0.0) return std::nullopt;
  const Vec2 w = (u.squaredNorm() * v - v.squaredNorm() * u) / twice;
  return a + Vec2(w.y(), -w.x());
}

std::optional<CadShape> arcOf(const NurbsCurve& curve, double size) {
  const std::vector<Vec2> places = placesAlong(curve);
  const std::size_t n = places.size() - 1;
  const auto centre = centreThrough(places[0], places[n / 3], places[2 * n / 3]);
  if (!centre) return std::nullopt;
  const double radius = (places[0] - *centre).norm();
  if (!(radius < kFlattest * size)) return std::nullopt;
  double turned = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2 out = places[i] - *centre;
    if (std::abs(out.norm() - radius) > kExact * size) return std::nullopt;
    if (i == 0) continue;
    const Vec2 before = places[i - 1] - *centre;
    const double step = std::atan2(cross(before, out), before.dot(out));
    if (step * turned < 0.0 || step == 0.0) return std::nullopt;
    turned += step;
  }
  const bool whole = (places.back() - places.front()).norm() <= kExact * size;
  if (std::abs(turned) > kFullTurnRad * (1.0 + kExact)) return std::nullopt;
  const Vec2 first = (turned > 0.0 ? places.front() : places.back()) - *centre;
  return CadArc{*centre, radius, std::atan2(first.y(), first.x()), whole ? kFullTurnRad : std::abs(turned)};
}

/// The edge of a polyline that begins at vertex i: a line, or an arc and whether it is run through backwards.
struct Edge {
  CadShape shape;
  bool backwards = false;
};
Edge edgeOf(const CadPolyline& line, std::size_t i) {
  const CadVertex &from = line.vertices[i], &to = line.vertices[(i + 1) % line.vertices.size()];
  const Vec2 chord = to.point - from.point;
  if (from.bulge == 0.0 || chord.norm() == 0.0) return {CadLine{from.point, to.point}};
  const double b = from.bulge;
  const Vec2 left(-chord.y(), chord.x());
  const Vec2 centre = from.point + 0.5 * chord + (1.0 - b * b) / (4.0 * b) * left;
  const Vec2 first = (b > 0.0 ? from.point : to.point) - centre;
  return {CadArc{centre, first.norm(), std::atan2(first.y(), first.x()), 4.0 * std::atan(std::abs(b))}, b < 0.0};
}

Vec2 pointOf(const CadPolyline& line, double fraction) {
  const int n = static_cast<int>(line.vertices.size()), edges = line.closed ? n : n - 1;
  if (edges == 0) return line.vertices.front().point;
  const double at = std::clamp(fraction, 0.0, 1.0) * edges;
  const int i = std::min(static_cast<int>(at), edges - 1);
  const double t = at - i;
  const Edge edge = edgeOf(line, i);
  return pointAt(edge.shape, edge.backwards ? 1.0 - t : t);
}

/// Quadratics of at most a quarter turn each; weights cos of half their angle.
Result<NurbsCurve> arcCurve(const CadArc& arc) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(arc.sweepRad / (0.5 * std::numbers::pi) - 1e-9)));
  const double step = arc.sweepRad / pieces, half = std::cos(0.5 * step), length = step * arc.radius;
  std::vector<double> knots(3, 0.0), weights = {1.0};
  std::vector<Vec2> points = {onCircle(arc.centre, arc.radius, arc.startRad)};
  for (int i = 0; i < pieces; ++i) {
    const double at = arc.startRad + i * step;
    points.push_back(onCircle(arc.centre, arc.radius / half, at + 0.5 * step));
    points.push_back(onCircle(arc.centre, arc.radius, at + step));
    weights.insert(weights.end(), {half, 1.0});
    knots.insert(knots.end(), 2, (i + 1) * length);
  }
  knots.push_back(pieces * length);
  if (isCircle(arc)) points.back() = points.front();
  return NurbsCurve::make(2, std::move(knots), std::move(points), std::move(weights));
}

Result<NurbsCurve> lineCurve(const Vec2& from, const Vec2& to) {
  const double length = (to - from).norm();
  return NurbsCurve::make(1, {0.0, 0.0, length, length}, {from, to});
}

Result<NurbsCurve> polylineCurve(const CadPolyline& line) {
  auto edges = edgesOf(line);
  if (!edges) return fail(edges.error());
  if (edges->empty()) return fail(ErrorCode::BadParameter, "A polyline has no length.");
  const bool arcs = std::any_of(edges->begin(), edges->end(), [](const NurbsCurve& edge) { return edge.degree() > 1; });
  for (NurbsCurve& edge : *edges) {
    auto raised = elevated(edge, arcs ? 2 : 1);
    if (!raised) return raised;
    edge = std::move(*raised);
  }
  double size = 0.0;
  for (const NurbsCurve& edge : *edges) size = std::max(size, extent(edge));
  return joinAtCorners(*edges, 1e-6 * size);
}

double arcDifference(const CadArc& a, const CadArc& b) {
  if (isCircle(a) && isCircle(b)) return (a.centre - b.centre).norm() + std::abs(a.radius - b.radius);
  double most = 0.0;
  for (int i = 0; i <= kCompared; ++i) {
    const double t = static_cast<double>(i) / kCompared;
    most = std::max(most, (pointAt(a, t) - pointAt(b, t)).norm());
  }
  return most;
}

}  // namespace

Vec2 pointAt(const CadShape& shape, double fraction) {
  if (const auto* line = std::get_if<CadLine>(&shape)) return line->from + fraction * (line->to - line->from);
  if (const auto* arc = std::get_if<CadArc>(&shape)) return pointAt(*arc, fraction);
  if (const auto* line = std::get_if<CadPolyline>(&shape)) return pointOf(*line, fraction);
  const auto& curve = std::get<NurbsCurve>(shape);
  return curve.point(fraction == 1.0 ? curve.end() : curve.start() + fraction * (curve.end() - curve.start()));
}

std::optional<CadShape> simpleShape(const NurbsCurve& curve) {
  const double size = extent(curve);
  if (!(size > 0.0)) return std::nullopt;
  if (auto line = lineOf(curve, size)) return line;
  return arcOf(curve, size);
}

Result<std::vector<NurbsCurve>> edgesOf(const CadPolyline& line) {
  std::vector<NurbsCurve> edges;
  const std::size_t n = line.vertices.size();
  for (std::size_t i = 0; i + 1 < n + (line.closed ? 1 : 0); ++i) {
    const Edge edge = edgeOf(line, i);
    if ((pointAt(edge.shape, 0.0) - pointAt(edge.shape, 1.0)).norm() == 0.0) continue;  // a vertex twice
    auto curve = curveOf(edge.shape);
    if (!curve) return fail(curve.error());
    edges.push_back(edge.backwards ? reversed(*curve) : std::move(*curve));
  }
  return edges;
}

Result<NurbsCurve> curveOf(const CadShape& shape) {
  if (const auto* line = std::get_if<CadLine>(&shape)) return lineCurve(line->from, line->to);
  if (const auto* arc = std::get_if<CadArc>(&shape)) return arcCurve(*arc);
  if (const auto* line = std::get_if<CadPolyline>(&shape)) return polylineCurve(*line);
  return std::get<NurbsCurve>(shape);
}

std::optional<NurbsCurve> partBetween(const NurbsCurve& whole, double from, double to, double same) {
  const double start = whole.start(), end = whole.end(), least = same * (end - start);
  const auto isInside = [&](double u) { return u > start + least && u < end - least; };
  NurbsCurve part = whole;
  if (!(to > from + least)) return part;
  if (isInside(to)) {
    auto halves = split(part, to);
    if (!halves) return std::nullopt;
    part = std::move(halves->left);
  }
  if (isInside(from)) {
    auto halves = split(part, from);
    if (!halves) return std::nullopt;
    part = std::move(halves->right);
  }
  return part;
}

Result<double> largestDifference(const CadDrawing& written, const CadDrawing& readBack) {
  if (written.entities.size() != readBack.entities.size() || readBack.left > 0)
    return readsBackOtherwise(std::to_string(readBack.entities.size()) + " entities for " +
                              std::to_string(written.entities.size()));
  if (written.mmPerUnit != readBack.mmPerUnit) return readsBackOtherwise("another unit");
  double most = 0.0;
  for (std::size_t i = 0; i < written.entities.size(); ++i) {
    const CadShape &a = written.entities[i].shape, &b = readBack.entities[i].shape;
    if (a.index() != b.index()) return readsBackOtherwise("another kind of entity for " + written.entities[i].name);
    if (const auto* p = std::get_if<CadArc>(&a), *q = std::get_if<CadArc>(&b); p != nullptr) {
      most = std::max(most, arcDifference(*p, *q));
      continue;
    }
    if (const auto* p = std::get_if<CadPolyline>(&a), *q = std::get_if<CadPolyline>(&b); p != nullptr) {
      if (p->vertices.size() != q->vertices.size() || p->closed != q->closed)
        return readsBackOtherwise("other vertices of " + written.entities[i].name);
      for (std::size_t k = 0; k < p->vertices.size(); ++k)
        most = std::max(most, (p->vertices[k].point - q->vertices[k].point).norm());
    }
    for (int k = 0; k <= kCompared; ++k) {
      const double t = static_cast<double>(k) / kCompared;
      most = std::max(most, (pointAt(a, t) - pointAt(b, t)).norm());
    }
  }
  if (!std::isfinite(most)) return readsBackOtherwise("a number that is not finite");
  return most * written.mmPerUnit.value_or(1.0);
}

}  // namespace batten
