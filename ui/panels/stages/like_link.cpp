// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/like_link.h"

#include <QCoreApplication>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <iterator>

#include "core/fairing/like_profile.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/curve_names.h"
#include "ui/session/fairing_edits.h"
#include "ui/session/profile_library.h"

namespace batten {
namespace {

QString words(const char* text) { return QCoreApplication::translate("LikeLink", text); }

const NurbsCurve& resultOf(const TracedCurve& curve) { return curve.faired.isEmpty() ? curve.sketched : curve.faired; }

void followShape(EditorSession& session, const std::vector<ProfilePoint>& shape) {
  if (const TracedCurve* curve = session.selected())
    drawTarget(session, profileLike(shape, curve->sketched, curve->closed), -1);
}

void followSaved(EditorSession& session, QWidget* parent, const QString& name) {
  const auto shape = ProfileLibrary().load(name);
  if (shape) return followShape(session, *shape);
  QMessageBox::warning(parent, words("Profile"), QString::fromStdString(shape.error().message));
}

void saveProfile(EditorSession& session, QWidget* parent) {
  const TracedCurve* curve = session.selected();
  if (!curve) return;
  const auto shape = shapeOf(resultOf(*curve));
  bool isGiven = false;
  const QString name = QInputDialog::getText(parent, words("Save the profile"), words("Name"), QLineEdit::Normal,
                                             curveName(session, session.selectedCurve()), &isGiven);
  if (!isGiven) return;
  if (const auto saved = ProfileLibrary().save(name.trimmed(), shape); !saved)
    QMessageBox::warning(parent, words("Profile"), QString::fromStdString(saved.error().message));
}

void showMenu(EditorSession& session, QPushButton* link) {
  if (!session.selected()) return;
  auto* menu = new QMenu(link);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setObjectName(QStringLiteral("fairing.likes"));
  const auto curves = session.curves();
  for (int i = 0; i < std::ssize(curves); ++i) {
    const TracedCurve& other = curves[static_cast<std::size_t>(i)];
    if (i == session.selectedCurve() || other.sketched.isEmpty()) continue;
    const auto shape = shapeOf(resultOf(other));
    QObject::connect(menu->addAction(curveName(session, i)), &QAction::triggered, link,
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
                   [&session, link] { saveProfile(session, link); });
  menu->popup(link->mapToGlobal(QPoint(0, link->height())));
}

}  // namespace

QPushButton* likeLink(EditorSession& session, QWidget* parent) {
  auto* link = linkButton(words("Make it like…"), QStringLiteral("fairing.like"), parent);
  link->setToolTip(
      words("Uses the curvature profile of another or a saved curve as the target, rescaled to this "
            "length."));
  QObject::connect(link, &QPushButton::clicked, link, [&session, link] { showMenu(session, link); });
  return link;
}

}  // namespace batten
