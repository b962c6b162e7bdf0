// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/corner_tool.h"

#include <QCoreApplication>
#include <QPen>
#include <cmath>

#include "core/base/angle.h"
#include "core/contour/corner/corner_suggestions.h"
#include "ui/canvas/layers/corner_layer.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/canvas/tools/point_tool.h"
#include "ui/session/suggestion_source.h"

namespace batten {
namespace {

QString cornerText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class CornerTool final : public PointTool {
 public:
  using PointTool::PointTool;

  void paint(QPainter& painter) override {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colors::corner(), 1.4, Qt::DotLine));
    for (const CornerSuggestion& suggestion : scene_.session.suggestions().found())
      if (!foundAt(suggestion.positionPx, scene_.session.recipe().corners.snapDistancePx) &&
          !nearest(suggestion.positionPx, scene_.session.recipe().corners.snapDistancePx))
        painter.drawEllipse(scene_.transform.toWidget(suggestion.positionPx), 7.0, 7.0);
    if (const Index mark = selected()) {
      painter.setPen(QPen(colors::corner(), 1.2));
      const QPointF at = scene_.transform.toWidget(shown(*mark));
      painter.drawRect(QRectF(at - QPointF(9.0, 9.0), QSizeF(18.0, 18.0)));
    }
    if (hovered() && *hovered() < count()) {
      const QPointF at = scene_.transform.toWidget(shown(*hovered()));
      paintCornerSquare(painter, at, 6.5, colors::corner(), false);
      paintLabel(painter, scene_, angleText(*hovered()), at);
    } else if (const Corner* found = hoveredFound()) {
      const QPointF at = scene_.transform.toWidget(found->positionPx);
      paintFoundCorner(painter, at, 7.5, colors::corner());
      paintLabel(painter, scene_, turnText(*found), at);
    } else if (snapped()) {
      const QPointF at = scene_.transform.toWidget(*snapped());
      painter.setPen(QPen(Qt::white, 4.0));
      painter.drawEllipse(at, 6.0, 6.0);
      painter.setPen(QPen(colors::corner(), 2.0));
      painter.drawEllipse(at, 6.0, 6.0);
    }
    painter.restore();
  }

 protected:
  Steps steps() const override {
    return {cornerText("Mark corner"), cornerText("Move corner"), cornerText("Remove corner")};
  }
  std::size_t count() const override { return marks().size(); }
  Vec2 stored(std::size_t mark) const override { return marks()[mark].positionPx; }
  /// At its corner once that is known.
  Vec2 shown(std::size_t mark) const override {
    const Corner* corner = cornerOf(mark);
    return corner ? corner->positionPx : stored(mark);
  }
  void add(Recipe& recipe, const Vec2& px) const override { recipe.cornerMarks.push_back({px}); }
  void place(Recipe& recipe, std::size_t mark, const Vec2& px) const override {
    recipe.cornerMarks[mark].positionPx = px;
  }
  void erase(Recipe& recipe, std::size_t mark) const override {
    recipe.cornerMarks.erase(recipe.cornerMarks.begin() + static_cast<std::ptrdiff_t>(mark));
  }

  /// A corner that was found without a mark is left out by a click, and stays out.
  bool pressElse(const ToolEvent& event, GestureId gesture) override {
    const Corner* found =
        event.modifiers.testFlag(Qt::AltModifier) ? nullptr : foundAt(event.px, scene_.reachImagePx());
    if (!found) return false;
    Recipe recipe = scene_.session.recipe();
    recipe.refusedCornersPx.push_back(found->positionPx);
    scene_.session.change(cornerText("Exclude corner"), std::move(recipe), gesture);
    return true;
  }

  /// The nearest place of a line within reach; with Alt the place itself.
  std::optional<Vec2> placeFor(const ToolEvent& event) const override {
    pointed_ = event.px;
    const auto& contours = scene_.session.output().contours;
    if (event.modifiers.testFlag(Qt::AltModifier)) return event.px;
    if (!contours) return std::nullopt;
    // A suggestion within reach is what is meant.
    const double reach = scene_.reachImagePx();
    for (const CornerSuggestion& suggestion : scene_.session.suggestions().found())
      if ((suggestion.positionPx - event.px).norm() <= reach) return suggestion.positionPx;
    const auto corner = nearestContourPoint(*contours, event.px, reach);
    return corner ? std::optional(corner->positionPx) : std::nullopt;
  }

  QString hintText() const override {
    if (hovered() && hovered() == selected())
      return cornerText("Click to remove this corner; drag or press arrow keys to move it.");
    if (!hovered() && hoveredFound())
      return cornerText("Corner detected automatically. Click to exclude it; click again to mark it.");
    if (hovered()) return cornerText("Click to select this corner, click again to remove it; drag to move it.");
    return snapped() ? cornerText("Click to mark a corner.") : cornerText("Click a line where it has a sharp corner.");
  }

  Index selected() const override {
    const auto mark = scene_.session.selectedCorner();
    return mark ? Index(*mark) : std::nullopt;
  }
  void select(Index mark) override {
    scene_.session.selectCorner(mark ? std::optional(static_cast<int>(*mark)) : std::nullopt);
  }

 private:
  const std::vector<CornerMark>& marks() const { return scene_.session.recipe().cornerMarks; }
  bool isFresh() const { return scene_.session.output().pieces && !scene_.session.isStale(StageId::Pieces); }

  const Corner* cornerOf(std::size_t mark) const {
    if (isFresh())
      for (const Corner& corner : scene_.session.output().pieces->corners)
        if (corner.mark == static_cast<int>(mark)) return &corner;
    return nullptr;
  }

  static QString turnText(const Corner& corner) {
    return cornerText("turns %1°").arg(QString::number(std::abs(corner.turningAngleRad) * kDegPerRad, 'f', 1));
  }

  /// The nearest corner without a mark within reach of a place.
  const Corner* foundAt(const Vec2& px, double reachPx) const {
    const Corner* found = nullptr;
    if (!isFresh()) return found;
    for (const Corner& corner : scene_.session.output().pieces->corners) {
      const double distance = (corner.positionPx - px).norm();
      if (!corner.mark && distance <= reachPx) reachPx = distance, found = &corner;
    }
    return found;
  }
  /// The one under the mouse.
  const Corner* hoveredFound() const { return snapped() ? foundAt(pointed_, scene_.reachImagePx()) : nullptr; }

  QString angleText(std::size_t mark) const {
    if (!isFresh()) return {};
    if (const Corner* corner = cornerOf(mark)) return turnText(*corner);
    return cornerText("no line within %1 px").arg(scene_.session.recipe().corners.snapDistancePx, 0, 'f', 0);
  }

  mutable Vec2 pointed_ = Vec2::Zero();  ///< [px] Where the mouse last was over the drawing.
};

}  // namespace

std::unique_ptr<CanvasTool> makeCornerTool(CanvasScene& scene) { return std::make_unique<CornerTool>(scene); }

}  // namespace batten
