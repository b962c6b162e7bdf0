// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/robot.h"

#include <QApplication>
#include <QDesktopServices>
#include <QFileDialog>
#include <QMouseEvent>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <array>
#include <iterator>

#include "tests/ui/pause_meter.h"

namespace batten::test {
namespace {

/// In a hundred: most dialogs are left soon, as they stand before everything else.
constexpr int kLeaveDialog = 25, kAcceptDialog = 8;
constexpr int kLongestInDialog = 25;  ///< [events]

constexpr std::array kKeys = {
    Qt::Key_Return, Qt::Key_Enter,     Qt::Key_Escape, Qt::Key_Tab,    Qt::Key_Backtab,  Qt::Key_Space, Qt::Key_Left,
    Qt::Key_Right,  Qt::Key_Up,        Qt::Key_Down,   Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Home,  Qt::Key_End,
    Qt::Key_Delete, Qt::Key_Backspace, Qt::Key_F1,     Qt::Key_F2,     Qt::Key_F3,       Qt::Key_F4,    Qt::Key_F5,
    Qt::Key_F6,     Qt::Key_F7,        Qt::Key_F8,     Qt::Key_F11,    Qt::Key_Plus,     Qt::Key_Minus};

constexpr std::array kSchemes = {"http", "https", "mailto", "file"};

QtMessageHandler previous = nullptr;

void noteWarning(QtMsgType type, const QMessageLogContext& context, const QString& text) {
  if (type != QtDebugMsg && type != QtInfoMsg)
    WarningCatcher::warnings().append(QString::fromLatin1(context.category ? context.category : "") +
                                      QStringLiteral(": ") + text);
  if (previous) previous(type, context, text);
}

}  // namespace

NoBrowser::NoBrowser() {
  for (const char* scheme : kSchemes) QDesktopServices::setUrlHandler(QString::fromLatin1(scheme), this, "open");
}
NoBrowser::~NoBrowser() {
  for (const char* scheme : kSchemes) QDesktopServices::unsetUrlHandler(QString::fromLatin1(scheme));
}

WarningCatcher::WarningCatcher() {
  warnings().clear();
  previous = qInstallMessageHandler(noteWarning);
}
WarningCatcher::~WarningCatcher() { qInstallMessageHandler(previous); }
QStringList& WarningCatcher::warnings() {
  static QStringList list;
  return list;
}

void Robot::run(int events) {
  left_ = events;
  const bool quits = QApplication::quitOnLastWindowClosed();
  QApplication::setQuitOnLastWindowClosed(false);
  stepSoon();
  loop_.exec();
  QApplication::setQuitOnLastWindowClosed(quits);
}

void Robot::stepSoon() { QTimer::singleShot(0, this, &Robot::step); }

void Robot::step() {
  QWidget* popup = QApplication::activePopupWidget();
  QWidget* dialog = QApplication::activeModalWidget();
  if (left_ == 0 && !popup && !dialog) {
    release();
    return loop_.quit();
  }
  // Before the event: a dialog that it opens has an event loop of its own, in which the robot goes on.
  stepSoon();
  if (left_ > 0) --left_;
  if (!window_.isVisible()) window_.show();
  if (window_.isMinimized()) window_.showNormal();
  if (popup) {
    if (left_ == 0 || below(100) < kLeaveDialog) {
      say("closes", popup);
      popup->close();
    } else {
      act(*popup);
    }
    return;
  }
  if (dialog) {
    ++inDialog_;
    const int chance = below(100);
    const bool isOver = left_ == 0 || inDialog_ > kLongestInDialog || chance < kLeaveDialog;
    if (isOver || chance < kLeaveDialog + kAcceptDialog) {
      inDialog_ = 0;
      say("leaves", dialog);
      return QTest::keyClick(dialog, isOver ? Qt::Key_Escape : Qt::Key_Return);
    }
    if (qobject_cast<QFileDialog*>(dialog)) return typeSomething(*dialog);
    return act(*dialog);
  }
  inDialog_ = 0;
  QWidgetList tops;
  for (QWidget* top : QApplication::topLevelWidgets())
    if (top->isVisible() && !(top->windowFlags() & Qt::ToolTip & ~Qt::Window)) tops.append(top);
  // The main window most of the time; others that are open, too.
  QWidget* top = below(10) == 0 && !tops.isEmpty() ? tops[below(static_cast<int>(tops.size()))] : &window_;
  if (top != &window_ && below(8) == 0) {
    say("closes", top);
    top->close();
    return;
  }
  act(*top);
}

void Robot::act(QWidget& top) {
  if (held_) {
    if (below(6) == 0) return release();
    return goOnDragging();
  }
  const int chance = below(100);
  if (chance < 50) return pressSomewhere(top);
  if (chance < 62) return turnWheel(top);
  typeSomething(top);
}

QWidget* Robot::aimAt(QWidget& top, QPoint& at) {
  const QSize size = top.size();
  if (size.isEmpty()) return nullptr;
  at = QPoint(below(size.width()), below(size.height()));
  QWidget* widget = top.childAt(at);
  if (!widget) return &top;
  at = widget->mapFrom(&top, at);
  return widget;
}

void Robot::say(const char* what, const QWidget* where) const {
  const QString name = where ? where->objectName() : QString();
  TestApplication::meter().setDoing(QString::fromLatin1(what) + QLatin1Char(' ') +
                                    QString::fromLatin1(where ? where->metaObject()->className() : "nothing") +
                                    QLatin1Char(' ') + name);
}

void Robot::pressSomewhere(QWidget& top) {
  QPoint at;
  QWidget* widget = aimAt(top, at);
  if (!widget || !widget->isEnabled()) return;
  const int chance = below(20);
  const auto modifiers = below(6) == 0   ? Qt::KeyboardModifiers(Qt::ShiftModifier)
                         : below(8) == 0 ? Qt::KeyboardModifiers(Qt::ControlModifier)
                                         : Qt::KeyboardModifiers();
  if (chance == 0) {
    say("double-clicks", widget);
    return QTest::mouseDClick(widget, Qt::LeftButton, modifiers, at);
  }
  if (chance == 1) {
    say("right-clicks", widget);
    return QTest::mouseClick(widget, Qt::RightButton, modifiers, at);
  }
  if (chance < 12) {
    say("clicks", widget);
    return QTest::mouseClick(widget, Qt::LeftButton, modifiers, at);
  }
  say("presses", widget);
  held_ = widget;
  heldAt_ = at;
  QTest::mousePress(widget, Qt::LeftButton, modifiers, at);
}

void Robot::goOnDragging() {
  heldAt_ += QPoint(below(81) - 40, below(61) - 30);
  say("drags", held_);
  QMouseEvent move(QEvent::MouseMove, QPointF(heldAt_), QPointF(held_->mapToGlobal(heldAt_)), Qt::NoButton,
                   Qt::LeftButton, {});
  QCoreApplication::sendEvent(held_, &move);
}

void Robot::release() {
  if (!held_) return;
  say("releases", held_);
  QPointer<QWidget> widget = std::exchange(held_, nullptr);
  QMouseEvent up(QEvent::MouseButtonRelease, QPointF(heldAt_), QPointF(widget->mapToGlobal(heldAt_)), Qt::LeftButton,
                 {}, {});
  QCoreApplication::sendEvent(widget, &up);
}

void Robot::turnWheel(QWidget& top) {
  QPoint at;
  QWidget* widget = aimAt(top, at);
  if (!widget) return;
  say("turns the wheel over", widget);
  const QPoint turn(0, below(2) == 0 ? 120 : -120);
  QWheelEvent wheel(QPointF(at), QPointF(widget->mapToGlobal(at)), {}, turn, Qt::NoButton,
                    below(4) == 0 ? Qt::ControlModifier : Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(widget, &wheel);
}

void Robot::typeSomething(QWidget& top) {
  QWidget* focus = QApplication::focusWidget();
  QWidget* to = focus && focus->window() == &top ? focus : &top;
  const int chance = below(10);
  const auto modifier = chance < 7    ? Qt::NoModifier
                        : chance == 7 ? Qt::ShiftModifier
                        : chance == 8 ? Qt::ControlModifier
                                      : Qt::AltModifier;
  if (below(2) == 0) {
    const Qt::Key key = kKeys[below(static_cast<int>(kKeys.size()))];
    // Return in a file dialog goes where the robot is not to go.
    if (qobject_cast<QFileDialog*>(&top) && (key == Qt::Key_Backspace || modifier != Qt::NoModifier)) return;
    say(qPrintable(QStringLiteral("presses key %1 in").arg(QKeySequence(key).toString())), to);
    return QTest::keyClick(to, key, modifier);
  }
  static constexpr char kCharacters[] = "abcdefghijklmnopqrstuvwxyz0123456789 ,-:;?_#[]()";
  const char character = kCharacters[below(static_cast<int>(std::size(kCharacters)) - 1)];
  say(qPrintable(QStringLiteral("types %1 in").arg(QLatin1Char(character))), to);
  QTest::keyClick(to, character, modifier);
}

}  // namespace batten::test
