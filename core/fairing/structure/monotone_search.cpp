// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/monotone_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/curve/extremum_indices.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/structure/monotone_program.h"

namespace batten {
namespace {

/// Constraints act at so many places a span at least; the result is checked at four times as many.
constexpr int kPlacesPerSpan = 8, kDenseFactor = 4;
/// Cut-off wave in mean spans of the term against staircases.
constexpr double kWaveSpans = 2.0;
/// Share of a sliding along the curve in the distance: it changes no shape, but far slides make the linear model wrong.
constexpr double kSlideShare = 0.01;
constexpr int kIterations = 20;  // at most, of programs
/// Programs in a row that bring nothing: curves whose curvature has peaks beyond all measure, such as near-cusps, of
/// which a linear model tells nothing.
constexpr int kMostStuck = 3;
/// After so many iterations windows stay, and steps are shortened: what has not settled by then swings.
constexpr int kFreeIterations = 6;
constexpr double kLateShare = 0.6;  // of a step
/// The least slope that is asked for, in units of the range of the curvature over the length, and its growth where the
/// curvature still turned between the places.
constexpr double kMargin = 1e-3, kMarginGrowth = 2.5;
/// Share of the least move that the last step may move the curve.
constexpr double kSettled = 5e-3;
/// Of the bound: places whose distance is less cannot reach it in one step.
constexpr double kNearBound = 0.25;
/// The unit of distances, as a part of the estimated move and at least of the least one: the squares of a program then
/// are about 1 where the curve is off by a tenth of its move.
constexpr double kUnitShare = 0.1, kLeastUnit = 0.05;
/// No step moves a control point by more than this, in the larger of the least and the estimated move.
constexpr double kLongestStep = 1.0;

/// By what the places of a span are multiplied. Where its parameter speed varies, the curvature turns within small
/// parts of it: once the speed has more than doubled twice as many, and once more as many for each further doubling.
int placeFactor(const SpanCurve& curve, int span) {
  constexpr int kLooks = 8, kMostTimes = 4;
  const SpanCurve::SpeedRange speed = curve.speedRange(span, kLooks);
  int times = 1;
  while (times < kMostTimes && speed.most > std::ldexp(speed.least, times)) ++times;
  return times;
}

std::vector<SpanPlace> checkPlaces(const SpanCurve& curve, int leastPerSpan) {
  const SpanBasis& basis = curve.basis();
  // Below degree 5 the slope of the curvature jumps at knots: both sides count.
  const bool smooth = basis.degree() >= 5;
  std::vector<SpanPlace> places;
  for (int span = 0; span < basis.spanCount(); ++span) {
    const int perSpan = leastPerSpan * placeFactor(curve, span);
    for (int k = 0; k < perSpan; ++k)
      places.push_back({span, static_cast<double>(k) / (smooth ? perSpan : perSpan - 1)});
  }
  if (smooth && !basis.isPeriodic()) places.push_back({basis.spanCount() - 1, 1.0});
  return places;
}

}  // namespace

/// The curve on its way.
struct MonotoneSearch::State {
  std::vector<Vec2> points;
  std::vector<Sample> samples;
  bool valid = false;
};

MonotoneSearch::MonotoneSearch(const FairingSetup& setup, double leastMoveMm, const RunContext& context)
    : setup_(setup),
      leastMoveMm_(leastMoveMm),
      context_(context),
      start_(setup.basis, setup.points),
      counted_(checkPlaces(start_, kPlacesPerSpan * kDenseFactor)),
      places_(checkPlaces(start_, kPlacesPerSpan)) {
  for (const SpanPlace& place : places_) sketched_.push_back(setup.sketchedPlace(place));
  wave_ = kWaveSpans * setup.start.length / setup.basis.spanCount();
  const State state = evaluate(setup.points, sketched_);
  if (!state.valid) return;
  double s = 0.0, low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    s_.push_back(s);
    kappa_.push_back(state.samples[i].curvature.kappa);
    s += state.samples[i].step;
    low = i == 0 ? kappa_[i] : std::min(low, kappa_[i]);
    high = i == 0 ? kappa_[i] : std::max(high, kappa_[i]);
  }
  flat_ = 1e-9 * std::max(std::abs(low), std::abs(high));
}

int MonotoneSearch::wrapped(int sample) const {
  const int count = static_cast<int>(places_.size());
  return setup_.closed ? (sample % count + count) % count : std::clamp(sample, 0, count - 1);
}

MonotoneSearch::State MonotoneSearch::evaluate(const std::vector<Vec2>& points,
                                               const std::vector<SpanPlace>& feet) const {
  State state;
  state.points = points;
  const SpanCurve curve(setup_.basis, points);
  const int count = static_cast<int>(places_.size());
  const double meanSpeed = setup_.start.length / (setup_.original.end() - setup_.original.start());
  for (int i = 0; i < count; ++i) {
    if (context_.isCancelled()) return state;
    const Jet jet = curve.at(places_[i], 4);
    if (!(jet[1].norm() > kCuspShare * meanSpeed) || !jet[0].allFinite()) return state;
    const SpanPlace foot = footPoint(setup_.reference, jet[0], feet[i]);
    const Jet base = setup_.reference.at(foot, 1), same = start_.at(places_[i], 0);
    Sample& sample = state.samples.emplace_back();
    sample.jet = jet;
    sample.curvature = curvatureJet(jet);
    sample.foot = foot;
    sample.tangent = base[1].norm() > 0.0 ? Vec2(base[1].normalized()) : Vec2(Vec2::UnitX());
    sample.normal = leftNormal(sample.tangent);
    sample.distance = (jet[0] - base[0]).dot(sample.normal);
    sample.slide = (jet[0] - same[0]).dot(sample.tangent);
  }
  const double unit = setup_.start.length / setup_.basis.spanCount();
  for (int i = 0; i < (setup_.closed ? count : count - 1); ++i) {
    const int next = (i + 1) % count;
    // Corrected trapezoid of the speed; the last place of a span belongs to the next one's begin where they coincide.
    const SpanPlace &a = places_[i], &b = places_[next];
    const double width = (b.span == a.span ? b.tau - a.tau : 1.0 - a.tau + b.tau) * setup_.basis.width(a.span);
    Sample &from = state.samples[i], &to = state.samples[next];
    from.step = 0.5 * width * (from.curvature.speed + to.curvature.speed);
    from.weight += 0.5 * from.step / unit;
    to.weight += 0.5 * from.step / unit;
  }
  state.valid = true;
  return state;
}

std::vector<MonotoneSearch::Window> MonotoneSearch::windows(const CurvatureStructure& structure) const {
  std::vector<Window> result;
  const int count = static_cast<int>(places_.size()), extrema = static_cast<int>(structure.extrema.size());
  for (int j = 0; j < extrema; ++j) {
    const int here = structure.extrema[j].sample;
    int before = j > 0 ? structure.extrema[j - 1].sample : -1,
        after = j + 1 < extrema ? structure.extrema[j + 1].sample : count;
    if (setup_.closed && j == 0) before = structure.extrema.back().sample - count;
    if (setup_.closed && j + 1 == extrema) after = structure.extrema.front().sample + count;
    // By number: where places are dense, the curvature turns within a shorter way.
    const int left = std::max((here - before) / 4, here - before > 3 ? 1 : 0);
    const int right = std::max((after - here) / 4, after - here > 3 ? 1 : 0);
    const int half = std::min(left, right);
    Window window{here - half, here + half, structure.extrema[j].maximum};
    if (!setup_.closed) {
      window.low = std::max(window.low, 0);
      window.high = std::min(window.high, count - 1);
    }
    result.push_back(window);
  }
  return result;
}

void MonotoneSearch::recentre(CurvatureStructure& structure, const std::vector<Window>& windows,
                              const State& state) const {
  const auto kappaAt = [&](int i) { return state.samples[wrapped(i)].curvature.kappa; };
  for (std::size_t j = 0; j < windows.size(); ++j) {
    const double sign = windows[j].maximum ? 1.0 : -1.0;
    int best = windows[j].low;
    for (int i = windows[j].low; i <= windows[j].high; ++i) {
      if (sign * kappaAt(i) > sign * kappaAt(best)) best = i;
    }
    // An extremum in the middle of its window is left there, or two of them would swing to and fro.
    const int centre = (windows[j].low + windows[j].high) / 2, half = (windows[j].high - windows[j].low) / 2;
    if (10 * std::abs(best - centre) > 7 * half) structure.extrema[j].sample = wrapped(best);
  }
}

void MonotoneSearch::addDistance(Program& program, const State& state, const Scales& scales) const {
  const int degree = setup_.basis.degree();
  LocalRow row;
  for (std::size_t i = 0; i < places_.size() && !context_.isCancelled(); ++i) {
    const SpanRow basis = setup_.basis.row(places_[i], 0);
    const auto along = [&](const Vec2& direction) {
      row.fill(Vec2::Zero());
      for (int j = 0; j <= degree; ++j) row[j] = basis.d[0][j] * direction;
      return program.localRow(places_[i].span, row);
    };
    const Sample& sample = state.samples[i];
    const double w = sample.weight / (scales.distance * scales.distance);
    const Program::Row normal = along(sample.normal);
    program.addSquare(normal, sample.distance, w);
    // Places far inside the bound cannot reach it in one step, and every second one is dense enough.
    if (scales.bound && i % 2 == 0 && std::abs(sample.distance) >= kNearBound * *scales.bound) {
      program.addBound(normal, -1.0, sample.distance - *scales.bound);
      program.addBound(normal, 1.0, -*scales.bound - sample.distance);
    }
    program.addSquare(along(sample.tangent), sample.slide, kSlideShare * w);
  }
}

void MonotoneSearch::addBend(Program& program, const State& state, const Scales& scales) const {
  const double lambda = std::pow(wave_ / (2.0 * std::numbers::pi), 8.0) / (scales.distance * scales.distance);
  const double unit = setup_.start.length / setup_.basis.spanCount();
  const int count = static_cast<int>(places_.size());
  for (int i = 0; i < (setup_.closed ? count : count - 1) && !context_.isCancelled(); ++i) {
    const int next = (i + 1) % count;
    const double step = state.samples[i].step;
    if (!(step > 1e-9 * unit)) continue;
    const Program::Row row = program.difference(i, next);
    const double change = state.samples[next].curvature.slope - state.samples[i].curvature.slope;
    program.addSquare(row, change, lambda / (step * unit));
  }
}

void MonotoneSearch::addSigns(Program& program, const State& state, const CurvatureStructure& structure,
                              const Scales& scales) const {
  const std::vector<Window> all = windows(structure);
  const int count = static_cast<int>(places_.size());
  const auto slope = [&](int i) { return state.samples[wrapped(i)].curvature.slope; };
  const auto rising = [&](int i, double sign, double margin) {
    program.addBound(program.slope(wrapped(i)), sign, margin - sign * slope(i));
  };
  const auto stretch = [&](int from, int to, double sign) {  // between windows, their borders not included
    for (int i = from; i < to && !context_.isCancelled(); ++i) rising(i, sign, scales.margin);
  };
  if (all.empty()) return stretch(0, count, structure.rising ? 1.0 : -1.0);
  for (std::size_t j = 0; j < all.size() && !context_.isCancelled(); ++j) {
    const Window& w = all[j];
    const double sign = w.maximum ? 1.0 : -1.0;
    if (!setup_.closed && j == 0) stretch(0, w.low, sign);
    // A window of one place: the extremum lies about there, and its neighbours fix the rest.
    if (w.low < w.high) {
      rising(w.low, sign, 0.0);
      rising(w.high, -sign, 0.0);
    }
    for (int i = w.low; i < w.high; ++i) {
      const Program::Row row = program.difference(wrapped(i), wrapped(i + 1));
      const double change = slope(i + 1) - slope(i);
      program.addBound(row, -sign, sign * change);
    }
    const bool last = j + 1 == all.size();
    const int end = !last ? all[j + 1].low : setup_.closed ? all.front().low + count : count;
    stretch(w.high + 1, end, -sign);
  }
}

MonotoneSearch::Outcome MonotoneSearch::solve(CurvatureStructure structure, const std::vector<Vec2>& start,
                                              double estimateMm, const Limits& limits) const {
  Outcome outcome;
  outcome.points = start;
  State state = evaluate(start, sketched_);
  if (!state.valid) return outcome;
  const auto [low, high] = std::minmax_element(kappa_.begin(), kappa_.end());
  Scales scales{std::max(kLeastUnit * leastMoveMm_, kUnitShare * estimateMm),
                kMargin * (*high - *low) / setup_.start.length, limits.boundMm};
  int stuck = 0;  // programs in a row
  for (; outcome.iterations < kIterations && !context_.isCancelled(); ++outcome.iterations) {
    Program program(setup_, places_, state.samples, context_);
    if (context_.isCancelled()) break;
    addDistance(program, state, scales);
    addBend(program, state, scales);
    addSigns(program, state, structure, scales);
    if (context_.isCancelled()) break;
    const std::vector<Window> used = windows(structure);
    const auto solution = program.solve(limits.boundMm.has_value());
    stuck = solution && solution->isStuck ? stuck + 1 : 0;
    if (!solution || stuck >= kMostStuck) break;
    double moved = 0.0;
    std::vector<Vec2> points = state.points;
    std::vector<SpanPlace> feet;
    for (const Sample& sample : state.samples) feet.push_back(sample.foot);
    setup_.unknowns.move(solution->step, points);
    for (std::size_t i = 0; i < points.size(); ++i) moved = std::max(moved, (points[i] - state.points[i]).norm());
    // The linear model of the curvature holds for small moves only.
    const double longest = kLongestStep * std::max(leastMoveMm_, estimateMm);
    if (const double share = std::min(longest / moved, outcome.iterations < kFreeIterations ? 1.0 : kLateShare);
        share < 1.0) {
      for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = state.points[i] + share * (points[i] - state.points[i]);
    }
    State next = evaluate(points, feet);
    if (!next.valid) break;
    state = std::move(next);
    if (outcome.iterations < kFreeIterations) recentre(structure, used, state);
    const auto isFar = [&](const Sample& sample) { return std::abs(sample.distance) > *limits.giveUpMm; };
    if (limits.giveUpMm && std::any_of(state.samples.begin(), state.samples.end(), isFar)) {
      outcome.found = false;
      break;
    }
    const bool settled = moved < kSettled * std::max(leastMoveMm_, estimateMm);
    if (countAllExtrema(state.points) == std::ssize(structure.extrema)) {
      outcome.found = true;
      outcome.points = state.points;
      if (settled) break;
    } else if (settled || outcome.iterations >= kFreeIterations) {
      scales.margin *= kMarginGrowth;
    }
  }
  if (outcome.found) outcome.deviationMm = largestDeviation(setup_, outcome.points, true);
  return outcome;
}

int MonotoneSearch::countAllExtrema(const std::vector<Vec2>& points) const {
  const SpanCurve curve(setup_.basis, points);
  std::vector<double> kappa;
  kappa.reserve(counted_.size());
  for (const SpanPlace& place : counted_) {
    if (context_.isCancelled()) return 0;
    kappa.push_back(curvatureJet(curve.at(place, 2)).kappa);
  }
  return countExtrema(kappa, flat_, setup_.closed);
}

}  // namespace batten
