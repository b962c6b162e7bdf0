// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/setting_finder.h"

#include <QAbstractButton>
#include <QAction>
#include <QCheckBox>
#include <QLineEdit>
#include <QPointer>
#include <QScrollArea>
#include <QTimer>

#include "ui/command_palette.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/panels/controls/setting_name.h"

namespace batten {
namespace {

template <class T>
T* ancestorOf(QWidget* widget) {
  for (QWidget* up = widget->parentWidget(); up; up = up->parentWidget())
    if (auto* found = qobject_cast<T*>(up)) return found;
  return nullptr;
}

/// A group of buttons takes the keyboard at the one that is chosen.
QWidget* focusOf(QWidget* control) {
  if (control->focusPolicy() != Qt::NoFocus || control->focusProxy()) return control;
  QWidget* first = nullptr;
  for (auto* button : control->findChildren<QAbstractButton*>()) {
    if (button->focusPolicy() == Qt::NoFocus) continue;
    if (button->isChecked()) return button;
    if (!first) first = button;
  }
  return first ? first : control;
}

/// Neither hidden itself nor within something hidden; folded away under "More" is not hidden.
bool applies(const QWidget& widget, const QWidget& panel) {
  for (const QWidget* one = &widget; one && one != &panel; one = one->parentWidget()) {
    const bool isFold = one != &widget && qobject_cast<const ParameterEditor*>(one->parentWidget());
    if (one->isHidden() && !isFold) return false;
  }
  return true;
}

}  // namespace

void SettingFinder::add(PanelStage stage, QScrollArea* panel) {
  QWidget* inside = panel->widget();
  for (auto* row : inside->findChildren<ParameterRow*>())
    add(stage, panel, row, row->control(), {row->title(), QString::fromStdString(row->parameter().help)});
  for (auto* field : inside->findChildren<NumberField*>())
    if (!ancestorOf<ParameterRow>(field))
      add(stage, panel, field, field->edit(), {field->edit()->accessibleName(), field->toolTip()});
  for (auto* box : inside->findChildren<QCheckBox*>())
    if (!ancestorOf<ParameterRow>(box)) add(stage, panel, box, box, {box->text(), box->toolTip()});
  for (auto* widget : inside->findChildren<QWidget*>())
    if (const QString name = settingName(*widget); !name.isEmpty())
      add(stage, panel, widget, widget, {name, widget->toolTip()});
}

void SettingFinder::add(PanelStage stage, QScrollArea* panel, QWidget* widget, QWidget* control, const Words& words) {
  if (words.name.isEmpty()) return;
  auto* action = new QAction(tr("%1 (%2)", "a setting and its stage").arg(words.name, label(stage)), this);
  action->setObjectName(QStringLiteral("setting.") + control->objectName());
  action->setStatusTip(words.help.section(QLatin1Char('\n'), 0, 0));
  const Entry entry{stage, panel, widget, control, action};
  entries_.push_back(entry);
  connect(action, &QAction::triggered, this, [this, entry] { show(entry); });
}

QList<QAction*> SettingFinder::actions() {
  QList<QAction*> all;
  for (const Entry& entry : entries_) {
    const QWidget* panel = entry.panel->widget();
    entry.action->setEnabled(applies(*entry.widget, *panel) && entry.widget->isEnabledTo(panel));
    setWhyNot(*entry.action, tr("Has no effect with what is chosen in %1.").arg(label(entry.stage)));
    all.append(entry.action);
  }
  return all;
}

void SettingFinder::show(const Entry& entry) {
  emit stageAsked(entry.stage);
  if (auto* editor = ancestorOf<ParameterEditor>(entry.widget)) editor->unfold(entry.widget);
  QWidget* control = focusOf(entry.control);
  control->setFocus(Qt::ShortcutFocusReason);
  if (auto* edit = qobject_cast<QLineEdit*>(control)) edit->selectAll();
  // Once the unfolded rows have their places.
  QTimer::singleShot(0, this, [panel = QPointer<QScrollArea>(entry.panel), widget = QPointer<QWidget>(entry.widget)] {
    if (panel && widget) panel->ensureWidgetVisible(widget, 0, 60);
  });
}

}  // namespace batten
