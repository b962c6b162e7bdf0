// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe_places.h"

#include <algorithm>

#include "core/image/rectify/sheet_map.h"

namespace batten {
namespace {

/// [px] Farther out than any page: what lay beyond the horizon of the sheet's plane is put here, where nothing finds
/// it.
constexpr double kBeyondPagePx = 1e5;

/// From places of one page to places of another.
class BetweenPages {
 public:
  BetweenPages(const std::optional<Rectification>& before, const std::optional<Rectification>& after)
      : from_(before ? std::optional(SheetMap(*before)) : std::nullopt),
        to_(after ? std::optional(SheetMap(*after)) : std::nullopt) {}
  Vec2 operator()(const Vec2& place) const {
    const Vec2 picture = from_ ? from_->toPicture(place) : place;
    const Vec2 page = to_ ? to_->toPage(picture).value_or(Vec2(-kBeyondPagePx, -kBeyondPagePx)) : picture;
    return page.cwiseMax(-kBeyondPagePx).cwiseMin(kBeyondPagePx);
  }

 private:
  std::optional<SheetMap> from_, to_;
};

bool isSamePage(const std::optional<Rectification>& a, const std::optional<Rectification>& b) {
  if (!a || !b) return !a && !b;
  return a->cornersPx == b->cornersPx && a->widthPx == b->widthPx && a->heightPx == b->heightPx;
}

}  // namespace

void movePlaces(Recipe& recipe, const std::function<Vec2(const Vec2&)>& move, double scale) {
  const auto moveOne = [&](Vec2& place) { place = move(place); };
  const auto moveAll = [&](std::vector<Vec2>& places) { std::ranges::for_each(places, moveOne); };
  for (PenStroke& stroke : recipe.penStrokes) moveAll(stroke.points);
  for (RegionOfInterest& region : recipe.regions) moveAll(region.cornersPx);
  for (EdgeChoice& choice : recipe.edges.choices) moveOne(choice.positionPx);
  for (PaintedInk& painted : recipe.edges.painted) {
    moveAll(painted.coursePx);
    painted.radiusPx = scaledRadius(painted, scale);
  }
  for (JunctionChoice& choice : recipe.edges.junctions) {
    moveOne(choice.positionPx);
    for (BranchPair& pair : choice.pairs) {
      moveOne(pair.firstPx);
      moveOne(pair.secondPx);
    }
  }
  for (CornerMark& mark : recipe.cornerMarks) moveOne(mark.positionPx);
  moveAll(recipe.refusedCornersPx);
  for (SegmentPoint& point : recipe.segmentPoints) moveOne(point.positionPx);
  for (ExtremumChoice& choice : recipe.extremumChoices) moveOne(choice.positionPx);
  for (PieceChoice& choice : recipe.choices) {
    moveAll(choice.anchorsPx);
    moveAll(choice.keepPx);
    moveAll(choice.splitsPx);
    for (SpanChoice& span : choice.spanTargets) moveOne(span.placePx);
  }
  for (NumberedCurve& curve : recipe.curveNumbers.curves) moveAll(curve.placesPx);
  for (DirectionMark& mark : recipe.directions) {
    moveOne(mark.positionPx);
    moveOne(mark.towardsPx);
  }
  for (StartMark& mark : recipe.starts) moveOne(mark.positionPx);
  if (recipe.scaleLine) {
    moveOne(recipe.scaleLine->fromPx);
    moveOne(recipe.scaleLine->toPx);
  }
}

CurveNumbers rectifiedNumbers(CurveNumbers numbers, const std::optional<Rectification>& before,
                              const std::optional<Rectification>& after) {
  if (isSamePage(before, after)) return numbers;
  const BetweenPages move(before, after);
  for (NumberedCurve& curve : numbers.curves) {
    for (Vec2& place : curve.placesPx) place = move(place);
  }
  return numbers;
}

Recipe rectifiedRecipe(Recipe recipe, const std::optional<Rectification>& before,
                       const std::optional<Rectification>& after, const RectifyParams& params) {
  const double scale = (after ? after->scale : 1.0) / (before ? before->scale : 1.0);
  if (!isSamePage(before, after)) movePlaces(recipe, BetweenPages(before, after), scale);
  recipe.preparation.rectify = params;
  if (recipe.scaleLine)
    setScaleLine(recipe, ScaleLine(*recipe.scaleLine));
  else if (after && after->dpi)
    recipe.dpi.reset();
  else if (recipe.dpi)
    *recipe.dpi *= scale;
  return recipe;
}

}  // namespace batten
