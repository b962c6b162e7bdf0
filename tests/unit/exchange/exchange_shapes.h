// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/export_model.h"

namespace batten::test {

inline NurbsCurve made(int degree, std::vector<double> knots, std::vector<Vec2> points) {
  return NurbsCurve::make(degree, std::move(knots), std::move(points)).value();
}

inline NurbsCurve oneSpan() {
  return made(5, {0, 0, 0, 0, 0, 0, 30, 30, 30, 30, 30, 30},
              {{10, 10}, {16, 18}, {24, 22}, {30, 20}, {36, 12}, {45, 15}});
}
/// Inner knots of multiplicity 1 and 3.
inline NurbsCurve severalSpans() {
  return made(
      5, {0, 0, 0, 0, 0, 0, 10, 20, 20, 20, 35, 50, 50, 50, 50, 50, 50},
      {{5, 40}, {9, 48}, {16, 55}, {25, 52}, {33, 45}, {40, 41}, {48, 44}, {55, 50}, {61, 49}, {66, 44}, {70, 40}});
}
/// Two Bezier pieces with a corner at u = 20.
inline NurbsCurve bezierChain() {
  return made(
      5, {0, 0, 0, 0, 0, 0, 20, 20, 20, 20, 20, 40, 40, 40, 40, 40, 40},
      {{5, 60}, {9, 64}, {13, 66}, {17, 66}, {21, 64}, {25, 60}, {29, 68}, {33, 72}, {37, 74}, {41, 73}, {45, 70}});
}
inline NurbsCurve straightLine() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 5; ++i) points.emplace_back(10 + 8 * i, 80 + 2 * i);
  return made(5, {0, 0, 0, 0, 0, 0, 41, 41, 41, 41, 41, 41}, points);
}
/// A smooth closed curve: a periodic uniform quintic through a bumpy ring, with clamped ends.
inline NurbsCurve smoothLoop() {
  std::vector<Vec2> points;
  std::vector<double> knots;
  const int n = 12;
  for (int i = 0; i < n + 5; ++i) {
    const double a = 2 * M_PI * i / n, r = 18 + 3 * std::sin(3 * a);
    points.emplace_back(50 + r * std::cos(a), 50 + 0.8 * r * std::sin(a));
  }
  for (int i = 0; i < n + 11; ++i) knots.push_back(10.0 * (i - 5));
  return clamped(made(5, knots, points)).value();
}

/// The test set: every kind of curve an export may meet.
inline ExportDocument exportOfAllKinds() {
  ExportDocument document;
  document.frame = {1200, 1000, 0.1};
  document.dpi = 254.0;
  document.imageSha256 = std::string(64, 'a');
  document.title = "Süße <Linie> & \"漢字\".png";
  document.curves = {{"curve-1", false, {{oneSpan()}}},
                     {"curve-2", false, {{severalSpans()}}},
                     {"curve-3", false, {{bezierChain()}}},
                     {"curve-4", true, {{smoothLoop()}}},
                     {"curve-5", false, {{straightLine()}}}};
  // A loop with three corners.
  const auto edge = [](Vec2 a, Vec2 b) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 5; ++i) {
      const double t = i / 5.0;
      points.push_back((1 - t) * a + t * b + 4.0 * t * (1 - t) * 2.0 * leftNormal((b - a).normalized()));
    }
    return made(5, {0, 0, 0, 0, 0, 0, 25, 25, 25, 25, 25, 25}, points);
  };
  const Vec2 a(80, 10), b(110, 15), c(92, 40);
  document.curves.push_back({"curve-6", true, {{edge(a, b)}, {edge(b, c)}, {edge(c, a)}}});
  return document;
}

/// The test set with curves of every degree from 1 to 7, an exact arc and an exact circle beside it.
inline ExportDocument exportOfAllDegrees() {
  ExportDocument document = exportOfAllKinds();
  for (int degree = 1; degree <= 7; ++degree) {
    std::vector<Vec2> points;
    for (int i = 0; i <= degree + 2; ++i)
      points.emplace_back(10 + 9 * i, 60 + 5 * degree + (i % 2 == 0 ? 0 : 3) + i * i);
    std::vector<double> knots(degree + 1, 0.0);
    knots.insert(knots.end(), {11.0, 27.0});
    knots.insert(knots.end(), degree + 1, 40.0);
    document.curves.push_back({"degree-" + std::to_string(degree), false, {{made(degree, knots, points)}}});
  }
  document.curves.push_back({"arc", false, {{curveOf(CadArc{{60, 70}, 12.5, 0.4, 2.1}).value()}}});
  document.curves.push_back({"circle", true, {{curveOf(CadArc{{90, 80}, 7.25, 1.0, 2 * M_PI}).value()}}});
  return document;
}

/// B-spline by its definition (Cox and de Boor's recursion), so that no evaluation of the program judges itself.
inline double basisByDefinition(const std::vector<double>& knots, std::size_t i, int degree, double u) {
  const double end = knots.back();
  if (degree == 0) return (u >= knots[i] && u < knots[i + 1]) || (u == end && knots[i] < end && knots[i + 1] == end);
  const std::size_t p = degree;
  double sum = 0.0;
  if (knots[i + p] > knots[i])
    sum += (u - knots[i]) / (knots[i + p] - knots[i]) * basisByDefinition(knots, i, degree - 1, u);
  if (knots[i + p + 1] > knots[i + 1])
    sum += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) * basisByDefinition(knots, i + 1, degree - 1, u);
  return sum;
}
inline Vec2 splineByDefinition(int degree, const std::vector<double>& knots, const std::vector<Vec2>& points,
                               const std::vector<double>& weights, double fraction) {
  const double u = knots.front() + (knots.back() - knots.front()) * fraction;
  Vec2 sum = Vec2::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double b = basisByDefinition(knots, i, degree, u) * (weights.empty() ? 1.0 : weights[i]);
    sum += b * points[i];
    weight += b;
  }
  return sum / weight;
}

}  // namespace batten::test
