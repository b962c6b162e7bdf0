// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/tools/junction_tool.h"

#include <QCoreApplication>
#include <QPen>
#include <memory>

#include "ui/canvas/layers/junction_layer.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/scene/canvas_colors.h"
#include "ui/session/edits/junction_edits.h"

namespace batten {
namespace {

QString toolText(const char* text) { return QCoreApplication::translate("CurveCanvas", text); }

class JunctionTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const ToolEvent& event) override {
    forgetOldLines();
    const auto target = targetAt(event.px);
    if (!target) {
      first_.reset();
      scene_.flash(event.px);
      return scene_.repaint();
    }
    const StrokeJunction& junction = junctionsOf(scene_.session)[target->junction];
    if (!target->branch) {
      first_.reset();
      pairNext(scene_.session, junction);
    } else if (first_ && first_->junction == target->junction && first_->branch != target->branch) {
      const int first = *first_->branch;
      first_.reset();
      pairBranches(scene_.session, junction, first, *target->branch);
    } else {
      first_ = first_ == target ? std::nullopt : target;
    }
    tell();
    scene_.repaint();
  }

  void move(const ToolEvent& event, bool isPressed) override {
    if (isPressed) return;
    forgetOldLines();
    const auto over = targetAt(event.px);
    if (over != over_) scene_.repaint();
    over_ = over;
    tell();
  }

  void abort() override { first_.reset(); }
  void leave() override {
    over_.reset();
    scene_.repaint();
  }
  void reset() override {
    over_.reset();
    first_.reset();
  }
  void recipeChanged() override { first_.reset(); }
  Qt::CursorShape cursorShape() const override { return over_ ? Qt::PointingHandCursor : Qt::ArrowCursor; }

  void paint(QPainter& painter) override {
    forgetOldLines();
    const auto& shown = first_ ? first_ : over_;
    const auto junctions = junctionsOf(scene_.session);
    if (!shown || shown->junction >= std::ssize(junctions)) return;
    const StrokeJunction& junction = junctions[shown->junction];
    paintPairs(painter, scene_, junction);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (int i = 0; i < std::ssize(junction.branchesPx); ++i) {
      if (!isApart(junction, i)) continue;
      const bool isFirst = first_ && first_->branch == i;
      const bool isOver = over_ && over_->junction == shown->junction && over_->branch == i;
      painter.setPen(QPen(colors::corner(), 1.6));
      painter.setBrush(isFirst ? QBrush(colors::corner()) : QBrush(Qt::white));
      const double radius = isFirst || isOver ? 5.0 : 3.5;
      painter.drawEllipse(scene_.transform.toWidget(junction.branchesPx[i]), radius, radius);
    }
    painter.restore();
    if (over_ && !over_->branch && over_->junction == shown->junction)
      paintLabel(painter, scene_, junctionHint(scene_, junction), scene_.transform.toWidget(junction.positionPx));
  }

 private:
  struct Target {
    int junction = 0;
    std::optional<int> branch;
    bool operator==(const Target&) const = default;
  };

  // Both targets count in the lines that they were found on.
  void forgetOldLines() {
    if (lines_ == scene_.session.output().contours) return;
    lines_ = scene_.session.output().contours;
    reset();
  }

  // Seen from afar a branch cannot be told from its junction.
  bool isApart(const StrokeJunction& junction, int branch) const {
    const double widgetPx =
        (junction.branchesPx[branch] - junction.positionPx).norm() / scene_.transform.imagePerWidget();
    return widgetPx > 1.5 * kMarkReachPx;
  }

  std::optional<Target> targetAt(const Vec2& px) const {
    const auto junctions = junctionsOf(scene_.session);
    double least = kMarkReachPx * scene_.transform.imagePerWidget();
    std::optional<Target> nearest;
    for (int i = 0; i < std::ssize(junctions); ++i) {
      const StrokeJunction& junction = junctions[i];
      if ((junction.positionPx - px).norm() <= least) {
        least = (junction.positionPx - px).norm();
        nearest = Target{i, std::nullopt};
      }
      for (int b = 0; b < std::ssize(junction.branchesPx); ++b) {
        const double distance = (junction.branchesPx[b] - px).norm();
        if (distance > least || !isApart(junction, b)) continue;
        least = distance;
        nearest = Target{i, b};
      }
    }
    return nearest;
  }

  void tell() {
    const auto junctions = junctionsOf(scene_.session);
    if (first_) return scene_.hint(toolText("Click another branch: both are one stroke, or come apart."));
    if (!over_ || over_->junction >= std::ssize(junctions))
      return scene_.hint(
          toolText("Click a junction for the next pairing of its strokes, or two of its branches to join them."));
    scene_.hint(over_->branch ? toolText("Click to join this branch with another one.")
                              : junctionHint(scene_, junctions[over_->junction]));
  }

  std::optional<Target> over_, first_;
  std::shared_ptr<const ContourSet> lines_;
};

}  // namespace

std::unique_ptr<CanvasTool> makeJunctionTool(CanvasScene& scene) { return std::make_unique<JunctionTool>(scene); }

}  // namespace batten
