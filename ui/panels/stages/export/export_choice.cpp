// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_choice.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/curves/curve_names.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kSelectionWidth = 118, kTickRow = 24, kLeastTickRows = 8;   // [px] width and height; rows that are seen
constexpr int kNumberRole = Qt::UserRole, kIndexRole = Qt::UserRole + 1;  // data of a row

}  // namespace

ExportChoice::ExportChoice(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      selection_(new QComboBox(this)),
      ticks_(new QWidget(this)),
      list_(new QListWidget(ticks_)) {
  build();
  connect(selection_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    refresh();
    emit changed();
  });
  connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
    if (filling_) return;
    const int number = item->data(kNumberRole).toInt();
    if (item->checkState() == Qt::Checked)
      unticked_.erase(number);
    else
      unticked_.insert(number);
    emit changed();
  });
  connect(list_, &QListWidget::currentItemChanged, this, [this](const QListWidgetItem* item) {
    if (!filling_ && item != nullptr) session_.selectCurve(item->data(kIndexRole).toInt());
  });
}

void ExportChoice::build() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  auto* row = new QHBoxLayout;
  auto* name = new QLabel(tr("Which curves"), this);
  const QString help = tr("All included curves, the selected one, or those that are ticked in a list.");
  name->setToolTip(help);
  selection_->setToolTip(help);
  selection_->setObjectName(QStringLiteral("export.choice"));
  selection_->setAccessibleName(tr("Which curves"));
  selection_->addItems({tr("All"), tr("The selected one"), tr("Ticked ones")});
  selection_->setFixedWidth(kSelectionWidth);
  row->addWidget(name);
  row->addStretch();
  row->addWidget(selection_);
  layout->addLayout(row);
  list_->setObjectName(QStringLiteral("export.list"));
  list_->setAccessibleName(tr("Curves to export"));
  list_->setUniformItemSizes(true);
  list_->setFrameShape(QFrame::NoFrame);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setToolTip(tr("Tick what is to be exported; a click on a name selects the curve in the drawing."));
  auto* box = new QVBoxLayout(ticks_);
  box->setContentsMargins(0, 0, 0, 0);
  box->setSpacing(4);
  box->addWidget(list_);
  auto* links = new QHBoxLayout;
  for (const bool ticked : {true, false}) {
    auto* link = linkButton(ticked ? tr("Tick all") : tr("Tick none"),
                            ticked ? QStringLiteral("export.all") : QStringLiteral("export.none"), ticks_);
    connect(link, &QPushButton::clicked, this, [this, ticked] { tickAll(ticked); });
    links->addWidget(link);
  }
  links->addStretch();
  box->addLayout(links);
  layout->addWidget(ticks_);
  ticks_->hide();
}

ExportChoice::Selection ExportChoice::selection() const {
  constexpr std::array kListed = {All, Selected, Ticked};  // in the order of the list
  return kListed.at(selection_->currentIndex());
}

std::optional<std::set<int>> ExportChoice::numbers() const {
  if (selection() == All) return std::nullopt;
  std::set<int> numbers;
  const auto curves = session_.curves();
  for (int i = 0; i < std::ssize(curves); ++i) {
    if (!curves[i].included || (selection() == Selected && i != session_.selectedCurve())) continue;
    const int number = curveNumber(session_.output(), curves[i]);
    if (selection() == Selected || !unticked_.contains(number)) numbers.insert(number);
  }
  return numbers;
}

QString ExportChoice::obstacle() const {
  const auto chosen = numbers();
  if (!chosen || !chosen->empty()) return {};
  return selection() == Selected ? tr("Select the curve to export, or take all.")
                                 : tr("Tick at least one curve to export, or take all.");
}

void ExportChoice::refresh() {
  ticks_->setVisible(selection() == Ticked);
  setMaximumHeight(QWIDGETSIZE_MAX);
  setSizePolicy(QSizePolicy::Preferred, selection() == Ticked ? QSizePolicy::Preferred : QSizePolicy::Fixed);
  if (selection() != Ticked) return;
  filling_ = true;
  const auto curves = session_.curves();
  int row = 0;
  for (int i = 0; i < std::ssize(curves); ++i) {
    if (!curves[i].included) continue;
    if (row == list_->count()) list_->addItem(new QListWidgetItem);
    QListWidgetItem* item = list_->item(row++);
    const int number = curveNumber(session_.output(), curves[i]);
    item->setText(curveName(session_, i));
    item->setToolTip(curveOrigin(session_, i));
    item->setData(kNumberRole, number);
    item->setData(kIndexRole, i);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(unticked_.contains(number) ? Qt::Unchecked : Qt::Checked);
    item->setFont(uiFont(12));
    if (i == session_.selectedCurve()) list_->setCurrentItem(item);
  }
  while (list_->count() > row) delete list_->takeItem(list_->count() - 1);
  filling_ = false;
  const int line = list_->count() > 0 ? std::max(list_->sizeHintForRow(0), 1) : kTickRow;
  const int least = line * std::clamp(list_->count(), 1, kLeastTickRows) + 2,
            all = line * std::max(1, list_->count()) + 2;
  list_->setMinimumHeight(least);
  list_->setMaximumHeight(all);
  // The box around the list grows with it, and no further.
  for (QWidget* around : {ticks_, static_cast<QWidget*>(this)}) {
    around->updateGeometry();
    around->setMaximumHeight(around->minimumSizeHint().height() + all - least);
  }
}

void ExportChoice::tickAll(bool ticked) {
  unticked_.clear();
  if (!ticked) {
    for (const TracedCurve& curve : session_.curves()) unticked_.insert(curveNumber(session_.output(), curve));
  }
  refresh();
  emit changed();
}

void ExportChoice::reset() {
  unticked_.clear();
  const QSignalBlocker quiet(selection_);
  selection_->setCurrentIndex(All);
  refresh();
}

}  // namespace batten
