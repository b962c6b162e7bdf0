// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFile>
#include <QLineEdit>
#include <QMessageBox>
#include <QRect>
#include <QSettings>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "tests/ui/rendered_scan.h"
#include "ui/canvas/curve_canvas.h"
#include "ui/main_window.h"

namespace batten::test {

/// A window with a page open and computed; its settings live in a folder of their own.
class WindowFixture : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_.isValid());
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder_.path());
    ASSERT_NO_FATAL_FAILURE(openWindow());
  }
  /// A new window in place of the one there is, as at the next start.
  void openWindow() {
    window_.reset();
    window_ = std::make_unique<MainWindow>();
    session().setStartRecipe(start_);
    // No test waits for an answer that nobody gives.
    window_->setUnsavedQuestion([this](const QString&) {
      ++questions_;
      return answer_;
    });
    window_->resize(1280, 860);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }
  /// Does something with the dialog that comes up, which then must be gone; fails when none comes.
  void inDialog(const std::function<void(QWidget&)>& act, const std::function<void()>& open) {
    bool seen = false;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, [&] {
      QWidget* dialog = QApplication::activeModalWidget();
      if (!dialog || !dialog->isVisible()) return;
      timer.stop();
      seen = true;
      act(*dialog);
    });
    timer.start(20);
    open();
    EXPECT_TRUE(seen) << "no dialog came up";
  }
  /// Types a name into the dialog for saving and accepts.
  void saveAs(const QString& path, const std::function<void()>& open) {
    inDialog(
        [&](QWidget& dialog) {
          auto* edit = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
          ASSERT_NE(edit, nullptr);
          // A file that is selected in the list would be meant, whatever is typed.
          for (auto* view : dialog.findChildren<QAbstractItemView*>())
            if (view->selectionModel() != nullptr) view->clearSelection();
          edit->setText(path);
          QTest::keyClick(edit, Qt::Key_Return);
        },
        open);
  }
  /// The same for a dialog that somebody else opens, soon.
  void saveAsOnceItIsThere(const QString& path) {
    bool isTyped = false;
    inDialog(
        [&](QWidget& dialog) {
          auto* edit = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
          ASSERT_NE(edit, nullptr);
          isTyped = true;
          edit->setText(path);
          QTest::keyClick(edit, Qt::Key_Return);
        },
        [&] { EXPECT_TRUE(waitUntil([&] { return isTyped; })); });
  }
  void openPage(const QImage& page) {
    path_ = folder_.filePath(QStringLiteral("page.png"));
    ASSERT_TRUE(page.save(path_));
    ASSERT_NO_FATAL_FAILURE(openFile(path_));
    ASSERT_TRUE(settle());
    ASSERT_FALSE(session().output().error) << session().output().error->message;
    ASSERT_FALSE(session().curves().empty());
  }
  /// Chooses who an export is for, by the keyboard.
  void chooseReceiver(const char* id) {
    auto* box = find<QComboBox>("export.preset");
    const int wanted = box->findData(QString::fromLatin1(id));
    ASSERT_GE(wanted, 0) << id;
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Home);
    for (int i = 0; i < wanted; ++i) QTest::keyClick(box, Qt::Key_Down);
    ASSERT_EQ(box->currentIndex(), wanted);
  }
  void openFile(const QString& path) {
    QSignalSpy opened(&session(), &EditorSession::scanOpened);
    window_->openPath(path);
    ASSERT_TRUE(waitUntil([&] { return opened.count() > 0; }));
    ASSERT_TRUE(settle());
  }
  /// A change that is worth a question.
  void changeSomething() {
    Recipe recipe = session().recipe();
    recipe.filter.coefficient = recipe.filter.coefficient == 3 ? 2 : 3;
    session().change(QStringLiteral("Coefficient"), recipe);
    ASSERT_TRUE(settle());
  }
  bool settle() {
    return waitUntil([this] { return !session().isBusy(); });
  }
  /// Waits until nothing of the window has moved or changed its size for kStillMs: layouts act in posted events, which
  /// may post more.
  bool settleLayout() {
    constexpr int kStillMs = 20, kLimitMs = 5000;  // many turns of the loop; nothing is laid out by a longer timer
    std::vector<QRect> last;
    QElapsedTimer still;
    return waitUntil(
        [&] {
          std::vector<QRect> now;
          for (const auto* widget : window_->findChildren<QWidget*>())
            if (widget->isVisible()) now.push_back(widget->geometry());
          if (!still.isValid() || now != last) still.start();
          last = std::move(now);
          return still.elapsed() >= kStillMs;
        },
        kLimitMs);
  }
  EditorSession& session() { return window_->session(); }
  template <class T>
  T* find(const char* name) {
    auto* found = window_->findChild<T*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void clickCanvas(const Vec2& imagePx) {
    QCoreApplication::processEvents();  // a change of the stage may have given the canvas another size
    auto* canvas = find<CurveCanvas>("canvas");
    const QPoint at = canvas->toWidget(imagePx).toPoint();
    QTest::mouseMove(canvas, at);
    QTest::mouseClick(canvas, Qt::LeftButton, Qt::NoModifier, at);
  }
  /// Replaces what a field holds by typing.
  void type(QLineEdit* field, const QString& text) {
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
  QByteArray read(const QString& path) {
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << path.toStdString();
    return file.readAll();
  }

  Recipe start_ = markedCornersOnly();  ///< What pages without a recipe open with.
  QTemporaryDir folder_;
  QString path_;
  std::unique_ptr<MainWindow> window_;
  UnsavedAnswer answer_ = UnsavedAnswer::Discard;
  int questions_ = 0;
};

}  // namespace batten::test
