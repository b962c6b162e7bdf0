// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/segment_tool.h"

#include <QCoreApplication>
#include <QPen>

#include "ui/canvas/scene/canvas_colors.h"
#include "ui/canvas/tools/point_tool.h"

namespace batten {
namespace {

QString segmentText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class SegmentTool final : public PointTool {
 public:
  using PointTool::PointTool;

  void paint(QPainter& painter) override {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    if (const Index mark = selected(); mark && *mark < count()) {
      painter.setPen(QPen(colors::segment(), 1.2));
      painter.drawEllipse(scene_.transform.toWidget(stored(*mark)), 10.0, 10.0);
    }
    const bool isOver = hovered() && *hovered() < count();
    if (const std::optional<Vec2> at = isOver ? std::optional(stored(*hovered())) : snapped()) {
      const QPointF centre = scene_.transform.toWidget(*at);
      painter.setPen(QPen(Qt::white, 4.0));
      painter.drawEllipse(centre, 7.0, 7.0);
      painter.setPen(QPen(colors::segment(), 2.0));
      painter.drawEllipse(centre, 7.0, 7.0);
    }
    painter.restore();
  }

 protected:
  Steps steps() const override {
    return {segmentText("Set segment point"), segmentText("Move segment point"), segmentText("Remove segment point")};
  }
  std::size_t count() const override { return scene_.session.recipe().segmentPoints.size(); }
  Vec2 stored(std::size_t mark) const override { return scene_.session.recipe().segmentPoints[mark].positionPx; }
  void add(Recipe& recipe, const Vec2& px) const override { recipe.segmentPoints.push_back({px}); }
  void place(Recipe& recipe, std::size_t mark, const Vec2& px) const override {
    recipe.segmentPoints[mark].positionPx = px;
  }
  void erase(Recipe& recipe, std::size_t mark) const override {
    recipe.segmentPoints.erase(recipe.segmentPoints.begin() + static_cast<std::ptrdiff_t>(mark));
  }
  std::optional<Vec2> placeFor(const ToolEvent& event) const override {
    const auto& contours = scene_.session.output().contours;
    if (!contours) return std::nullopt;
    const auto at = nearestContourPoint(*contours, event.px, scene_.reachImagePx());
    return at ? std::optional(at->positionPx) : std::nullopt;
  }
  QString hintText() const override {
    if (hovered() && hovered() == selected())
      return segmentText("Click to remove this segment point; drag to move it.");
    if (hovered()) return segmentText("Click to select this segment point, click again to remove it; drag to move it.");
    if (scene_.session.recipe().construct.method != ConstructMethod::Typical)
      return segmentText("Segment points only affect the method Typical curves; choose it in stage Curves.");
    return snapped() ? segmentText("Click to make two typical curves meet here.")
                     : segmentText("Click a line where two typical curves should meet.");
  }
};

}  // namespace

std::unique_ptr<CanvasTool> makeSegmentTool(CanvasScene& scene) { return std::make_unique<SegmentTool>(scene); }

}  // namespace batten
