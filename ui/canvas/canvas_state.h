// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <array>
#include <tuple>

#include "ui/canvas/curve_canvas.h"
#include "ui/canvas/scene/canvas_scene.h"
#include "ui/canvas/screen_tiles.h"
#include "ui/canvas/tools/canvas_tool.h"
#include "ui/session/background_worker.h"

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
  RasterContent rasterContent() const;
  /// Sets the common cursor when the mouse is near the selected curve, clears it when it has left.
  void linkCursor(const std::optional<Vec2>& px);
  void updateMouseCursor();
  ToolEvent toolEvent(QPointF widget, Qt::KeyboardModifiers) const;

  CurveCanvas& canvas;
  ScreenTiles tiles;
  std::array<std::unique_ptr<CanvasTool>, kTools.size()> tools;
  QPainterPath ghost;
  int ghostDegree = 0;
  bool isFitted = true;  ///< Follows the size of the view until the user zooms or pans.
  bool isPanning = false, isPressed = false, spaceHeld = false, ownsCursor = false;
  QPointF lastMouse;
  QString lastHint;
  std::optional<Vec2> flashPx;
  QElapsedTimer flashAge;
  QTimer flashTimer, lateTimer;

  /// The lines, and all that is under the overlay, each kept as long as nothing of it changes: moving the mouse costs
  /// one blit, and a new mask does not stroke the curves again.
  QImage lines, still;
  struct LinesKey {
    QPoint origin;
    QSize size;
    double zoom = 0.0, ratio = 0.0, combScale = 0.0;
    int combDensity = 0, selected = -1, layers = 0;
    bool isGrowing = false, isRadius = false;
    const void *shapes = nullptr, *combs = nullptr, *segments = nullptr, *overlay = nullptr, *contours = nullptr;
    bool operator==(const LinesKey&) const = default;
  };
  LinesKey linesKey;
  struct StillKey {
    RasterContent raster;
    LinesKey lines;
    bool operator==(const StillKey&) const = default;
  };
  StillKey stillKey;

  QObject inbox;
  BackgroundWorker imaging, shaping, combing, comparing;

  /// The pinned result, or the uniform curves, have changed.
  void requestOverlay();

 private:
  void paintStill();
  void paintLines(const LinesKey&);
  void requestShapes();
  void requestCombs();
  void requestSuggestions();
  void refreshExtrema();
  CurveSource source() const;
  LinesKey linesKeyNow() const;
  void paintFlash(QPainter&);

  CurveSource shapesFor, combsFor;
  double shapesZoom = 0.0;
  int combsSelected = -2;
  Judged combsJudged = Judged::Result;
  OverlaySource overlayFor;
};

}  // namespace batten
