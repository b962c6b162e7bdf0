// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/rounded_corner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "core/solve/residual_blocks.h"

namespace batten {

namespace {

using Complex = std::complex<double>;

// What counts as a corner to be rounded: less is a line, more a hairpin whose vertex runs off.
constexpr double kLeastTurnRad = 0.01, kMostTurnRad = 3.0;
constexpr double kCornerRounding = 1e-9;  ///< Relative: a ratio at its limit may be over it by rounding.
constexpr double kLeastShare = 1e-3;      ///< Of half the turn, that an arc takes.
constexpr int kHalvings = 200;            ///< Until two numbers have no third between them.
constexpr double kStraightShare = 0.01;   ///< Of the curvature of the rounding: an end with less counts as straight.
constexpr double kCornerMet = 1e-11;      ///< Of the chord: how near the arcs come to its end.
/// Where the search for the ratio of edges starts, as its logarithm: gentle, middling and sharp changes of curvature.
constexpr std::array<double, 3> kFirstLogRatios = {-0.2, -0.7, -1.2};
// A ratio of edges: from `form` on downwards until both arcs are monotone.
constexpr double kLeastForm = 0.2, kNextRatio = 0.95;
constexpr int kRatiosTried = 30;  // down to 0.23 of the first

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
  if (!(f.turn > kLeastTurnRad && f.turn < kMostTurnRad)) return std::nullopt;
  const Vec2 chord = behind.point - before.point;
  f.chord = {chord.dot(before.tangent), f.side * chord.dot(leftNormal(before.tangent))};
  // The vertex lies ahead of the first place and behind the second.
  const double toVertex = f.chord.real() - f.chord.imag() / std::tan(f.turn),
               fromVertex = f.chord.imag() / std::sin(f.turn);
  if (!(toVertex > 0.0) || !(fromVertex > 0.0)) return std::nullopt;
  return f;
}

/// One arc of a rounding as seen from its end of it: first edge, ratio of edges and turn from edge to edge.
struct Arc {
  double edge = 0.0, ratio = 1.0, turn = 0.0;

  /// Positive edges, and curvature that goes one way but for rounding.
  bool isSound() const { return edge > 0.0 && ratio > 0.0 && ratio <= std::cos(turn) * (1.0 + kCornerRounding); }
};

/// Chord of such a curve whose first edge points along the real axis.
Complex chordOf(const Arc& arc) {
  const Complex z = std::polar(arc.ratio, arc.turn);
  return arc.edge * (1.0 + z + z * z);
}

/// From before to behind over both arcs: the second is the mirror of a curve from its far end.
Complex chordOver(const Frame& f, const Arc& first, const Arc& second) {
  return chordOf(first) + std::polar(1.0, f.turn) * std::conj(chordOf(second));
}

std::optional<RoundedCorner> assemble(const Frame& f, const Arc& first, const Arc& second) {
  if (!first.isSound() || !second.isSound()) return std::nullopt;
  RoundedCorner corner;
  corner.arcs[0] = {f.origin, f.angle, first.edge, first.ratio, f.side * first.turn};
  const Vec2 middle = corner.arcs[0].controlPoints()[3];
  corner.arcs[1] = {middle, f.angle + f.side * 2.0 * first.turn, second.edge * second.ratio * second.ratio,
                    1.0 / second.ratio, f.side * second.turn};
  return corner;
}

/// G1 ends: one h for both arcs; the turn is shared such that the chord gets its direction, then the size its length.
std::optional<RoundedCorner> withRatio(const Frame& f, double h) {
  const double half = 0.5 * f.turn, wanted = std::arg(f.chord);
  const auto chordWith = [&](double phi1) {
    return chordOver(f, {std::sin(phi1), h, phi1}, {std::sin(half - phi1), h, half - phi1});
  };
  double low = kLeastShare * half, high = (1.0 - kLeastShare) * half;
  // A larger first arc stays longer on the first direction... until the chord's direction is met.
  const double atLow = std::arg(chordWith(low)) - wanted, atHigh = std::arg(chordWith(high)) - wanted;
  if (!(atLow * atHigh <= 0.0)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    ((std::arg(chordWith(middle)) - wanted) * atLow > 0.0 ? low : high) = middle;
  }
  const double phi1 = 0.5 * (low + high), size = std::abs(f.chord) / std::abs(chordWith(phi1));
  return assemble(f, {size * std::sin(phi1), h, phi1}, {size * std::sin(half - phi1), h, half - phi1});
}

/// G2 ends: both curvatures given, h of both follows from where they meet; two unknowns for the two of the chord.
std::optional<RoundedCorner> withCurvatures(const Frame& f, double kappa1, double kappa2) {
  const double half = 0.5 * f.turn, step = std::pow(kappa2 / kappa1, 0.25), size = std::abs(f.chord);
  const auto arcsOf = [&](std::span<const double> x) {
    std::array<Arc, 2> arcs;
    arcs[0].turn = half / (1.0 + std::exp(-x[1]));
    arcs[1].turn = half - arcs[0].turn;
    arcs[0].ratio = std::exp(x[0]);
    arcs[1].ratio = arcs[0].ratio * step;
    arcs[0].edge = 2.0 * arcs[0].ratio * std::sin(arcs[0].turn) / (3.0 * kappa1);
    arcs[1].edge = 2.0 * arcs[1].ratio * std::sin(arcs[1].turn) / (3.0 * kappa2);
    return arcs;
  };
  ResidualBlock block{{0, 1}, 2, [&](std::span<const double> x, std::span<double> r) {
                        const auto arcs = arcsOf(x);
                        const Complex away = (chordOver(f, arcs[0], arcs[1]) - f.chord) / size;
                        r[0] = away.real();
                        r[1] = away.imag();
                      }};
  for (const double first : kFirstLogRatios) {
    const auto solved = minimiseBlocks(Eigen::Vector2d(first, 0.0), Eigen::Vector2d::Ones(), std::array{block}, {});
    if (!(solved.run.cost < kCornerMet * kCornerMet)) continue;
    const auto arcs = arcsOf(std::span(solved.x.data(), 2));
    auto corner = assemble(f, arcs[0], arcs[1]);
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
  const double least = kStraightShare * frame->turn / std::abs(frame->chord);
  if (kappa1 > least && kappa2 > least) {
    if (auto corner = withCurvatures(*frame, kappa1, kappa2)) return corner;
  }
  // Monotone needs h <= cos(phi), and phi of the larger arc is not known beforehand.
  double h = std::clamp(form, kLeastForm, 1.0) * std::cos(0.25 * frame->turn);
  for (int i = 0; i < kRatiosTried; ++i, h *= kNextRatio) {
    if (auto corner = withRatio(*frame, h)) return corner;
  }
  return std::nullopt;
}

}  // namespace batten
