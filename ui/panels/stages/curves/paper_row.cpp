// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/paper_row.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/pipeline/recipe/paper_presets.h"
#include "ui/panels/controls/panel_parts.h"

namespace batten {

PaperRow::PaperRow(EditorSession& session, QWidget* parent)
    : QWidget(parent), session_(session), cost_(note({}, this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  row->addWidget(new QLabel(tr("As in paper"), this));
  for (const PaperPreset& preset : paperPresets()) {
    const QString id = QString::fromStdString(preset.id);
    auto* link = linkButton(preset.cost.empty() ? tr("Back") : id, QStringLiteral("curves.paper.") + id, this);
    link->setToolTip(preset.cost.empty()
                         ? tr("Restores the program's settings.")
                         : tr("%1: sets everything as in paper %2. %3")
                               .arg(QString::fromStdString(preset.title), id, QString::fromStdString(preset.cost)));
    link->setAccessibleName(preset.cost.empty() ? tr("Back to the program's settings") : tr("As in paper %1").arg(id));
    links_.push_back(link);
    row->addWidget(link);
    connect(link, &QPushButton::clicked, this, [this, &preset, id] {
      Recipe after = session_.recipe();
      if (!applyPaperPreset(preset, after)) return;
      session_.change(preset.cost.empty() ? tr("Program's settings") : tr("As in paper %1").arg(id), std::move(after));
    });
  }
  row->addStretch();
  column->addLayout(row);
  cost_->setObjectName(QStringLiteral("curves.paperCost"));
  connect(&session_, &EditorSession::recipeChanged, this, &PaperRow::refresh);
  refresh();
}

QWidget* PaperRow::cost() const { return cost_; }

void PaperRow::refresh() {
  const PaperPreset* now = paperPresetOf(session_.recipe());
  const bool isPaper = now != nullptr && !now->cost.empty();
  links_.back()->setVisible(isPaper);
  cost_->setVisible(isPaper);
  if (isPaper)
    cost_->setText(tr("As in paper %1, %2: %3")
                       .arg(QString::fromStdString(now->id), QString::fromStdString(now->title),
                            QString::fromStdString(now->cost)));
}

}  // namespace batten
