// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/canvas_state.h"

#include <cmath>

#include "ui/canvas/layers/chip_layer.h"
#include "ui/canvas/layers/corner_layer.h"
#include "ui/canvas/layers/cursor_layer.h"
#include "ui/canvas/layers/direction_layer.h"
#include "ui/canvas/layers/drop_hint_layer.h"
#include "ui/canvas/layers/extremum_layer.h"
#include "ui/canvas/layers/ghost_layer.h"
#include "ui/canvas/layers/growing_layer.h"
#include "ui/canvas/layers/junction_layer.h"
#include "ui/canvas/layers/region_grid_layer.h"
#include "ui/canvas/layers/region_of_interest_layer.h"
#include "ui/canvas/layers/ruling_layer.h"
#include "ui/canvas/layers/segment_point_layer.h"
#include "ui/canvas/layers/sheet_layer.h"
#include "ui/canvas/layers/span_layer.h"
#include "ui/canvas/layers/text_box.h"
#include "ui/canvas/tools/corner_tool.h"
#include "ui/canvas/tools/direction_tool.h"
#include "ui/canvas/tools/ink_tool.h"
#include "ui/canvas/tools/junction_tool.h"
#include "ui/canvas/tools/lines_tool.h"
#include "ui/canvas/tools/paint_tool.h"
#include "ui/canvas/tools/pen_tool.h"
#include "ui/canvas/tools/region_tool.h"
#include "ui/canvas/tools/scale_tool.h"
#include "ui/canvas/tools/segment_tool.h"
#include "ui/canvas/tools/select_tool.h"
#include "ui/canvas/tools/sheet_tool.h"
#include "ui/canvas/tools/threshold_tool.h"
#include "ui/session/explanation_source.h"
#include "ui/session/growing_player.h"
#include "ui/session/runs/coarse_runner.h"
#include "ui/session/suggestion_source.h"
#include "ui/session/view/judged_view.h"

namespace batten {
namespace {

constexpr int kLateMs = 200;   // what takes longer is shown to be late
constexpr int kFlashMs = 350;  // of what has just changed

}  // namespace

CurveCanvas::State::State(CurveCanvas& owner, EditorSession& s, ViewSettings& v)
    : CanvasScene(s, v), canvas(owner), tools{makeSelectTool(*this),        makeThresholdTool(*this),
                                              makeCornerTool(*this),        makePenTool(*this),
                                              makeSegmentTool(*this),       makeLinesTool(*this),
                                              makeRegionTool(*this, false), makeRegionTool(*this, true),
                                              makeScaleTool(*this),         makeDirectionTool(*this),
                                              makeJunctionTool(*this),      makeSheetTool(*this),
                                              makeInkTool(*this),           makePaintTool(*this)} {
  repaint = [this] { canvas.update(); };
  hint = [this](const QString& text) {
    if (text == lastHint) return;
    lastHint = text;
    emit canvas.hint(text);
  };
  flash = [this](const Vec2& px) {
    flashPx = px;
    flashAge.start();
    flashTimer.start();
    canvas.update();
  };
  flashTimer.setInterval(25);
  QObject::connect(&flashTimer, &QTimer::timeout, &inbox, [this] {
    if (flashAge.elapsed() > kFlashMs) {
      flashPx.reset();
      flashTimer.stop();
    }
    canvas.update();
  });
  lateTimer.setSingleShot(true);
  lateTimer.setInterval(kLateMs);
  QObject::connect(&lateTimer, &QTimer::timeout, &inbox, [this] {
    isLate = session.isBusy();
    canvas.update();
  });
}

void CurveCanvas::State::scanOpened() {
  const auto scan = session.scan();
  pyramid = coarsePyramid(scan);
  shapes.reset();
  combs.reset();
  overlay.reset();
  overlayFor = {};
  extrema.clear();
  ghost = {};
  for (const auto& each : tools) each->reset();
  transform.setImageSize({scan->grey.width, scan->grey.height});
  transform.fit();
  isFitted = true;
  imaging.start([this, scan](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto built = buildPyramid(scan, context);
    if (!built) return;
    inbox.post([this, scan, built] {
      if (scan != session.scan()) return;
      pyramid = built;
      canvas.update();
    });
  });
  emit canvas.zoomChanged(transform.zoom());
  canvas.update();
}

void CurveCanvas::State::stageReady(StageId stage) {
  if (stage == StageId::Contours) requestSuggestions();
  if (stage == StageId::Curves || stage == StageId::Faired) {
    requestShapes();
    requestCombs();
    requestOverlay();
    refreshExtrema();
  }
  canvas.update();
}

void CurveCanvas::State::coarseReady() {
  requestShapes();
  canvas.update();
}

void CurveCanvas::State::recipeChanged() {
  refreshExtrema();
  tool().recipeChanged();
  canvas.update();
}

void CurveCanvas::State::refreshExtrema() { extrema = extremumMarks(session, session.selectedCurve(), judgedIn(view)); }

void CurveCanvas::State::viewChanged() {
  session.setEdgesWanted(view.isVisible(Layer::Edges));
  session.explanation().setWanted(view.isVisible(Layer::Explained));
  requestSuggestions();
  requestCombs();
  requestOverlay();
  refreshExtrema();
  canvas.update();
}

void CurveCanvas::State::transformChanged() {
  requestShapes();
  requestOverlay();
  canvas.update();
}

void CurveCanvas::State::selectionChanged() {
  refreshExtrema();
  requestCombs();
  hoverChanged();
  canvas.update();
}

void CurveCanvas::State::hoverChanged() {
  ghost = {};
  const auto degree = session.hoveredTarget();
  const auto targets = session.targets();
  if (degree && targets) {
    const auto& outcome = targets->faired[*degree - 1];
    if (outcome) ghost = sampledPath(outcome->curve, session.output().frame, 0.15 / zoomBracket(transform.zoom()));
  }
  canvas.update();
}

void CurveCanvas::State::busyChanged(bool busy) {
  isLate = false;
  if (busy)
    lateTimer.start();
  else
    lateTimer.stop();
  canvas.update();
}

CurveSource CurveCanvas::State::source() const {
  CurveSource from;
  if (const auto coarse = session.coarseCurves()) {
    from.faired = coarse->faired;
    from.frame = coarse->frame;
    return from;
  }
  const PipelineOutput& output = session.output();
  from.faired = output.faired;
  if (!from.faired) from.constructed = output.constructed;
  from.frame = output.frame;
  return from;
}

void CurveCanvas::State::requestShapes() {
  const CurveSource from = source();
  const double bracket = zoomBracket(transform.zoom());
  if (from == shapesFor && bracket == shapesZoom) return;
  shapesFor = from;
  shapesZoom = bracket;
  shaping.start([this, from, bracket](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto built = buildShapes(from, bracket, context);
    if (!built) return;
    inbox.post([this, built] {
      if (!(built->source == source())) return;
      shapes = built;
      canvas.update();
    });
  });
}

void CurveCanvas::State::requestCombs() {
  const CurveSource from = source();
  const auto selected = session.selectedCurve();
  const Judged judged = judgedIn(view);
  if (from == combsFor && selected == combsSelected && judged == combsJudged) return;
  combsFor = from;
  combsSelected = selected;
  combsJudged = judged;
  combing.start([this, from, selected, judged](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto built = buildCombs(from, selected, judged, context);
    if (!built) return;
    inbox.post([this, built] {
      if (!(built->source == source()) || built->judged != judgedIn(view)) return;
      combs = built;
      canvas.update();
    });
  });
}

void CurveCanvas::State::requestOverlay() {
  const OverlaySource from = overlaySource(session, view, zoomBracket(transform.zoom()));
  if (from == overlayFor) return;
  overlayFor = from;
  if (!from.pinned && !from.contours) {
    comparing.cancelAll();
    overlay.reset();
    canvas.update();
    return;
  }
  comparing.start([this, from](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto built = buildOverlay(from, context);
    if (!built) return;
    inbox.post([this, from, built] {
      if (!(from == overlayFor)) return;
      overlay = built;
      canvas.update();
    });
  });
}

void CurveCanvas::State::requestSuggestions() {
  if (view.tool() == Tool::Corners) session.suggestions().look(view.suggestionAngleDeg(), view.suggestionScalePx());
}

void CurveCanvas::State::paintFlash(QPainter& painter) {
  if (!flashPx) return;
  const double t = std::min(1.0, static_cast<double>(flashAge.elapsed()) / kFlashMs);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(90, 90, 90, static_cast<int>(190 * (1.0 - t))), 1.6));
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(transform.toWidget(*flashPx), 5.0 + 12.0 * t, 5.0 + 12.0 * t);
  painter.restore();
}

void CurveCanvas::State::paint(QPainter& painter) {
  palette = canvas.palette();
  font = canvas.font();
  if (font.pixelSize() <= 0 || font.pixelSize() > 12) font.setPixelSize(12);
  still.paint(painter, *this);
  if (!session.hasScan()) {
    paintDropHint(painter, *this);
    return;
  }
  if (!view.isScanOnly()) {
    if (view.isVisible(Layer::Scan)) {
      paintSheet(painter, *this);
      paintRulings(painter, *this);
    }
    paintRegions(painter, *this);
    if (isSelectionShown()) paintDirection(painter, *this);
    if (areCombsShown()) paintSpans(painter, *this);
    if (areExtremaShown()) paintExtrema(painter, *this);
    if (view.isVisible(Layer::Corners) || view.tool() == Tool::Corners) paintCorners(painter, *this);
    if (view.isVisible(Layer::Junctions) || view.tool() == Tool::Junctions) paintJunctions(painter, *this);
    if (view.isVisible(Layer::Regions) && view.tool() != Tool::Thresholds) paintRegionGrid(painter, *this);
    paintSegmentPoints(painter, *this);
    if (!ghost.isEmpty()) paintGhost(painter, *this, ghost);
    paintGrowing(painter, *this);
    tool().paint(painter);
    paintCursor(painter, *this);
    paintFlash(painter);
  }
  paintChips(painter, *this);
}

void CurveCanvas::State::moveMouse(const std::optional<QPointF>& widget) {
  const auto isBeside = [this](const std::optional<QPointF>& at) { return at && isBesideChips(*this, *at); };
  const bool isChanged = isBeside(mouse) || isBeside(widget);
  mouse = widget;
  if (isChanged) canvas.update();
}

void CurveCanvas::State::linkCursor(const std::optional<Vec2>& px) {
  const CurveComb* comb = selectedComb();
  if (px && comb != nullptr) {
    if (const auto near = nearestOn(comb->points, *px); near && near->distance <= reachImagePx()) {
      const int i = static_cast<int>(near->position);
      const int next = std::min(i + 1, static_cast<int>(comb->points.size()) - 1);
      const double t = near->position - i;
      ownsCursor = true;
      session.setCursor(comb->points[i].s + t * (comb->points[next].s - comb->points[i].s));
      return;
    }
  }
  if (ownsCursor) session.setCursor(std::nullopt);
  ownsCursor = false;
}

void CurveCanvas::State::updateMouseCursor() {
  const Qt::CursorShape shape = isPanning   ? Qt::ClosedHandCursor
                                : spaceHeld ? Qt::OpenHandCursor
                                            : tool().cursorShape();
  if (canvas.cursor().shape() != shape) canvas.setCursor(shape);
}

ToolEvent CurveCanvas::State::toolEvent(QPointF widget, Qt::KeyboardModifiers modifiers) const {
  return {widget, transform.toImage(widget), modifiers};
}

}  // namespace batten
