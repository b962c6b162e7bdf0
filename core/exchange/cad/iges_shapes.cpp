// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/iges_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/conventions.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

std::optional<CadShape> lineOf(const IgesNumbers& n) {
  if (!n.has(6) || n.point(0) == n.point(3)) return std::nullopt;
  return CadLine{n.point(0), n.point(3)};
}

std::optional<CadShape> arcOf(const IgesNumbers& n) {
  if (!n.has(7)) return std::nullopt;
  const Vec2 centre = n.point(1), start = n.point(3) - centre, end = n.point(5) - centre;
  if (!(start.norm() > 0.0)) return std::nullopt;
  const double first = std::atan2(start.y(), start.x());
  double sweep = std::atan2(cross(start, end), start.dot(end));
  if (sweep <= 0.0) sweep += kFullTurnRad;
  return CadArc{centre, start.norm(), first, start == end ? kFullTurnRad : sweep};
}

std::optional<CadShape> splineOf(const IgesNumbers& n) {
  const auto last = n.count(0, 1, kMostIgesPoints), degree = n.count(1, 1, 7);
  if (!last || !degree || *last < *degree) return std::nullopt;
  const std::size_t points = *last + 1, knots = points + *degree + 1, begin = 6;
  if (!n.has(begin + knots + 4 * points)) return std::nullopt;
  std::vector<Vec2> control;
  for (std::size_t i = 0; i < points; ++i) control.push_back(n.point(begin + knots + points + 3 * i));
  auto curve = NurbsCurve::make(*degree, n.range(begin, knots), std::move(control), n.range(begin + knots, points));
  if (!curve) return std::nullopt;
  const std::size_t domain = begin + knots + 4 * points;
  if (!n.has(domain + 2)) return std::move(*curve);
  constexpr double kSame = 1e-9;  // of the parameters
  auto part = partBetween(*curve, n.at(domain), n.at(domain + 1), kSame);
  return part ? std::optional<CadShape>(std::move(*part)) : std::nullopt;
}

/// Only ellipses in their own axes, which is how they are written; A x^2 + C y^2 + F = 0.
std::optional<CadShape> conicOf(const IgesNumbers& n) {
  if (!n.has(11)) return std::nullopt;
  const double a = n.at(0), b = n.at(1), c = n.at(2), d = n.at(3), e = n.at(4), f = n.at(5);
  if (b != 0.0 || d != 0.0 || e != 0.0 || !(-f * a > 0.0) || !(-f * c > 0.0)) return std::nullopt;
  const Vec2 half(std::sqrt(-f / a), std::sqrt(-f / c));
  const Vec2 start = n.point(7), end = n.point(9);
  const double first = std::atan2(start.y() / half.y(), start.x() / half.x());
  double sweep = std::atan2(end.y() / half.y(), end.x() / half.x()) - first;
  while (sweep <= 0.0) sweep += kFullTurnRad;
  const auto unit =
      curveOf(CadArc{Vec2::Zero(), 1.0, first, start == end ? kFullTurnRad : std::min(sweep, kFullTurnRad)});
  if (!unit) return std::nullopt;
  return unit->mapped(half.asDiagonal(), Vec2::Zero());
}

/// Points: pairs at a common z, triples, or triples with a vector each.
std::optional<CadShape> copiousOf(const IgesNumbers& n, int form) {
  const auto kind = n.count(0, 1, 3), count = n.count(1, 2, kMostIgesPoints);
  if (!kind || !count) return std::nullopt;
  const std::size_t stride = *kind == 1 ? 2 : *kind == 2 ? 3 : 6, begin = *kind == 1 ? 3 : 2;
  if (!n.has(begin + stride * *count)) return std::nullopt;
  constexpr int kClosedArea = 63;  // form
  CadPolyline line{{}, form == kClosedArea};
  for (int i = 0; i < *count; ++i) line.vertices.push_back({n.point(begin + stride * i)});
  if (line.closed && line.vertices.front().point == line.vertices.back().point) line.vertices.pop_back();
  if (line.vertices.size() < 2) return std::nullopt;
  return line;
}

/// Cubics in powers of the parameter, one behind the other.
std::optional<CadShape> parametricSplineOf(const IgesNumbers& n) {
  const auto segments = n.count(3, 1, kMostIgesPoints / 16);
  if (!segments) return std::nullopt;
  const std::size_t count = *segments, breaks = 4, begin = breaks + count + 1;
  if (!n.has(begin + 12 * count)) return std::nullopt;
  std::vector<NurbsCurve> pieces;
  double size = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double from = n.at(breaks + i), to = n.at(breaks + i + 1), h = to - from;
    if (!(h > 0.0)) return std::nullopt;
    std::array<Vec2, 4> power;
    for (std::size_t k = 0; k < 4; ++k) {
      power[k] = Vec2(n.at(begin + 12 * i + k), n.at(begin + 12 * i + 4 + k)) * std::pow(h, static_cast<double>(k));
    }
    const Vec2 p0 = power[0], p1 = p0 + power[1] / 3.0, p2 = p0 + (2.0 * power[1] + power[2]) / 3.0;
    const Vec2 p3 = power[0] + power[1] + power[2] + power[3];
    size = std::max({size, (p3 - p0).norm(), (p1 - p0).norm(), (p2 - p0).norm()});
    auto piece = NurbsCurve::make(3, {from, from, from, from, to, to, to, to}, {p0, p1, p2, p3});
    if (!piece) return std::nullopt;
    pieces.push_back(std::move(*piece));
  }
  constexpr double kGap = 1e-6;  // of the size
  auto joined = joinAtCorners(pieces, kGap * size);
  return joined ? std::optional<CadShape>(std::move(*joined)) : std::nullopt;
}

}  // namespace

std::optional<CadShape> igesShape(const IgesDirectoryEntry& entry, const IgesNumbers& n) {
  switch (entry.type) {
    case 100:
      return arcOf(n);
    case 104:
      return conicOf(n);
    case 106:
      return copiousOf(n, entry.form);
    case 110:
      return lineOf(n);
    case 112:
      return parametricSplineOf(n);
    case 126:
      return splineOf(n);
    default:
      return std::nullopt;
  }
}

std::optional<std::size_t> igesOwnNumbers(const IgesDirectoryEntry& entry, const IgesNumbers& n) {
  switch (entry.type) {
    case 100:
      return 7;
    case 104:
      return 11;
    case 106: {
      const auto kind = n.count(0, 1, 3), count = n.count(1, 2, kMostIgesPoints);
      if (!kind || !count) return std::nullopt;
      const std::size_t stride = *kind == 1 ? 2 : *kind == 2 ? 3 : 6;
      return (*kind == 1 ? 3 : 2) + stride * *count;
    }
    case 110:
      return 6;
    case 126: {
      const auto last = n.count(0, 1, kMostIgesPoints), degree = n.count(1, 1, 7);
      if (!last || !degree) return std::nullopt;
      // Six of its head, knots, weights, places, the two ends and the normal.
      return 6 + *last + *degree + 2 + 4 * (*last + 1) + 5;
    }
    default:
      return std::nullopt;
  }
}

}  // namespace batten
