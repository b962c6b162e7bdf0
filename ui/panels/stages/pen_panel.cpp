// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/pen_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/edits/pen_edits.h"
#include "ui/theme/theme.h"

namespace batten {

PenPanel::PenPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      draw_(plainButton(tr("Draw with the pen"), QStringLiteral("pen.draw"), this)),
      list_(new QListWidget(this)),
      remove_(plainButton(tr("Remove"), QStringLiteral("pen.remove"), this)),
      removeAll_(plainButton(tr("Remove all"), QStringLiteral("pen.removeAll"), this)) {
  // What is left of the panel's height belongs below it.
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(caption(tr("Drawn by hand"), this));
  layout->addWidget(
      note(tr("Drag on the drawing with a mouse or tablet. These lines are added to those of the scan."), this));
  draw_->setCheckable(true);
  draw_->setToolTip(tr("Drag to draw a line; end at its start to close it  (D)"));
  layout->addWidget(draw_, 0, Qt::AlignLeft);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(remove_);
  buttons->addWidget(removeAll_);
  buttons->addStretch();
  layout->addLayout(buttons);
  list_->setObjectName(QStringLiteral("pen.list"));
  list_->setAccessibleName(tr("Lines drawn by hand"));
  layout->addWidget(list_);
  auto* del = new QShortcut(QKeySequence(Qt::Key_Delete), list_, nullptr, nullptr, Qt::WidgetShortcut);
  connect(del, &QShortcut::activated, this, &PenPanel::removeSelected);
  remove_->setToolTip(tr("Removes the line that is selected in the list."));
  removeAll_->setToolTip(tr("Removes all lines drawn by hand."));
  connect(remove_, &QPushButton::clicked, this, &PenPanel::removeSelected);
  connect(removeAll_, &QPushButton::clicked, this, [this] { removeAllStrokes(session_); });
  connect(draw_, &QPushButton::clicked, this, [this](bool on) { view_.setTool(on ? Tool::Pen : Tool::Select); });
  connect(&view_, &ViewSettings::toolChanged, this, [this](Tool tool) { draw_->setChecked(tool == Tool::Pen); });
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    remove_->setEnabled(row >= 0);
    if (filling_ || row < 0) return;
    if (const auto curve = curveOfStroke(session_, row)) session_.selectCurve(*curve);
  });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished})
    connect(&session_, signal, this, &PenPanel::refresh);
  refresh();
}

void PenPanel::refresh() {
  filling_ = true;
  const auto& strokes = session_.recipe().penStrokes;
  list_->clear();
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const QString points = tr("%1 points").arg(grouped(static_cast<qint64>(strokes[i].points.size())));
    auto* item = new QListWidgetItem(
        tr("Line %1   %2%3").arg(i + 1).arg(points, strokes[i].closed ? tr(", closed") : QString()), list_);
    item->setFont(uiFont(12));
  }
  const auto selected = strokeOf(session_, session_.selectedCurve());
  list_->setCurrentRow(selected ? static_cast<int>(*selected) : -1);
  const int row = list_->count() > 0 ? std::max(22, list_->sizeHintForRow(0)) : 22;
  list_->setFixedHeight(row * std::clamp(list_->count(), 1, 8) + 2);
  list_->setVisible(!strokes.empty());
  removeAll_->setEnabled(!strokes.empty());
  remove_->setEnabled(list_->currentRow() >= 0);
  draw_->setEnabled(session_.hasScan());
  draw_->setChecked(view_.tool() == Tool::Pen);
  filling_ = false;
}

void PenPanel::removeSelected() {
  const int row = list_->currentRow();
  if (row >= 0) removeStroke(session_, row);
}

}  // namespace batten
