// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAbstractButton>
#include <QClipboard>
#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QImage>
#include <QLocale>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QUrl>
#include <memory>
#include <utility>

#include "core/document/import_curves.h"
#include "core/exchange/import_file.h"
#include "core/exchange/save_atomically.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "ui/canvas/curve_canvas.h"
#include "ui/main_window_parts.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/panels/stages/scan_panel.h"
#include "ui/session/files/opened_scan.h"
#include "ui/session/files/path_text.h"
#include "ui/session/view/judged_view.h"
#include "ui/status_line.h"

namespace batten {
namespace {

const QString kSaveFolderKey = QStringLiteral("recipe/folder");

bool isRecipeFile(const QString& path) { return path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive); }

UnsavedAnswer askOnScreen(QWidget* window, const QString& drawing) {
  QMessageBox box(QMessageBox::NoIcon, QStringLiteral("Batten"), QObject::tr("%1 has unsaved changes.").arg(drawing),
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window);
  box.setObjectName(QStringLiteral("unsavedBox"));
  box.setInformativeText(QObject::tr("Save the recipe, or discard the changes?"));
  box.button(QMessageBox::Save)->setText(QObject::tr("Save…"));
  box.button(QMessageBox::Discard)->setText(QObject::tr("Discard"));
  // The words say it; the toolkit's pictures are from another house.
  for (QAbstractButton* button : box.buttons()) button->setIcon({});
  box.setDefaultButton(QMessageBox::Save);
  switch (box.exec()) {
    case QMessageBox::Save:
      return UnsavedAnswer::Save;
    case QMessageBox::Discard:
      return UnsavedAnswer::Discard;
    default:
      return UnsavedAnswer::Cancel;
  }
}

}  // namespace

void MainWindow::setUnsavedQuestion(UnsavedQuestion question) { parts_->unsavedQuestion = std::move(question); }

bool MainWindow::maybeDiscard() {
  if (!session_.hasUnsavedChanges()) return true;
  const UnsavedAnswer answer =
      parts_->unsavedQuestion ? parts_->unsavedQuestion(drawingName()) : askOnScreen(this, drawingName());
  return answer == UnsavedAnswer::Discard || (answer == UnsavedAnswer::Save && saveRecipe());
}

void MainWindow::openPath(const QString& path) {
  if (isRecipeFile(path)) return readRecipe(path);
  if (isImportName(nativePath(path))) return readImport(path, false);
  if (!maybeDiscard()) return;
  parts_->pageRecipe.clear();
  session_.openScan(path);
}

void MainWindow::beginDrawing(const Recipe& recipe) {
  if (!maybeDiscard()) return;
  parts_->pageRecipe.clear();
  session_.newDrawing(recipe);
}

void MainWindow::scanOpened() {
  Parts& p = *parts_;
  p.recipePath = std::exchange(p.pageRecipe, {});
  const bool isReopened = !p.recipePath.isEmpty();
  if (session_.openedWithRecipe() && !isReopened)
    p.recipePath = pathText(recipeBeside(nativePath(session_.scanPath()), session_.recipe().scanPage.number));
  // Nobody changes what came with the program: the first time Ctrl+S asks where.
  if (isOfProgram(p.recipePath)) p.recipePath.clear();
  forgetDrawing(view_);
  if (!session_.isBlankPage() && isReopened && !p.recipePath.isEmpty())
    rememberFile(p.recipePath, session_.scanPath());
  else if (!session_.isBlankPage())
    rememberFile(session_.scanPath());
  refreshTitle();
  p.errors->hide();
  p.problemOrigin.reset();
  p.status->setStageHint(stageHint());
  if (!session_.openProblem().isEmpty())
    showProblem({ErrorCode::BadParameter, session_.openProblem().toStdString(), {}}, FailureOrigin::OpenRecipe);
  else if (p.leftWork)
    offerLeftWork();
  else if (!session_.isBlankPage() && !session_.wasRestored())
    offerSavedRecipe();
  if (session_.isBlankPage() && !session_.recipe().imports.empty()) {
    setStage(PanelStage::Fairing);
  } else if (session_.isBlankPage()) {
    setStage(PanelStage::Edges);
    view_.setTool(Tool::Pen);
    p.status->setStageHint(tr("Drag on the page to draw a line; end at its start to close it."));
  } else if (session_.openedWithRecipe() || session_.wasRestored()) {
    // Work that was saved is past the first stages: it opens where it is read.
    setStage(PanelStage::Fairing);
  }
  if (session_.wasRestored())
    p.status->showMessage(tr("Unsaved work restored. Save it to keep it."));
  else if (isReopened && !session_.isBlankPage())
    p.status->showMessage(tr("Opened with the recipe %1.").arg(shownFileName(p.recipePath)));
  else if (session_.openedWithRecipe())
    p.status->showMessage(tr("Opened with the recipe stored next to the drawing."));
  p.canvas->zoomFit();
}

QString MainWindow::startFolder() const {
  QStringList known = recentFiles();
  if (session_.hasScan() && !session_.isBlankPage()) known.prepend(session_.scanPath());
  for (const QString& path : known)
    if (!isOfProgram(path) && isUnicodePath(path)) return QFileInfo(path).absolutePath();
  return QDir::homePath();
}

void MainWindow::chooseScan() {
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Open scan"), startFolder(),
      tr("Scans (*.png *.jpg *.jpeg *.tif *.tiff *.pdf *.jp2 *.j2k *.bmp *.webp *.pgm *.pbm *.ppm *.pnm);;"
         "Curves and points (*.dxf *.igs *.iges *.stp *.step *.svg *.csv *.txt *.json);;All files (*)"));
  if (!path.isEmpty()) openPath(chosenPath(path));
}

void MainWindow::chooseRecipe() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Open recipe"), startFolder(), tr("Recipes (*.json)"));
  if (!path.isEmpty()) readRecipe(chosenPath(path));
}

void MainWindow::readRecipe(const QString& path, const QString& withScan) {
  parts_->recipeReader->start([this, path, withScan](const CancelToken& token) {
    const auto recipe = readRecipeFile(nativePath(path));
    if (token.isCancelled()) return;
    if (!recipe && isImportName(nativePath(path))) {
      // JSON may hold curves or points as well.
      if (const auto read = readImportFile(nativePath(path)); read && !token.isCancelled()) {
        const auto report = std::make_shared<const ImportReport>(*read);
        parts_->inbox.post([this, report] { useImport(*report, false); });
        return;
      }
    }
    parts_->inbox.post([this, path, recipe, withScan] { useRecipe(path, recipe, withScan); });
  });
}

void MainWindow::useRecipe(const QString& path, const Result<Recipe>& recipe, const QString& withScan) {
  if (!recipe) {
    parts_->opening->end();  // it has been read to its end, whatever it is
    return showProblem(recipe.error(), FailureOrigin::OpenRecipe);
  }
  if (recipe->page) {
    if (!maybeDiscard()) return;
    parts_->pageRecipe = absolutePath(path);
    session_.newDrawing(*recipe);
    return rememberFile(path);
  }
  const QString savedFor = scanOfRecipe(path);
  const bool isOfThisScan = !savedFor.isEmpty() && savedFor == absolutePath(session_.scanPath());
  const QString scan = withScan.isEmpty() && (isOfThisScan || !session_.hasScan()) ? savedFor : withScan;
  if (!scan.isEmpty()) {
    if (!maybeDiscard()) return;
    parts_->pageRecipe = absolutePath(path);
    return session_.openSaved(scan, *recipe);
  }
  if (!session_.hasScan())
    return showProblem({ErrorCode::BadParameter,
                        tr("A recipe needs a drawing: open a scan first, then this recipe.").toStdString(),
                        {}},
                       FailureOrigin::OpenRecipe);
  Recipe after = *recipe;
  after.scanPage = session_.recipe().scanPage;  // it is used on the page that is open
  session_.change(tr("Open recipe"), std::move(after));
}

void MainWindow::chooseImport() {
  const QString path = QFileDialog::getOpenFileName(
      this, tr("Import curves"), startFolder(),
      tr("Curves and points (*.dxf *.igs *.iges *.stp *.step *.svg *.csv *.txt *.json);;All files (*)"));
  if (!path.isEmpty()) readImport(chosenPath(path), true);
}

void MainWindow::readImport(const QString& path, bool intoDrawing) {
  parts_->recipeReader->start([this, path, intoDrawing](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    const auto read = std::make_shared<const Result<ImportReport>>(readImportFile(nativePath(path), {}, context));
    if (token.isCancelled()) return;
    parts_->inbox.post([this, read, intoDrawing] {
      if (*read) return useImport(**read, intoDrawing);
      showProblem(read->error(), FailureOrigin::OpenScan);
    });
  });
}

void MainWindow::useImport(const ImportReport& report, bool intoDrawing) {
  QStringList said;
  for (const std::string& note : report.notes) said += QString::fromStdString(note);
  const QString source = QString::fromStdString(report.file.source);
  if (!intoDrawing || !session_.hasScan()) {
    if (!maybeDiscard()) return;
    parts_->pageRecipe.clear();
    session_.newDrawing(drawingOf(report.file, report.parts));
  } else {
    AddedImport added = withImport(session_.recipe(), report.file, frameFor(*session_.scan(), session_.recipe()));
    if (added.moved) said += tr("The lines were outside the page and have been centred on it.");
    session_.change(tr("Import %1").arg(source), std::move(added.recipe));
  }
  const int count = static_cast<int>(report.file.lines.size());
  said.prepend(count == 1 ? tr("Imported 1 line from %1.").arg(source)
                          : tr("Imported %1 lines from %2.").arg(count).arg(source));
  parts_->status->showMessage(said.join(QLatin1Char(' ')));
}

void MainWindow::openPage(const PageChoice& page) {
  if (!maybeDiscard()) return parts_->scanPanel->refresh();
  parts_->pageRecipe.clear();
  session_.openScan(session_.scanPath(), page);
}

// A recipe needs its scan: the picture becomes a file of the user's own data, and opens as any other.
void MainWindow::pasteScan() {
  const QMimeData* held = QGuiApplication::clipboard()->mimeData();
  if (held != nullptr && held->hasUrls() && held->urls().first().isLocalFile())
    return openPath(pathText(held->urls().first()));
  const QImage picture = held != nullptr && held->hasImage() ? qvariant_cast<QImage>(held->imageData()) : QImage();
  if (picture.isNull()) return parts_->status->showMessage(tr("The clipboard contains no picture."));
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/pasted");
  const QString name = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd HH.mm.ss.zzz"));
  const QString path = folder + QStringLiteral("/Pasted %1.png").arg(name);
  parts_->recipeReader->start([this, folder, path, picture](const CancelToken& token) {
    const bool isSaved = QDir().mkpath(folder) && picture.save(path, "PNG");
    if (token.isCancelled()) return;
    parts_->inbox.post([this, path, isSaved] {
      if (isSaved) return openPath(path);
      showProblem({ErrorCode::CannotWrite, tr("The picture cannot be saved in %1.").arg(path).toStdString(), {}},
                  FailureOrigin::OpenScan);
    });
  });
}

bool MainWindow::saveRecipe() {
  return parts_->recipePath.isEmpty() ? saveRecipeAs() : saveRecipeTo(parts_->recipePath);
}

bool MainWindow::saveRecipeAs() {
  const SaveQuestion question{tr("Save recipe"), proposedRecipePath(), tr("Recipes (*.json)"), QStringLiteral("json")};
  const QString path = askSavePath(this, question);
  return !path.isEmpty() && saveRecipeTo(path);
}

bool MainWindow::saveRecipeTo(const QString& path) {
  if (const auto saved = saveAtomically(nativePath(path), recipeToJson(session_.recipeToSave()), Leftovers::OfThisFile);
      !saved) {
    showProblem(saved.error(), FailureOrigin::SaveRecipe);
    return false;
  }
  parts_->recipePath = absolutePath(path);
  QSettings().setValue(kSaveFolderKey, storedPath(folderOf(path)));
  session_.markSaved();
  rememberFile(path, session_.isBlankPage() ? QString() : session_.scanPath());
  refreshTitle();
  parts_->status->showMessage(tr("Saved the recipe to %1.").arg(shownFileName(path)));
  return true;
}

// Where it lies now; else beside the scan, where it is found by itself; else where the last one was saved.
QString MainWindow::proposedRecipePath() const {
  if (!parts_->recipePath.isEmpty()) return parts_->recipePath;
  const QString last = pathFromStored(QSettings().value(kSaveFolderKey).toString());
  const QString folder = isPlaceToSave(last) ? last : QDir::homePath();
  if (session_.isBlankPage()) return folder + QStringLiteral("/drawing.recipe.json");
  const QString beside =
      absolutePath(pathText(recipeBeside(nativePath(session_.scanPath()), session_.recipe().scanPage.number)));
  if (!isOfProgram(session_.scanPath()) && isPlaceToSave(folderOf(beside))) return beside;
  return folder + QLatin1Char('/') + proposedFileName(beside);
}

QString MainWindow::journalFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/unsaved");
}

bool MainWindow::offerLeftWork() {
  Parts& p = *parts_;
  if (!p.leftWork) p.leftWork = p.journal->left();
  if (!p.leftWork) return false;
  const RecipeJournal::Left& left = *p.leftWork;
  p.problemOrigin.reset();
  p.status->setStageHint(stageHint());
  p.remedy = [this] {
    if (!maybeDiscard()) return;
    const RecipeJournal::Left taken = *std::exchange(parts_->leftWork, std::nullopt);
    parts_->journal->takeOver(taken);
    parts_->errors->hide();
    parts_->pageRecipe.clear();
    session_.restore(taken.scanPath, taken.recipe);
  };
  p.dismissal = [this] {
    if (const auto dropped = std::exchange(parts_->leftWork, std::nullopt)) parts_->journal->discard(*dropped);
    if (const QString sample = std::exchange(parts_->sample, {}); !sample.isEmpty()) openAtStart(sample);
  };
  const QString name = left.scanPath.isEmpty() ? tr("a new drawing") : shownFileName(left.scanPath);
  p.errors->show(tr("Batten did not close properly. Unsaved work on %1 from %2 is available.")
                     .arg(name, QLocale().toString(left.when, QLocale::ShortFormat)),
                 tr("Restore it"), tr("Discard it"));
  refreshActions();
  return true;
}

}  // namespace batten
