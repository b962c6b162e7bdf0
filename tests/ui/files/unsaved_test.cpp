// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QDir>
#include <QDropEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>

#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/new_drawing_dialog.h"
#include "ui/session/recipe_journal.h"
#include "ui/status_line.h"

namespace batten {
namespace {

using test::waitUntil;

class Unsaved : public test::WindowFixture {
 protected:
  void SetUp() override {
    QDir(MainWindow::journalFolder()).removeRecursively();
    ASSERT_NO_FATAL_FAILURE(WindowFixture::SetUp());
    ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
    other_ = folder_.filePath(QStringLiteral("other.png"));
    ASSERT_TRUE(test::ellipsePage().save(other_));
  }
  void TearDown() override {
    window_.reset();
    QDir(MainWindow::journalFolder()).removeRecursively();
  }
  void drop(const QString& path) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(window_.get(), &enter);
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(window_.get(), &event);
  }
  void openRecent() {
    auto* menu = find<QMenu>("recentMenu");
    emit menu->aboutToShow();
    ASSERT_FALSE(menu->actions().isEmpty());
    menu->actions().first()->trigger();
  }
  QString writeRecipe(const char* name, const Recipe& recipe) {
    const QString path = folder_.filePath(QString::fromLatin1(name));
    QFile file(path);
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(recipeToJson(recipe)));
    return path;
  }
  bool isOpen(const QString& path) { return QFileInfo(session().scanPath()) == QFileInfo(path); }

  QString other_;
};

TEST_F(Unsaved, EveryWayOutAsksAndCancelKeepsTheWork) {
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  const Recipe work = session().recipe();
  const QString page = writeRecipe("page-of-its-own.json", NewDrawingDialog::recipeFor({100, 80}, 127.0));
  const std::pair<const char*, std::function<void()>> ways[] = {
      {"open", [&] { window_->openPath(other_); }},
      {"drop", [&] { drop(other_); }},
      {"recent", [&] { openRecent(); }},
      {"new drawing",
       [&] {
         window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
       }},
      {"recipe with a page", [&] { window_->openPath(page); }},
      {"quit", [&] { window_->action(ActionId::Quit)->trigger(); }},
      {"the window's cross", [&] { window_->close(); }}};
  answer_ = UnsavedAnswer::Cancel;
  for (const auto& [name, go] : ways) {
    questions_ = 0;
    go();
    EXPECT_TRUE(waitUntil([this] { return questions_ > 0; }, 5000)) << name;
    QTest::qWait(50);  // a second question would come in the next turns of the event loop: there is nothing to wait for
    ASSERT_TRUE(settle());
    EXPECT_EQ(questions_, 1) << name;
    EXPECT_TRUE(window_->isVisible()) << name;
    EXPECT_TRUE(isOpen(path_)) << name;
    EXPECT_EQ(session().recipe(), work) << name;
    EXPECT_TRUE(session().undoStack()->canUndo()) << name;
  }
  answer_ = UnsavedAnswer::Discard;
  ASSERT_NO_FATAL_FAILURE(openFile(other_));
  EXPECT_TRUE(isOpen(other_));
  EXPECT_FALSE(session().hasUnsavedChanges());
}

TEST_F(Unsaved, NothingIsAskedWhereNothingIsLost) {
  drop(other_);
  ASSERT_TRUE(waitUntil([this] { return isOpen(other_) && !session().isBusy(); }));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  session().undoStack()->undo();
  EXPECT_FALSE(session().hasUnsavedChanges()) << "undone";
  ASSERT_TRUE(settle());
  EXPECT_TRUE(window_->close());
  EXPECT_EQ(questions_, 0);
}

TEST_F(Unsaved, TheTitleSaysSoUntilItIsSaved) {
  EXPECT_FALSE(window_->isWindowModified());
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  EXPECT_TRUE(window_->isWindowModified());
  EXPECT_TRUE(find<QLabel>("documentTitle")->text().endsWith(QStringLiteral("•")));
  const QString target = folder_.filePath(QStringLiteral("work"));
  saveAs(target, [this] { window_->action(ActionId::SaveRecipe)->trigger(); });
  EXPECT_TRUE(QFile::exists(target + QStringLiteral(".json"))) << "the suffix is added";
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_TRUE(find<QLabel>("status.hint")->text().contains(QStringLiteral("work.json")));
  EXPECT_TRUE(window_->close());
  EXPECT_EQ(questions_, 0);
}

TEST_F(Unsaved, TheBoxOnTheScreenSavesAndCloses) {
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  window_->setUnsavedQuestion({});
  const auto press = [](const char* text) {
    return [text](QWidget& dialog) {
      auto* box = qobject_cast<QMessageBox*>(&dialog);
      ASSERT_NE(box, nullptr);
      for (QAbstractButton* button : box->buttons())
        if (button->text().remove(QLatin1Char('&')).startsWith(QLatin1String(text)))
          return QTest::mouseClick(button, Qt::LeftButton);
      FAIL() << text;
    };
  };
  inDialog(press("Cancel"), [this] { EXPECT_FALSE(window_->close()); });
  EXPECT_TRUE(window_->isVisible());
  const QString target = folder_.filePath(QStringLiteral("kept.json"));
  inDialog(
      [&](QWidget& dialog) {
        QTimer::singleShot(0, [this, target] { saveAsOnceItIsThere(target); });
        press("Save")(dialog);
      },
      [this] { EXPECT_TRUE(window_->close()); });
  EXPECT_FALSE(window_->isVisible());
  EXPECT_TRUE(QFile::exists(target));
}

TEST_F(Unsaved, ASuffixIsAddedBeforeTheQuestionAboutAnExistingFile) {
  const QString existing = writeRecipe("mine.json", Recipe{});
  const QByteArray before = read(existing);
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  inDialog(
      [&](QWidget& dialog) {
        auto* edit = dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
        ASSERT_NE(edit, nullptr);
        edit->setText(folder_.filePath(QStringLiteral("mine")));
        // The question whether to replace mine.json: no.
        QTimer::singleShot(100, [&dialog] {
          auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
          EXPECT_NE(box, nullptr) << "mine.json was about to be replaced without a question";
          if (box) box->button(QMessageBox::No)->click();
          qobject_cast<QDialog*>(&dialog)->reject();
        });
        QTest::keyClick(edit, Qt::Key_Return);
      },
      [this] { window_->action(ActionId::SaveRecipe)->trigger(); });
  EXPECT_EQ(read(existing), before);
}

TEST_F(Unsaved, ACrashLosesNothing) {
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  const Recipe work = session().recipe();
  const QDir folder(MainWindow::journalFolder());
  const auto journals = [&] { return folder.entryList({QStringLiteral("*.journal")}, QDir::Files); };
  ASSERT_TRUE(waitUntil([&] { return journals().size() == 1; }));
  // A program that dies leaves its file and a lock that nobody holds.
  ASSERT_TRUE(QFile::copy(folder.filePath(journals().first()), folder.filePath(QStringLiteral("dead.journal"))));
  ASSERT_NO_FATAL_FAILURE(openWindow());
  EXPECT_EQ(journals(), QStringList{QStringLiteral("dead.journal")})
      << "one that ends as it should takes its own along";

  ASSERT_TRUE(window_->offerLeftWork());
  auto* strip = find<ErrorStrip>("errorStrip");
  EXPECT_TRUE(strip->message().contains(QStringLiteral("page.png"))) << strip->message().toStdString();
  QTest::mouseClick(find<QAbstractButton>("error.action"), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([this] { return session().hasScan() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe(), work);
  EXPECT_TRUE(session().hasUnsavedChanges()) << "it still is not saved";
  EXPECT_EQ(journals().size(), 1);
  saveAs(folder_.filePath(QStringLiteral("page.recipe.json")),
         [this] { window_->action(ActionId::SaveRecipe)->trigger(); });
  EXPECT_TRUE(waitUntil([&] { return journals().isEmpty(); })) << "saved: the journal goes";
}

TEST_F(Unsaved, LeftWorkCanBeDiscardedAndRunningProgramsKeepTheirs) {
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  const QDir folder(MainWindow::journalFolder());
  ASSERT_TRUE(waitUntil([&] { return folder.entryList({QStringLiteral("*.journal")}).size() == 1; }));
  EditorSession another;
  RecipeJournal journal(another, MainWindow::journalFolder());
  EXPECT_FALSE(journal.left()) << "the window that runs holds its file";
  ASSERT_TRUE(QFile::copy(folder.filePath(folder.entryList({QStringLiteral("*.journal")}).first()),
                          folder.filePath(QStringLiteral("dead.journal"))));
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_TRUE(window_->offerLeftWork());
  QTest::mouseClick(find<QAbstractButton>("error.dismiss"), Qt::LeftButton);
  EXPECT_FALSE(QFile::exists(folder.filePath(QStringLiteral("dead.journal"))));
  EXPECT_FALSE(window_->offerLeftWork());
}

TEST_F(Unsaved, WorkIsWrittenAgainAsItGoesOn) {
  EditorSession& work = session();
  RecipeJournal journal(work, folder_.filePath(QStringLiteral("journals")));
  journal.setIntervalMs(20);
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  ASSERT_TRUE(waitUntil([&] { return QFile::exists(journal.file()); }));
  const QByteArray first = read(journal.file());
  Recipe recipe = work.recipe();
  recipe.cornerMarks = {{{200, 100}}};
  work.change(QStringLiteral("Mark"), recipe);
  EXPECT_TRUE(waitUntil([&] { return read(journal.file()) != first; }, 5000));
}

TEST_F(Unsaved, AMessageGoesAfterAWhileAndWithTheStage) {
  writeRecipe("page.recipe.json", session().recipe());
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  auto* hint = find<QLabel>("status.hint");
  EXPECT_TRUE(hint->text().startsWith(QStringLiteral("Opened with the recipe")));
  window_->setStage(PanelStage::Corners);
  EXPECT_TRUE(hint->text().startsWith(QStringLiteral("Click a line to mark a corner"))) << hint->text().toStdString();
  find<StatusLine>("statusLine")->showMessage(QStringLiteral("said"));
  EXPECT_EQ(hint->text(), QStringLiteral("said"));
  EXPECT_TRUE(waitUntil([&] { return hint->text() != QStringLiteral("said"); }, 6000));
}

}  // namespace
}  // namespace batten
