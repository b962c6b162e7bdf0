// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/parameter_editor.h"

#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/pipeline/recipe/parameter_table.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/theme/theme.h"

namespace batten {

ParameterEditor::ParameterEditor(EditorSession& session, const std::vector<std::string_view>& names, QWidget* parent)
    : QWidget(parent), layout_(new QVBoxLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setSpacing(8);
  QWidget* folded = nullptr;
  QVBoxLayout* foldedLayout = nullptr;
  for (const auto name : names) {
    const Parameter* parameter = findParameter(name);
    if (!parameter) continue;
    if (parameter->expert && !folded) {
      folded = new QWidget(this);
      foldedLayout = new QVBoxLayout(folded);
      foldedLayout->setContentsMargins(0, 0, 0, 0);
      foldedLayout->setSpacing(8);
    }
    auto* row = new ParameterRow(session, *parameter, parameter->expert ? folded : this);
    (parameter->expert ? foldedLayout : layout_)->addWidget(row);
    rows_.push_back(row);
  }
  if (!folded) return;
  auto* more = more_ = new QToolButton(this);
  more->setObjectName(QStringLiteral("moreButton"));
  more->setText(tr("More"));
  more->setAccessibleName(tr("More settings"));
  more->setCheckable(true);
  more->setArrowType(Qt::RightArrow);
  more->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  folded_ = folded;
  layout_->addWidget(more);
  layout_->addWidget(folded);
  folded->hide();
  connect(more, &QToolButton::toggled, folded, [more, folded](bool open) {
    folded->setVisible(open);
    more->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
  });
}

ParameterRow* ParameterEditor::row(std::string_view name) const {
  for (auto* row : rows_)
    if (row->parameter().name == name) return row;
  return nullptr;
}

void ParameterEditor::unfold(const QWidget* row) {
  if (folded_ && folded_->isAncestorOf(row)) more_->setChecked(true);
}

void ParameterEditor::addBelow(std::string_view name, QWidget* widget) {
  layout_->insertWidget(layout_->indexOf(row(name)) + 1, widget);
}

void ParameterEditor::setRowVisible(std::string_view name, bool visible) {
  if (auto* found = row(name)) found->setVisible(visible);
  if (!more_) return;
  // "More" of nothing would be a door to an empty room.
  const bool any = std::any_of(rows_.begin(), rows_.end(),
                               [](const ParameterRow* one) { return one->parameter().expert && !one->isHidden(); });
  more_->setVisible(any);
}

}  // namespace batten
