// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/segmented_control.h"

#include <QButtonGroup>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QToolButton>
#include <algorithm>

#include "ui/theme/theme.h"

namespace batten {

SegmentedControl::SegmentedControl(const QStringList& labels, QWidget* parent)
    : QFrame(parent), group_(new QButtonGroup(this)) {
  setObjectName(QStringLiteral("segmented"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  // Equal parts where the longest word allows it, else parts that follow the words.
  const QFontMetrics metrics(uiFont(13, QFont::DemiBold));
  int widest = 0;
  for (const QString& one : labels) widest = std::max(widest, metrics.horizontalAdvance(one));
  const bool isEven = (widest + 10) * labels.size() <= 268;
  const bool isTight = !fits(labels, 280);
  for (int i = 0; i < labels.size(); ++i) {
    auto* button = new QToolButton(this);
    button->setText(labels[i]);
    button->setAccessibleName(labels[i]);
    button->setCheckable(true);
    button->setProperty("segment", true);
    button->setProperty("tight", isTight);
    button->setFocusPolicy(Qt::TabFocus);
    // Never wider than the panel: a control that is would push everything in it out of sight.
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    group_->addButton(button, i);
    layout->addWidget(button, isEven ? 1 : metrics.horizontalAdvance(labels[i]) + 10);
  }
  connect(group_, &QButtonGroup::idClicked, this, &SegmentedControl::chosen);
}

bool SegmentedControl::fits(const QStringList& labels, int widthPx) {
  const QFontMetrics metrics(uiFont(13, QFont::DemiBold));
  int needed = 0;
  for (const QString& label : labels) needed += metrics.horizontalAdvance(label) + 12;
  return needed <= widthPx;
}

int SegmentedControl::current() const { return group_->checkedId(); }

void SegmentedControl::setCurrent(std::optional<int> index) {
  const int id = index.value_or(-1);  // what Qt takes for none
  if (id == group_->checkedId()) return;
  if (auto* button = group_->button(id)) {
    button->setChecked(true);
    return;
  }
  group_->setExclusive(false);
  for (auto* button : group_->buttons()) button->setChecked(false);
  group_->setExclusive(true);
}

void SegmentedControl::setNames(const QString& prefix, const QStringList& words) {
  for (int i = 0; i < words.size(); ++i)
    if (auto* button = group_->button(i)) button->setObjectName(prefix + QLatin1Char('.') + words[i]);
}

void SegmentedControl::setSegmentEnabled(int index, bool enabled) {
  if (auto* button = group_->button(index)) button->setEnabled(enabled);
}

}  // namespace batten
