// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QAction;
class QLabel;
class QMenu;
class QPushButton;
class QToolButton;

namespace batten {

class EditorSession;
class ViewSettings;

/// The bar at the top: menu, title, undo, what is shown, the action finder, and Export.
class TopBar : public QWidget {
  Q_OBJECT
 public:
  struct Actions {
    QAction *undo, *redo, *scan, *comb, *fit, *actual, *find, *exportCurves;
  };
  TopBar(ViewSettings& view, const Actions& actions, QMenu* mainMenu, QMenu* layersMenu, QWidget* parent = nullptr);
  /// @param unsaved marks the title.
  void setTitle(const QString& title, bool unsaved, const QString& toolTip);
  void setZoom(double zoom);
  void openMenu();
  /// One button of a screen has the accent: in Export that of the panel.
  void setExportIsPrimary(bool isPrimary);

 protected:
  void paintEvent(QPaintEvent*) override;
  void changeEvent(QEvent*) override;

 private:
  void buildTitle(QMenu* mainMenu);
  void buildViewButtons(ViewSettings& view, QMenu* layersMenu);
  void buildExport(QAction* action);
  QToolButton* addButton(QAction* action, const QString& text);
  void setIcons();
  QToolButton* menu_;
  QLabel* title_;
  QToolButton *undo_, *redo_, *zoom_, *find_;
  QPushButton* export_ = nullptr;
};

}  // namespace batten
