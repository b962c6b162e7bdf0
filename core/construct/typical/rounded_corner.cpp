// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/rounded_corner.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/solve/residual_blocks.h"

namespace batten {

namespace {

using Complex = std::complex<double>;

/// The corner in the frame of its first direction, turning left.
struct Frame {
  Vec2 origin;
  double angle, side, turn;
  Complex chord;  ///< From before to behind.
};

std::optional<Frame> frameOf(const Joint& before, const Joint& behind) {
  Frame f;
  f.origin = before.point;
  f.angle = std::atan2(before.tangent.y(), before.tangent.x());
  const double turn = std::atan2(cross(before.tangent, behind.tangent), before.tangent.dot(behind.tangent));
  f.side = turn > 0.0 ? 1.0 : -1.0;
  f.turn = std::abs(turn);
  if (!(f.turn > 0.01 && f.turn < 3.0)) return std::nullopt;
  const Vec2 way = behind.point - before.point;
  f.chord = {way.dot(before.tangent), f.side * way.dot(leftNormal(before.tangent))};
  // The vertex lies ahead of the first place and behind the second.
  const double toVertex = f.chord.real() - f.chord.imag() / std::tan(f.turn),
               fromVertex = f.chord.imag() / std::sin(f.turn);
  if (!(toVertex > 0.0) || !(fromVertex > 0.0)) return std::nullopt;
  return f;
}

/// Way along a typical curve whose first edge points along the real axis, and back along one that ends there.
Complex wayOf(double edge, double ratio, double turn) {
  const Complex z = std::polar(ratio, turn);
  return edge * (1.0 + z + z * z);
}

/// From before to behind over both arcs: the second is the mirror of a curve from its far end.
Complex wayOver(const Frame& f, double edge1, double h1, double phi1, double edge2, double h2, double phi2) {
  return wayOf(edge1, h1, phi1) + std::polar(1.0, f.turn) * std::conj(wayOf(edge2, h2, phi2));
}

std::optional<RoundedCorner> assemble(const Frame& f, double edge1, double h1, double phi1, double edge2, double h2,
                                      double phi2) {
  if (!(edge1 > 0.0 && edge2 > 0.0 && h1 > 0.0 && h2 > 0.0)) return std::nullopt;
  if (h1 > std::cos(phi1) * (1.0 + 1e-9) || h2 > std::cos(phi2) * (1.0 + 1e-9)) return std::nullopt;
  RoundedCorner corner;
  corner.arcs[0] = {f.origin, f.angle, edge1, h1, f.side * phi1};
  const Vec2 middle = corner.arcs[0].controlPoints()[3];
  corner.arcs[1] = {middle, f.angle + f.side * 2.0 * phi1, edge2 * h2 * h2, 1.0 / h2, f.side * phi2};
  return corner;
}

/// G1 ends: one h for both arcs; the turn is shared such that the chord gets its direction, then the size its length.
std::optional<RoundedCorner> withRatio(const Frame& f, double h) {
  const double half = 0.5 * f.turn, wanted = std::arg(f.chord);
  const auto way = [&](double phi1) {
    return wayOver(f, std::sin(phi1), h, phi1, std::sin(half - phi1), h, half - phi1);
  };
  double low = 1e-3 * half, high = (1.0 - 1e-3) * half;
  // A larger first arc stays longer on the first direction... until the chord's direction is met.
  const double atLow = std::arg(way(low)) - wanted, atHigh = std::arg(way(high)) - wanted;
  if (!(atLow * atHigh <= 0.0)) return std::nullopt;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((std::arg(way(middle)) - wanted) * atLow > 0.0 ? low : high) = middle;
  }
  const double phi1 = 0.5 * (low + high), size = std::abs(f.chord) / std::abs(way(phi1));
  return assemble(f, size * std::sin(phi1), h, phi1, size * std::sin(half - phi1), h, half - phi1);
}

/// G2 ends: both curvatures given, h of both follows from where they meet; two unknowns for the two of the chord.
std::optional<RoundedCorner> withCurvatures(const Frame& f, double kappa1, double kappa2) {
  const double half = 0.5 * f.turn, step = std::pow(kappa2 / kappa1, 0.25), size = std::abs(f.chord);
  struct Shape {
    double edge1, h1, phi1, edge2, h2, phi2;
  };
  const auto shapeOf = [&](std::span<const double> x) {
    Shape s;
    s.phi1 = half / (1.0 + std::exp(-x[1]));
    s.phi2 = half - s.phi1;
    s.h1 = std::exp(x[0]);
    s.h2 = s.h1 * step;
    s.edge1 = 2.0 * s.h1 * std::sin(s.phi1) / (3.0 * kappa1);
    s.edge2 = 2.0 * s.h2 * std::sin(s.phi2) / (3.0 * kappa2);
    return s;
  };
  ResidualBlock block{{0, 1}, 2, [&](std::span<const double> x, std::span<double> r) {
                        const Shape s = shapeOf(x);
                        const Complex away =
                            (wayOver(f, s.edge1, s.h1, s.phi1, s.edge2, s.h2, s.phi2) - f.chord) / size;
                        r[0] = away.real();
                        r[1] = away.imag();
                      }};
  for (const double first : {-0.2, -0.7, -1.2}) {
    const auto solved = minimiseBlocks(Eigen::Vector2d(first, 0.0), Eigen::Vector2d::Ones(), std::array{block}, {});
    if (!(solved.run.cost < 1e-22)) continue;
    const Shape s = shapeOf(std::span(solved.x.data(), 2));
    auto corner = assemble(f, s.edge1, s.h1, s.phi1, s.edge2, s.h2, s.phi2);
    if (!corner) continue;
    corner->curvatureAtEnds = true;
    return corner;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RoundedCorner> roundCorner(const Joint& before, const Joint& behind, double form) {
  const auto frame = frameOf(before, behind);
  if (!frame) return std::nullopt;
  const double kappa1 = frame->side * before.kappa, kappa2 = frame->side * behind.kappa;
  // Below a hundredth of the curvature of the rounding itself an end counts as straight.
  const double least = 0.01 * frame->turn / std::abs(frame->chord);
  if (kappa1 > least && kappa2 > least) {
    if (auto corner = withCurvatures(*frame, kappa1, kappa2)) return corner;
  }
  // Monotone needs h <= cos(phi), and phi of the larger arc is not known beforehand.
  double h = std::clamp(form, 0.2, 1.0) * std::cos(0.25 * frame->turn);
  for (int i = 0; i < 30; ++i, h *= 0.95) {
    if (auto corner = withRatio(*frame, h)) return corner;
  }
  return std::nullopt;
}

}  // namespace batten
