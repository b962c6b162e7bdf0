// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <QFile>
#include <QLineEdit>
#include <QSettings>
#include <QTest>
#include <memory>

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
    window_ = std::make_unique<MainWindow>();
    window_->resize(1280, 860);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  }
  void openPage(const QImage& page) {
    path_ = folder_.filePath(QStringLiteral("page.png"));
    ASSERT_TRUE(page.save(path_));
    window_->openPath(path_);
    ASSERT_TRUE(waitUntil([this] { return session().hasScan(); }));
    ASSERT_TRUE(settle());
    ASSERT_FALSE(session().output().error) << session().output().error->message;
    ASSERT_FALSE(session().curves().empty());
  }
  bool settle() {
    return waitUntil([this] { return !session().isBusy(); });
  }
  EditorSession& session() { return window_->session(); }
  template <class T>
  T* find(const char* name) {
    auto* found = window_->findChild<T*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  void clickCanvas(const Vec2& imagePx) {
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

  QTemporaryDir folder_;
  QString path_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace batten::test
