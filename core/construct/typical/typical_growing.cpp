// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_growing.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/construct/typical/typical_grower.h"
#include "core/construct/typical/typical_path_fit.h"
#include "core/construct/typical/typical_rough_path.h"
#include "core/construct/typical/typical_structure.h"

namespace batten {

namespace {

/// Of a segment: a joint is passed if a grown curve ends less than this before it.
constexpr double kPassedShare = 0.3;

std::complex<double> complexOf(const Vec2& v) { return {v.x(), v.y()}; }

std::vector<Vec2> pointsBetween(const TypicalLine& line, std::size_t firstJoint, std::size_t lastJoint) {
  std::vector<Vec2> result;
  std::size_t joint = 0;
  for (const Vec2& p : line.points) {
    while (joint + 2 < line.joints.size() &&
           (p - line.joints[joint + 1].point).dot(line.joints[joint + 1].tangent) > 0.0) {
      ++joint;
    }
    // A segment more on both sides: what lies beyond the ends is left out by the feet.
    if (joint + 1 >= firstJoint && joint <= lastJoint) result.push_back(p);
  }
  return result;
}

std::vector<GrowingStretch> stretchesOf(const TypicalLine& line, std::span<const Vec2> breakpoints) {
  std::vector<std::size_t> cuts;
  for (const Vec2& place : breakpoints) {
    const auto nearest = std::min_element(line.joints.begin(), line.joints.end(), [&](const Joint& a, const Joint& b) {
      return (a.point - place).squaredNorm() < (b.point - place).squaredNorm();
    });
    cuts.push_back(static_cast<std::size_t>(nearest - line.joints.begin()));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<GrowingStretch> result;
  for (const JointRun& run : bendingRuns(line.joints)) {
    std::size_t first = run.first, last = run.last;
    // A closed line ends with a Hermite piece that meets its start.
    if (line.closed && last + 1 == line.joints.size()) --last;
    for (const std::size_t cut : cuts) {
      if (cut <= first || cut >= last) continue;
      result.push_back({first, cut, pointsBetween(line, first, cut)});
      first = cut;
    }
    if (last > first) result.push_back({first, last, pointsBetween(line, first, last)});
  }
  return result;
}

PathState stateOf(const Joint& joint, double near) {
  const double angle = std::atan2(joint.tangent.y(), joint.tangent.x());
  return {joint.point, near + std::remainder(angle - near, 2.0 * std::numbers::pi), joint.kappa};
}

void appendHermite(TypicalPath& path, const PathState& to) {
  PathElement hermite;
  hermite.typical = false;
  path.elements.push_back(hermite);
  path.states.push_back(to);
}

void appendTypical(TypicalPath& path, const TypicalCurve& curve) {
  PathElement element;
  element.side = curve.turnRad > 0.0 ? 1.0 : -1.0;
  element.logTurn = std::log(std::abs(curve.turnRad));
  element.shape = std::log(curve.ratio);
  path.elements.push_back(element);
  path.states.push_back({curve.endJoint().point, curve.angleRad + 2.0 * curve.turnRad, curve.endCurvature()});
}

/// An extremum inside becomes a joint: exact.
void divideAtMaxima(TypicalPath& path) {
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    if (!path.elements[e].typical || path.elements[e].isMonotone()) continue;
    const double top = placeOfMaximum(path.elements[e]);
    if (top > 1e-3 && top < 1.0 - 1e-3) {
      path.split(e++, top);
    } else {
      // So near to an end that a hair of shape makes up for it.
      path.elements[e].setTrend(path.elements[e].logRatio() < 0.0 ? Trend::Rising : Trend::Falling);
    }
  }
}

/// Turns and scales the whole path so that it ends where it has to: less than noise.
void settleEnd(TypicalPath& path, const Vec2& end) {
  const Vec2 start = path.states.front().point;
  const std::complex<double> was = complexOf(path.states.back().point - start), wanted = complexOf(end - start);
  if (!(std::abs(was) > 0.0) || !(std::abs(wanted) > 0.0)) return;
  const std::complex<double> turn = wanted / was;
  for (PathState& s : path.states) {
    const std::complex<double> p = complexOf(s.point - start) * turn;
    s.point = start + Vec2(p.real(), p.imag());
    s.angleRad += std::arg(turn);
    s.kappa /= std::abs(turn);
  }
}

}  // namespace

std::string_view name(GrowingStep::Kind kind) {
  switch (kind) {
    case GrowingStep::Kind::Seed:
      return "seed";
    case GrowingStep::Kind::Extrapolated:
      return "extrapolated";
    case GrowingStep::Kind::Fitted:
      return "fitted";
    case GrowingStep::Kind::Kept:
      return "kept";
  }
  return "unknown";
}

std::optional<FoundPath> grownPath(const TypicalLine& line, std::span<const Vec2> breakpointsMm,
                                   const ConstructParams& params, std::vector<GrowingStep>* steps,
                                   const RunContext& context) {
  std::vector<Vec2> breakpoints;
  for (const Vec2& p : breakpointsMm) breakpoints.push_back(line.toLine(p));
  GrowingRecord record{steps};
  TypicalPath path;
  path.closed = line.closed;
  path.states.push_back(stateOf(line.joints.front(), 0.0));
  std::size_t at = 0;
  const auto goTo = [&](std::size_t joint) {
    for (std::size_t i = at + 1; i <= joint; ++i)
      appendHermite(path, stateOf(line.joints[i], path.states.back().angleRad));
    at = std::max(at, joint);
  };
  for (const GrowingStretch& stretch : stretchesOf(line, breakpoints)) {
    if (context.isCancelled()) return std::nullopt;
    goTo(stretch.firstJoint);
    const GrowingStart start{path.states.back(), path.elements.empty() || !path.elements.back().typical};
    const GrownCurves grown = growStretch(line, params, stretch, start, record, context);
    if (grown.curves.empty()) continue;
    ++record.segment;
    if (start.isFree) {
      path.states.back().angleRad = grown.curves.front().angleRad;
      path.states.back().kappa = grown.curves.front().startCurvature();
    }
    for (const TypicalCurve& curve : grown.curves) appendTypical(path, curve);
    // Where it had to stop early the rest is left to Hermite pieces.
    at = stretch.firstJoint;
    while (at < stretch.lastJoint && (line.joints[at + 1].point - grown.end.point).dot(line.joints[at + 1].tangent) <
                                         kPassedShare * (line.joints[at + 1].point - line.joints[at].point).norm()) {
      ++at;
    }
  }
  goTo(line.joints.size() - 1);
  if (path.elements.empty()) return std::nullopt;
  if (!path.update()) return std::nullopt;
  divideAtMaxima(path);
  if (!path.update()) return std::nullopt;
  if (!path.closed && path.endsTypical()) settleEnd(path, line.joints.back().point);
  return FoundPath{std::move(path), record.rested};
}

Result<std::vector<GrowingStep>> growingSteps(const ConstructPiece& piece, double pixelMm,
                                              const ConstructParams& params, const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  const TypicalLine line = typicalLine(piece, pixelMm, params, context);
  std::vector<GrowingStep> steps;
  if (!line.joints.empty()) grownPath(line, piece.breakpoints, params, &steps, context);
  if (context.isCancelled()) return cancelled();
  return steps;
}

}  // namespace batten
