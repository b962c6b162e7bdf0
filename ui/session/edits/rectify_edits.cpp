// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/rectify_edits.h"

#include <QObject>
#include <optional>
#include <utility>

#include "core/image/rectified_scan.h"
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

Result<void> change(EditorSession& session, const QString& what, const RectifyParams& params) {
  const auto made = rectificationOf(*session.picture(), params.cornersPx, params.format);
  if (!made) return fail(made.error());
  session.change(what, rectifiedRecipe(session.recipe(), pageOfRecipe(session), *made, params));
  return {};
}

}  // namespace

SheetCorners shownSheetCorners(const EditorSession& session) {
  constexpr double kMargin = 0.1;  // of the picture
  const auto& page = session.output().page;
  const double width = session.scan()->grey.width, height = session.scan()->grey.height;
  if (!session.scan()->rectification && page && page->view) return page->view->rectification.cornersPx;
  const double margin = session.scan()->rectification ? 0.0 : kMargin;
  const double x0 = margin * width, x1 = width - x0, y0 = margin * height, y1 = height - y0;
  return {Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)};
}

Result<void> rectifyBy(EditorSession& session, const SheetCorners& cornersPx) {
  RectifyParams params = withCorners(session.recipe().preparation.rectify, cornersPx);
  if (const auto& now = session.scan()->rectification) {
    const SheetMap map(*now);
    for (Vec2& corner : params.cornersPx) corner = map.toPicture(corner);
  }
  return change(session, QObject::tr("Rectify"), params);
}

Result<void> setSheetFormat(EditorSession& session, PaperFormat format) {
  const auto now = pageOfRecipe(session);
  if (!now) return {};
  return change(session, QObject::tr("Format of the sheet"), {RectifyUse::Corners, now->cornersPx, format});
}

void stopRectifying(EditorSession& session) {
  RectifyParams params;
  params.format = session.recipe().preparation.rectify.format;
  session.change(QObject::tr("Whole picture"),
                 rectifiedRecipe(session.recipe(), pageOfRecipe(session), std::nullopt, params));
}

}  // namespace batten
