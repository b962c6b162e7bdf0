// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/curve_figures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/curve/arc_length.h"
#include "core/exchange/model/cubic_path.h"
#include "core/fairing/followed_target.h"

namespace batten {
namespace {

constexpr int kPlotSamples = 400, kCombSamples = 120;  // along a curve
/// [mm] Distance of drawn cubics from the curves, and what their coordinates are rounded to.
constexpr double kDrawnWithinMm = 0.001, kDrawnGridMm = 1e-7;
constexpr double kDrawingMarginMm = 5.0;                                          // around the drawing
constexpr double kSketchedWidthMm = 0.18, kFairedWidthMm = 0.25, kThinMm = 0.12;  // of lines
constexpr double kNumberOffsetMm = 1.2;                                           // of the number of a curve from it
/// Of the larger side of a curve: the longest quill of its comb.
constexpr double kLongestQuill = 0.3;
/// Times the extent of a curve: radii that a plot tells apart.
constexpr double kLeastRadius = 1e-4, kMostRadius = 20.0;
constexpr double kLeastDecades = 0.5;  ///< A nearly constant radius looks constant.
constexpr double kAxisLeftMm = 13.0, kAxisFootMm = 8.0, kAxisHeadMm = 2.0, kAxisRightMm = 3.0;  // room for labels
constexpr int kMostTicks = 7;                                                                   // of an axis
/// [mm] Height of the numbers at the axes, and of the row that each of them needs.
constexpr double kLabelHeightMm = 2.2, kLabelRowMm = 2.6;

/// The cubics of a curve in a figure whose upper left corner stands at `corner` of the model frame, or an error.
Result<void> addCurve(Figure& figure, const NurbsCurve& curve, const Vec2& corner, Ink ink, double widthMm) {
  Eigen::Matrix2d flip;
  flip << 1.0, 0.0, 0.0, -1.0;
  const auto path = cubicPath(curve.mapped(flip, Vec2(-corner.x(), corner.y())), {kDrawnWithinMm, kDrawnGridMm});
  if (!path) return fail(path.error());
  for (const CubicRun& run : path->runs) {
    FigureStroke stroke{{run.start}, true, false, ink, widthMm};
    for (const auto& cubic : run.cubics) stroke.points.insert(stroke.points.end(), cubic.begin(), cubic.end());
    figure.strokes.push_back(std::move(stroke));
  }
  return {};
}

double clampedRadiusOf(double kappa, double size) {
  const double radius = std::abs(kappa) > 0.0 ? 1.0 / std::abs(kappa) : kMostRadius * size;
  return std::clamp(radius, kLeastRadius * size, kMostRadius * size);
}

struct RadiusSeries {
  std::vector<double> s, radius;
  Ink ink = Ink::Sketched;
};

RadiusSeries seriesOf(const NurbsCurve& curve, double size, Ink ink, double lengthMm) {
  RadiusSeries series;
  series.ink = ink;
  const auto samples = sampleByArcLength(curve, kPlotSamples);
  const double scale = samples.back().s > 0.0 ? lengthMm / samples.back().s : 1.0;
  for (const CurveSample& sample : samples) {
    series.s.push_back(scale * sample.s);
    series.radius.push_back(clampedRadiusOf(sample.kappa, size));
  }
  return series;
}

/// Axes of a plot: length over a logarithmic radius.
struct RadiusAxes {
  double widthMm, heightMm, lengthMm, low, high;  ///< low < high [mm]
  double left() const { return kAxisLeftMm; }
  double right() const { return widthMm - kAxisRightMm; }
  double foot() const { return heightMm - kAxisFootMm; }
  Vec2 place(double s, double radius) const {
    const double across = left() + (right() - left()) * s / lengthMm;
    const double up = std::log(std::clamp(radius, low, high) / low) / std::log(high / low);
    return {across, foot() - (foot() - kAxisHeadMm) * up};
  }
};

void addAxes(Figure& figure, const RadiusAxes& axes) {
  const auto line = [&](const Vec2& a, const Vec2& b, Ink ink) {
    figure.strokes.push_back({{a, b}, false, false, ink, kThinMm});
  };
  // Whole decades are labelled first, then 2 and 5 times them where they leave room.
  std::vector<double> labelled;
  const double lowest = std::pow(10.0, std::floor(std::log10(axes.low)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    for (double radius = factor * lowest; radius <= axes.high * (1 + 1e-9); radius *= 10.0) {
      if (radius < axes.low * (1 - 1e-9)) continue;
      const double y = axes.place(0.0, radius).y();
      line({axes.left(), y}, {axes.right(), y}, Ink::Grid);
      const bool hasRoom = y > kAxisHeadMm + 0.5 * kLabelRowMm &&
                           std::all_of(labelled.begin(), labelled.end(),
                                       [&](double other) { return std::abs(other - y) >= kLabelRowMm; });
      if (!hasRoom) continue;
      labelled.push_back(y);
      figure.texts.push_back({{axes.left() - 1.2, y + 0.8},
                              significantText(radius, 3),
                              FigureText::Anchor::End,
                              Ink::Mute,
                              kLabelHeightMm});
    }
  }
  const double step = roundStep(axes.lengthMm, kMostTicks);
  for (int i = 0; i * step <= axes.lengthMm * (1 + 1e-9); ++i) {
    const double x = axes.place(i * step, axes.low).x();
    line({x, kAxisHeadMm}, {x, axes.foot()}, Ink::Grid);
    figure.texts.push_back(
        {{x, axes.foot() + 3.0}, significantText(i * step, 6), FigureText::Anchor::Middle, Ink::Mute, 2.2});
  }
  line({axes.left(), axes.foot()}, {axes.right(), axes.foot()}, Ink::Mute);
  line({axes.left(), kAxisHeadMm}, {axes.left(), axes.foot()}, Ink::Mute);
  figure.texts.push_back({{0.5 * (axes.left() + axes.right()), axes.heightMm - 1.4},
                          "arc length, mm",
                          FigureText::Anchor::Middle,
                          Ink::Mute,
                          2.2});
  figure.texts.push_back({{0.0, kAxisHeadMm - 0.2}, "radius, mm", FigureText::Anchor::Start, Ink::Mute, 2.2});
}

void addSeries(Figure& figure, const RadiusAxes& axes, const RadiusSeries& series) {
  FigureStroke stroke;
  for (std::size_t i = 0; i < series.s.size(); ++i) stroke.points.push_back(axes.place(series.s[i], series.radius[i]));
  stroke.ink = series.ink;
  stroke.isDashed = series.ink == Ink::Target;
  stroke.widthMm = series.ink == Ink::Faired ? kFairedWidthMm : kSketchedWidthMm;
  figure.strokes.push_back(std::move(stroke));
}

}  // namespace

std::optional<TargetProfile> targetOf(const TracedCurve& curve) {
  if (curve.fairingUsed.mode != FairingMode::Target) return std::nullopt;
  return followedTarget(curve.fairingStart(), curve.closed, curve.fairingUsed, curve.fairing);
}

bool isShownFaired(const TracedCurve& curve) { return !curve.faired.isEmpty() && !(curve.faired == curve.sketched); }

Result<Figure> drawingFigure(const std::vector<const TracedCurve*>& curves, const std::vector<int>& numbers) {
  Eigen::AlignedBox2d box;
  for (const TracedCurve* curve : curves) {
    for (const NurbsCurve* shape : {&curve->sketched, &curve->faired}) {
      if (shape->isEmpty()) continue;
      for (const CurveSample& sample : sampleByArcLength(*shape, kPlotSamples)) box.extend(sample.point);
    }
  }
  Figure figure;
  if (box.isEmpty()) return figure;
  const Vec2 margin(kDrawingMarginMm, kDrawingMarginMm);
  const Vec2 size = box.sizes() + 2.0 * margin;
  figure.widthMm = size.x();
  figure.heightMm = size.y();
  const Vec2 corner(box.min().x() - margin.x(), box.max().y() + margin.y());
  for (const TracedCurve* curve : curves) {
    if (!isShownFaired(*curve)) continue;
    if (auto added = addCurve(figure, curve->sketched, corner, Ink::Sketched, kSketchedWidthMm); !added)
      return fail(added.error());
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const NurbsCurve& shape = curves[i]->faired.isEmpty() ? curves[i]->sketched : curves[i]->faired;
    if (auto added = addCurve(figure, shape, corner, Ink::Faired, kFairedWidthMm); !added) return fail(added.error());
    const CurveSample middle = sampleByArcLength(shape, 3)[1];
    const Vec2 at(middle.point.x() - corner.x(), corner.y() - middle.point.y());
    const Vec2 aside(-middle.tangent.y(), -middle.tangent.x());
    figure.texts.push_back(
        {at + kNumberOffsetMm * aside, std::to_string(numbers[i]), FigureText::Anchor::Middle, Ink::Mute, 2.4});
  }
  return figure;
}

Figure combFigure(const TracedCurve& curve, double widthMm, double heightMm) {
  const NurbsCurve& shape = curve.faired.isEmpty() ? curve.sketched : curve.faired;
  const auto samples = sampleByArcLength(shape, kCombSamples);
  Eigen::AlignedBox2d box;
  double most = 0.0;
  for (const CurveSample& sample : samples) {
    box.extend(sample.point);
    most = std::max(most, std::abs(sample.kappa));
  }
  const double longest = kLongestQuill * std::max(box.sizes().x(), box.sizes().y());
  const auto tipOf = [&](const CurveSample& sample) {
    const Vec2 left(-sample.tangent.y(), sample.tangent.x());
    return Vec2(sample.point - (most > 0.0 ? longest * sample.kappa / most : 0.0) * left);
  };
  Eigen::AlignedBox2d whole = box;
  for (const CurveSample& sample : samples) whole.extend(tipOf(sample));
  const Vec2 size = whole.sizes();
  const double room = 3.0;
  const double scale =
      std::min((widthMm - 2 * room) / std::max(size.x(), 1e-9), (heightMm - 2 * room) / std::max(size.y(), 1e-9));
  const Vec2 middle = whole.center();
  const auto place = [&](const Vec2& p) {
    return Vec2(0.5 * widthMm + scale * (p.x() - middle.x()), 0.5 * heightMm - scale * (p.y() - middle.y()));
  };
  Figure figure;
  figure.widthMm = widthMm;
  figure.heightMm = heightMm;
  FigureStroke outline{{}, false, false, Ink::Comb, kThinMm};
  for (const CurveSample& sample : samples) {
    figure.strokes.push_back({{place(sample.point), place(tipOf(sample))}, false, false, Ink::Comb, 0.5 * kThinMm});
    outline.points.push_back(place(tipOf(sample)));
  }
  figure.strokes.push_back(std::move(outline));
  FigureStroke line{{}, false, false, Ink::Faired, kFairedWidthMm};
  for (const CurveSample& sample : sampleByArcLength(shape, kPlotSamples)) line.points.push_back(place(sample.point));
  figure.strokes.push_back(std::move(line));
  const std::string text = most > 0.0 ? "longest quill: R " + significantText(1.0 / most, 4) + " mm" : "straight";
  figure.texts.push_back({{room, heightMm - 1.4}, text, FigureText::Anchor::Start, Ink::Mute, 2.2});
  return figure;
}

Figure radiusFigure(const TracedCurve& curve, const std::optional<TargetProfile>& target, double widthMm,
                    double heightMm) {
  const bool hasFaired = isShownFaired(curve);
  const NurbsCurve& shape = hasFaired ? curve.faired : curve.sketched;
  const double size = extent(curve.sketched), lengthMm = ArcLength(shape).total();
  Figure figure;
  figure.widthMm = widthMm;
  figure.heightMm = heightMm;
  if (!(lengthMm > 0.0) || !(size > 0.0)) return figure;
  std::vector<RadiusSeries> all = {seriesOf(curve.sketched, size, hasFaired ? Ink::Sketched : Ink::Faired, lengthMm)};
  if (hasFaired) all.push_back(seriesOf(curve.faired, size, Ink::Faired, lengthMm));
  RadiusAxes axes{widthMm, heightMm, lengthMm, kMostRadius * size, kLeastRadius * size};
  for (const RadiusSeries& series : all) {
    const auto [low, high] = std::minmax_element(series.radius.begin(), series.radius.end());
    axes.low = std::min(axes.low, *low);
    axes.high = std::max(axes.high, *high);
  }
  // From the curves alone: a target that shoots off must not flatten them.
  const double widen = std::max(1.15, std::pow(10.0, 0.5 * (kLeastDecades - std::log10(axes.high / axes.low))));
  axes.low /= widen;
  axes.high *= widen;
  if (target) {
    RadiusSeries series;
    series.ink = Ink::Target;
    for (int i = 0; i < kPlotSamples; ++i) {
      const double f = i / (kPlotSamples - 1.0), kappa = target->curvatureAt(f);
      if (!std::isfinite(kappa)) continue;
      series.s.push_back(f * lengthMm);
      series.radius.push_back(clampedRadiusOf(kappa, size));
    }
    all.push_back(std::move(series));
  }
  addAxes(figure, axes);
  for (const RadiusSeries& series : all)
    if (series.s.size() > 1) addSeries(figure, axes, series);
  return figure;
}

}  // namespace batten
