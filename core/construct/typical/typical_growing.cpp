// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_growing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>

#include "core/construct/pixel_frame.h"
#include "core/construct/typical/growing_stretch.h"
#include "core/construct/typical/typical_path_fit.h"
#include "core/construct/typical/typical_rough_path.h"
#include "core/construct/typical/typical_structure.h"

namespace batten {

namespace {

/// Of a segment: a joint is passed if a grown curve ends less than this before it.
constexpr double kPassedShare = 0.3;

/// [parameter] A maximum as near to an end of an element lies at it: both parts of a division must be long enough to
/// fit.
constexpr double kAtEndOfElement = 1e-3;

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
    cuts.push_back(nearest - line.joints.begin());
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<GrowingStretch> result;
  const auto add = [&](std::size_t first, std::size_t last, bool isOne) {
    if (last > first) result.push_back({first, last, pointsBetween(line, first, last), isOne});
  };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add(cuts[i], cuts[i + 1], true);
  for (const JointRun& run : bendingRuns(line.joints)) {
    // A closed line ends with a Hermite piece that meets its start.
    const std::size_t last = line.closed && run.last + 1 == line.joints.size() ? run.last - 1 : run.last;
    if (cuts.empty()) {
      add(run.first, last, false);
      continue;
    }
    // Beside the user's places as far as the line bends; between them there is one segment already.
    add(run.first, std::min(last, cuts.front()), false);
    add(std::max(run.first, cuts.back()), last, false);
  }
  std::sort(result.begin(), result.end(),
            [](const GrowingStretch& a, const GrowingStretch& b) { return a.firstJoint < b.firstJoint; });
  return result;
}

/// A curve that a path can hold.
bool isDrawable(const TypicalCurve& curve) {
  // inside what TypicalPath::update() takes (0.85, 1.7)
  constexpr double kMostDrawnTurn = 0.84, kMostDrawnLogRatio = 1.6;
  return std::abs(curve.turnRad) < kMostDrawnTurn && std::abs(std::log(curve.ratio)) < kMostDrawnLogRatio &&
         std::isfinite(curve.edge);
}

/// The last joint of a stretch that grown curves have passed: near their end, and about as far along the line as they
/// are long, for a closed line comes near its start again.
std::size_t passedJoint(const TypicalLine& line, const GrowingStretch& stretch, std::span<const TypicalCurve> grown) {
  constexpr double kLengthShare = 0.25;  // by which the line to a joint and the curves may differ …
  constexpr double kJointsOff = 3.0;     // … and so many joints more
  const auto chord = [&](std::size_t i) { return (line.joints[i + 1].point - line.joints[i].point).norm(); };
  double length = 0.0;
  for (const TypicalCurve& c : grown) length += c.size();
  const Vec2 end = grown.back().endJoint().point;
  std::size_t nearest = stretch.firstJoint;
  double s = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = stretch.firstJoint; i <= stretch.lastJoint; ++i) {
    if (i > stretch.firstJoint) s += chord(i - 1);
    const double step = i < stretch.lastJoint ? chord(i) : chord(i - 1), away = (line.joints[i].point - end).norm();
    if (std::abs(s - length) > kLengthShare * length + kJointsOff * step || away >= least) continue;
    least = away;
    nearest = i;
  }
  // One that lies clearly ahead is still to come.
  const Joint& joint = line.joints[nearest];
  const double step = nearest > stretch.firstJoint ? chord(nearest - 1) : chord(nearest);
  const bool isAhead = (joint.point - end).dot(joint.tangent) > kPassedShare * step;
  return isAhead && nearest > stretch.firstJoint ? nearest - 1 : nearest;
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
    if (top > kAtEndOfElement && top < 1.0 - kAtEndOfElement) {
      path.split(e++, top);
    } else {
      // So near to an end that a hair of shape makes up for it.
      path.elements[e].setTrend(path.elements[e].logRatio() < 0.0 ? Trend::Rising : Trend::Falling);
    }
  }
}

/// Rotates and scales the whole path so that it ends where it has to: less than noise.
void settleEnd(TypicalPath& path, const Vec2& end) {
  const Vec2 start = path.states.front().point;
  const std::complex<double> was = complexOf(path.states.back().point - start), wanted = complexOf(end - start);
  if (!(std::abs(was) > 0.0) || !(std::abs(wanted) > 0.0)) return;
  const std::complex<double> change = wanted / was;
  for (PathState& s : path.states) {
    const std::complex<double> p = complexOf(s.point - start) * change;
    s.point = start + Vec2(p.real(), p.imag());
    s.angleRad += std::arg(change);
    s.kappa /= std::abs(change);
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

GrownPath grownPath(const TypicalLine& line, std::span<const Vec2> places, const ConstructParams& params,
                    StepRecord steps, const RunContext& context) {
  std::vector<Vec2> breakpoints;
  for (const Vec2& p : places) breakpoints.push_back(line.toLine(p));
  GrownPath result;
  int segment = 0;
  bool rested = true;
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
    if (context.isCancelled()) return result;
    goTo(stretch.firstJoint);
    const GrowingStart start{path.states.back(), path.elements.empty() || !path.elements.back().typical, segment};
    GrownCurves grown = growStretch(line, params, stretch, start, steps, context);
    std::ranges::move(grown.steps, std::back_inserter(result.steps));
    rested = rested && grown.rested;
    segment = grown.segment;
    if (grown.curves.empty() && stretch.isOne) {
      appendHermite(path, stateOf(line.joints[stretch.lastJoint], path.states.back().angleRad));
      at = stretch.lastJoint;
    }
    if (grown.curves.empty()) continue;
    ++segment;
    if (start.isFree) {
      path.states.back().angleRad = grown.curves.front().angleRad;
      path.states.back().kappa = grown.curves.front().startCurvature();
    }
    // As far as it goes: an error that grows ends in a curve that is none.
    const auto drawn = std::find_if_not(grown.curves.begin(), grown.curves.end(), isDrawable);
    for (auto curve = grown.curves.begin(); curve != drawn; ++curve) appendTypical(path, *curve);
    const std::span<const TypicalCurve> kept(grown.curves.data(), drawn - grown.curves.begin());
    if (kept.empty()) continue;
    // Where it had to stop early the rest is left to Hermite pieces.
    at = stretch.isOne ? stretch.lastJoint : passedJoint(line, stretch, kept);
  }
  goTo(line.joints.size() - 1);
  if (path.elements.empty() || !path.update()) return result;
  divideAtMaxima(path);
  if (!path.update()) return result;
  // The paper's own way shows where it ends.
  if (!path.closed && path.endsTypical() && !params.growingAsInPaper) settleEnd(path, line.joints.back().point);
  result.found = FoundPath{std::move(path), rested};
  return result;
}

Result<std::vector<GrowingStep>> growingSteps(const ConstructPiece& piece, double pixelMm,
                                              const ConstructParams& params, const RunContext& context) {
  if (context.isCancelled()) return cancelled();
  if (!(pixelMm > 0.0) || !std::isfinite(pixelMm))
    return fail(ErrorCode::BadParameter, "The size of a pixel must be above 0 mm.");
  const ConstructPiece px = inPixels({{piece}, false, pixelMm}).pieces.front();
  const TypicalLine line = typicalLine(px, params, context);
  std::vector<GrowingStep> steps;
  if (!line.joints.empty()) steps = grownPath(line, px.breakpoints, params, StepRecord::Kept, context).steps;
  if (context.isCancelled()) return cancelled();
  for (GrowingStep& step : steps) {
    step.curve.start *= pixelMm;
    step.curve.edge *= pixelMm;
    step.distance *= pixelMm;
  }
  return steps;
}

}  // namespace batten
