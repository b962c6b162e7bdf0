// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_preview.h"

#include <QApplication>
#include <QLayout>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/curve/arc_length.h"
#include "core/exchange/model/arrangement.h"
#include "core/exchange/model/cad_drawing.h"
#include "ui/session/background/background_worker.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

// around the drawing; sizes of marks; reach of the mouse
constexpr double kMarginPx = 12.0, kArrowPx = 6.0, kStartPx = 2.4, kHitPx = 6.0;
constexpr double kLeastMarkedPx = 5.0 * kArrowPx;  ///< Diagonal of a curve that is marked.
constexpr int kPointsPerPiece = 48;                // Of a polygon for the curve.
constexpr int kLeastHeight = 72, kBelowPx = 8;     // [px] of the preview, and below what stays in sight
constexpr int kMostMarks = 80;                     ///< Arrows of more curves would hide them.

/// Of a chain in its order of travel.
PreviewCurve shapeOf(const std::vector<ExportPiece>& pieces, const ExportCurve& line) {
  PreviewCurve shape;
  for (const ExportPiece& piece : pieces) {
    const auto samples = sampleByArcLength(piece.curve, kPointsPerPiece);
    for (const CurveSample& sample : samples) shape.points << QPointF(sample.point.x(), -sample.point.y());
  }
  const auto middle = sampleByArcLength(pieces[pieces.size() / 2].curve, 3)[1];
  shape.arrowAt = {middle.point.x(), -middle.point.y()};
  shape.arrowDirection = {middle.tangent.x(), -middle.tangent.y()};
  shape.isSketched = line.isSketched;
  shape.isClosed = line.closed;
  shape.number = pieces.front().number;
  return shape;
}

}  // namespace

Result<PreviewContent> previewOf(const ExportRequest& request, const RunContext& context) {
  const auto made = arranged(documentOf(request, request.settings, context), isJoined(request.settings), context);
  if (!made) return fail(made.error());
  const ExportDocument document = scaled(made->document, request.settings.scale);
  PreviewContent content;
  content.doubles = made->doubles;
  std::set<std::string> layers;
  for (const ExportCurve& line : document.curves) {
    if (context.isCancelled()) return cancelled();
    layers.insert(line.layer);
    content.curves.push_back(shapeOf(line.pieces, line));
    content.box = content.box.united(content.curves.back().points.boundingRect());
  }
  content.layers = static_cast<int>(layers.size());
  return content;
}

ExportPreview::ExportPreview(QWidget* parent) : QWidget(parent), worker_(std::make_unique<BackgroundWorker>()) {
  setObjectName(QStringLiteral("export.preview"));
  setAccessibleName(tr("What will be written"));
  setFixedHeight(sizeHint().height());
  setCursor(Qt::OpenHandCursor);
  setToolTip(
      tr("What will be written: dots are starts, arrows directions. Drag a curve out as an SVG file; click it to "
         "select it."));
}

ExportPreview::~ExportPreview() = default;

void ExportPreview::show(const ExportRequest& request) {
  const int asked = ++request_;
  worker_->start([this, request, asked](const CancelToken& cancel) {
    RunContext context;
    context.cancel = cancel;
    auto content = previewOf(request, context);
    inbox_.post([this, asked, content = std::move(content)]() mutable {
      if (request_ != asked) return;
      content_ = content ? std::move(*content) : PreviewContent{};
      update();
      emit changed();
    });
  });
}

void ExportPreview::clear() {
  ++request_;
  content_ = {};
  update();
  emit changed();
}

QPointF ExportPreview::toWidget(QPointF mm) const {
  const QRectF& box = content_.box;
  const double scale = std::min((width() - 2 * kMarginPx) / std::max(box.width(), 1e-9),
                                (height() - 2 * kMarginPx) / std::max(box.height(), 1e-9));
  return rect().toRectF().center() + scale * (mm - box.center());
}

void ExportPreview::keepInSight(QWidget* below) {
  below_ = below;
  parentWidget()->installEventFilter(this);
}

bool ExportPreview::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest) fitHeight();
  return QWidget::eventFilter(watched, event);
}

void ExportPreview::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  // What is seen of the panel; only now is the panel where it stays.
  if (QWidget* view = parentWidget()->parentWidget()) view->installEventFilter(this);
  fitHeight();
}

void ExportPreview::fitHeight() {
  QWidget *panel = parentWidget(), *view = panel->parentWidget();
  if (!below_ || !view || !isVisible()) return;
  panel->layout()->activate();
  const int rest = below_->geometry().bottom() + 1 + kBelowPx - height();
  setFixedHeight(std::clamp(view->height() - rest, kLeastHeight, sizeHint().height()));
}

void ExportPreview::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme.line);
  painter.setBrush(theme.background);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
  painter.setBrush(Qt::NoBrush);
  for (const PreviewCurve& curve : content_.curves) {
    QPolygonF line;
    for (const QPointF& p : curve.points) line << toWidget(p);
    painter.setPen(QPen(curve.isSketched ? theme.mute : theme.accent, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(line);
  }
  if (std::ssize(content_.curves) > kMostMarks) return;
  painter.setPen(Qt::NoPen);
  for (const PreviewCurve& curve : content_.curves) {
    // On a curve that is hardly larger than its marks they would be a blot.
    const QRectF box = curve.points.boundingRect();
    if (QLineF(toWidget(box.topLeft()), toWidget(box.bottomRight())).length() < kLeastMarkedPx) continue;
    painter.setBrush(curve.isSketched ? theme.mute : theme.accent);
    painter.drawEllipse(toWidget(curve.points.front()), kStartPx, kStartPx);
    const double length = std::hypot(curve.arrowDirection.x(), curve.arrowDirection.y());
    if (!(length > 0.0)) continue;
    const QPointF direction = curve.arrowDirection / length, aside(-direction.y(), direction.x()),
                  at = toWidget(curve.arrowAt);
    painter.drawPolygon(
        QPolygonF{{at + 0.6 * kArrowPx * direction, at - 0.6 * kArrowPx * direction + 0.5 * kArrowPx * aside,
                   at - 0.6 * kArrowPx * direction - 0.5 * kArrowPx * aside}});
  }
}

std::optional<int> ExportPreview::curveAt(QPointF widget) const {
  std::optional<int> found;
  double nearest = kHitPx;
  for (const PreviewCurve& curve : content_.curves) {
    for (const QPointF& p : curve.points) {
      const double distance = QLineF(toWidget(p), widget).length();
      if (distance > nearest || !curve.number) continue;
      nearest = distance;
      found = curve.number;
    }
  }
  return found;
}

void ExportPreview::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && !content_.curves.empty()) pressedAt_ = event->position();
}

void ExportPreview::mouseMoveEvent(QMouseEvent* event) {
  if (!pressedAt_ || QLineF(*pressedAt_, event->position()).length() < QApplication::startDragDistance()) return;
  const auto curve = curveAt(*pressedAt_);
  pressedAt_.reset();
  emit dragAsked(curve);
}

void ExportPreview::mouseReleaseEvent(QMouseEvent* event) {
  if (!pressedAt_) return;
  pressedAt_.reset();
  if (const auto curve = curveAt(event->position())) emit chosen(*curve);
}

}  // namespace batten
