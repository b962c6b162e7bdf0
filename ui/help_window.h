// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QTextBrowser;

namespace batten {

/// The help pages of the resources: one a stage, and a start page.
class HelpWindow : public QWidget {
  Q_OBJECT
 public:
  explicit HelpWindow(QWidget* parent = nullptr);
  /// @param page "fairing", "index" … : a file of resources/help without its ending.
  void open(const QString& page);

 protected:
  void changeEvent(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;

 private:
  void load(const QString& page);
  QTextBrowser* browser_;
  QString page_;
};

}  // namespace batten
