// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/profile_shelf.h"

#include <QAction>
#include <QKeySequence>
#include <QMessageBox>
#include <QMimeData>
#include <algorithm>

#include "ui/session/edits/like_edits.h"
#include "ui/session/files/profile_library.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kShelfRow = 24, kMostShelfRows = 5;  // [px] height; rows that are seen

}  // namespace

ProfileShelf::ProfileShelf(EditorSession& session, QWidget* parent) : QListWidget(parent), session_(session) {
  setObjectName(QStringLiteral("fairing.profiles"));
  setAccessibleName(tr("Saved profiles"));
  setToolTip(
      tr("Drag a profile onto a line of the drawing: it becomes its target. Or double-click it for the selected "
         "curve; Del removes it."));
  setFont(uiFont(12));
  setFrameShape(QFrame::NoFrame);
  setUniformItemSizes(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setDragEnabled(true);
  setDragDropMode(QAbstractItemView::DragOnly);
  setDefaultDropAction(Qt::CopyAction);
  connect(this, &QListWidget::itemActivated, this, [this](const QListWidgetItem* item) {
    if (const auto done = followSavedProfile(session_, item->text()); !done)
      QMessageBox::warning(this, tr("Profile"), QString::fromStdString(done.error().message));
  });
  setContextMenuPolicy(Qt::ActionsContextMenu);
  auto* removal = new QAction(tr("Remove the profile…"), this);
  removal->setObjectName(QStringLiteral("fairing.removeProfile"));
  removal->setShortcuts({QKeySequence(Qt::Key_Delete), QKeySequence(Qt::Key_Backspace)});
  removal->setShortcutContext(Qt::WidgetShortcut);
  addAction(removal);
  connect(removal, &QAction::triggered, this, &ProfileShelf::removeCurrent);
  refresh();
}

void ProfileShelf::removeCurrent() {
  const QListWidgetItem* item = currentItem();
  if (item == nullptr) return;
  const QString name = item->text();
  const auto answer =
      QMessageBox::question(this, tr("Remove the profile"),
                            tr("Remove the profile \"%1\"? Drawings that use it keep their targets.").arg(name));
  if (answer != QMessageBox::Yes) return;
  if (const auto done = ProfileLibrary().remove(name); !done)
    QMessageBox::warning(this, tr("Profile"), QString::fromStdString(done.error().message));
  refresh();
  if (count() == 0) emit emptied();
}

void ProfileShelf::refresh() {
  const QStringList names = ProfileLibrary().names();
  clear();
  for (const QString& name : names) {
    auto* entry = new QListWidgetItem(name, this);
    entry->setSizeHint({120, kShelfRow});
  }
  setFixedHeight(kShelfRow * std::clamp(count(), 1, kMostShelfRows) + 2);
}

QStringList ProfileShelf::mimeTypes() const { return {QString::fromLatin1(kProfileMime)}; }

QMimeData* ProfileShelf::mimeData(const QList<QListWidgetItem*>& items) const {
  if (items.isEmpty()) return nullptr;
  auto* dragged = new QMimeData;
  dragged->setData(QString::fromLatin1(kProfileMime), items.front()->text().toUtf8());
  return dragged;
}

void ProfileShelf::showEvent(QShowEvent* event) {
  QListWidget::showEvent(event);
  refresh();
}

}  // namespace batten
