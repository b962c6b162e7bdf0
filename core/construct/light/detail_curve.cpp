// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/detail_curve.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/angle.h"
#include "core/base/parallel.h"
#include "core/construct/light/detail_line.h"
#include "core/construct/light/light_corners.h"
#include "core/construct/light/light_search.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kStepsPerScale = 12.0;            // samples of the line
constexpr double kLeftOut = 1.2;                   // scales beside a corner, where ink is rounded
constexpr double kSmoothedBy = 0.4;                // scales
constexpr double kFitShare = 0.9;                  // of the tolerance; the rest is for the smoothing
constexpr double kClearNotch = 60.0 * kRadPerDeg;  // a corner that does not turn at large must turn by this
constexpr int kFewestStretchSamples = 16;          // steps of a stretch, however short it is
// control points of a stretch that are tried: at least up to, and no more than
constexpr int kFewestTried = 9, kMostDetailPoints = 60;
constexpr double kChordReach = 3.0;       // tolerances
constexpr int kMostCuts = 4;              // of a stretch, one within the other
constexpr double kSamplesPerPoint = 4.0;  // more control points than this allows would follow single samples
constexpr int kAnyNumber = std::numeric_limits<int>::max();  // of control points
constexpr int kFewestOfHalves = 3;                           // control points
constexpr int kMeasuredEvery = 3;                            // samples of the line

/// Points at even steps along a polyline, both ends included.
std::vector<Vec2> evenly(const std::vector<Vec2>& line, double step) {
  const std::vector<double> s = cumulativeLength(line);
  const int steps = std::max(kFewestStretchSamples, static_cast<int>(std::lround(s.back() / step)));
  std::vector<Vec2> points;
  std::size_t at = 0;
  for (int k = 0; k <= steps; ++k) {
    const double wanted = s.back() * k / steps;
    while (at + 2 < s.size() && s[at + 1] < wanted) ++at;
    const double width = s[at + 1] - s[at], f = width > 0.0 ? std::clamp((wanted - s[at]) / width, 0.0, 1.0) : 0.0;
    points.push_back(line[at] + f * (line[at + 1] - line[at]));
  }
  return points;
}

/// The line from one corner, or its start, to the next, or its end.
struct Stretch {
  std::optional<Vec2> from, to;  ///< The corners.
  int first = 0, last = 0;       ///< Samples; the last may pass the number of those of a closed line.
};

std::vector<Stretch> stretchesOf(const EvenLine& line, const std::vector<ScaleCorner>& corners) {
  std::vector<Stretch> stretches;
  const int n = line.size();
  if (line.closed) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const ScaleCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      stretches.push_back({a.vertex, b.vertex, a.sample, i + 1 < corners.size() ? b.sample : b.sample + n});
    }
    return stretches;
  }
  Stretch now{{}, {}, 0, 0};
  for (const ScaleCorner& corner : corners) {
    now.to = corner.vertex;
    now.last = corner.sample;
    stretches.push_back(now);
    now = {corner.vertex, {}, corner.sample, 0};
  }
  now.last = n - 1;
  stretches.push_back(now);
  return stretches;
}

std::vector<Vec2> pointsOf(const Stretch& stretch, const EvenLine& line, double scale) {
  const int away = static_cast<int>(std::lround(kLeftOut * scale / line.step));
  std::vector<Vec2> points;
  if (stretch.from) points.push_back(*stretch.from);
  const int first = stretch.first + (stretch.from ? away : 0), last = stretch.last - (stretch.to ? away : 0);
  for (int i = first; i <= last; ++i) points.push_back(line.points[i % line.size()]);
  if (stretch.to) points.push_back(*stretch.to);
  return points;
}

/// LightForms::All stands for a closed line.
LightCurve fitOf(const NurbsCurve& dense, const std::vector<Vec2>& points, LightForms forms,
                 const LightOptions& options, const RunContext& context) {
  const bool closed = forms == LightForms::All;
  const auto reference = LightReference::through(points, closed);
  if (!reference) return {};
  LightTask task;
  task.forms = forms;
  task.keepStructure = false;
  task.mostPoints = std::clamp(static_cast<int>(static_cast<double>(points.size()) / kSamplesPerPoint), kFewestTried,
                               kMostDetailPoints);
  LightOptions within = options;
  within.tolerance = kFitShare * options.tolerance;
  within.start = within.end = LightHold::Position;
  return searchLight(dense, *reference, within, task, context);
}

/// Where a stretch is farthest from its chord.
std::size_t farthestFromChord(const std::vector<Vec2>& points) {
  const Vec2& first = points.front();
  const Vec2 chord = points.back() - first;
  const double length = chord.norm();
  std::size_t at = points.size() / 2;
  double most = 0.0;
  for (std::size_t i = kFewestStretchSamples / 2; i + kFewestStretchSamples / 2 < points.size(); ++i) {
    const Vec2 away = points[i] - first;
    const double distance = length > 0.0 ? std::abs(cross(chord, away)) / length : away.norm();
    if (distance > most) {
      most = distance;
      at = i;
    }
  }
  return at;
}

/// What is left of a spike or a notch: a straight line, if no point lies farther from it than that.
std::optional<LightCurve> chordOf(const std::vector<Vec2>& points, double most) {
  const Vec2& first = points.front();
  const Vec2 chord = points.back() - first;
  const double length = chord.norm();
  if (!(length > 0.0)) return std::nullopt;
  for (const Vec2& p : points) {
    if (awayFromSegment(p, first, points.back()).norm() > most) return std::nullopt;
  }
  auto line = NurbsCurve::make(1, {0.0, 0.0, length, length}, {first, points.back()});
  if (!line) return std::nullopt;
  LightCurve curve{std::move(*line), {}};
  curve.report.kind = LightKind::Line;
  curve.report.points = 2;
  return curve;
}

/// No fewer control points have the curves of these parts together: raised to one degree, a part has no fewer than
/// before.
int pointsTogether(const std::vector<LightCurve>& parts) {
  int points = 1;
  for (const LightCurve& part : parts) points += part.curve.isEmpty() ? 1 : part.curve.controlPointCount() - 1;
  return points;
}

bool areAllFound(const std::vector<LightCurve>& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const LightCurve& part) {
    return !part.curve.isEmpty() && part.report.kind != LightKind::Dense;
  });
}

/// The curves of a stretch: one, or where none is found those of two parts of it, which meet in a corner. Where
/// LightOptions::mostPoints are too few, one that was not found.
std::vector<LightCurve> fitsOf(const NurbsCurve& dense, const std::vector<Vec2>& points, LightForms forms,
                               const LightOptions& options, int cuts, const RunContext& context) {
  LightCurve one = fitOf(dense, points, forms, options, context);
  if (areAllFound({one}) || forms == LightForms::All || context.isCancelled()) return {one};
  if (cuts == 0 || points.size() < 2 * kFewestStretchSamples) {
    if (auto chord = chordOf(points, kChordReach * options.tolerance)) return {*chord};
    return {one};
  }
  const bool isBounded = options.mostPoints < kAnyNumber;
  if (options.mostPoints < kFewestOfHalves) return {one};
  const auto at = points.begin() + static_cast<std::ptrdiff_t>(farthestFromChord(points));
  LightOptions half = options;
  if (isBounded) half.mostPoints = options.mostPoints - 1;
  auto parts = fitsOf(dense, {points.begin(), at + 1}, forms, half, cuts - 1, context);
  if (!areAllFound(parts)) return {tooManyPoints(dense)};
  if (isBounded) half.mostPoints = options.mostPoints + 1 - pointsTogether(parts);
  auto rest = fitsOf(dense, {at, points.end()}, forms, half, cuts - 1, context);
  if (!areAllFound(rest)) return {tooManyPoints(dense)};
  std::move(rest.begin(), rest.end(), std::back_inserter(parts));
  return parts;
}

/// The stretches from the shortest to the longest.
std::vector<std::size_t> byLength(const std::vector<std::vector<Vec2>>& stretches) {
  std::vector<std::size_t> order(stretches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stretches[a].size() < stretches[b].size(); });
  return order;
}

/// The curves of all stretches; none when they have more control points than are wanted. Without such a bound they
/// share the threads; with one they are made in turn, and the first ones that are too many end it.
std::optional<std::vector<std::vector<LightCurve>>> fitsOfAll(const NurbsCurve& dense,
                                                              const std::vector<std::vector<Vec2>>& stretches,
                                                              LightForms forms, bool closed,
                                                              const LightOptions& options, const RunContext& context) {
  std::vector<std::vector<LightCurve>> fits(stretches.size());
  if (forms == LightForms::All || options.mostPoints == kAnyNumber) {
    // One stretch without a curve is enough to give up: the long ones, which mostly are it, come first.
    const std::vector<std::size_t> order = byLength(stretches);
    std::atomic<bool> isHopeless = false;
    parallelFor(context, static_cast<int>(fits.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end && !context.isCancelled(); ++i) {
        const std::size_t at = order[std::ssize(order) - 1 - i];
        auto& own = fits[at];
        own.resize(1);
        if (isHopeless) continue;
        own = fitsOf(dense, stretches[at], forms, options, kMostCuts, context);
        if (!areAllFound(own)) isHopeless = true;
      }
    });
    return fits;
  }
  // Each stretch adds one point and more: those beyond are for this stretch. The short ones are quickly made, and leave
  // the long ones less to try.
  int spare = options.mostPoints - static_cast<int>(stretches.size()) - (closed ? 0 : 1);
  for (const std::size_t i : byLength(stretches)) {
    if (context.isCancelled()) break;
    if (spare < 0) return std::nullopt;
    LightOptions own = options;
    own.mostPoints = spare + 2;
    fits[i] = fitsOf(dense, stretches[i], forms, own, kMostCuts, context);
    if (!areAllFound(fits[i])) return std::nullopt;
    spare -= pointsTogether(fits[i]) - 2;
  }
  return fits;
}

double farthest(const EvenLine& line, const NurbsCurve& curve, const RunContext& context) {
  const ClosestPointFinder finder(curve, context);
  double worst = 0.0;
  for (int i = 0; i < line.size() && !context.isCancelled(); i += kMeasuredEvery) {
    worst = std::max(worst, finder.closestTo(line.points[i]).distance);
  }
  return worst;
}

/// With sections of these forms, where it has corners or is open.
std::optional<LightCurve> simplifiedTo(LightForms forms, const NurbsCurve& dense, bool closed,
                                       const LightOptions& options, const RunContext& context) {
  const double scale = options.tolerance;
  const EvenLine whole = evenLine(dense, closed, std::max(options.step, scale / kStepsPerScale));
  EvenLine line = whole;
  const int necks = cutNecks(line, scale, context);
  if (context.isCancelled()) return std::nullopt;
  std::vector<ScaleCorner> corners = cornersAtScale(line, scale);
  std::erase_if(corners, [](const ScaleCorner& c) { return !c.hard && std::abs(c.turnRad) < kClearNotch; });
  const bool loop = closed && corners.empty();
  const double sigma = kSmoothedBy * scale / line.step;
  std::vector<std::vector<Vec2>> stretches;
  if (loop) {
    stretches.push_back(smoothPolyline(line.points, true, sigma));
  } else {
    for (const Stretch& stretch : stretchesOf(line, corners)) {
      auto points = pointsOf(stretch, line, scale);
      if (points.size() < 2) return std::nullopt;
      stretches.push_back(smoothPolyline(evenly(points, line.step), false, sigma));
    }
  }
  const auto fits = fitsOfAll(dense, stretches, loop ? LightForms::All : forms, closed, options, context);
  if (context.isCancelled()) return std::nullopt;
  if (!fits) return tooManyPoints(dense);
  std::vector<LightCurve> parts;
  for (const auto& some : *fits) parts.insert(parts.end(), some.begin(), some.end());
  const int cuts = static_cast<int>(parts.size() - stretches.size());
  LightCurve simple;
  for (const LightCurve& part : parts) {
    if (part.curve.isEmpty() || part.report.kind == LightKind::Dense) return std::nullopt;
    simple.report.iterations += part.report.iterations;
    simple.report.tries += part.report.tries;
  }
  std::vector<NurbsCurve> curves;
  curves.reserve(parts.size());
  for (const LightCurve& part : parts) curves.push_back(part.curve);
  auto joined = joinedAtCorners(curves, scale);
  if (!joined) return std::nullopt;
  simple.curve = std::move(*joined);
  // Parts of a lower degree have been raised to that of the others: what counts is the curve that comes out.
  const bool isExact = parts.size() == 1 && (parts.front().report.kind == LightKind::Line || simple.curve.isRational());
  simple.report.points =
      isExact || loop ? parts.front().report.points : simple.curve.controlPointCount() - (closed ? 1 : 0);
  simple.report.kind = parts.size() == 1 ? parts.front().report.kind : LightKind::Chain;
  simple.report.sections = static_cast<int>(parts.size());
  simple.report.necks = necks;
  simple.report.corners = static_cast<int>(corners.size()) + cuts;
  simple.report.pointsBefore = dense.controlPointCount() - (closed ? dense.degree() : 0);
  if (simple.report.points > options.mostPoints) return tooManyPoints(dense);
  simple.report.worst = farthest(line, simple.curve, context);
  if (context.isCancelled()) return std::nullopt;
  simple.report.extrema = countedExtrema(simple.curve, closed);
  return simple;
}

}  // namespace

std::optional<LightCurve> simplifiedCurve(const NurbsCurve& dense, bool closed, const LightOptions& options,
                                          const RunContext& context) {
  // One quintic among many short sections would raise all of them to its degree.
  auto cubic = simplifiedTo(LightForms::UpToCubic, dense, closed, options, context);
  if (cubic || context.isCancelled()) return cubic;
  return simplifiedTo(LightForms::UpToQuintic, dense, closed, options, context);
}

}  // namespace batten
