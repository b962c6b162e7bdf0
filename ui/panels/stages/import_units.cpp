// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/import_units.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <string>

#include "core/document/import_curves.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/panel_parts.h"

namespace batten {
namespace {

constexpr int kImportUnitWidth = 92;        // px
constexpr std::size_t kMostImportRows = 8;  ///< A drawing of more files shows the last ones.

bool isUnitAssumed(const std::string& unit) { return unit.ends_with('?'); }

}  // namespace

ImportUnits::ImportUnits(EditorSession& session, QWidget* parent)
    : QWidget(parent), session_(session), note_(note({}, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(caption(tr("Imported lines"), this));
  note_->setObjectName(QStringLiteral("import.note"));
  layout->addWidget(note_);
  connect(&session_, &EditorSession::scanOpened, this, &ImportUnits::refresh);
  connect(&session_, &EditorSession::recipeChanged, this, &ImportUnits::refresh);
  refresh();
}

void ImportUnits::refresh() {
  std::vector<std::pair<std::string, std::string>> now;
  if (session_.hasScan())
    for (const ImportedFile& file : session_.recipe().imports) now.emplace_back(file.source, file.unit);
  setVisible(!now.empty());
  if (now == shown_) return;
  shown_ = std::move(now);
  build();
  const bool asks =
      std::any_of(shown_.begin(), shown_.end(), [](const auto& one) { return isUnitAssumed(one.second); });
  note_->setText((asks ? tr("A file states no unit: choose the unit of its coordinates. ") : QString()) +
                 tr("Resolution, width and paper size do not affect imported lines."));
}

void ImportUnits::build() {
  // The list may be changed by a choice in one of these rows, which is still at work then.
  if (rows_ != nullptr) {
    rows_->hide();
    rows_->setParent(nullptr);
    rows_->deleteLater();
  }
  rows_ = new QWidget(this);
  auto* grid = new QGridLayout(rows_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setColumnStretch(0, 1);
  const std::size_t first = shown_.size() - std::min(shown_.size(), kMostImportRows);
  for (std::size_t i = first; i < shown_.size(); ++i) {
    const auto& [source, unit] = shown_[i];
    const QString name = QString::fromStdString(source), now = QString::fromStdString(unit);
    auto* label = new QLabel(name, rows_);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    label->setToolTip(name);
    auto* choice = new QComboBox(rows_);
    choice->setObjectName(QStringLiteral("import.unit.%1").arg(i));
    choice->setAccessibleName(tr("Unit of %1").arg(name));
    choice->setToolTip(tr("Unit of the coordinates in the file. Changing it rescales the imported lines."));
    choice->setFixedWidth(kImportUnitWidth);
    QStringList units = {QStringLiteral("mm"), QStringLiteral("cm"), QStringLiteral("m"), QStringLiteral("in")};
    if (!units.contains(now)) units.prepend(now);
    choice->addItems(units);
    choice->setCurrentText(now);
    connect(choice, &QComboBox::textActivated, this, [this, i](const QString& wanted) { choose(i, wanted); });
    grid->addWidget(label, static_cast<int>(i - first), 0);
    grid->addWidget(choice, static_cast<int>(i - first), 1);
  }
  static_cast<QVBoxLayout*>(layout())->insertWidget(1, rows_);
}

void ImportUnits::choose(std::size_t import, const QString& unit) {
  if (!session_.hasScan() || import >= session_.recipe().imports.size() || import >= shown_.size()) return;
  if (unit.toStdString() == shown_[import].second) return;
  auto after =
      withImportUnit(session_.recipe(), import, unit.toStdString(), frameFor(*session_.scan(), session_.recipe()));
  if (!after) {
    // The choice goes back to what holds.
    shown_.clear();
    refresh();
    emit failed(after.error());
    return;
  }
  session_.change(tr("Unit of %1").arg(QString::fromStdString(shown_[import].first)), std::move(*after));
}

}  // namespace batten
