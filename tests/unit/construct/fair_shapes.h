// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "core/construct/construct.h"
#include "core/construct/fair/fair_fit.h"
#include "core/curve/nurbs_curve.h"

namespace batten::test {

/// A curve given by its curvature over arc length (px), integrated in steps of 1/16 px.
struct TrueCurve {
  std::vector<Vec2> points;
  std::vector<Vec2> normals;
  double step = 1.0 / 16.0;
  double length() const { return step * static_cast<double>(points.size() - 1); }
};

inline TrueCurve curveOfCurvature(double length, const std::function<double(double)>& kappa) {
  TrueCurve c;
  const int n = static_cast<int>(std::lround(length / c.step));
  double angle = 0.0;
  Vec2 p = Vec2::Zero();
  for (int i = 0; i <= n; ++i) {
    c.points.push_back(p);
    c.normals.push_back({-std::sin(angle), std::cos(angle)});
    const double next = angle + c.step * kappa((i + 0.5) * c.step);
    const double middle = 0.5 * (angle + next);
    p += c.step * Vec2(std::cos(middle), std::sin(middle));
    angle = next;
  }
  return c;
}

/// Edge points every px with MA(1, .6) noise along the normal, as moments of a blurred edge have it.
inline std::vector<Vec2> noisyPoints(const TrueCurve& c, double sigma, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<Vec2> out;
  double previous = normal(random);
  for (std::size_t i = 8; i < c.points.size(); i += 16) {
    const double now = normal(random);
    out.push_back(c.points[i] + sigma * (now + 0.6 * previous) / std::sqrt(1.36) * c.normals[i]);
    previous = now;
  }
  return out;
}

/// rms distance of a curve (in px units: pixelMm = 1) from the true one, sampled on both.
inline double rmsFrom(const TrueCurve& truth, const NurbsCurve& curve) {
  double sum = 0.0;
  int count = 0;
  const int samples = 2000;
  std::size_t at = 0;
  for (int i = 0; i <= samples; ++i) {
    const Vec2 p = curve.point(curve.start() + (curve.end() - curve.start()) * i / samples);
    while (at + 1 < truth.points.size() &&
           (truth.points[at + 1] - p).squaredNorm() <= (truth.points[at] - p).squaredNorm())
      ++at;
    const double e = (p - truth.points[at]).dot(truth.normals[at]);
    sum += e * e;
    ++count;
  }
  return std::sqrt(sum / count);
}

struct CurvatureProfile {
  std::vector<double> s, kappa;
  double diagonal = 0.0;
};
/// Curvature by the closed formula at `perSpan` parameters a span.
inline CurvatureProfile profileOf(const NurbsCurve& curve, int perSpan = 12) {
  CurvatureProfile out;
  const auto breaks = curve.breaks();
  Vec2 low = curve.point(curve.start()), high = low, last = low;
  double s = 0.0;
  for (std::size_t j = 0; j + 1 < breaks.size(); ++j) {
    for (int i = 0; i < perSpan + (j + 2 == breaks.size() ? 1 : 0); ++i) {
      const auto d = curve.derivatives(breaks[j] + (breaks[j + 1] - breaks[j]) * i / perSpan, 2);
      s += (d[0] - last).norm();
      last = d[0];
      low = low.cwiseMin(d[0]);
      high = high.cwiseMax(d[0]);
      out.s.push_back(s);
      out.kappa.push_back(cross(d[1], d[2]) / std::pow(d[1].norm(), 3));
    }
  }
  out.diagonal = (high - low).norm();
  return out;
}

struct FoundExtremum {
  double fraction = 0.0;
  int type = 1;
};
/// Extrema that rise above both neighbours (or ends) by at least `share` / diagonal; naive persistence on the samples.
inline std::vector<FoundExtremum> extremaOf(const NurbsCurve& curve, bool closed, double share = 5e-3) {
  const CurvatureProfile p = profileOf(curve);
  const double least = share / p.diagonal;
  std::vector<FoundExtremum> found;
  const int n = static_cast<int>(p.kappa.size()) - (closed ? 1 : 0);
  // Start at the global minimum when closed, so that no extremum is cut in two.
  int offset = 0;
  if (closed) {
    for (int i = 1; i < n; ++i) {
      if (p.kappa[i] < p.kappa[offset]) offset = i;
    }
  }
  const auto at = [&](int i) { return p.kappa[(i + offset) % n]; };
  const int steps = closed ? n : n - 1;
  double low = at(0), high = at(0);
  int lowAt = 0, highAt = 0, direction = 0;
  const auto add = [&](int i, int type) { found.push_back({p.s[(i + offset) % n] / p.s.back(), type}); };
  for (int i = 1; i <= steps; ++i) {
    const double k = at(i);
    if (k > high) high = k, highAt = i;
    if (k < low) low = k, lowAt = i;
    if (direction >= 0 && high - k >= least) {
      if (direction > 0) add(highAt, 1);
      direction = -1;
      low = k, lowAt = i;
    } else if (direction <= 0 && k - low >= least) {
      if (direction < 0) add(lowAt, -1);
      direction = 1;
      high = k, highAt = i;
    }
  }
  if (closed && !found.empty()) found.push_back({p.s[offset] / p.s.back(), -1});
  return found;
}

/// The dense fair fit of a contour in mm.
inline Result<std::vector<ConstructedPiece>> fitInMillimetres(const ConstructContour& contour,
                                                              const FairFitOptions& options = {},
                                                              const RunContext& context = {}) {
  ConstructParams params;
  params.light = false;
  params.extremumSignificance = options.extremumSignificance;
  params.knotRemovalTolerance = options.knotRemovalTolerance;
  return construct(contour, params, context);
}

inline Result<std::vector<ConstructedPiece>> fitOne(std::vector<Vec2> points, bool closed, double pixelMm = 1.0) {
  ConstructContour contour;
  contour.pixelMm = pixelMm;
  contour.pieces.resize(1);
  contour.pieces[0].points = piecePoints(std::move(points));
  contour.pieces[0].closed = closed;
  return fitInMillimetres(contour);
}

}  // namespace batten::test
