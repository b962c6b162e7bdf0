// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_series.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/fairing.h"
#include "ui/session/edits/fairing_edits.h"

namespace batten {

double PlotSeries::at(double place) const {
  const auto next = std::ranges::lower_bound(points, place, {}, &PlotPoint::s);
  if (next == points.begin()) return points.front().value;
  if (next == points.end()) return points.back().value;
  const PlotPoint &from = *(next - 1), &to = *next;
  const double width = to.s - from.s;
  const double t = width > 0.0 ? (place - from.s) / width : 0.0;
  return from.value + t * (to.value - from.value);
}

namespace {

constexpr double kLargestRadius = 20.0;  // extents that a plot shows
/// Of the largest radius shown: where the lines of the radius end. So far above the plot that a line to a straight
/// stretch leaves it steeply.
constexpr double kFarAbove = 1000.0;
constexpr double kLeastSeen = 0.06;     // of the range that is shown: less of a line below its upper edge is a speck
constexpr double kMostlyBelow = 0.9;    // of the samples, on a linear axis
constexpr int kSamples = 400;           // along a curve
constexpr int kDeviationSamples = 160;  // along a curve
/// Of the mean: how far up and down the plot of the speed reaches at least.
constexpr double kLeastSpeedRange = 0.05;
/// Of the extent: ends that are nearer to each other than this from left to right lie above each other.
constexpr double kUpright = 0.1;

bool isFaired(const TracedCurve& curve) {
  return !curve.faired.isEmpty() && (curve.fairingUsed.mode != FairingMode::None || isChanged(curve));
}

void add(PlotData& data, PlotRole role, const std::vector<CurveSample>& samples, double scale, const auto& valueOf) {
  PlotSeries series{role};
  for (const CurveSample& sample : samples) {
    const double value = valueOf(sample);
    if (!std::isfinite(value)) continue;
    series.points.push_back({sample.s * scale, value});
  }
  if (series.points.size() > 1) data.series.push_back(std::move(series));
}

/// The samples with one more, of no curvature, wherever the curvature changes its sign between two: there the radius is
/// infinite, however far from either sample.
std::vector<CurveSample> withInflections(const std::vector<CurveSample>& samples) {
  std::vector<CurveSample> all;
  for (const CurveSample& sample : samples) {
    if (!all.empty() && all.back().kappa * sample.kappa < 0.0) {
      const CurveSample& before = all.back();
      CurveSample between = before;
      between.s = std::lerp(before.s, sample.s, before.kappa / (before.kappa - sample.kappa));
      between.kappa = 0.0;
      all.push_back(between);
    }
    all.push_back(sample);
  }
  return all;
}

std::optional<int> chosenDegree(const TracedCurve& curve, const TargetOutcomes& targets) {
  if (curve.fairingUsed.mode != FairingMode::Target || !isPolynomial(curve.fairingUsed.target)) return std::nullopt;
  const std::optional<int> asked = degreeOf(curve.fairingUsed.target);
  return asked ? asked : targets.recommendedDegree;
}

/// A profile at evenly spaced places and where its curvature changes its sign.
std::vector<PlotPoint> profilePoints(const TargetProfile& profile, int count, double lengthMm, const auto& valueOf) {
  std::vector<PlotPoint> points;
  const auto put = [&](double f, double kappa) {
    if (const double value = valueOf(kappa); std::isfinite(value)) points.push_back({f * lengthMm, value});
  };
  double before = 0.0;
  for (int i = 0; i < count; ++i) {
    const double f = i / (count - 1.0), kappa = profile.curvatureAt(f);
    if (before * kappa < 0.0) put((i - kappa / (kappa - before)) / (count - 1.0), 0.0);
    put(f, kappa);
    before = kappa;
  }
  return points;
}

void addTargets(PlotData& data, const EditorSession& session, const TracedCurve& curve, const auto& valueOf) {
  const auto targets = session.targets();
  if (!targets) return;
  const auto chosen = session.pointedSpan() ? chosenSpanTarget(session) : chosenDegree(curve, *targets);
  for (const TargetProfile& profile : targets->targets.profiles) {
    if (!profile.valid) continue;
    PlotSeries series{PlotRole::Target, profile.degree};
    if (profile.degree == chosen) series.role = PlotRole::ChosenTarget;
    if (profile.degree == session.hoveredTarget()) series.role = PlotRole::HoveredTarget;
    series.points = profilePoints(profile, kSamples / 2, data.lengthMm, valueOf);
    if (series.points.size() > 1) data.series.push_back(std::move(series));
  }
}

/// The drawn target as the recipe has it now, so that it follows the mouse and not the run.
void addDrawn(PlotData& data, const EditorSession& session, const TracedCurve& curve, const auto& valueOf) {
  // Natural spans meet at extrema, whose marks can be clicked: they are only shown where there is a target to split.
  if (fairingAsked(session).mode == FairingMode::Target || !hasNaturalSpans(session))
    for (const double f : splitsOf(session)) data.splits.push_back(f * data.lengthMm);
  if (fairingAsked(session).mode == FairingMode::Monotone)
    for (const double f : keptOf(session)) data.kept.push_back(f * data.lengthMm);
  if (!isTargetDrawn(session)) return;
  const FairingParams asked = fairingAsked(session);
  const TargetProfile profile = drawnProfile(asked.profile, curve.closed);
  if (!profile.valid) return;
  PlotSeries series{PlotRole::DrawnTarget};
  series.points = profilePoints(profile, kSamples, data.lengthMm, valueOf);
  if (series.points.size() > 1) data.series.push_back(std::move(series));
  for (const ProfilePoint& p : asked.profile) data.handles.push_back({p.fraction * data.lengthMm, valueOf(p.kappa)});
}

/// Range from the two curves alone: a target that shoots off must not flatten them. Of the curves themselves, single
/// peaks may leave it, but not where a mark can be clicked.
void fitRange(PlotData& data, double padding) {
  bool any = false;
  for (const PlotSeries& series : data.series) {
    if (series.role != PlotRole::Sketched && series.role != PlotRole::Faired) continue;
    std::vector<double> sorted;
    for (const PlotPoint& point : series.points)
      if (!data.most || point.value <= *data.most) sorted.push_back(point.value);
    if (sorted.empty()) continue;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t cut = sorted.size() / 100;
    const double low = sorted[cut], high = sorted[sorted.size() - 1 - cut];
    data.low = any ? std::min(data.low, low) : low;
    data.high = any ? std::max(data.high, high) : high;
    any = true;
  }
  if (!any && data.most) {  // straight: there is nothing but the way out
    data.low = 0.1 * *data.most;
    data.high = *data.most;
    any = true;
  }
  if (!any) return;
  for (const ExtremumMark& mark : data.marks) {
    if (!std::isfinite(mark.kappa)) continue;
    data.low = std::min(data.low, mark.kappa);
    data.high = std::max(data.high, mark.kappa);
  }
  if (data.logarithmic) {
    const double grow = std::max(1.15, std::pow(data.high / data.low, padding));
    data.low /= grow;
    data.high *= grow;
  } else {
    const double size = std::max(data.high - data.low, 1e-6 * std::max(std::abs(data.low), std::abs(data.high)));
    const double pad = size > 0 ? padding * size : 1.0;
    data.low -= pad;
    data.high += pad;
  }
  // Within the plot, where they can be dragged.
  for (PlotPoint& handle : data.handles)
    if (data.most) handle.value = std::min(handle.value, data.high);
}

/// A line that comes down from above the plot only to turn back at its upper edge is left out there: what is seen of it
/// would be a speck.
void dropSpecks(PlotData& data) {
  const auto levelOf = [&](double value) { return data.logarithmic ? std::log(std::max(value, 1e-300)) : value; };
  const double high = levelOf(data.high), edge = high - kLeastSeen * (high - levelOf(data.low));
  for (PlotSeries& series : data.series) {
    std::vector<PlotPoint>& points = series.points;
    for (std::size_t i = 0; i < points.size();) {
      std::size_t end = i;
      double lowest = high;
      while (end < points.size() && levelOf(points[end].value) < high)
        lowest = std::min(lowest, levelOf(points[end++].value));
      const bool isEnclosed = i > 0 && end < points.size();
      if (end > i && isEnclosed && lowest > edge)
        for (std::size_t k = i; k < end; ++k) points[k].value = std::max(points[i - 1].value, points[end].value);
      i = std::max(end, i) + 1;
    }
  }
}

/// [mm] Where a linear axis of the radius ends: straight stretches would press all others flat.
double linearLimit(const std::vector<CurveSample>& samples, double size) {
  std::vector<double> radii;
  for (const CurveSample& sample : samples)
    if (std::abs(sample.kappa) > 0.0) radii.push_back(1.0 / std::abs(sample.kappa));
  if (radii.empty()) return kLargestRadius * size;
  return std::min(kLargestRadius * size, 2.0 * lowerQuantile(radii, kMostlyBelow));
}

void addNoise(PlotData& data, const TracedCurve& curve, const std::vector<CurveSample>& sketched, double scale) {
  const std::vector<NoiseNote>& noise = curve.construct.noise;
  if (noise.size() < 2 || sketched.size() < 2) return;
  const double step = sketched.back().s / (static_cast<double>(sketched.size()) - 1.0);
  for (const auto& [s, sigma] : noise) {
    const double at = step > 0 ? s / step : 0.0;
    const long k = std::clamp(std::lround(at), 0L, static_cast<long>(sketched.size()) - 1);
    if (!std::isfinite(sigma) || !std::isfinite(s)) continue;
    data.noise.push_back({s * scale, sketched[k].kappa - 2 * sigma, sketched[k].kappa + 2 * sigma});
  }
}

/// Where two pieces of the shown curve meet (001 figures 11 to 14): knots of multiplicity 3 and more.
void addJoints(PlotData& data, const NurbsCurve& curve, double scale, const auto& valueAt) {
  PlotSeries joints{PlotRole::Joint};
  const auto knots = curve.knots();
  const ArcLength arc(curve);
  for (const double u : curve.breaks()) {
    if (u <= curve.start() || u >= curve.end() || std::count(knots.begin(), knots.end(), u) < 3) continue;
    const std::optional<double> value = valueAt(curve, u);
    if (!value) continue;
    joints.points.push_back({arc.at(u) * scale, *value});
  }
  if (!joints.points.empty()) data.series.push_back(std::move(joints));
}

void addDeviation(PlotData& data, const EditorSession& session, const TracedCurve& curve, double scale, Judged judged) {
  // Signed distance of the scan's edge points and of the faired curve from the sketched one, positive to the left.
  const ArcLength arc(curve.sketched);
  const ClosestPointFinder finder(curve.sketched);
  const auto measure = [&](const Vec2& p, PlotSeries& series) {
    const ClosestPoint hit = finder.closestTo(p);
    const auto d = curve.sketched.derivatives(hit.u, 1);
    const double side = cross(d[1], p - hit.point) < 0 ? -1.0 : 1.0;
    series.points.push_back({arc.at(hit.u) * scale, side * hit.distance});
  };
  const auto sorted = [](PlotSeries& series) {
    std::ranges::sort(series.points, {}, [](const PlotPoint& p) { return std::pair(p.s, p.value); });
  };
  PlotSeries drawn{PlotRole::Sketched};
  const auto& pieces = session.output().pieces;
  if (pieces && curve.piece >= 0 && curve.piece < std::ssize(pieces->pieces)) {
    const auto& px = pieces->pieces[curve.piece].points;
    const std::size_t step = std::max<std::size_t>(1, px.size() / kDeviationSamples);
    for (std::size_t i = 0; i < px.size(); i += step) measure(session.output().frame.pointToModel(px[i].at), drawn);
    sorted(drawn);
  }
  if (drawn.points.size() > 1) data.series.push_back(std::move(drawn));
  if (judged != Judged::Result || !isFaired(curve)) return;
  PlotSeries faired{PlotRole::Faired};
  for (const CurveSample& sample : sampleByArcLength(curve.faired, kDeviationSamples)) measure(sample.point, faired);
  sorted(faired);
  data.series.push_back(std::move(faired));
  const double tolerance = curve.fairingUsed.toleranceMm;
  for (const double sign : {-1.0, 1.0})
    data.series.push_back({PlotRole::Tolerance, {}, {{0.0, sign * tolerance}, {data.lengthMm, sign * tolerance}}});
}

bool runsLeft(const TracedCurve& curve, const PageFrame& frame) {
  if (curve.closed) return false;
  const Vec2 from = frame.pointToImage(curve.sketched.point(curve.sketched.start()));
  const Vec2 chord = frame.pointToImage(curve.sketched.point(curve.sketched.end())) - from;
  const bool isUpright = std::abs(chord.x()) < kUpright * frame.lengthToImage(extent(curve.sketched));
  return isUpright ? chord.y() < 0.0 : chord.x() < 0.0;
}

/// The selected curve as its plots need it.
struct SampledCurve {
  const TracedCurve& curve;
  std::vector<CurveSample> sketched;
  std::vector<CurveSample> faired;  ///< Empty where the sketched curve is judged alone.
  double scale = 1.0;               ///< Of lengths along the sketched curve on the axis.

  const NurbsCurve& shown() const { return faired.empty() ? curve.sketched : curve.faired; }
  double shownScale() const { return faired.empty() ? scale : 1.0; }
};

void addSketchedAndFaired(PlotData& data, const SampledCurve& sampled, const auto& valueOf) {
  add(data, PlotRole::Sketched, sampled.sketched, sampled.scale, valueOf);
  add(data, PlotRole::Faired, sampled.faired, 1.0, valueOf);
}

/// The curves and their targets. @param valueOfKappa what the axis shows of a curvature
void addWithTargets(PlotData& data, const EditorSession& session, const SampledCurve& sampled,
                    const auto& valueOfKappa) {
  addTargets(data, session, sampled.curve, valueOfKappa);
  addDrawn(data, session, sampled.curve, valueOfKappa);
  addSketchedAndFaired(data, sampled, [&](const CurveSample& sample) { return valueOfKappa(sample.kappa); });
}

void addRadius(PlotData& data, const EditorSession& session, SampledCurve sampled, bool isLinear) {
  sampled.sketched = withInflections(sampled.sketched);
  sampled.faired = withInflections(sampled.faired);
  data.logarithmic = !isLinear;
  const double size = extent(sampled.curve.sketched);
  const double most = isLinear ? linearLimit(sampled.sketched, size) : kLargestRadius * size;
  data.most = most;
  addWithTargets(data, session, sampled,
                 [=](double kappa) { return clampedRadius(kappa, size * 1e-4, kFarAbove * most); });
}

void addCurvature(PlotData& data, const EditorSession& session, const SampledCurve& sampled, Judged judged) {
  addNoise(data, sampled.curve, sampled.sketched, sampled.scale);
  addWithTargets(data, session, sampled, [](double kappa) { return kappa; });
  addJoints(data, sampled.shown(), sampled.shownScale(),
            [](const NurbsCurve& of, double u) { return curvature(of, u); });
  data.marks = extremumMarks(session, session.selectedCurve(), judged);
  for (ExtremumMark& mark : data.marks) mark.s *= mark.note ? sampled.scale : 1.0;
}

void addSlope(PlotData& data, const SampledCurve& sampled) {
  const auto slopeOf = [](const NurbsCurve& of) {
    return [&of](const CurveSample& sample) {
      return curvatureSlope(of, sample.u).value_or(std::numeric_limits<double>::quiet_NaN());
    };
  };
  add(data, PlotRole::Sketched, sampled.sketched, sampled.scale, slopeOf(sampled.curve.sketched));
  add(data, PlotRole::Faired, sampled.faired, 1.0, slopeOf(sampled.curve.faired));
}

void addSpeed(PlotData& data, const SampledCurve& sampled) {
  addSketchedAndFaired(data, sampled, [](const CurveSample& sample) { return sample.speed; });
  addJoints(data, sampled.shown(), sampled.shownScale(),
            [](const NurbsCurve& of, double u) { return std::optional(of.derivatives(u, 1)[1].norm()); });
}

/// Nearly even must look even, and not like its last digits.
void widenSpeedRange(PlotData& data) {
  const double middle = 0.5 * (data.low + data.high), least = kLeastSpeedRange * std::abs(middle);
  data.low = std::min(data.low, middle - least);
  data.high = std::max(data.high, middle + least);
}

}  // namespace

double clampedRadius(double kappa, double smallest, double largest) {
  const double size = std::abs(kappa);
  if (!std::isfinite(size)) return smallest;
  if (size * largest <= 1.0) return largest;
  return std::max(smallest, 1.0 / size);
}

PlotData plotData(const EditorSession& session, PlotTab tab, Judged judged, bool linearRadius) {
  PlotData data;
  const TracedCurve* curve = session.selected();
  if (!curve || curve->sketched.isEmpty()) return data;
  SampledCurve sampled{*curve, sampleByArcLength(curve->sketched, kSamples), {}};
  if (judged == Judged::Result && isFaired(*curve)) sampled.faired = sampleByArcLength(curve->faired, kSamples);
  // One axis for both: arc length of the curve that counts; the other is stretched by less than a hair.
  const double sketchedLength = sampled.sketched.back().s;
  data.lengthMm = sampled.faired.empty() ? sketchedLength : sampled.faired.back().s;
  if (!(data.lengthMm > 0) || !(sketchedLength > 0)) return {};
  sampled.scale = data.lengthMm / sketchedLength;
  switch (tab) {
    case PlotTab::Radius:
      addRadius(data, session, sampled, linearRadius);
      break;
    case PlotTab::Curvature:
      addCurvature(data, session, sampled, judged);
      break;
    case PlotTab::CurvatureSlope:
      addSlope(data, sampled);
      break;
    case PlotTab::Speed:
      addSpeed(data, sampled);
      break;
    case PlotTab::Deviation:
      addDeviation(data, session, *curve, sampled.scale, judged);
      break;
  }
  data.runsLeft = runsLeft(*curve, session.output().frame);
  fitRange(data, tab == PlotTab::Radius ? 0.06 : 0.12);
  if (tab == PlotTab::Radius) dropSpecks(data);
  if (tab == PlotTab::Speed) widenSpeedRange(data);
  return data;
}

}  // namespace batten
