// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameters_construct.h"

#include "core/pipeline/recipe/parameter_builders.h"

namespace batten::table {
namespace {

void appendMethod(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;  // a short name for the entries below
  table.push_back(choice<ConstructMethod>(
      kCurves,
      {"construct.method", "Method", "",
       "How a line becomes a curve: the fit to its points, or a method of the papers."},
      {{"fair", "True and fair fit", ConstructMethod::Fair},
       {"nurbs", "Quintic NURBS", ConstructMethod::Nurbs},
       {"bezier", "Bézier path", ConstructMethod::Bezier},
       {"typical", "Typical curves", ConstructMethod::Typical},
       {"control-polygon", "Control polygon", ConstructMethod::ControlPolygon}},
      [](auto& r) -> auto& { return r.construct.method; }));
  table.push_back(choice<ConstructStart>(
      kCurves,
      {"construct.start", "Start from", "",
       "Quintic NURBS, Bézier path, control polygon: starts from the edge points, or from their "
       "true and fair fit, which has little of their noise."},
      {{"line", "Edge points", ConstructStart::Line}, {"fit", "True and fair fit", ConstructStart::Fit}},
      [](auto& r) -> auto& { return r.construct.start; }));
}

void appendPathsOfThePapers(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;  // a short name for the entries below
  table.push_back(real(
      kCurves,
      {"construct.derivative_magnitude", "Derivative magnitude", "",
       "Quintic NURBS: length of the first derivatives, 1 = natural. Larger makes the curve fuller between stations."},
      {0.1, 3.0, 0.05, 2, true}, [](auto& r) -> auto& { return r.construct.derivativeMagnitude; }));
  table.push_back(boolean(
      kCurves,
      {"construct.magnitude_as_in_paper", "Magnitude as in the paper", "",
       "Quintic NURBS: one third of the distance between stations, for comparison; produces "
       "wiggles.",
       true},
      [](auto& r) -> auto& { return r.construct.magnitudeAsInPaper; }));
  table.push_back(choice<GradientUse>(
      kCurves,
      {"construct.gradients", "Gradients", "",
       "Quintic NURBS: which tangent directions are used in addition to the points; down-weighted: the lengths of the "
       "derivatives count little.",
       true},
      {{"all", "All", GradientUse::All},
       {"four", "Two at each end", GradientUse::Four},
       {"natural-ends", "None, natural ends", GradientUse::NaturalEnds},
       {"directions", "Directions, lengths down-weighted", GradientUse::Directions}},
      [](auto& r) -> auto& { return r.construct.gradients; }));
  table.push_back(boolean(
      kCurves,
      {"construct.equalise", "Equal curvature at joints", "",
       "Bézier path with smoothing length 0: both sides of a joint get the mean of their curvatures. "
       "Off: the curvature jumps at joints, as in the figures of the paper.",
       true},
      [](auto& r) -> auto& { return r.construct.equaliseJoints; }));
  table.push_back(choice<ConstructEnds>(
      kCurves,
      {"construct.ends", "Ends", "",
       "Quintic NURBS and Bézier path of open lines: to the ends of the line, or from the first segment's midpoint to "
       "the last, as in the papers.",
       true},
      {{"line", "Of the line", ConstructEnds::Line}, {"stations", "First and last segment", ConstructEnds::Stations}},
      [](auto& r) -> auto& { return r.construct.ends; }));
  table.push_back(real(
      kCurves,
      {"construct.lowpass", "Smoothing length", "stations",
       "Bézier path: length over which its curvature is smoothed. 0 is the path as in the paper; larger is smoother."},
      {0.0, 8.0, 0.25, 2}, [](auto& r) -> auto& { return r.construct.lowPass; }));
  table.push_back(real(
      kCurves,
      {"construct.closeness", "Maximum deviation", "px",
       "Quintic NURBS and Bézier path: adds stations where the curve deviates from the line by "
       "more than this. Larger: fewer stations, smoother curve; 0, a fixed count or Sturges' "
       "rule: no stations are added, as in the papers."},
      {0.0, 50.0, 0.1, 1}, [](auto& r) -> auto& { return r.construct.maxDeviationPx; }));
}

void appendTypical(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;  // a short name for the entries below
  table.push_back(choice<TypicalMode>(
      kCurves,
      {"construct.typical", "Segments of the chain", "",
       "Typical curves: all fitted together, or grown one after the other as in the paper."},
      {{"chain", "Fitted together", TypicalMode::Chain}, {"growing", "Grown", TypicalMode::Growing}},
      [](auto& r) -> auto& { return r.construct.typical; }));
  table.push_back(real(
      kCurves,
      {"construct.growing_stop", "Growing limit", "°",
       "Grown typical curves: a segment ends where its normal deviates from that of the line by "
       "this angle. Larger: longer segments."},
      {0.2, 20.0, 0.1, 1, true}, [](auto& r) -> auto& { return r.construct.growingStopDeg; }));
  table.push_back(boolean(
      kCurves,
      {"construct.growing_as_in_paper", "Growing as in the paper", "",
       "Grown typical curves: keeps each fit in full, for comparison; errors accumulate from "
       "segment to segment.",
       true},
      [](auto& r) -> auto& { return r.construct.growingAsInPaper; }));
}

void appendControlPolygon(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;  // a short name for the entries below
  table.push_back(integer(
      kCurves,
      {"construct.degree", "Degree", "",
       "Control polygon: degree of the curve. Larger is smoother and cuts corners more."},
      {2, 5, 1}, [](auto& r) -> auto& { return r.construct.degree; }));
  table.push_back(choice<SharpKnots>(
      kCurves,
      {"construct.knots", "Knots at corners", "",
       "Control polygon: degree equal knots make a sharp corner. As many as the order, as in the paper, break the "
       "curve there. Uniform knots have free ends: the curve ends short of its corners, for comparison."},
      {{"degree", "As the degree", SharpKnots::Degree},
       {"order", "As the order (paper)", SharpKnots::Order},
       {"uniform", "Uniform, free ends", SharpKnots::Uniform}},
      [](auto& r) -> auto& { return r.construct.knots; }));
  table.push_back(choice<PointRemoval>(
      kCurves,
      {"construct.removal", "Remove points by", "",
       "Control polygon: which points of the line are kept as control points. Corners and ends always are."},
      {{"step", "Distance", PointRemoval::Step}, {"tolerance", "Accuracy", PointRemoval::Tolerance}},
      [](auto& r) -> auto& { return r.construct.removal; }));
  table.push_back(real(
      kCurves,
      {"construct.removal_step", "Keep one point every", "px",
       "Control polygon: distance of the points that are kept. Larger keeps fewer; 0 keeps all."},
      {0.0, 200.0, 1.0, 0}, [](auto& r) -> auto& { return r.construct.removalStepPx; }));
  table.push_back(real(
      kCurves,
      {"construct.removal_tolerance", "Within", "px",
       "Control polygon: farthest that a removed point may lie from the polygon. Larger keeps fewer."},
      {0.0, 50.0, 0.1, 1}, [](auto& r) -> auto& { return r.construct.removalTolerancePx; }));
}

void appendFit(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;  // a short name for the entries below
  table.push_back(real(
      kCurves,
      {"construct.keep_extrema", "Extremum significance", "",
       "True and fair fit: minimum significance (chi square) of a curvature extremum that is "
       "kept. Larger keeps fewer."},
      {1.0, 1000.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.construct.extremumSignificance; }));
  table.push_back(boolean(
      kCurves,
      {"construct.light", "Light curves", "",
       "True and fair fit: fewest control points that preserve the curve and its curvature "
       "extrema; lines, arcs and circles become exact. Off: the dense curve of the fit."},
      [](auto& r) -> auto& { return r.construct.light; }));
  table.push_back(real(
      kCurves,
      {"construct.light_tolerance", "Light tolerance", "px",
       "Light curves: maximum deviation from the dense curve. Larger: fewer control points, and "
       "small extrema vanish."},
      {0.005, 50.0, 0.05, 3, true}, [](auto& r) -> auto& { return r.construct.lightTolerancePx; }));
  table.push_back(real(
      kCurves,
      {"construct.detail", "Detail", "",
       "Light curves: 0 follows the ink; larger values remove larger deviations, up to a quarter of "
       "the ink width, and keep sharp corners. Taken in steps of 0.1."},
      {0.0, 1.0, 0.1, 2}, [](auto& r) -> auto& { return r.construct.detail; }));
  table.push_back(boolean(
      kCurves,
      {"construct.smooth_ragged", "Smooth ragged outlines", "",
       "Light curves: outlines of dry brush, chalk and pencil tone are drawn with a detail of at least 0.8 where they "
       "are ragged. Off: they follow the ink as all others do."},
      [](auto& r) -> auto& { return r.construct.smoothRagged; }));
  table.push_back(real(
      kCurves,
      {"construct.reduce", "Fewer control points", "× noise",
       "True and fair fit without light curves: knot removal tolerance as a fraction of the "
       "edge noise. Larger: fewer control points; 0 keeps all."},
      {0.0, 1.0, 0.05, 2}, [](auto& r) -> auto& { return r.construct.knotRemovalTolerance; }));
}

}  // namespace

std::vector<Parameter> constructParameters() {
  std::vector<Parameter> table;
  appendMethod(table);
  appendPathsOfThePapers(table);
  appendTypical(table);
  appendControlPolygon(table);
  appendFit(table);
  return table;
}

}  // namespace batten::table
