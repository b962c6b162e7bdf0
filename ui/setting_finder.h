// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>
#include <QObject>
#include <vector>

#include "ui/panels/rail/panel_stage.h"

class QAction;
class QScrollArea;

namespace batten {

/// The settings of all panels as entries of the action finder: choosing one opens its stage, unfolds and scrolls to the
/// control, and gives it the keyboard. Found are the rows of parameters, numbers with a name of their own, check boxes,
/// and what is given a name by setSettingName().
class SettingFinder : public QObject {
  Q_OBJECT
 public:
  explicit SettingFinder(QObject* parent) : QObject(parent) {}
  /// Adds what a panel holds now.
  void add(PanelStage stage, QScrollArea* panel);
  /// One a setting; those that do not apply with the present settings are not enabled.
  QList<QAction*> actions();

 signals:
  void stageAsked(batten::PanelStage stage);

 private:
  struct Entry {
    PanelStage stage;
    QScrollArea* panel;
    QWidget* widget;   ///< Hidden while the setting does not apply.
    QWidget* control;  ///< Takes the keyboard.
    QAction* action;
  };
  struct Words {
    QString name, help;
  };
  void add(PanelStage stage, QScrollArea* panel, QWidget* widget, QWidget* control, const Words& words);
  void show(const Entry& entry);
  std::vector<Entry> entries_;
};

}  // namespace batten
