// SPDX-License-Identifier: GPL-3.0-or-later
// Files and folders whose names are bytes that are no UTF-8, as old systems and archives leave them.
#include <QAbstractButton>
#include <QComboBox>
#include <QDir>
#include <QDropEvent>
#include <QFileDialog>
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
#include "ui/session/files/path_text.h"
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
  // Qt cannot remove what it cannot name.
  void TearDown() override {
    window_.reset();
    fs::remove_all(latin_);
  }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(latin_)) all.insert(entry.path().filename().native());
    return all;
  }
  /// A part of the dialog for such folders.
  template <class T>
  static T* part(QWidget& dialog, const char* name) {
    auto* found = dialog.findChild<T*>(QStringLiteral("saveHere.") + QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return found;
  }
  static void press(QWidget& dialog, const char* name) {
    QTest::mouseClick(part<QAbstractButton>(dialog, name), Qt::LeftButton);
  }
  static std::string bytesOf(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static Recipe savedIn(const fs::path& path) {
    const auto recipe = recipeFromJson(bytesOf(path));
    EXPECT_TRUE(recipe) << path;
    // The session keeps the numbers of the curves apart from what is decided.
    Recipe decided = recipe.value_or(Recipe{});
    decided.curveNumbers = {};
    return decided;
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

TEST_F(LatinFolder, TheFirstSaveIsBesideTheScanAndTheNextAsksNothing) {
  ASSERT_NO_FATAL_FAILURE(open());
  changeSomething();
  inDialog(
      [&](QWidget& dialog) {
        EXPECT_TRUE(part<QLabel>(dialog, "folder")->text().endsWith(QStringLiteral("/entw?rfe")));
        EXPECT_EQ(nativePath(part<QLineEdit>(dialog, "name")->text()), "b\xfcgel.recipe.json");
        press(dialog, "save");
      },
      [&] { window_->action(ActionId::SaveRecipe)->trigger(); });
  const fs::path beside = latin_ / "b\xfcgel.recipe.json";
  EXPECT_EQ(names(), (std::set<std::string>{"b\xfcgel.png", "b\xfcgel.recipe.json"}));
  EXPECT_EQ(savedIn(beside), session().recipe());
  EXPECT_FALSE(session().hasUnsavedChanges());
  changeSomething();
  window_->action(ActionId::SaveRecipe)->trigger();  // no dialog: it would never return here
  EXPECT_EQ(savedIn(beside), session().recipe());
  // It is found beside its scan, as any other.
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(open());
  EXPECT_TRUE(session().openedWithRecipe());
}

TEST_F(LatinFolder, AFileIsReplacedOnlyWhenPressedAgain) {
  ASSERT_NO_FATAL_FAILURE(open());
  std::ofstream(latin_ / "other.json") << "kept";
  changeSomething();
  inDialog(
      [&](QWidget& dialog) {
        type(part<QLineEdit>(dialog, "name"), QStringLiteral("other"));  // with Return, which saves
        ASSERT_TRUE(dialog.isVisible());
        EXPECT_EQ(part<QLabel>(dialog, "message")->text(),
                  QStringLiteral("other.json exists. Press again to replace it."));
        EXPECT_EQ(bytesOf(latin_ / "other.json"), "kept");
        type(part<QLineEdit>(dialog, "name"), QStringLiteral("other.jso"));
        EXPECT_FALSE(dialog.isVisible()) << "another name is another file";
      },
      [&] { window_->action(ActionId::SaveRecipeAs)->trigger(); });
  EXPECT_EQ(bytesOf(latin_ / "other.json"), "kept");
  EXPECT_EQ(savedIn(latin_ / "other.jso"), session().recipe());
  inDialog(
      [&](QWidget& dialog) {
        type(part<QLineEdit>(dialog, "name"), QStringLiteral("other.json"));
        press(dialog, "save");
      },
      [&] { window_->action(ActionId::SaveRecipeAs)->trigger(); });
  EXPECT_EQ(savedIn(latin_ / "other.json"), session().recipe());
}

TEST_F(LatinFolder, NamesThatAreNoneAreNotTaken) {
  ASSERT_NO_FATAL_FAILURE(open());
  fs::create_directory(latin_ / "sub.json");
  const auto before = names();
  inDialog(
      [&](QWidget& dialog) {
        auto* name = part<QLineEdit>(dialog, "name");
        auto* message = part<QLabel>(dialog, "message");
        for (const QString& typed : {QStringLiteral("a/b"), QStringLiteral("/tmp/a"), QStringLiteral(".."),
                                     QString(QChar(0xD800)), QStringLiteral("sub"), QString()}) {
          name->setText(typed);
          EXPECT_EQ(message->text().isEmpty(), typed.isEmpty()) << typed.toStdString();
          QTest::keyClick(name, Qt::Key_Return);
          EXPECT_TRUE(dialog.isVisible());
          EXPECT_FALSE(part<QAbstractButton>(dialog, "save")->isEnabled());
        }
        QTest::keyClick(name, Qt::Key_Escape);
      },
      [&] { window_->action(ActionId::SaveRecipe)->trigger(); });
  EXPECT_EQ(names(), before);
}

TEST_F(LatinFolder, AnotherFolderIsChosenInTheFileDialog) {
  qputenv("HOME", folder_.path().toUtf8());
  ASSERT_NO_FATAL_FAILURE(open());
  changeSomething();
  const auto before = names();
  const auto toFileDialog = [&](QWidget& dialog) {
    // It comes up while the button is pressed.
    QTimer::singleShot(0, &dialog, [&] { press(dialog, "elsewhere"); });
  };
  QString proposed;
  inDialog(toFileDialog, [&] {
    QTimer next;
    QObject::connect(&next, &QTimer::timeout, [&] {
      auto* files = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (files == nullptr || !files->isVisible()) return;
      next.stop();
      auto* name = files->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      proposed = files->directory().filePath(name->text());
      QTest::keyClick(name, Qt::Key_Return);
    });
    next.start(20);
    window_->action(ActionId::SaveRecipe)->trigger();
  });
  EXPECT_EQ(proposed, folder_.filePath(QStringLiteral("b_gel.recipe.json")));
  EXPECT_FALSE(session().hasUnsavedChanges());
  EXPECT_EQ(savedIn(nativePath(proposed)), session().recipe());
  EXPECT_EQ(names(), before);
}

TEST_F(LatinFolder, AnExportAndAReportAreWrittenBesideTheScan) {
  ASSERT_NO_FATAL_FAILURE(open());
  window_->setStage(PanelStage::Export);
  auto* path = find<QLineEdit>("export.path");
  EXPECT_EQ(nativePath(path->text()).parent_path(), latin_);
  auto* run = find<QAbstractButton>("export.run");
  ASSERT_TRUE(test::waitUntil([&] { return run->isEnabled(); }));
  QSignalSpy exported(window_->findChild<ExportPanel*>(), &ExportPanel::exported);
  QTest::mouseClick(run, Qt::LeftButton);
  ASSERT_TRUE(test::waitUntil([&] { return exported.count() > 0; }));
  const std::string first = nativePath(path->text()).filename().native();
  EXPECT_TRUE(names().contains(first)) << first;
  // The same again is the window's own file; that of another program is asked about.
  std::ofstream(nativePath(path->text())) << "changed";
  QTest::mouseClick(run, Qt::LeftButton);
  EXPECT_TRUE(test::waitUntil([&] { return run->text() == QStringLiteral("Replace the file"); }));
  EXPECT_EQ(bytesOf(latin_ / first), "changed");
  inDialog(
      [&](QWidget& dialog) {
        type(part<QLineEdit>(dialog, "name"), QStringLiteral("x") + QString::fromStdString(first));
      },
      [&] { QTest::mouseClick(find<QAbstractButton>("export.browse"), Qt::LeftButton); });
  EXPECT_EQ(nativePath(path->text()), latin_ / ("x" + first));
  QTest::mouseClick(run, Qt::LeftButton);
  EXPECT_TRUE(test::waitUntil([&] { return names().contains("x" + first); }));
  ASSERT_TRUE(settle());
  find<QComboBox>("report.kind")->setCurrentIndex(2);
  inDialog([&](QWidget& dialog) { press(dialog, "save"); },
           [&] { QTest::mouseClick(find<QAbstractButton>("report.write"), Qt::LeftButton); });
  EXPECT_TRUE(test::waitUntil([&] { return names().contains("b_gel.report.html"); }));
  ASSERT_TRUE(settle());
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
