// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <array>
#include <memory>
#include <tuple>

#include "ui/canvas/curve_canvas.h"
#include "ui/canvas/scene/canvas_scene.h"
#include "ui/canvas/still_image.h"
#include "ui/canvas/tools/canvas_tool.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

/// The canvas' own state: the scene, what is computed for it in the background, and the gesture in progress.
struct CurveCanvas::State : CanvasScene {
  State(CurveCanvas&, EditorSession&, ViewSettings&);

  void scanOpened();
  void stageReady(StageId);
  void coarseReady();
  void recipeChanged();
  void viewChanged();
  void transformChanged();
  void selectionChanged();
  void hoverChanged();
  void busyChanged(bool busy);
  CanvasTool& tool() { return *tools[indexOf(view.tool())]; }

  void paint(QPainter&);
  /// Sets the common cursor when the mouse is near the selected curve, clears it when it has left.
  void linkCursor(const std::optional<Vec2>& px);
  void updateMouseCursor();
  /// @param widget where the mouse is over the view, or none
  void moveMouse(const std::optional<QPointF>& widget);
  ToolEvent toolEvent(QPointF widget, Qt::KeyboardModifiers) const;

  CurveCanvas& canvas;
  std::array<std::unique_ptr<CanvasTool>, kTools.size()> tools;
  QPainterPath ghost;
  bool isFitted = true;  ///< Follows the size of the view until the user zooms or pans.
  bool isPanning = false, isPressed = false, spaceHeld = false, ownsCursor = false;
  QPointF lastMouse;
  QString lastHint;
  std::optional<Vec2> flashPx;
  QElapsedTimer flashAge;
  QTimer flashTimer, lateTimer;

  StillImage still;

  Inbox inbox;
  BackgroundWorker imaging, shaping, combing, comparing;

  /// The pinned result, or the uniform curves, have changed.
  void requestOverlay();

 private:
  void requestShapes();
  void requestCombs();
  void requestSuggestions();
  void refreshExtrema();
  CurveSource source() const;
  void paintFlash(QPainter&);

  CurveSource shapesFor, combsFor;
  double shapesZoom = 0.0;
  std::optional<int> combsSelected;
  Judged combsJudged = Judged::Result;
  OverlaySource overlayFor;
};

}  // namespace batten
