// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "core/fairing/profile/target_degrees.h"

namespace batten {
namespace {

/// Resolutions that a drawing can have: coarser or finer ones are typing errors.
constexpr double kMinDpi = 1.0, kMaxDpi = 100000.0;

std::optional<Error> bad(std::string message) { return Error{ErrorCode::BadParameter, std::move(message), {}}; }

/// [px] No page is larger: a place farther out is a typing error or damage.
constexpr double kFarthestPlacePx = 1e6;

bool isPlace(const Vec2& p) { return std::abs(p.x()) <= kFarthestPlacePx && std::abs(p.y()) <= kFarthestPlacePx; }
bool arePlaces(const std::vector<Vec2>& places) { return std::all_of(places.begin(), places.end(), isPlace); }

std::optional<Error> badPlace(const std::string& what) {
  return bad(what + " has an invalid position: x and y must be from -1000000 to 1000000 px.");
}

/// The first place of the recipe that no page can have.
std::optional<Error> validatePlaces(const Recipe& recipe) {
  for (const PenStroke& stroke : recipe.penStrokes) {
    if (!arePlaces(stroke.points)) return badPlace("A point of a pen stroke");
  }
  for (const RegionOfInterest& region : recipe.regions) {
    if (!arePlaces(region.cornersPx)) return badPlace("A corner of a region");
  }
  for (const EdgeChoice& choice : recipe.edges.choices) {
    if (!isPlace(choice.positionPx)) return badPlace("A trace mode choice");
  }
  for (const PaintedInk& painted : recipe.edges.painted) {
    if (!arePlaces(painted.coursePx)) return badPlace("A place of painted ink");
  }
  for (const JunctionChoice& choice : recipe.edges.junctions) {
    const auto arePlacesOf = [](const BranchPair& pair) { return isPlace(pair.firstPx) && isPlace(pair.secondPx); };
    if (!isPlace(choice.positionPx) || !std::ranges::all_of(choice.pairs, arePlacesOf))
      return badPlace("The pairing of a junction");
  }
  for (const CornerMark& mark : recipe.cornerMarks) {
    if (!isPlace(mark.positionPx)) return badPlace("A corner mark");
  }
  if (!arePlaces(recipe.refusedCornersPx)) return badPlace("An excluded corner");
  for (const SegmentPoint& point : recipe.segmentPoints) {
    if (!isPlace(point.positionPx)) return badPlace("A segment point");
  }
  for (const PieceChoice& choice : recipe.choices) {
    if (!arePlaces(choice.anchorsPx)) return badPlace("An anchor of a choice for a curve");
    if (!arePlaces(choice.keepPx)) return badPlace("An extremum kept by a choice for a curve");
    if (!arePlaces(choice.splitsPx)) return badPlace("A split in a choice for a curve");
    for (const SpanChoice& span : choice.spanTargets) {
      if (!isPlace(span.placePx)) return badPlace("A span in a choice for a curve");
      if (!isTargetDegree(span.degree))
        return bad("The target of a span must be 1 to " + std::to_string(kMostTargetDegree) + ".");
    }
  }
  for (const ExtremumChoice& choice : recipe.extremumChoices) {
    if (!isPlace(choice.positionPx)) return badPlace("A choice for a curvature extremum");
  }
  for (const DirectionMark& mark : recipe.directions) {
    if (!isPlace(mark.positionPx) || !isPlace(mark.towardsPx)) return badPlace("A direction of a curve");
    if (mark.positionPx == mark.towardsPx) return bad("A direction of a curve must lead from one place to another.");
  }
  for (const StartMark& mark : recipe.starts) {
    if (!isPlace(mark.positionPx)) return badPlace("The start of a curve");
  }
  if (recipe.scaleLine && !(isPlace(recipe.scaleLine->fromPx) && isPlace(recipe.scaleLine->toPx))) {
    return badPlace("The line by which the scale is measured");
  }
  return std::nullopt;
}

std::optional<Error> validateNumbers(const CurveNumbers& numbers) {
  // Far more than any drawing comes to; counting on from here still fits an int.
  constexpr int kMostNumbered = 1'000'000'000;
  if (!(numbers.lastGiven >= 0 && numbers.lastGiven <= kMostNumbered)) {
    return bad("The last number given to a curve must be 0 to 1000000000.");
  }
  std::set<int> given;
  for (const NumberedCurve& curve : numbers.curves) {
    if (!(curve.number >= 1 && curve.number <= kMostNumbered && given.insert(curve.number).second)) {
      return bad("Curves are numbered from 1 to 1000000000, each number once.");
    }
    if (curve.placesPx.empty() || curve.placesPx.size() > kMostPlacesOfCurve) {
      return bad("A numbered curve must have 1 to " + std::to_string(kMostPlacesOfCurve) + " places.");
    }
    if (!arePlaces(curve.placesPx)) return badPlace("A place of a numbered curve");
  }
  return std::nullopt;
}

/// No drawing has so many, and what a file may ask of the memory stays in proportion.
std::optional<Error> validateCounts(const Recipe& recipe) {
  constexpr std::size_t kMostEntries = 100'000;  // of each kind, in a recipe
  constexpr std::size_t kMostPairs = 100;        // of one junction
  for (const auto& [count, what] : {std::pair{recipe.cornerMarks.size(), "corner marks"},
                                    {recipe.refusedCornersPx.size(), "excluded corners"},
                                    {recipe.segmentPoints.size(), "segment points"},
                                    {recipe.choices.size(), "choices for curves"},
                                    {recipe.extremumChoices.size(), "choices for curvature extrema"},
                                    {recipe.edges.choices.size(), "trace mode choices"},
                                    {recipe.edges.painted.size(), "strokes of the trace brush"},
                                    {recipe.edges.junctions.size(), "paired junctions"},
                                    {recipe.regions.size(), "regions"},
                                    {recipe.directions.size(), "directions of curves"},
                                    {recipe.starts.size(), "starts of curves"},
                                    {recipe.penStrokes.size(), "pen strokes"}}) {
    if (count > kMostEntries)
      return bad("It holds " + std::to_string(count) + " " + what + "; at most " + std::to_string(kMostEntries) +
                 " can be used.");
  }
  for (const JunctionChoice& junction : recipe.edges.junctions) {
    if (junction.pairs.size() > kMostPairs)
      return bad("A paired junction holds " + std::to_string(junction.pairs.size()) + " pairs; at most " +
                 std::to_string(kMostPairs) + " can be used.");
  }
  return std::nullopt;
}

constexpr double kFarthestPageMm = 1e5;  // limit of input: 100 m from the origin

bool isPageSide(int px) { return px >= 16 && px <= 20000; }

std::optional<Error> validateChoice(const PieceChoice& choice) {
  // The rest has the ranges of the common settings.
  if (choice.detail && !(*choice.detail >= 0.0 && *choice.detail <= 1.0)) {
    return bad("The choice for a curve cannot be used. Its detail must lie between 0 and 1.");
  }
  if (auto wrong = validate(choice.fairing({}))) return bad("The choice for a curve cannot be used. " + wrong->message);
  return std::nullopt;
}

}  // namespace

FairingParams PieceChoice::fairing(FairingParams common) const {
  common.mode = mode.value_or(common.mode);
  common.target = target.value_or(common.target);
  common.toleranceMm = toleranceMm.value_or(common.toleranceMm);
  common.lowPassMm = lowPassMm.value_or(common.lowPassMm);
  common.keepExtrema = keepExtrema.value_or(common.keepExtrema);
  common.tolerancePolicy = tolerancePolicy.value_or(common.tolerancePolicy);
  common.means = means.value_or(common.means);
  common.startHold = startHold.value_or(common.startHold);
  common.endHold = endHold.value_or(common.endHold);
  common.targets.spans = spans.value_or(common.targets.spans);
  if (!profile.empty()) common.profile = profile;
  return common;
}

std::optional<Error> validate(const Recipe& recipe) {
  if (recipe.dpi && !(*recipe.dpi >= kMinDpi && *recipe.dpi <= kMaxDpi)) {
    return bad("The resolution must be between 1 and 100000 dpi.");
  }
  if (auto e = validate(recipe.scanPage)) return e;
  if (auto e = validateCounts(recipe)) return e;
  if (auto e = validatePlaces(recipe)) return e;
  if (recipe.scaleLine && !resolutionOf(*recipe.scaleLine)) {
    return bad("The line by which the scale is measured must have a length on the page and one in mm above 0.");
  }
  if (auto e = validate(recipe.log)) return e;
  if (auto e = validate(recipe.preparation)) return e;
  if (auto e = validate(recipe.threshold)) return e;
  if (auto e = validate(recipe.filter)) return e;
  if (auto e = validate(recipe.edges)) return e;
  if (auto e = validate(recipe.contours)) return e;
  for (const PenStroke& stroke : recipe.penStrokes) {
    if (auto e = validate(stroke)) return e;
  }
  if (recipe.page && !(isPageSide(recipe.page->widthPx) && isPageSide(recipe.page->heightPx))) {
    return bad("A page without a scan must be 16 to 20000 px wide and high.");
  }
  for (const ImportedFile& file : recipe.imports) {
    if (auto e = validate(file)) return e;
  }
  if (recipe.page &&
      !(std::abs(recipe.page->leftMm) <= kFarthestPageMm && std::abs(recipe.page->bottomMm) <= kFarthestPageMm))
    return bad("A page without a scan must lie within 100 m of the origin.");
  for (const RegionOfInterest& region : recipe.regions) {
    if (auto e = validate(region)) return e;
  }
  if (auto e = validate(recipe.corners)) return e;
  for (const CornerMark& mark : recipe.cornerMarks) {
    if (!(mark.roundMm >= 0.0 && mark.roundMm <= 500.0)) return bad("The rounding of a corner must be 0 to 500 mm.");
  }
  if (auto e = validate(recipe.segments)) return e;
  if (auto e = validate(recipe.construct)) return e;
  if (auto e = validate(recipe.fairing)) return e;
  for (const PieceChoice& choice : recipe.choices) {
    if (auto e = validateChoice(choice)) return e;
  }
  if (auto e = validateNumbers(recipe.curveNumbers)) return e;
  return std::nullopt;
}

}  // namespace batten
