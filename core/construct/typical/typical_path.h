// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/construct/typical/typical_curve.h"
#include "core/curve/bezier_quintics.h"

namespace batten {

/// \file
/// A path of typical curves (002) and, where those cannot go, quintic Hermite pieces. What two neighbours share is a
/// state: place, direction and curvature; so the path is G2 by construction. The unit is the caller's (px: noise is
/// then about 1).

/// Limits of the first guess of a typical curve. The fit itself allows a little more, so that it does not start at a
/// border of its own.
inline constexpr double kMostStartTurnRad = 1.4;    ///< [rad] Change of direction; more is divided.
inline constexpr double kLeastStartTurnRad = 1e-4;  ///< [rad] Less is straight.
inline constexpr double kMostStartLogRatio = 1.2;   ///< Of the edges: the curvatures at the ends differ 120 times.

/// Where |curvature| goes along a typical curve. Rising and Falling keep it monotone by construction: h <= cos(phi) or
/// h >= 1 / cos(phi) whatever the unknowns are.
enum class Trend { Free, Rising, Falling };

/// What a path is where two of its elements meet, or at an end.
struct PathState {
  Vec2 point = Vec2::Zero();  ///< [px]
  double angleRad = 0.0;      ///< Direction of travel.
  double kappa = 0.0;         ///< [1/px] Signed curvature.

  Joint joint() const;
};

/// One element of a path with its own unknowns.
struct PathElement {
  bool typical = true;
  double side = 1.0;  ///< +1 turns left, -1 right.
  Trend trend = Trend::Free;
  double logTurn = 0.0;  ///< log |phi|
  double shape = 0.0;    ///< Free: log h. Else the slack of the condition, before it is made positive.

  double turn() const;  ///< |phi|
  /// log h.
  double logRatio() const;
  /// d logRatio / d (logTurn, shape).
  std::array<double, 2> logRatioSlopes() const;
  /// Sets `shape` to what gives this log h, or the nearest that the trend allows.
  void setLogRatio(double logRatio);
  /// Holds the curvature monotone in the way it goes now; a curve with an extremum inside keeps its nearer border.
  void setTrend(Trend);
  bool isMonotone() const;
};

/// Elements and the states between them: states[e] is where element e starts. States behind typical curves follow from
/// what is before them.
struct TypicalPath {
  std::vector<PathElement> elements;
  std::vector<PathState> states;  ///< elements.size() + 1; closed: the last repeats the first.
  bool closed = false;

  bool isFree(std::size_t state) const;  ///< An unknown of its own.
  bool endsTypical() const { return !elements.empty() && elements.back().typical; }
  /// Computes the states that follow from others. False where the unknowns make no path.
  bool update();
  /// Element e as a typical curve. @pre it is one.
  TypicalCurve typical(std::size_t e) const;
  /// [px] Length of the first derivative of element e as a Hermite piece.
  double hermiteLength(std::size_t e) const;
  /// Element e, of either kind, as a quintic over 0..1.
  Quintic quintic(std::size_t e) const;
  /// Divides an element at t in 0..1: exactly where it is typical, nearly where it is not.
  void split(std::size_t e, double t);
  /// One element in place of e and the next: typical, which turns as far, from curvature to curvature; or Hermite. Or a
  /// typical one in place of a Hermite piece that bends one way. False, and nothing changed, where that makes no sense.
  bool join(std::size_t e);
  bool joinAsHermite(std::size_t e);
  bool makeTypical(std::size_t e);
};

/// [units] A shorter segment is a sliver: its curvature would be all rounding.
inline constexpr double kShortestSegment = 0.5;
/// The first element that is a sliver.
std::optional<std::size_t> firstSliver(const TypicalPath&);

/// Length of the first derivative of a Hermite piece between two states: the arc length of a flat cubic over their
/// chord.
struct HermiteLength {
  double length = 0.0;                           ///< [px]
  std::array<double, 4> fromStart{}, fromEnd{};  ///< Derivatives by x, y, angle and curvature.
};
HermiteLength hermiteLength(const PathState& a, const PathState& b);

}  // namespace batten
