// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameters_curves.h"

#include "core/pipeline/recipe/parameter_builders.h"
#include "core/pipeline/recipe/profile_text.h"

namespace batten::table {
namespace {

// Once it was a switch: files and commands may still say true and false.
Parameter innerBordersParameter() {
  Parameter inner = choice<InnerBorders>(
      StageId::Contours,
      {"edges.internal", "Inner outlines", "",
       "Whether borders of holes in the ink are traced. Automatic: those of shapes such as "
       "letters, but not where trace mode is Outline."},
      {{"auto", "Automatic", InnerBorders::Automatic},
       {"on", "Always", InnerBorders::On},
       {"off", "Never", InnerBorders::Off}},
      [](auto& r) -> auto& { return r.edges.internal; });
  inner.set = [byWord = inner.set](Recipe& r, std::string_view text) -> Result<void> {
    const std::string_view word = trimmed(text);
    if (word == "true" || word == "yes" || word == "1") return byWord(r, "on");
    if (word == "false" || word == "no" || word == "0") return byWord(r, "off");
    return byWord(r, text);
  };
  return inner;
}

void appendEdges(std::vector<Parameter>& table) {
  constexpr StageId kContours = StageId::Contours;
  table.push_back(choice<EdgeMode>(
      kContours,
      {"edges.mode", "Trace", "",
       "What is traced: the middle of strokes, the outline of shapes, or whichever suits each piece of ink."},
      {{"auto", "Automatic", EdgeMode::Automatic},
       {"outline", "Outline", EdgeMode::Outline},
       {"centreline", "Centre line", EdgeMode::Centreline}},
      [](auto& r) -> auto& { return r.edges.mode; }));
  table.push_back(innerBordersParameter());
  table.push_back(boolean(
      kContours,
      {"edges.subpixel", "Sub-pixel accuracy", "",
       "Locates the line on the grey values of the scan to a fraction of a pixel. Off: pixel "
       "borders only."},
      [](auto& r) -> auto& { return r.edges.subpixel; }));
  table.push_back(real(
      kContours,
      {"edges.stroke_width", "Stroke limit", "", "No effect; kept so that older recipes remain valid.", true},
      {0.005, 0.1, 0.001, 3, true}, [](auto& r) -> auto& { return r.edges.strokeWidth; }));
  table.push_back(real(
      kContours,
      {"edges.gap", "Bridge gaps", "stroke widths",
       "Longest gap between two stroke ends that is bridged. Larger joins more; 0 bridges none."},
      {0.0, 20.0, 0.5, 1}, [](auto& r) -> auto& { return r.edges.gapFactor; }));
  table.push_back(real(
      kContours,
      {"edges.merge", "Merge strokes", "stroke widths",
       "Strokes of one intended line that run closer than this become one line. Larger merges more; 0 is off."},
      {0.0, 20.0, 0.5, 1}, [](auto& r) -> auto& { return r.edges.mergeWidths; }));
  table.push_back(boolean(
      kContours,
      {"edges.intent", "Curves that were meant", "",
       "Lines drawn over more than once become the curves that were meant, strokes near and far apart alike. Pages "
       "without such lines stay as they are."},
      [](auto& r) -> auto& { return r.edges.intent; }));
  table.push_back(real(
      kContours,
      {"edges.spur", "Drop side branches", "stroke widths",
       "Side branches of a stroke shorter than this are dropped. Larger drops more.", true},
      {0.0, 5.0, 0.1, 1}, [](auto& r) -> auto& { return r.edges.spurFactor; }));
  table.push_back(real(
      kContours,
      {"edges.bend", "Continue through crossings", "°",
       "A stroke that bends by less than this continues through a crossing. Larger joins more.", true},
      {0.0, 90.0, 1.0, 0}, [](auto& r) -> auto& { return r.edges.maxBendDeg; }));
  table.push_back(real(
      kContours,
      {"contours.min_widths", "Shortest line", "stroke widths",
       "Lines shorter than this many widths of their stroke are left out. Larger keeps fewer lines."},
      {0.0, 100.0, 0.5, 1}, [](auto& r) -> auto& { return r.contours.minWidths; }));
  table.push_back(real(
      kContours,
      {"contours.min_length", "Shortest line in pixels", "px",
       "Lines shorter than this are also dropped, whatever their width. Larger keeps fewer "
       "lines; 0 uses the stroke widths only."},
      {0.0, 100000.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.contours.minLengthPx; }));
  Parameter most = integer(
      kContours,
      {"contours.max_count", "Maximum lines", "",
       "Keeps at most this many lines, the longest first; all (0) keeps every line.", true},
      {0, 100000, 1}, [](auto& r) -> auto& { return r.contours.maxCount; });
  most.minimumWord = "all";
  table.push_back(std::move(most));
}

void appendCornersAndSegments(std::vector<Parameter>& table) {
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.auto", "Certain corners", "",
       "Uses corners that are certain even if unmarked. Off: only marked corners."},
      [](auto& r) -> auto& { return r.corners.automatic; }));
  table.push_back(real(
      StageId::Pieces,
      {"corners.snap", "Corner reach", "px",
       "Largest distance of a corner mark from its line. Larger reaches farther."},
      {1.0, 200.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.corners.snapDistancePx; }));
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.exact", "Exact corners", "",
       "Places the corner where its two sides meet when extended. Off: at the nearest point of "
       "the line."},
      [](auto& r) -> auto& { return r.corners.exact; }));
  constexpr StageId kSegments = StageId::Segments;
  table.push_back(choice<SegmentMode>(
      kSegments,
      {"segments.mode", "Segments", "",
       "How a line is divided: stations at equal distance, Sturges' rule, a fixed count, or by accuracy."},
      {{"stations", "Equal stations", SegmentMode::Stations},
       {"sturges", "Sturges (paper)", SegmentMode::Sturges},
       {"count", "Fixed count", SegmentMode::Count},
       {"adaptive", "Adaptive", SegmentMode::Adaptive}},
      [](auto& r) -> auto& { return r.segments.mode; }));
  Parameter count = integer(
      kSegments,
      {"segments.count", "Number of segments", "",
       "Segments per line; auto (0) derives the number from the length, otherwise at least 2. "
       "More segments follow the line more closely."},
      {0, 2000, 1}, [](auto& r) -> auto& { return r.segments.count; });
  count.set = [inRange = count.set, name = count.name](Recipe& r, std::string_view text) -> Result<void> {
    const auto value = integerFromText(text);
    if (value && *value == 1) return refuse(name, text, "it must be 0 (from the length) or 2 to 2000");
    return inRange(r, text);
  };
  count.minimumWord = "auto";
  count.leastAbove = 2.0;
  table.push_back(std::move(count));
  table.push_back(real(
      kSegments,
      {"segments.spacing", "Spacing", "px",
       "Distance of the stations along the line. Larger: fewer control points and a smoother curve."},
      {8.0, 400.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.segments.spacingPx; }));
  table.push_back(real(
      kSegments,
      {"segments.tolerance", "Segment accuracy", "px",
       "Adaptive: largest distance of the line from its segments. Larger: fewer segments."},
      {0.02, 5.0, 0.01, 2, true}, [](auto& r) -> auto& { return r.segments.tolerancePx; }));
}

void appendControlPolygon(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;
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

void appendConstruct(std::vector<Parameter>& table) {
  constexpr StageId kCurves = StageId::Curves;
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
       "true and fair fit, which is free of noise."},
      {{"line", "Edge points", ConstructStart::Line}, {"fit", "True and fair fit", ConstructStart::Fit}},
      [](auto& r) -> auto& { return r.construct.start; }));
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
       "Quintic NURBS: which tangent directions are used in addition to the points.", true},
      {{"all", "All", GradientUse::All},
       {"four", "Two at each end", GradientUse::Four},
       {"natural-ends", "None, natural ends", GradientUse::NaturalEnds},
       {"directions", "Directions, lengths down-weighted", GradientUse::Directions}},
      [](auto& r) -> auto& { return r.construct.gradients; }));
  table.push_back(boolean(
      kCurves,
      {"construct.equalise", "Equal curvature at joints", "",
       "Bézier path without low pass: both sides of a joint get the mean of their curvatures. "
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
      {"construct.lowpass", "Low pass", "stations",
       "Bézier path: length over which its curvature is smoothed. 0 is the path as in the paper; larger is smoother."},
      {0.0, 8.0, 0.25, 2}, [](auto& r) -> auto& { return r.construct.lowPass; }));
  table.push_back(real(
      kCurves,
      {"construct.closeness", "Maximum deviation", "px",
       "Quintic NURBS and Bézier path: adds stations where the curve deviates from the line by "
       "more than this. Larger: fewer stations, smoother curve; 0, a fixed count or Sturges' "
       "rule: no stations are added, as in the papers."},
      {0.0, 50.0, 0.1, 1}, [](auto& r) -> auto& { return r.construct.maxDeviationPx; }));
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
  table.push_back(integer(
      kCurves,
      {"construct.degree", "Degree", "",
       "Control polygon: degree of the curve. Larger is smoother and cuts corners more."},
      {2, 5, 1}, [](auto& r) -> auto& { return r.construct.degree; }));
  appendControlPolygon(table);
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
       "Light curves: 0 follows the ink; larger values remove larger bumps, up to a quarter of "
       "the ink width, and keep sharp corners. Taken in steps of 0.1."},
      {0.0, 1.0, 0.1, 2}, [](auto& r) -> auto& { return r.construct.detail; }));
  table.push_back(real(
      kCurves,
      {"construct.reduce", "Fewer control points", "× noise",
       "True and fair fit without light curves: knot removal tolerance as a fraction of the "
       "edge noise. Larger: fewer control points; 0 keeps all."},
      {0.0, 1.0, 0.05, 2}, [](auto& r) -> auto& { return r.construct.knotRemovalTolerance; }));
}

/// The end condition as one choice: each step holds what the one before holds, and more.
template <class Field>
Parameter holdParameter(Words words, Field field) {
  return choice<EndHold>(StageId::Faired, std::move(words),
                         {{"position", "Position", {false, false}},
                          {"tangent", "Tangent", {true, false}},
                          {"curvature", "Tangent and curvature", {true, true}}},
                         field);
}

Parameter profileParameter() {
  Parameter p = described(StageId::Faired,
                          {"fairing.profile", "Drawn profile", "",
                           "Drawn target: pairs of arc length fraction (0 to 1) and curvature in 1/mm, such as "
                           "\"0:0.01 0.5:0.02 1:0.01\", joined by a smooth curve."},
                          ParameterType::Text);
  p.get = [](const Recipe& r) { return profileToText(r.fairing.profile); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    auto profile = profileFromText(text);
    if (!profile) return refuse(name, text, profile.error().message);
    r.fairing.profile = std::move(*profile);
    return {};
  };
  return p;
}

Parameter alphaParameter() {
  Parameter p = described(StageId::Faired,
                          {"fairing.alpha", "Alpha", "",
                           "Log-aesthetic target: the exponent for which radius^alpha is linear in arc length, -3 "
                           "to 6: -1 clothoid, 0 Nielsen's spiral, 1 logarithmic spiral, 2 involute; auto: best fit "
                           "of each span.",
                           true},
                          ParameterType::Text);
  p.get = [](const Recipe& r) { return r.fairing.alpha ? numberToText(*r.fairing.alpha) : std::string("auto"); };
  p.set = [name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    const std::string_view word = trimmed(text);
    if (word == "auto") {
      r.fairing.alpha.reset();
      return {};
    }
    const auto value = numberFromText(word);
    if (!value || !(*value >= kLeastAlpha && *value <= kMostAlpha))
      return refuse(name, text, "it must be auto or a number from -3 to 6");
    r.fairing.alpha = *value;
    return {};
  };
  return p;
}

void appendFairing(std::vector<Parameter>& table) {
  constexpr StageId kFaired = StageId::Faired;
  table.push_back(choice<FairingMode>(
      kFaired,
      {"fairing.mode", "Fairing", "",
       "None; towards a curvature profile; least variation of curvature within the tolerance; "
       "monotone curvature between few extrema; or without short waves."},
      {{"none", "None", FairingMode::None},
       {"target", "Target", FairingMode::Target},
       {"tolerance", "Smooth", FairingMode::Tolerance},
       {"monotone", "Monotone", FairingMode::Monotone},
       {"lowpass", "Low-pass", FairingMode::LowPass}},
      [](auto& r) -> auto& { return r.fairing.mode; }));
  table.push_back(choice<int>(
      kFaired,
      {"fairing.target", "Target", "",
       "Degree of the curvature profile; auto is the recommended one, drawn the one in "
       "fairing.profile, log-aesthetic a power of the radius linear in arc length. A higher "
       "degree follows the sketch more closely."},
      {{"auto", "Recommended", 0},
       {"1", "Degree 1", 1},
       {"2", "Degree 2", 2},
       {"3", "Degree 3", 3},
       {"4", "Degree 4", 4},
       {"5", "Degree 5", 5},
       {"6", "Degree 6", 6},
       {"drawn", "Drawn", kDrawnTarget},
       {"log-aesthetic", "Log-aesthetic", kLogAestheticTarget}},
      [](auto& r) -> auto& { return r.fairing.target; }));
  table.push_back(choice<TargetChoice>(
      kFaired,
      {"fairing.choose", "Recommended target", "",
       "How the recommended target is chosen: the simplest one reached within the tolerance "
       "without added extrema, or the one with the highest similarity S, as in the papers; S "
       "rises with the degree.",
       true},
      {{"simplest", "Simplest", TargetChoice::Simplest}, {"similarity", "Highest S (paper)", TargetChoice::Similarity}},
      [](auto& r) -> auto& { return r.fairing.targetChoice; }));
  table.push_back(real(
      kFaired,
      {"fairing.tolerance", "Tolerance", "mm",
       "Maximum distance of the faired curve from the sketched one. Larger: fairer, less faithful."},
      {0.001, 20.0, 0.01, 3, true}, [](auto& r) -> auto& { return r.fairing.toleranceMm; }));
  table.push_back(choice<TolerancePolicy>(
      kFaired,
      {"fairing.spend", "Use the tolerance", "",
       "Smooth: as needed removes only waves that the line does not support; all of it smooths "
       "as far as the tolerance allows."},
      {{"needed", "As needed", TolerancePolicy::AsNeeded}, {"all", "All of it", TolerancePolicy::All}},
      [](auto& r) -> auto& { return r.fairing.tolerancePolicy; }));
  table.push_back(choice<FairingMeans>(
      kFaired,
      {"fairing.moves", "Move", "",
       "Target and low-pass: move all control points, or only change the edge lengths of a "
       "Bézier path; edge directions are kept."},
      {{"points", "Control points", FairingMeans::ControlPoints}, {"edges", "Edge lengths", FairingMeans::EdgeLengths}},
      [](auto& r) -> auto& { return r.fairing.means; }));
  table.push_back(profileParameter());
  table.push_back(alphaParameter());
  Parameter keep = integer(
      kFaired,
      {"fairing.keep_extrema", "Extrema to keep", "",
       "Monotone: number of curvature extrema to keep; 0 is monotone from end to end, fewest "
       "(-1) keeps as few as the tolerance allows."},
      {-1, 99, 1}, [](auto& r) -> auto& { return r.fairing.keepExtrema; });
  keep.minimumWord = "fewest";
  table.push_back(std::move(keep));
  table.push_back(real(
      kFaired,
      {"fairing.lowpass", "Wavelength", "mm",
       "Low-pass: curvature waves of this length are halved, shorter ones removed. Larger is "
       "smoother."},
      {0.1, 10000.0, 0.1, 1, true}, [](auto& r) -> auto& { return r.fairing.lowPassMm; }));
  table.push_back(choice<TargetSpans>(
      kFaired,
      {"fairing.spans", "Spans", "",
       "One polynomial between consecutive significant curvature extrema, or one for the whole "
       "curve, as in the papers."},
      {{"natural", "Natural", TargetSpans::Natural}, {"whole", "Whole curve", TargetSpans::Whole}},
      [](auto& r) -> auto& { return r.fairing.targets.spans; }));
  table.push_back(choice<TargetQuantity>(
      kFaired,
      {"fairing.quantity", "Profile of", "",
       "What the profile describes: curvature (also through inflections) or radius, as in the papers.", true},
      {{"curvature", "Curvature", TargetQuantity::Curvature}, {"radius", "Radius", TargetQuantity::Radius}},
      [](auto& r) -> auto& { return r.fairing.targets.quantity; }));
  table.push_back(boolean(
      kFaired,
      {"fairing.monotone", "Monotone profiles", "",
       "Makes the profiles monotone, so that they add no curvature extrema. Off: plain "
       "polynomials, as in the papers.",
       true},
      [](auto& r) -> auto& { return r.fairing.targets.monotone; }));
  table.push_back(integer(
      kFaired,
      {"fairing.samples", "Samples", "",
       "Number of sample points at which the curve is compared with the profile. Larger is slower.", true},
      {101, 2001, 20}, [](auto& r) -> auto& { return r.fairing.targets.samples; }));
  table.push_back(holdParameter(
      {"fairing.hold_start", "Hold at start", "", "What fairing holds fixed at the start of an open curve."},
      [](auto& r) -> auto& { return r.fairing.startHold; }));
  table.push_back(holdParameter(
      {"fairing.hold_end", "Hold at end", "", "What fairing holds fixed at the end of an open curve."},
      [](auto& r) -> auto& { return r.fairing.endHold; }));
}

}  // namespace

void appendCurveParameters(std::vector<Parameter>& table) {
  appendEdges(table);
  appendCornersAndSegments(table);
  appendConstruct(table);
  appendFairing(table);
}

}  // namespace batten::table
