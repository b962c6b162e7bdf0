// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/canvas_state.h"

#include <cmath>

#include "core/image/log_transform.h"
#include "ui/canvas/layers/chip_layer.h"
#include "ui/canvas/layers/comb_layer.h"
#include "ui/canvas/layers/compare_layer.h"
#include "ui/canvas/layers/corner_layer.h"
#include "ui/canvas/layers/cursor_layer.h"
#include "ui/canvas/layers/deviation_layer.h"
#include "ui/canvas/layers/direction_layer.h"
#include "ui/canvas/layers/drop_hint_layer.h"
#include "ui/canvas/layers/extremum_layer.h"
#include "ui/canvas/layers/faired_layer.h"
#include "ui/canvas/layers/fallback_layer.h"
#include "ui/canvas/layers/ghost_layer.h"
#include "ui/canvas/layers/growing_layer.h"
#include "ui/canvas/layers/region_grid_layer.h"
#include "ui/canvas/layers/region_of_interest_layer.h"
#include "ui/canvas/layers/ruling_layer.h"
#include "ui/canvas/layers/segment_layer.h"
#include "ui/canvas/layers/segment_point_layer.h"
#include "ui/canvas/layers/sheet_layer.h"
#include "ui/canvas/layers/sketched_layer.h"
#include "ui/canvas/layers/span_layer.h"
#include "ui/canvas/layers/stroke_layer.h"
#include "ui/session/coarse_runner.h"
#include "ui/session/growing_player.h"
#include "ui/session/judged_view.h"
#include "ui/session/suggestion_source.h"

namespace batten {
namespace {

constexpr int kLateMs = 200;
constexpr int kFlashMs = 350;

}  // namespace

CurveCanvas::State::State(CurveCanvas& owner, EditorSession& s, ViewSettings& v)
    : CanvasScene(s, v), canvas(owner), tools{makeSelectTool(*this),        makeThresholdTool(*this),
                                              makeCornerTool(*this),        makePenTool(*this),
                                              makeSegmentTool(*this),       makeLinesTool(*this),
                                              makeRegionTool(*this, false), makeRegionTool(*this, true),
                                              makeScaleTool(*this),         makeDirectionTool(*this)} {
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
    QMetaObject::invokeMethod(
        &inbox,
        [this, scan, built] {
          if (scan != session.scan()) return;
          pyramid = built;
          canvas.update();
        },
        Qt::QueuedConnection);
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
  ghostDegree = session.hoveredTarget();
  const auto targets = session.targets();
  if (ghostDegree >= 1 && ghostDegree <= 6 && targets) {
    const auto& outcome = targets->faired[ghostDegree - 1];
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
    QMetaObject::invokeMethod(
        &inbox,
        [this, built] {
          if (!(built->source == source())) return;
          shapes = built;
          canvas.update();
        },
        Qt::QueuedConnection);
  });
}

void CurveCanvas::State::requestCombs() {
  const CurveSource from = source();
  const int selected = session.selectedCurve();
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
    QMetaObject::invokeMethod(
        &inbox,
        [this, built] {
          if (!(built->source == source()) || built->judged != judgedIn(view)) return;
          combs = built;
          canvas.update();
        },
        Qt::QueuedConnection);
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
    QMetaObject::invokeMethod(
        &inbox,
        [this, from, built] {
          if (!(from == overlayFor)) return;
          overlay = built;
          canvas.update();
        },
        Qt::QueuedConnection);
  });
}

void CurveCanvas::State::requestSuggestions() {
  if (view.tool() == Tool::Corners) session.suggestions().look(view.suggestionAngleDeg(), view.suggestionScalePx());
}

RasterContent CurveCanvas::State::rasterContent() const {
  RasterContent content;
  const auto scan = session.scan();
  if (!scan) return content;
  content.pyramid = pyramid;
  content.pageWidth = scan->grey.width;
  content.pageHeight = scan->grey.height;
  const bool isLog = view.isVisible(Layer::LogImage) && !view.isScanOnly();
  content.showsPicture = view.isVisible(Layer::Scan) || isLog || view.isScanOnly();
  if (isLog) content.tones = toneTable(session.recipe().log);
  if (view.isScanOnly()) return content;
  const PipelineOutput& output = session.output();
  if (view.isVisible(Layer::Paper) && output.thresholds && !output.thresholds->paper.isEmpty())
    content.paper = std::shared_ptr<const PaperBackground>(output.thresholds, &output.thresholds->paper);
  if (view.isVisible(Layer::Mask)) {
    const auto coarse = session.coarseInk();
    if (coarse) content.maskFactor = coarse->factor;
    const auto& filtered = coarse ? coarse->filtered : output.filtered;
    if (filtered && !view.showsMaskUncleaned())
      content.mask = std::shared_ptr<const BitImage>(filtered, &filtered->ink);
    else
      content.mask = coarse ? coarse->binary : output.binary;
  }
  if (view.isVisible(Layer::Edges)) content.edges = output.edges;
  return content;
}

CurveCanvas::State::LinesKey CurveCanvas::State::linesKeyNow() const {
  LinesKey key;
  key.origin = transform.origin();
  key.size = transform.viewSize();
  key.zoom = transform.zoom();
  key.ratio = transform.ratio();
  if (view.isScanOnly()) return key;
  for (std::size_t i = 0; i < kLayers.size(); ++i) key.layers |= view.isVisible(kLayers[i]) ? 1 << i : 0;
  key.combScale = view.combScale();
  key.isRadius = view.combShowsRadius();
  key.combDensity = view.combDensity();
  key.selected = session.selectedCurve();
  key.isGrowing = session.growing().isOpen();
  key.shapes = shapes.get();
  key.combs = combs.get();
  key.overlay = overlay.get();
  if (view.isVisible(Layer::Segments)) key.segments = session.output().segments.get();
  if (view.isVisible(Layer::Strokes) || view.isVisible(Layer::Fallback)) key.contours = session.output().contours.get();
  return key;
}

void CurveCanvas::State::paintLines(const LinesKey& key) {
  if (!lines.isNull() && key == linesKey) return;
  linesKey = key;
  if (lines.size() != key.size) lines = QImage(key.size, QImage::Format_ARGB32_Premultiplied);
  if (lines.isNull()) return;
  lines.setDevicePixelRatio(key.ratio);
  lines.fill(Qt::transparent);
  if (view.isScanOnly()) return;
  QPainter painter(&lines);
  paintOverlay(painter, *this);
  if (view.isVisible(Layer::Strokes)) paintStrokes(painter, *this);
  if (view.isVisible(Layer::Fallback)) paintFallback(painter, *this);
  if (view.isVisible(Layer::Segments)) paintSegments(painter, *this);
  if (view.isVisible(Layer::Curve)) paintSketched(painter, *this);
  if (view.isVisible(Layer::Faired)) paintFaired(painter, *this);
  if (areCombsShown()) paintCombs(painter, *this);
  if (view.isVisible(Layer::Deviation)) paintDeviation(painter, *this);
}

void CurveCanvas::State::paintStill() {
  const StillKey key{rasterContent(), linesKeyNow()};
  if (!still.isNull() && key == stillKey) return;
  paintLines(key.lines);
  if (still.size() != key.lines.size) still = QImage(key.lines.size, QImage::Format_RGB32);
  if (still.isNull()) return;
  still.setDevicePixelRatio(1.0);
  {
    QPainter painter(&still);
    tiles.paint(painter, transform, key.raster);
    if (!lines.isNull()) {
      lines.setDevicePixelRatio(1.0);
      painter.drawImage(QPoint(0, 0), lines);
    }
  }
  still.setDevicePixelRatio(key.lines.ratio);
  stillKey = key;
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
  paintStill();
  if (!still.isNull()) painter.drawImage(QPointF(0, 0), still);
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
    if (areCombsShown()) {
      paintDirection(painter, *this);
      paintSpans(painter, *this);
    }
    if (areExtremaShown()) paintExtrema(painter, *this);
    if (view.isVisible(Layer::Corners)) paintCorners(painter, *this);
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

void CurveCanvas::State::linkCursor(const std::optional<Vec2>& px) {
  const CurveComb* comb = selectedComb();
  if (px && comb != nullptr) {
    if (const auto near = nearestOn(comb->points, *px); near && near->distance <= reachImagePx()) {
      const auto i = static_cast<std::size_t>(near->position);
      const auto next = std::min(i + 1, comb->points.size() - 1);
      const double t = near->position - static_cast<double>(i);
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
