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
       "Whether the borders of holes inside the ink are followed too. Automatic: those of shapes, as in letters, but "
       "not of a page that is followed by outlines alone."},
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
      {"edges.mode", "Follow", "",
       "What is traced: the middle of strokes, the outline of shapes, or whichever suits each piece of ink."},
      {{"auto", "Automatic", EdgeMode::Automatic},
       {"outline", "Outline", EdgeMode::Outline},
       {"centreline", "Centre line", EdgeMode::Centreline}},
      [](auto& r) -> auto& { return r.edges.mode; }));
  table.push_back(innerBordersParameter());
  table.push_back(boolean(
      kContours,
      {"edges.subpixel", "Sub-pixel placing", "",
       "Places the line on the grey values of the scan, far finer than a pixel. Off: pixel borders only."},
      [](auto& r) -> auto& { return r.edges.subpixel; }));
  table.push_back(real(
      kContours,
      {"edges.stroke_width", "Stroke limit", "",
       "Without effect: strokes and shapes are told apart region by region. Recipes that name it stay valid.", true},
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
  table.push_back(real(
      kContours,
      {"edges.spur", "Drop side branches", "stroke widths",
       "Side branches of a stroke shorter than this are dropped. Larger drops more.", true},
      {0.0, 5.0, 0.1, 1}, [](auto& r) -> auto& { return r.edges.spurFactor; }));
  table.push_back(real(
      kContours,
      {"edges.bend", "Continue through crossings", "°",
       "Strokes that bend less than this carry on through a crossing. Larger joins more.", true},
      {0.0, 90.0, 1.0, 0}, [](auto& r) -> auto& { return r.edges.maxBendDeg; }));
  table.push_back(real(
      kContours,
      {"contours.min_widths", "Shortest line", "stroke widths",
       "Lines shorter than this many widths of their stroke are left out. Larger keeps fewer lines."},
      {0.0, 100.0, 0.5, 1}, [](auto& r) -> auto& { return r.contours.minWidths; }));
  table.push_back(real(
      kContours,
      {"contours.min_length", "Shortest line in pixels", "px",
       "Lines shorter than this are left out too, whatever their width. Larger keeps fewer lines; 0 leaves it to the "
       "stroke widths."},
      {0.0, 100000.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.contours.minLengthPx; }));
  Parameter most = integer(
      kContours,
      {"contours.max_count", "Most lines", "",
       "Only this many lines are kept, the longest first; all (0) keeps every one.", true},
      {0, 100000, 1}, [](auto& r) -> auto& { return r.contours.maxCount; });
  most.minimumWord = "all";
  table.push_back(std::move(most));
}

void appendCornersAndSegments(std::vector<Parameter>& table) {
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.auto", "Certain corners", "",
       "Corners that are certain count without a mark. Off: only what is marked is a corner."},
      [](auto& r) -> auto& { return r.corners.automatic; }));
  table.push_back(real(
      StageId::Pieces,
      {"corners.snap", "Corner reach", "px",
       "Largest distance of a corner mark from its line. Larger reaches farther."},
      {1.0, 200.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.corners.snapDistancePx; }));
  table.push_back(boolean(
      StageId::Pieces,
      {"corners.exact", "Exact corners", "",
       "Puts the corner where its two sides meet when extended. Off: at the nearest point of the line."},
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
       "Segments per line; auto (0) derives the number from the length, otherwise at least 2. More follow the line "
       "closer."},
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
       "Quintic NURBS, Bézier path, control polygon: the edge points as they are, or where the true and fair fit of "
       "them "
       "lies, free of their noise."},
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
       "Quintic NURBS: one third of the distance of the stations, for comparison; it makes wiggles.", true},
      [](auto& r) -> auto& { return r.construct.magnitudeAsInPaper; }));
  table.push_back(choice<GradientUse>(
      kCurves,
      {"construct.gradients", "Gradients", "", "Quintic NURBS: which directions it uses beside the points.", true},
      {{"all", "All", GradientUse::All},
       {"four", "Two at each end", GradientUse::Four},
       {"natural-ends", "None, natural ends", GradientUse::NaturalEnds},
       {"directions", "Directions, lengths loosely", GradientUse::Directions}},
      [](auto& r) -> auto& { return r.construct.gradients; }));
  table.push_back(boolean(
      kCurves,
      {"construct.equalise", "Equal curvature at joints", "",
       "Bézier path without low pass: both sides of a joint take the mean of their curvatures. Off: the path before "
       "that, as in the figures of the paper; its curvature jumps.",
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
       "Quintic NURBS and Bézier path: where the curve would leave the line by more, stations are set closer. Larger: "
       "fewer, and calmer; 0, a set number of segments or Sturges' rule: only those given, as in the papers."},
      {0.0, 50.0, 0.1, 1}, [](auto& r) -> auto& { return r.construct.maxDeviationPx; }));
  table.push_back(choice<TypicalMode>(
      kCurves,
      {"construct.typical", "Segments of the chain", "",
       "Typical curves: all fitted together, or grown one after the other as in the paper."},
      {{"chain", "Fitted together", TypicalMode::Chain}, {"growing", "Grown", TypicalMode::Growing}},
      [](auto& r) -> auto& { return r.construct.typical; }));
  table.push_back(real(
      kCurves,
      {"construct.growing_stop", "Stop growing at", "°",
       "Grown typical curves: a segment ends where its normal leaves that of the line by this. Larger: longer "
       "segments."},
      {0.2, 20.0, 0.1, 1, true}, [](auto& r) -> auto& { return r.construct.growingStopDeg; }));
  table.push_back(boolean(
      kCurves,
      {"construct.growing_as_in_paper", "Growing as in the paper", "",
       "Grown typical curves: keeps every fit whole, for comparison; errors grow from segment to segment.", true},
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
       "True and fair fit: least significance of an extremum of curvature that is kept. Larger keeps fewer."},
      {1.0, 1000.0, 1.0, 0, true}, [](auto& r) -> auto& { return r.construct.extremumSignificance; }));
  table.push_back(boolean(
      kCurves,
      {"construct.light", "Light curves", "",
       "True and fair fit: the fewest control points that keep the curve and the extrema of its curvature; lines, arcs "
       "and circles exact. Off: the dense curve of the fit itself."},
      [](auto& r) -> auto& { return r.construct.light; }));
  table.push_back(real(
      kCurves,
      {"construct.light_tolerance", "Light within", "px",
       "Light curves: farthest that they lie from the dense curve. Larger: fewer control points, and smaller extrema "
       "go."},
      {0.005, 50.0, 0.05, 3, true}, [](auto& r) -> auto& { return r.construct.lightTolerancePx; }));
  table.push_back(real(
      kCurves,
      {"construct.detail", "Detail", "",
       "Light curves: 0 is true to the ink; larger leaves out ever larger bumps, up to a quarter of the width of the "
       "ink, and keeps sharp corners: what was meant. Taken in steps of 0.1."},
      {0.0, 1.0, 0.1, 2}, [](auto& r) -> auto& { return r.construct.detail; }));
  table.push_back(real(
      kCurves,
      {"construct.reduce", "Fewer control points", "× noise",
       "True and fair fit: how far the curve may move, as a part of the noise of the scan's edge, to need fewer "
       "control points. Larger: fewer points; 0 keeps all."},
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
                           "Target drawn: share of the length 0 to 1 and curvature in 1/mm, as in \"0:0.01 0.5:0.02 "
                           "1:0.01\"; a smooth curve "
                           "joins them."},
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
                           "Log-aesthetic target: the power of the radius that is linear in the length, -3 to 6: -1 "
                           "clothoid, 0 Nielsen's spiral, 1 logarithmic spiral, 2 involute; auto: what each span comes "
                           "nearest to.",
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
       "Off; towards a curvature profile; as even as the tolerance allows; curvature monotone between few extrema; or "
       "without its short waves."},
      {{"none", "None", FairingMode::None},
       {"target", "Target", FairingMode::Target},
       {"tolerance", "Smooth", FairingMode::Tolerance},
       {"monotone", "Monotone", FairingMode::Monotone},
       {"lowpass", "Low-pass", FairingMode::LowPass}},
      [](auto& r) -> auto& { return r.fairing.mode; }));
  table.push_back(choice<int>(
      kFaired,
      {"fairing.target", "Target", "",
       "Degree of the curvature profile; auto takes the recommended one, drawn the user's own (fairing.profile), "
       "log-aesthetic a power of the radius that is linear in the length. A larger degree follows the sketch closer."},
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
       "Which target is recommended: the simplest that is met within the tolerance without more extrema, or the one of "
       "the highest similarity S, as in the papers; S rises with the degree.",
       true},
      {{"simplest", "Simplest", TargetChoice::Simplest}, {"similarity", "Highest S (paper)", TargetChoice::Similarity}},
      [](auto& r) -> auto& { return r.fairing.targetChoice; }));
  table.push_back(real(
      kFaired,
      {"fairing.tolerance", "Tolerance", "mm",
       "Farthest the faired curve may leave the sketched one. Larger: fairer, less faithful."},
      {0.001, 20.0, 0.01, 3, true}, [](auto& r) -> auto& { return r.fairing.toleranceMm; }));
  table.push_back(choice<TolerancePolicy>(
      kFaired,
      {"fairing.spend", "Use the tolerance", "",
       "Within tolerance: until no wave is left that the line does not prove, or all of it, whatever was drawn."},
      {{"needed", "As needed", TolerancePolicy::AsNeeded}, {"all", "All of it", TolerancePolicy::All}},
      [](auto& r) -> auto& { return r.fairing.tolerancePolicy; }));
  table.push_back(choice<FairingMeans>(
      kFaired,
      {"fairing.moves", "Move", "",
       "Target and low-pass: all control points, or only the lengths of the edges of a Bézier path, whose directions "
       "stay."},
      {{"points", "Control points", FairingMeans::ControlPoints}, {"edges", "Edge lengths", FairingMeans::EdgeLengths}},
      [](auto& r) -> auto& { return r.fairing.means; }));
  table.push_back(profileParameter());
  table.push_back(alphaParameter());
  Parameter keep = integer(
      kFaired,
      {"fairing.keep_extrema", "Extrema to keep", "",
       "Monotone: places where the curvature may turn back; 0 is monotone from end to end, fewest (-1) keeps as few as "
       "the tolerance allows."},
      {-1, 99, 1}, [](auto& r) -> auto& { return r.fairing.keepExtrema; });
  keep.minimumWord = "fewest";
  table.push_back(std::move(keep));
  table.push_back(real(
      kFaired,
      {"fairing.lowpass", "Wavelength", "mm",
       "Low-pass: waves of the curvature of this length are halved, shorter ones go. Larger is smoother."},
      {0.1, 10000.0, 0.1, 1, true}, [](auto& r) -> auto& { return r.fairing.lowPassMm; }));
  table.push_back(choice<TargetSpans>(
      kFaired,
      {"fairing.spans", "Spans", "",
       "A target has one polynomial from each extremum of the curvature to the next, small ones left out; or one for "
       "the whole curve, as in the papers."},
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
       "Profiles never turn back, so the faired curve has no bump. Off: plain polynomials, as in the paper.", true},
      [](auto& r) -> auto& { return r.fairing.targets.monotone; }));
  table.push_back(integer(
      kFaired,
      {"fairing.samples", "Samples", "", "Places along the curve at which the profile is compared. Larger is slower.",
       true},
      {101, 2001, 20}, [](auto& r) -> auto& { return r.fairing.targets.samples; }));
  table.push_back(holdParameter(
      {"fairing.hold_start", "Hold at start", "", "What fairing leaves as it is at the start of an open curve."},
      [](auto& r) -> auto& { return r.fairing.startHold; }));
  table.push_back(holdParameter(
      {"fairing.hold_end", "Hold at end", "", "What fairing leaves as it is at the end of an open curve."},
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
