// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/knot_gallery.h"

#include <QAbstractButton>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/background/background_worker.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kStepsPerSpan = 8;                  // of a polygon for the curve
constexpr int kFirstDegree = 2, kLastDegree = 5;  // that are shown

/// What one tile draws, page up = screen up (y mirrored).
struct TilePicture {
  QPainterPath curve;
  std::vector<QPointF> points, sharp;
};

QPointF onScreen(const Vec2& p) { return {p.x(), -p.y()}; }

QPainterPath pathOf(const NurbsCurve& curve) {
  QPainterPath path;
  const std::vector<double> breaks = curve.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double span = breaks[i + 1] - breaks[i];
    // The right limit at a knot and the left one at the next: a break of the curve stays a gap, as it is.
    const QPointF from = onScreen(curve.point(breaks[i]));
    if (path.isEmpty())
      path.moveTo(from);
    else if (QLineF(path.currentPosition(), from).length() > 1e-6 * (1.0 + std::abs(from.x()) + std::abs(from.y())))
      path.moveTo(from);
    for (int k = 1; k <= kStepsPerSpan; ++k) {
      const double f = k < kStepsPerSpan ? static_cast<double>(k) / kStepsPerSpan : 1.0 - 1e-9;
      path.lineTo(onScreen(curve.point(breaks[i] + f * span)));
    }
  }
  return path;
}

}  // namespace

/// One curve of the gallery.
class KnotTile : public QAbstractButton {
 public:
  KnotTile(int degree, bool uniform, QWidget* parent) : QAbstractButton(parent), degree_(degree), uniform_(uniform) {
    setObjectName(QStringLiteral("knots.tile.%1.%2")
                      .arg(uniform ? QStringLiteral("uniform") : QStringLiteral("repeated"))
                      .arg(degree));
    setCheckable(true);
    setFocusPolicy(Qt::TabFocus);
    setAttribute(Qt::WA_Hover);
    setMinimumSize(120, 110);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAccessibleName(uniform ? KnotGallery::tr("Degree %1, uniform knots").arg(degree)
                              : KnotGallery::tr("Degree %1, repeated knots").arg(degree));
    setToolTip(KnotGallery::tr("Click to take degree %1.").arg(degree));
  }
  int degree() const { return degree_; }
  bool isUniform() const { return uniform_; }
  void setPicture(TilePicture picture) {
    picture_ = std::move(picture);
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF frame = QRectF(rect()).adjusted(1, 1, -1, -1);
    painter.setPen(QPen(isChecked() ? theme.accent : theme.line, isChecked() ? 2.0 : 1.0));
    painter.setBrush(theme.panel);
    painter.drawRoundedRect(frame, 6, 6);
    if (hasFocus()) drawFocusRing(painter, frame, 6, theme);
    QRectF bounds = picture_.curve.controlPointRect();
    for (const QPointF& p : picture_.points) bounds = bounds.united(QRectF(p, QSizeF(1e-9, 1e-9)));
    if (bounds.width() <= 0.0 && bounds.height() <= 0.0) return;
    const QRectF room = frame.adjusted(12, 12, -12, -12);
    const double scale =
        std::min(room.width() / std::max(bounds.width(), 1e-9), room.height() / std::max(bounds.height(), 1e-9));
    painter.translate(room.center());
    painter.scale(scale, scale);
    painter.translate(-bounds.center());
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme.mute);
    for (const QPointF& p : picture_.points) painter.drawEllipse(p, 1.1 / scale, 1.1 / scale);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(
        QPen(uniform_ ? QColor(200, 112, 0) : theme.accent, 1.5 / scale, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(picture_.curve);
    painter.setPen(QPen(QColor(201, 60, 16), 1.3 / scale));
    painter.setBrush(theme.panel);
    const double half = 2.6 / scale;
    for (const QPointF& p : picture_.sharp) painter.drawRect(QRectF(p.x() - half, p.y() - half, 2 * half, 2 * half));
  }

 private:
  int degree_;
  bool uniform_;
  TilePicture picture_;
};

KnotGallery::KnotGallery(EditorSession& session, QWidget* parent)
    : QWidget(parent, Qt::Window), session_(session), worker_(std::make_unique<BackgroundWorker>()) {
  setObjectName(QStringLiteral("knots.gallery"));
  setWindowTitle(tr("Uniform and repeated knots — Batten"));
  resize(820, 500);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(16, 12, 16, 16);
  grid->setSpacing(8);
  for (int degree = kFirstDegree; degree <= kLastDegree; ++degree) {
    auto* title = caption(tr("Degree %1").arg(degree), this);
    title->setAlignment(Qt::AlignHCenter);
    title->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    grid->addWidget(title, 0, degree - 1);
  }
  for (const bool uniform : {true, false}) {
    auto* side = note(uniform ? tr("Uniform knots") : tr("Repeated at the corners"), this);
    side->setFixedWidth(84);
    side->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    grid->addWidget(side, uniform ? 1 : 2, 0);
    for (int degree = kFirstDegree; degree <= kLastDegree; ++degree) {
      auto* tile = new KnotTile(degree, uniform, this);
      tiles_.push_back(tile);
      grid->addWidget(tile, uniform ? 1 : 2, degree - 1);
      connect(tile, &QAbstractButton::clicked, this, [this, degree] {
        Recipe after = session_.recipe();
        after.construct.degree = degree;
        session_.change(tr("Degree %1").arg(degree), std::move(after));
        refresh();
      });
    }
  }
  grid->setRowStretch(1, 1);
  grid->setRowStretch(2, 1);
  connect(&session_, &EditorSession::recipeChanged, this, &KnotGallery::refresh);
  refresh();
  for (KnotTile* tile : tiles_)
    if (tile->isChecked()) tile->setFocus();
}

KnotGallery::~KnotGallery() = default;

void KnotGallery::refresh() {
  for (KnotTile* tile : tiles_)
    tile->setChecked(!tile->isUniform() && tile->degree() == session_.recipe().construct.degree);
}

void KnotGallery::setLine(const LinePolygon& line, SharpKnots repeated) {
  const int request = ++request_;
  worker_->start([this, line, repeated, request](const CancelToken& token) {
    std::vector<TilePicture> pictures;
    for (const bool uniform : {true, false}) {
      for (int degree = kFirstDegree; degree <= kLastDegree; ++degree) {
        if (token.isCancelled()) return;
        TilePicture picture;
        if (const auto made = polygonCurve(line, degree, uniform ? SharpKnots::Uniform : repeated))
          picture.curve = pathOf(made->curve);
        for (const Vec2& p : line.points) picture.points.push_back(onScreen(p));
        for (const int s : line.sharp) picture.sharp.push_back(onScreen(line.points[s]));
        pictures.push_back(std::move(picture));
      }
    }
    inbox_.post([this, request, pictures = std::move(pictures)] {
      if (request_ != request) return;
      for (std::size_t i = 0; i < pictures.size(); ++i) tiles_[i]->setPicture(pictures[i]);
    });
  });
}

void KnotGallery::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return void(close());
  QWidget::keyPressEvent(event);
}

}  // namespace batten
