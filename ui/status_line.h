// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTimer>
#include <QWidget>
#include <functional>
#include <map>
#include <optional>

#include "core/base/vec2.h"
#include "ui/session/editor_session.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace batten {

/// The line at the bottom: where the mouse is, the scale, the zoom, what can be done here, and how the work goes.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  explicit StatusLine(EditorSession& session, QWidget* parent = nullptr);
  void setPlace(std::optional<Vec2> imagePx);
  void setZoom(double zoom);
  void setHint(const QString& text);
  /// What stands there while nothing under the mouse has a hint of its own.
  void setStageHint(const QString& text);
  /// The same stage goes on: a message stays until its time is over.
  void updateStageHint(const QString& text);
  /// Says what has happened, for five seconds or until the stage changes; with an action, beside a button that does it.
  void showMessage(const QString& text, const QString& actionText = {}, std::function<void()> action = {});
  /// What keeps the program from its work. Its text stands over every hint until it is over.
  enum class Trouble { Threads, Journal };
  /// @param text what is wrong and what to do; empty: it is over.
  void setTrouble(Trouble trouble, const QString& text);

 signals:
  void scaleAsked();  ///< "no scale: set it" was pressed.

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  /// @param widest a text that the label has room for, whatever it says; empty: as wide as its text.
  QLabel* addLabel(const char* name, const QString& widest);
  void buildHint();
  void buildWork();
  void followSession();
  void refreshScale();
  void refreshWork();
  void refreshHint();
  EditorSession& session_;
  QString stageHint_, placeHint_, message_;
  std::map<Trouble, QString> troubles_;  ///< The first one is shown.
  QTimer messageTimer_;
  QLabel *millimetres_, *pixels_, *scale_, *zoom_, *hint_, *work_;
  QPushButton* setScale_;
  QProgressBar* progress_;
  QPushButton *cancel_, *again_, *act_;
  std::function<void()> action_;
};

}  // namespace batten
