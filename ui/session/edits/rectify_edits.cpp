// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/rectify_edits.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/image/rectified_scan.h"
#include "core/image/rectify/sheet_corners.h"
#include "core/image/rectify/sheet_map.h"
#include "core/pipeline/recipe/recipe_places.h"
#include "ui/session/editor_session.h"

namespace batten {
namespace {

// The page on which the places of the recipe lie; another one is shown as long as this one is being made.
std::optional<Rectification> pageOfRecipe(const EditorSession& session) {
  const RectifyParams& params = session.recipe().preparation.rectify;
  if (params.use == RectifyUse::Off) return std::nullopt;
  if (params.use == RectifyUse::Corners) {
    if (auto made = rectificationOf(*session.picture(), params.cornersPx, params.format)) return *made;
  }
  return session.scan()->rectification;
}

// Which page the places lie on is known only when the sheet has been looked for. If that was stopped or failed the page
// is the one shown.
bool isPageAwaited(const EditorSession& session) {
  const RectifyParams& params = session.recipe().preparation.rectify;
  return params.use == RectifyUse::Automatic && session.isBusy() && !isRectifiedAs(*session.scan(), params);
}

// Whether a side of the rectangle is an edge of paper, to which the corners were led by hand.
bool hasPaperEdge(const Scan& picture, const Rectification& made) {
  constexpr double kReachShare = 0.006;  // of the diagonal: the rim that is cut off a sheet
  const double reachPx = kReachShare * std::hypot(made.widthPx, made.heightPx) / made.scale;
  const auto isEdge = paperEdges(picture.grey, picture.colour, made.cornersPx, reachPx, {});
  return std::ranges::find(isEdge, true) != isEdge.end();
}

// How the picture would be rectified.
Result<Rectification> rectificationBy(const EditorSession& session, const RectifyParams& params) {
  if (isPageAwaited(session))
    return fail(ErrorCode::BadParameter, "The sheet is still being looked for; try again when the page is shown.");
  return rectificationOf(*session.picture(), params.cornersPx, params.format);
}

// Of another rectangle than a sheet, as a frame that was drawn, nothing is cut off; that ends with it.
bool isKeptForFrame(const EditorSession& session) {
  const auto now = pageOfRecipe(session);
  return session.recipe().preparation.sheet == SheetUse::Off && now && !hasPaperEdge(*session.picture(), *now);
}

}  // namespace

std::optional<SheetCorners> knownSheetCorners(const EditorSession& session) {
  const double width = session.scan()->grey.width, height = session.scan()->grey.height;
  if (session.scan()->rectification)
    return SheetCorners{Vec2(0, 0), Vec2(width, 0), Vec2(width, height), Vec2(0, height)};
  const auto& page = session.output().page;
  if (page && page->view) return page->view->rectification.cornersPx;
  return std::nullopt;
}

SheetCorners shownSheetCorners(const EditorSession& session) {
  constexpr double kMargin = 0.1;  // of the picture
  if (const auto known = knownSheetCorners(session)) return *known;
  const Vec2 size(session.scan()->grey.width, session.scan()->grey.height);
  const Vec2 low = kMargin * size, high = size - low;
  return {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
}

Result<void> rectifyBy(EditorSession& session, const SheetCorners& cornersPx) {
  RectifyParams params = withCorners(session.recipe().preparation.rectify, cornersPx);
  if (const auto& now = session.scan()->rectification) {
    const SheetMap map(*now);
    for (Vec2& corner : params.cornersPx) corner = map.toPicture(corner);
  }
  const auto made = rectificationBy(session, params);
  if (!made) return fail(made.error());
  Recipe after = rectifiedRecipe(session.recipe(), pageOfRecipe(session), *made, params);
  if (!hasPaperEdge(*session.picture(), *made))
    after.preparation.sheet = SheetUse::Off;
  else if (isKeptForFrame(session))
    after.preparation.sheet = SheetUse::CutOff;
  session.change(QObject::tr("Rectify"), std::move(after));
  return {};
}

Result<void> setSheetFormat(EditorSession& session, PaperFormat format) {
  const auto now = pageOfRecipe(session);
  if (!now) return {};
  const RectifyParams params{RectifyUse::Corners, now->cornersPx, format};
  const auto made = rectificationBy(session, params);
  if (!made) return fail(made.error());
  session.change(QObject::tr("Format of the sheet"), rectifiedRecipe(session.recipe(), now, *made, params));
  return {};
}

void stopRectifying(EditorSession& session) {
  if (isPageAwaited(session)) return;
  RectifyParams params;
  params.format = session.recipe().preparation.rectify.format;
  Recipe after = rectifiedRecipe(session.recipe(), pageOfRecipe(session), std::nullopt, params);
  if (isKeptForFrame(session)) after.preparation.sheet = SheetUse::CutOff;
  session.change(QObject::tr("Whole picture"), std::move(after));
}

}  // namespace batten
