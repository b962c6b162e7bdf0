// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/like_link.h"

#include <QCoreApplication>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QPainter>
#include <QPixmap>
#include <QPolygonF>
#include <QPushButton>
#include <QTransform>
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/fairing/profile/like_profile.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/like_edits.h"
#include "ui/session/files/profile_library.h"

namespace batten {
namespace {

QString words(const char* text) { return QCoreApplication::translate("LikeLink", text); }

const NurbsCurve& resultOf(const TracedCurve& curve) { return curve.faired.isEmpty() ? curve.sketched : curve.faired; }

void followSaved(EditorSession& session, QWidget* parent, const QString& name) {
  if (const auto done = followSavedProfile(session, name); !done)
    QMessageBox::warning(parent, words("Profile"), QString::fromStdString(done.error().message));
}

void saveProfile(EditorSession& session, QWidget* parent, const std::function<void()>& saved) {
  const TracedCurve* curve = session.selected();
  if (!curve) return;
  const auto shape = shapeOf(resultOf(*curve));
  bool isGiven = false;
  const QString name = QInputDialog::getText(parent, words("Save the profile"), words("Name"), QLineEdit::Normal,
                                             curveName(session, *session.selectedCurve()), &isGiven);
  if (!isGiven) return;
  if (const auto done = ProfileLibrary().save(name.trimmed(), shape); !done)
    QMessageBox::warning(parent, words("Profile"), QString::fromStdString(done.error().message));
  saved();
}

/// The course of a curve as it lies on the drawing, so that it is known again.
QIcon courseIcon(const NurbsCurve& curve, const QWidget* link) {
  constexpr int kPlaces = 96;                                  // of a polygon for the curve
  constexpr double kProfilePictureSide = 20.0, kMargin = 1.0;  // px
  QPolygonF line;
  for (int i = 0; i <= kPlaces; ++i) {
    const Vec2 p = curve.point(curve.start() + (curve.end() - curve.start()) * i / kPlaces);
    line.append({p.x(), -p.y()});
  }
  const QRectF box = line.boundingRect();
  const double scale = (kProfilePictureSide - 2.0 * kMargin) / std::max({box.width(), box.height(), 1e-9});
  QTransform fit;
  fit.translate(0.5 * kProfilePictureSide, 0.5 * kProfilePictureSide);
  fit.scale(scale, scale);
  fit.translate(-box.center().x(), -box.center().y());
  const double ratio = link->devicePixelRatioF();
  QPixmap picture(QSize(static_cast<int>(kProfilePictureSide * ratio), static_cast<int>(kProfilePictureSide * ratio)));
  picture.setDevicePixelRatio(ratio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(link->palette().color(QPalette::Text), 1.4));
  painter.drawPolyline(fit.map(line));
  return QIcon(picture);
}

void showMenu(EditorSession& session, QPushButton* link, const std::function<void()>& saved) {
  if (!session.selected()) return;
  auto* menu = new QMenu(link);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setObjectName(QStringLiteral("fairing.likes"));
  const auto curves = session.curves();
  for (int i = 0; i < std::ssize(curves); ++i) {
    const TracedCurve& other = curves[i];
    if (i == session.selectedCurve() || other.sketched.isEmpty()) continue;
    const auto shape = shapeOf(resultOf(other));
    const QString name = words("%1 · %2 mm").arg(curveName(session, i)).arg(other.sketchedFigures.lengthMm, 0, 'f', 0);
    QObject::connect(menu->addAction(courseIcon(resultOf(other), link), name), &QAction::triggered, link,
                     [&session, shape] { followShape(session, shape); });
  }
  const QStringList names = ProfileLibrary().names();
  if (!names.isEmpty()) menu->addSeparator();
  for (const QString& name : names) {
    QObject::connect(menu->addAction(name), &QAction::triggered, link,
                     [&session, link, name] { followSaved(session, link, name); });
  }
  menu->addSeparator();
  QObject::connect(menu->addAction(words("Save the profile of this curve…")), &QAction::triggered, link,
                   [&session, link, saved] { saveProfile(session, link, saved); });
  menu->popup(link->mapToGlobal(QPoint(0, link->height())));
}

}  // namespace

QPushButton* likeLink(EditorSession& session, QWidget* parent, std::function<void()> saved) {
  auto* link = linkButton(words("Make it like…"), QStringLiteral("fairing.like"), parent);
  link->setToolTip(
      words("Uses the curvature profile of another or a saved curve as the target, rescaled to this "
            "length."));
  QObject::connect(link, &QPushButton::clicked, link,
                   [&session, link, saved = std::move(saved)] { showMenu(session, link, saved); });
  return link;
}

}  // namespace batten
