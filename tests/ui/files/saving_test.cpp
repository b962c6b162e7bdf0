// SPDX-License-Identifier: GPL-3.0-or-later
// Where work is saved, what the window is then called, and how it is found again.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>

#include "core/pipeline/recipe/recipe_file.h"
#include "tests/ui/window_fixture.h"
#include "ui/error_strip.h"
#include "ui/new_drawing_dialog.h"

namespace batten {
namespace {

using test::waitUntil;

class Saving : public test::WindowFixture {
 protected:
  void save() { window_->action(ActionId::SaveRecipe)->trigger(); }
  /// @param target where a changed drawing is saved: in another folder than its scan.
  void saveWorkElsewhere(QString& target) {
    ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
    ASSERT_NO_FATAL_FAILURE(changeSomething());
    ASSERT_TRUE(QDir(folder_.path()).mkdir(QStringLiteral("work")));
    target = folder_.filePath(QStringLiteral("work/mine.recipe.json"));
    saveAs(target, [this] { save(); });
  }
  Recipe saved(const QString& path) {
    const auto recipe = recipeFromJson(read(path).toStdString());
    EXPECT_TRUE(recipe) << path.toStdString();
    // The session keeps the numbers of the curves apart from what is decided.
    Recipe decided = recipe.value_or(Recipe{});
    decided.curveNumbers = {};
    return decided;
  }
  /// The folder and the name that the dialog proposes.
  QFileInfo proposed(const std::function<void()>& open) {
    QString path;
    inDialog(
        [&](QWidget& dialog) {
          auto* files = qobject_cast<QFileDialog*>(&dialog);
          ASSERT_NE(files, nullptr);
          path = files->directory().filePath(dialog.findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->text());
          files->reject();
        },
        open);
    return QFileInfo(path);
  }
  QString titleOf() { return find<QLabel>("documentTitle")->text(); }
};

TEST_F(Saving, TheFirstTimeAsksAndThenItSavesInPlace) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  const QString target = folder_.filePath(QStringLiteral("mine.recipe.json"));
  saveAs(target, [this] { save(); });
  EXPECT_EQ(saved(target), session().recipe());
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  save();  // no dialog: it would never return here
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_EQ(saved(target), session().recipe());
  EXPECT_FALSE(session().hasUnsavedChanges());
  // Elsewhere only when asked.
  const QString other = folder_.filePath(QStringLiteral("other.json"));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  saveAs(other, [this] { window_->action(ActionId::SaveRecipeAs)->trigger(); });
  EXPECT_EQ(saved(other), session().recipe());
  EXPECT_NE(saved(target), session().recipe());
}

TEST_F(Saving, WhatWasOpenedWithItsRecipeIsSavedThere) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  const QString beside = folder_.filePath(QStringLiteral("page.recipe.json"));
  saveAs(beside, [this] { save(); });
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  save();
  EXPECT_EQ(saved(beside), session().recipe());
}

TEST_F(Saving, ADrawingOnAnEmptyPageTakesTheNameOfItsFile) {
  window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
  ASSERT_TRUE(waitUntil([this] { return session().hasScan() && !session().isBusy(); }));
  EXPECT_TRUE(titleOf().startsWith(QStringLiteral("New drawing")));
  const QString target = folder_.filePath(QStringLiteral("boat.json"));
  saveAs(target, [this] { save(); });
  EXPECT_TRUE(titleOf().startsWith(QStringLiteral("boat.json"))) << titleOf().toStdString();
  EXPECT_TRUE(window_->windowTitle().startsWith(QStringLiteral("boat.json")));
  // Another one is new again; opened anew it is called as its file.
  window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
  ASSERT_TRUE(waitUntil([this] { return titleOf().startsWith(QStringLiteral("New drawing")); }));
  window_->openPath(target);
  EXPECT_TRUE(waitUntil([this] { return titleOf().startsWith(QStringLiteral("boat.json")); }, 5000));
}

TEST_F(Saving, TheFolderIsRememberedAndTheProgramsOwnIsNotProposed) {
  QDir(folder_.path()).mkdir(QStringLiteral("work"));
  const QString work = folder_.filePath(QStringLiteral("work"));
  window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
  ASSERT_TRUE(waitUntil([this] { return session().hasScan() && !session().isBusy(); }));
  saveAs(work + QStringLiteral("/first.json"), [this] { save(); });
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  const QFileInfo forSample = proposed([this] { save(); });
  EXPECT_EQ(forSample.dir(), QDir(work)) << forSample.filePath().toStdString();
  EXPECT_EQ(forSample.fileName(), QStringLiteral("coupe-side.recipe.json"));
  window_->beginDrawing(NewDrawingDialog::recipeFor({100, 80}, 127.0));
  ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
  EXPECT_EQ(proposed([this] { save(); }).dir(), QDir(work));
}

// The folder of the sample is the program's, so its recipe cannot lie beside it.
TEST_F(Saving, WorkSavedElsewhereIsFoundAmongTheRecentFilesAndSavedThereAgain) {
  QString target;
  ASSERT_NO_FATAL_FAILURE(saveWorkElsewhere(target));
  const Recipe work = session().recipe();
  EXPECT_EQ(MainWindow::recentFiles().value(0), target);
  ASSERT_NO_FATAL_FAILURE(openWindow());
  auto* menu = find<QMenu>("recentMenu");
  emit menu->aboutToShow();
  ASSERT_FALSE(menu->actions().isEmpty());
  const QString entry = menu->actions().first()->text();
  EXPECT_TRUE(entry.startsWith(QStringLiteral("mine.recipe.json"))) << entry.toStdString();
  EXPECT_TRUE(entry.endsWith(QStringLiteral("work"))) << entry.toStdString();
  menu->actions().first()->trigger();
  ASSERT_TRUE(waitUntil([&] { return session().hasScan() && !session().isBusy(); }));
  EXPECT_EQ(session().scanPath(), path_);
  EXPECT_EQ(session().recipe(), work);
  EXPECT_FALSE(session().hasUnsavedChanges());
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  save();  // no dialog
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_EQ(saved(target), session().recipe());
  // The next start goes on with it.
  ASSERT_NO_FATAL_FAILURE(openWindow());
  window_->openAtStart({});
  EXPECT_TRUE(waitUntil([&] { return session().hasScan() && session().recipe() == saved(target); }));
  ASSERT_TRUE(settle());
}

TEST_F(Saving, TheScanAloneOffersTheWorkThatWasSavedOnIt) {
  QString target;
  ASSERT_NO_FATAL_FAILURE(saveWorkElsewhere(target));
  const Recipe work = session().recipe();
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  ASSERT_NE(session().recipe(), work);
  auto* strip = find<ErrorStrip>("errorStrip");
  ASSERT_TRUE(waitUntil([&] { return strip->message().contains(QStringLiteral("mine.recipe.json")); }, 5000));
  QTest::mouseClick(find<QAbstractButton>("error.action"), Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return session().recipe() == work; }));
  ASSERT_TRUE(settle());
  EXPECT_TRUE(strip->message().isEmpty());
  // A file that is gone is not offered.
  ASSERT_TRUE(QFile::remove(target));
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  auto* menu = find<QMenu>("recentMenu");
  emit menu->aboutToShow();
  // Which answers once the files have been looked for.
  ASSERT_TRUE(waitUntil([&] { return menu->actions().value(0)->text().startsWith(QStringLiteral("page.png")); }, 5000));
  EXPECT_TRUE(strip->message().isEmpty()) << strip->message().toStdString();
}

TEST_F(Saving, ADrawingIsOneRecentEntryAndGreyWhereItIsGone) {
  QString target;
  ASSERT_NO_FATAL_FAILURE(saveWorkElsewhere(target));
  auto* menu = find<QMenu>("recentMenu");
  emit menu->aboutToShow();
  ASSERT_EQ(menu->actions().size(), 1) << "the scan and its recipe are one drawing";
  EXPECT_TRUE(menu->actions()[0]->text().startsWith(QStringLiteral("mine.recipe.json")));
  EXPECT_TRUE(menu->actions()[0]->isEnabled());
  // The recipe alone opens nothing.
  ASSERT_TRUE(QFile::remove(path_));
  emit menu->aboutToShow();
  ASSERT_TRUE(waitUntil([&] { return !menu->actions().value(0)->isEnabled(); }, 5000));
  EXPECT_EQ(menu->actions().size(), 1);
  EXPECT_TRUE(menu->actions()[0]->text().contains(QStringLiteral("not found")));
}

TEST_F(Saving, ARecentEntryThatComesBackIsNoLongerGrey) {
  QString target;
  ASSERT_NO_FATAL_FAILURE(saveWorkElsewhere(target));
  auto* menu = find<QMenu>("recentMenu");
  const QString away = path_ + QStringLiteral(".away");
  ASSERT_TRUE(QFile::rename(path_, away));
  emit menu->aboutToShow();
  ASSERT_TRUE(waitUntil([&] { return !menu->actions().value(0)->isEnabled(); }, 5000));
  ASSERT_TRUE(QFile::rename(away, path_));
  // Open, so that nothing moves in it: the entry that is there has to change.
  menu->popup(window_->mapToGlobal(QPoint(20, 20)));
  ASSERT_TRUE(menu->isVisible());
  ASSERT_FALSE(menu->actions()[0]->isEnabled()) << "until the look is over";
  const QAction* entry = menu->actions()[0];
  EXPECT_TRUE(waitUntil([&] { return entry->isEnabled(); }, 5000));
  EXPECT_EQ(menu->actions().value(0), entry);
  EXPECT_FALSE(entry->text().contains(QStringLiteral("not found"))) << entry->text().toStdString();
  menu->close();
}

TEST_F(Saving, TwoRecipesOfOneScanAreTwoRecentEntries) {
  QString first;
  ASSERT_NO_FATAL_FAILURE(saveWorkElsewhere(first));
  const QString second = folder_.filePath(QStringLiteral("work/other.recipe.json"));
  ASSERT_NO_FATAL_FAILURE(changeSomething());
  saveAs(second, [this] { window_->action(ActionId::SaveRecipeAs)->trigger(); });
  auto* menu = find<QMenu>("recentMenu");
  emit menu->aboutToShow();
  ASSERT_EQ(menu->actions().size(), 2) << "two pieces of work; the scan alone opens the newer one";
  EXPECT_TRUE(menu->actions()[0]->text().startsWith(QStringLiteral("other.recipe.json")));
  EXPECT_TRUE(menu->actions()[1]->text().startsWith(QStringLiteral("mine.recipe.json")));
  // The older one stands for the scan where the newer one is gone.
  ASSERT_TRUE(QFile::remove(second));
  emit menu->aboutToShow();
  const auto isFirst = [&] { return menu->actions().value(0)->text().startsWith(QStringLiteral("mine.recipe.json")); };
  ASSERT_TRUE(waitUntil(isFirst, 5000)) << menu->actions().value(0)->text().toStdString();
  EXPECT_TRUE(menu->actions()[0]->isEnabled());
}

TEST_F(Saving, RecentFilesOfOneNameAreToldApartByTheirFolders) {
  for (const char* name : {"one", "two"}) {
    QDir(folder_.path()).mkdir(QString::fromLatin1(name));
    const QString path = folder_.filePath(QString::fromLatin1(name) + QStringLiteral("/page.png"));
    ASSERT_TRUE(test::ellipsePage().save(path));
    ASSERT_NO_FATAL_FAILURE(openFile(path));
  }
  auto* menu = find<QMenu>("recentMenu");
  emit menu->aboutToShow();
  ASSERT_GE(menu->actions().size(), 2);
  const QString first = menu->actions()[0]->text(), second = menu->actions()[1]->text();
  EXPECT_TRUE(first.startsWith(QStringLiteral("page.png")));
  EXPECT_TRUE(first.endsWith(QStringLiteral("two"))) << first.toStdString();
  EXPECT_TRUE(second.endsWith(QStringLiteral("one"))) << second.toStdString();
}

}  // namespace
}  // namespace batten
