// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/drawing_figures.h"

#include "core/solve/gauss_legendre.h"

namespace batten {
namespace {

constexpr int kPlaces = 5, kParts = 8;                   // nodes of the rule, and parts of a span that it is used on
constexpr QuadratureRule<5> kRule = gaussLegendre<5>();  // exact to degree 9

struct Moments {
  double length = 0.0;
  Vec2 first = Vec2::Zero();  ///< Integral of the place over the length.
};

Moments momentsOf(const NurbsCurve& curve) {
  Moments sum;
  const std::vector<double> breaks = curve.breaks();
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double half = 0.5 * (breaks[i] - breaks[i - 1]) / kParts;
    for (int part = 0; part < kParts; ++part) {
      const double middle = breaks[i - 1] + (2 * part + 1) * half;
      for (std::size_t k = 0; k < kRule.node.size(); ++k) {
        const auto d = curve.derivatives(middle + half * kRule.node[k], 1);
        const double share = half * kRule.weight[k] * d[1].norm();
        sum.length += share;
        sum.first += share * d[0];
      }
    }
  }
  return sum;
}

}  // namespace

DrawingFigures figuresOf(const CadDrawing& drawing) {
  DrawingFigures figures;
  Moments sum;
  for (const CadEntity& entity : drawing.entities) {
    const auto curve = curveOf(entity.shape);
    if (!curve) continue;  // an edge without length
    const Moments own = momentsOf(*curve);
    sum.length += own.length;
    sum.first += own.first;
    for (int i = 0; i < kPlaces; ++i)
      figures.places.push_back(pointAt(entity.shape, static_cast<double>(i) / (kPlaces - 1)));
  }
  figures.length = sum.length;
  if (sum.length > 0.0) figures.centroid = sum.first / sum.length;
  return figures;
}

}  // namespace batten
