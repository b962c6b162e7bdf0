// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/curve_canvas.h"

#include <QApplication>
#include <QDropEvent>
#include <QGestureEvent>
#include <QKeyEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPaintEvent>
#include <QPainter>
#include <QPinchGesture>
#include <QTabletEvent>
#include <QWheelEvent>
#include <cmath>

#include "ui/canvas/canvas_state.h"
#include "ui/session/edits/like_edits.h"
#include "ui/session/explanation_source.h"
#include "ui/session/growing_player.h"
#include "ui/session/suggestion_source.h"

namespace batten {
namespace {

constexpr double kZoomPerNotch = 1.2;  // of the wheel
constexpr double kArrowStepPx = 60.0;  // of the screen, at an arrow key

double notches(const QWheelEvent& event) {
  const QPoint angle = event.angleDelta();
  return (angle.y() != 0 ? angle.y() : angle.x()) / 120.0;
}

/// A saved profile that is dragged over the drawing, or dropped on a line of it; anything else is the window's.
bool takeProfile(QEvent& event, CanvasScene& scene) {
  const QEvent::Type type = event.type();
  if (type == QEvent::DragLeave) scene.hint({});
  if (type != QEvent::DragEnter && type != QEvent::DragMove && type != QEvent::Drop) return false;
  auto& drop = static_cast<QDropEvent&>(event);
  const QMimeData* data = drop.mimeData();
  if (data == nullptr || !data->hasFormat(QString::fromLatin1(kProfileMime))) {
    event.ignore();
    return false;
  }
  const Vec2 px = scene.transform.toImage(drop.position());
  const auto curve = scene.curveNear(px);
  const auto words = [](const char* text) { return QCoreApplication::translate("CurveCanvas", text); };
  scene.hint(curve ? words("Let go: this line follows the profile.") : words("Drop the profile on a line."));
  if (type == QEvent::Drop) {
    scene.hint({});
    if (!curve) scene.flash(px);
    if (curve) {
      scene.session.selectCurve(*curve);
      const auto done =
          followSavedProfile(scene.session, QString::fromUtf8(data->data(QString::fromLatin1(kProfileMime))));
      if (!done) scene.hint(QString::fromStdString(done.error().message));
    }
  }
  drop.setDropAction(Qt::CopyAction);
  drop.setAccepted(type == QEvent::DragEnter || curve.has_value());
  return true;
}

}  // namespace

CurveCanvas::CurveCanvas(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent), state_(std::make_unique<State>(*this, session, view)) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setMinimumSize(240, 180);
  grabGesture(Qt::PinchGesture);
  qApp->installEventFilter(this);
  setAccessibleName(tr("Drawing"));
  setAcceptDrops(true);
  State* state = state_.get();
  connect(&session, &EditorSession::scanOpened, this, [state] { state->scanOpened(); });
  connect(&session, &EditorSession::pageChanged, this, [state] { state->scanOpened(); });
  connect(&session, &EditorSession::stageReady, this, [state](StageId stage) { state->stageReady(stage); });
  connect(&session, &EditorSession::coarseReady, this, [state] { state->coarseReady(); });
  connect(&session, &EditorSession::recipeChanged, this, [state] { state->recipeChanged(); });
  connect(&session, &EditorSession::selectionChanged, this, [state] { state->selectionChanged(); });
  connect(&session, &EditorSession::targetsChanged, this, [state] { state->hoverChanged(); });
  connect(&session, &EditorSession::hoverChanged, this, [state] { state->hoverChanged(); });
  connect(&session, &EditorSession::pinChanged, this, [state] { state->requestOverlay(); });
  connect(&session.suggestions(), &SuggestionSource::changed, this, qOverload<>(&QWidget::update));
  connect(&session.explanation(), &ExplanationSource::changed, this, qOverload<>(&QWidget::update));
  connect(&session, &EditorSession::cornerSelectionChanged, this, qOverload<>(&QWidget::update));
  connect(&session.growing(), &GrowingPlayer::changed, this, [this] { update(); });
  connect(&session, &EditorSession::cursorChanged, this, qOverload<>(&QWidget::update));
  connect(&session, &EditorSession::runFinished, this, qOverload<>(&QWidget::update));
  connect(&session, &EditorSession::busyChanged, this, [state](bool busy) { state->busyChanged(busy); });
  connect(&view, &ViewSettings::changed, this, [state] { state->viewChanged(); });
  connect(&view, &ViewSettings::selectedRegionChanged, this, qOverload<>(&QWidget::update));
  connect(&view, &ViewSettings::measureChanged, this, qOverload<>(&QWidget::update));
  connect(&view, &ViewSettings::toolChanged, this, [state] {
    for (const auto& tool : state->tools) tool->reset();
    state->hint({});
    state->viewChanged();
    state->updateMouseCursor();
  });
  if (session.hasScan()) {
    state_->scanOpened();
    state_->stageReady(StageId::Contours);
    state_->stageReady(StageId::Faired);
  }
  state_->viewChanged();
}

CurveCanvas::~CurveCanvas() = default;

void CurveCanvas::zoomFit() {
  state_->transform.fit();
  state_->isFitted = true;
  state_->transformChanged();
  emit zoomChanged(zoom());
}

void CurveCanvas::zoomActual() { zoomBy(1.0 / zoom()); }

void CurveCanvas::zoomBy(double factor) {
  state_->transform.zoomAt(zoom() * factor, state_->transform.centre());
  state_->isFitted = false;
  state_->transformChanged();
  emit zoomChanged(zoom());
}

double CurveCanvas::zoom() const { return state_->transform.zoom(); }

QPointF CurveCanvas::toWidget(const Vec2& imagePx) const { return state_->transform.toWidget(imagePx); }

Vec2 CurveCanvas::toImage(const QPointF& widget) const { return state_->transform.toImage(widget); }

void CurveCanvas::paintEvent(QPaintEvent*) {
  const double ratio = devicePixelRatioF();
  const QSize device(static_cast<int>(std::lround(width() * ratio)), static_cast<int>(std::lround(height() * ratio)));
  if (device != state_->transform.viewSize() || ratio != state_->transform.ratio()) {
    state_->transform.setViewSize(device, ratio);
    if (state_->isFitted) state_->transform.fit();
  }
  QPainter painter(this);
  state_->paint(painter);
}

void CurveCanvas::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const double ratio = devicePixelRatioF();
  state_->transform.setViewSize(
      QSize(static_cast<int>(std::lround(width() * ratio)), static_cast<int>(std::lround(height() * ratio))), ratio);
  if (!state_->isFitted) return;
  state_->transform.fit();
  state_->transformChanged();
  emit zoomChanged(zoom());
}

void CurveCanvas::wheelEvent(QWheelEvent* event) {
  const double steps = notches(*event);
  if (steps == 0.0) return;
  State& s = *state_;
  event->accept();
  if (event->modifiers().testFlag(Qt::ShiftModifier)) {
    const bool isSideways = event->angleDelta().y() != 0;
    s.transform.pan(isSideways ? QPointF(steps * kArrowStepPx, 0) : QPointF(0, steps * kArrowStepPx));
    s.isFitted = false;
    s.transformChanged();
    return;
  }
  const bool isForTool = !s.spaceHeld && s.session.hasScan() && !s.view.isScanOnly();
  if (isForTool && s.tool().wheel(s.toolEvent(event->position(), event->modifiers()), steps)) return;
  s.transform.zoomAt(zoom() * std::pow(kZoomPerNotch, steps), event->position());
  s.isFitted = false;
  s.transformChanged();
  emit zoomChanged(zoom());
}

void CurveCanvas::mousePressEvent(QMouseEvent* event) {
  State& s = *state_;
  s.lastMouse = event->position();
  if (event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && s.spaceHeld)) {
    s.isPanning = true;
  } else if (event->button() == Qt::LeftButton && s.session.hasScan() && !s.view.isScanOnly()) {
    s.isPressed = true;
    s.tool().press(s.toolEvent(event->position(), event->modifiers()));
  } else {
    event->ignore();
    return;
  }
  s.updateMouseCursor();
}

void CurveCanvas::mouseMoveEvent(QMouseEvent* event) {
  State& s = *state_;
  const QPointF moved = event->position() - s.lastMouse;
  s.lastMouse = event->position();
  s.moveMouse(event->position());
  if (s.isPanning) {
    s.transform.pan(moved);
    s.isFitted = false;
    s.transformChanged();
    return;
  }
  if (!s.session.hasScan()) return;
  const ToolEvent at = s.toolEvent(event->position(), event->modifiers());
  emit hovered(at.px);
  if (!s.view.isScanOnly()) {
    s.tool().move(at, s.isPressed);
    if (!s.isPressed) s.linkCursor(at.px);
  }
  s.updateMouseCursor();
}

void CurveCanvas::mouseReleaseEvent(QMouseEvent* event) {
  State& s = *state_;
  if (s.isPanning && (event->button() == Qt::MiddleButton || event->button() == Qt::LeftButton)) {
    s.isPanning = false;
  } else if (event->button() == Qt::LeftButton && s.isPressed) {
    s.isPressed = false;
    s.tool().release(s.toolEvent(event->position(), event->modifiers()));
  }
  s.updateMouseCursor();
}

void CurveCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  State& s = *state_;
  if (event->button() != Qt::LeftButton || s.spaceHeld || !s.session.hasScan()) return;
  const ToolEvent at = s.toolEvent(event->position(), event->modifiers());
  // The second press of a double click is a press like any other for tools that do not know double clicks.
  if (s.view.tool() == Tool::Thresholds) {
    s.tool().doubleClick(at);
  } else {
    s.isPressed = true;
    s.tool().press(at);
  }
}

void CurveCanvas::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  state_->moveMouse(std::nullopt);
  emit hovered(std::nullopt);
  state_->tool().leave();
  state_->hint({});
  state_->linkCursor(std::nullopt);
}

void CurveCanvas::tabletEvent(QTabletEvent* event) {
  State& s = *state_;
  // Other tools and the barrel buttons work through the mouse events that Qt makes of what is ignored here.
  const bool isPen = s.view.tool() == Tool::Pen && s.session.hasScan() && !s.spaceHeld && !s.view.isScanOnly();
  const bool isTip = event->button() == Qt::LeftButton || event->buttons() == Qt::LeftButton || s.isPressed;
  if (!isPen || !isTip) return event->ignore();
  const ToolEvent at = s.toolEvent(event->position(), event->modifiers());
  if (event->type() == QEvent::TabletPress) {
    setFocus(Qt::MouseFocusReason);
    s.isPressed = true;
    s.tool().press(at);
  } else if (event->type() == QEvent::TabletMove && s.isPressed) {
    s.tool().move(at, true);
  } else if (event->type() == QEvent::TabletRelease && s.isPressed) {
    s.isPressed = false;
    s.tool().release(at);
  }
  emit hovered(at.px);
  event->accept();
}

bool CurveCanvas::focusNextPrevChild(bool next) {
  // Marks are walked by Tab, curves are not: there may be hundreds before the panels.
  return state_->tool().tab(next).value_or(false) || QWidget::focusNextPrevChild(next);
}

void CurveCanvas::keyPressEvent(QKeyEvent* event) {
  State& s = *state_;
  QPointF step;
  if (event->key() == Qt::Key_Escape && s.isPressed) {
    s.isPressed = false;
    s.tool().abort();
    s.updateMouseCursor();
    return;
  }
  if (event->key() == Qt::Key_Space || event->key() == Qt::Key_Backslash) return hold(*event, true);
  if (s.session.hasScan() && !s.view.isScanOnly() && s.tool().key(event)) return;
  switch (event->key()) {
    case Qt::Key_Left:
      step = {kArrowStepPx, 0};
      break;
    case Qt::Key_Right:
      step = {-kArrowStepPx, 0};
      break;
    case Qt::Key_Up:
      step = {0, kArrowStepPx};
      break;
    case Qt::Key_Down:
      step = {0, -kArrowStepPx};
      break;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  s.transform.pan(step);
  s.isFitted = false;
  s.transformChanged();
}

void CurveCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space || event->key() == Qt::Key_Backslash) return hold(*event, false);
  QWidget::keyReleaseEvent(event);
}

void CurveCanvas::hold(const QKeyEvent& event, bool isDown) {
  if (event.isAutoRepeat()) return;
  if (event.key() == Qt::Key_Backslash) return state_->view.setScanOnly(isDown);
  state_->spaceHeld = isDown;
  state_->updateMouseCursor();
}

bool CurveCanvas::eventFilter(QObject* watched, QEvent* event) {
  const bool isDown = event->type() == QEvent::KeyPress;
  if ((!isDown && event->type() != QEvent::KeyRelease) || watched == this || !watched->isWidgetType()) return false;
  const auto& key = *static_cast<QKeyEvent*>(event);
  const bool isSpace = key.key() == Qt::Key_Space;
  if ((!isSpace && key.key() != Qt::Key_Backslash) || (key.modifiers() & ~Qt::KeypadModifier) != 0) return false;
  // What was pressed for the drawing is released for it, wherever the mouse has gone meanwhile.
  const bool isHeld = isSpace ? state_->spaceHeld : state_->view.isScanOnly();
  if (isDown ? !takesHeldKey(static_cast<QWidget&>(*watched), isSpace) : !isHeld) return false;
  hold(key, isDown);
  return true;
}

bool CurveCanvas::takesHeldKey(const QWidget& focused, bool isSpace) const {
  if (focused.window() != window() || QApplication::activePopupWidget() || QApplication::activeModalWidget())
    return false;
  const bool isEditor = focused.inherits("QLineEdit") || focused.inherits("QTextEdit") ||
                        focused.inherits("QPlainTextEdit") || focused.inherits("QAbstractSpinBox");
  // Space presses the button that has the focus, unless the mouse is on the drawing.
  return !isEditor && (!isSpace || rect().contains(mapFromGlobal(QCursor::pos())));
}

bool CurveCanvas::event(QEvent* event) {
  if (takeProfile(*event, *state_)) return true;
  double factor = 1.0;
  QPointF anchor;
  if (event->type() == QEvent::NativeGesture) {
    const auto* gesture = static_cast<QNativeGestureEvent*>(event);
    if (gesture->gestureType() == Qt::ZoomNativeGesture) {
      factor = std::exp(gesture->value());
      anchor = gesture->position();
    }
  } else if (event->type() == QEvent::Gesture) {
    const auto* all = static_cast<QGestureEvent*>(event);
    if (const auto* pinch = static_cast<QPinchGesture*>(all->gesture(Qt::PinchGesture))) {
      factor = pinch->scaleFactor();
      anchor = mapFromGlobal(pinch->centerPoint().toPoint());
    }
  } else if (event->type() == QEvent::ShortcutOverride) {
    // Within a gesture Esc takes that back, before it stops work or hides a message.
    if ((state_->isPressed || state_->tool().isUnderWay()) && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
      event->accept();
      return true;
    }
  } else if (event->type() == QEvent::WindowDeactivate) {
    // A key released in another window is never seen here.
    state_->spaceHeld = false;
    state_->view.setScanOnly(false);
  }
  if (factor > 0.0 && factor != 1.0) {
    state_->transform.zoomAt(zoom() * factor, anchor);
    state_->isFitted = false;
    state_->transformChanged();
    emit zoomChanged(zoom());
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

}  // namespace batten
