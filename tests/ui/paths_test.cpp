// SPDX-License-Identifier: GPL-3.0-or-later
// Files and folders whose names are bytes that are no UTF-8, as old systems and archives leave them.
#include <QDir>
#include <QDropEvent>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QUrl>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "core/document/unsaved_work.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/panels/stages/export/export_panel.h"
#include "ui/session/path_text.h"
#include "ui/session/recipe_journal.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

TEST(PathText, KeepsEveryByte) {
  std::string all = "/";
  for (int byte = 1; byte < 256; ++byte)
    if (byte != '/') all += static_cast<char>(byte);
  for (const std::string& bytes :
       {std::string("/plain/name.png"), std::string("/caf\xc3\xa9/\xf0\x9f\x96\x8a.png"),
        std::string("/caf\xe9/\xff.png"), std::string("/\xe9\x9f\xa0\xed\xb2\x80\xc0\x80/\xf4\x90\x80\x80"),
        std::string("/cut \xf0\x9f\x96"), all}) {
    const QString text = pathText(fs::path(bytes));
    EXPECT_EQ(nativePath(text).native(), bytes);
    const QString stored = storedPath(text);
    EXPECT_EQ(QString::fromUtf8(stored.toUtf8()), stored) << "settings are UTF-8";
    EXPECT_EQ(nativePath(pathFromStored(stored)).native(), bytes);
    EXPECT_EQ(isUnicodePath(text), QUtf8StringView(bytes.c_str()).isValidUtf8()) << bytes;
    const QString shown = shownFileName(text);
    EXPECT_TRUE(isUnicodePath(shown));
    EXPECT_EQ(QString::fromUtf8(shown.toUtf8()), shown);
    EXPECT_TRUE(isUnicodePath(proposedFileName(text)));
  }
  EXPECT_EQ(nativePath(pathText(QUrl::fromEncoded("file:///caf%E9/a%20%C3%A9.png"))).native(),
            "/caf\xe9/a \xc3\xa9.png");
  EXPECT_EQ(pathText(QUrl(QStringLiteral("https://example.org/a.png"))), QString());
  EXPECT_EQ(folderOf(pathText(fs::path("/caf\xe9/\xff.png"))), pathText(fs::path("/caf\xe9")));
  EXPECT_EQ(shownFileName(pathText(fs::path("/caf\xe9/a\xff.png"))), QStringLiteral("a?.png"));
  EXPECT_EQ(proposedFileName(pathText(fs::path("/caf\xe9/a\xff.png"))), QStringLiteral("a_.png"));
}

/// A window, and a folder whose name is Latin-1.
class LatinFolder : public test::WindowFixture {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
    latin_ = fs::path(folder_.path().toStdString()) / "entw\xfcrfe";
    fs::create_directory(latin_);
    const QString plain = folder_.filePath(QStringLiteral("plain.png"));
    ASSERT_TRUE(test::zigzagPage().save(plain));
    scan_ = latin_ / "b\xfcgel.png";
    fs::copy_file(plain.toStdString(), scan_);
  }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(latin_)) all.insert(entry.path().filename().native());
    return all;
  }
  void open() {
    ASSERT_NO_FATAL_FAILURE(openFile(pathText(scan_)));
    ASSERT_FALSE(session().curves().empty());
  }

  fs::path latin_, scan_;
};

TEST_F(LatinFolder, AScanOpensAndIsAmongTheRecentFiles) {
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(window_->windowTitle().contains(QStringLiteral("b?gel.png"))) << window_->windowTitle().toStdString();
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_FALSE(MainWindow::recentFiles().isEmpty());
  EXPECT_EQ(nativePath(MainWindow::recentFiles().first()), scan_);
  QSignalSpy opened(&session(), &EditorSession::scanOpened);
  window_->openAtStart({});
  ASSERT_TRUE(test::waitUntil([&] { return opened.count() > 0; })) << "the newest recent file opens at the start";
  EXPECT_EQ(nativePath(session().scanPath()), scan_);
  ASSERT_TRUE(settle());
}

TEST_F(LatinFolder, AScanThatIsDroppedOpens) {
  QMimeData files;
  files.setUrls(
      {QUrl::fromEncoded(QByteArray("file://") + QByteArray::fromStdString(scan_.native()).toPercentEncoding("/"))});
  QSignalSpy opened(&session(), &EditorSession::scanOpened);
  QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(300, 300), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &drop);
  ASSERT_TRUE(test::waitUntil([&] { return opened.count() > 0; }));
  EXPECT_EQ(nativePath(session().scanPath()), scan_);
  ASSERT_TRUE(settle());
}

TEST_F(LatinFolder, WhatADialogCouldNotNameIsFound) {
  // Qt's dialogs hand U+FFFD over where a byte is no UTF-8.
  const QString fromDialog = QString::fromUtf8(QByteArray::fromStdString(scan_.native()));
  EXPECT_EQ(nativePath(chosenPath(fromDialog)), scan_);
  // Two that look alike: neither is guessed.
  fs::copy_file(scan_, latin_ / "b\xfegel.png");
  EXPECT_FALSE(pathExists(chosenPath(fromDialog)));
  // A new file goes to the folder that was meant.
  const QString fresh = folderOf(fromDialog) + QStringLiteral("/new.recipe.json");
  EXPECT_EQ(nativePath(chosenPath(fresh)), latin_ / "new.recipe.json");
}

TEST_F(LatinFolder, TheRecipeBesideTheScanIsReadAndSavedInItsPlace) {
  Recipe recipe;
  recipe.filter.coefficient = 3;
  const fs::path beside = latin_ / "b\xfcgel.recipe.json";
  std::ofstream(beside) << recipeToJson(recipe);
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(session().openedWithRecipe());
  EXPECT_EQ(session().recipe().filter.coefficient, 3);
  changeSomething();
  const auto before = names();
  window_->action(ActionId::SaveRecipe)->trigger();
  EXPECT_FALSE(session().hasUnsavedChanges());
  EXPECT_EQ(names(), before) << "no file beside the one that was meant";
  std::ifstream file(beside);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto saved = recipeFromJson(text);
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->filter.coefficient, 2);
}

TEST_F(LatinFolder, AFirstSaveAndAnExportGoWhereTheirDialogsCanGo) {
  qputenv("HOME", folder_.path().toUtf8());
  ASSERT_NO_FATAL_FAILURE(open());
  changeSomething();
  const auto before = names();
  QString proposed;
  inDialog(
      [&](QWidget& dialog) {
        proposed = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->text();
        QTest::keyClick(&dialog, Qt::Key_Escape);
      },
      [&] { window_->action(ActionId::SaveRecipe)->trigger(); });
  EXPECT_EQ(proposed, QStringLiteral("b_gel.recipe.json"));
  EXPECT_TRUE(session().hasUnsavedChanges());
  window_->setStage(PanelStage::Export);
  const QString path = find<QLineEdit>("export.path")->text();
  EXPECT_TRUE(isUnicodePath(path));
  EXPECT_TRUE(path.startsWith(QDir::homePath() + QStringLiteral("/b_gel."))) << path.toStdString();
  EXPECT_EQ(names(), before);
}

TEST_F(LatinFolder, TheJournalKnowsTheScan) {
  ASSERT_NO_FATAL_FAILURE(open());
  QTemporaryDir journals;
  RecipeJournal journal(session(), journals.path());
  changeSomething();
  ASSERT_TRUE(test::waitUntil([&] { return QFile::exists(journal.file()); }));
  std::string text = read(journal.file()).toStdString();
  const auto work = unsavedWorkFromJson(text);
  ASSERT_TRUE(work) << work.error().message;
  EXPECT_EQ(nativePath(pathFromStored(QString::fromStdString(work->scanPath))), scan_);
}

}  // namespace
}  // namespace batten
