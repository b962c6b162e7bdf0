// SPDX-License-Identifier: GPL-3.0-or-later
// Files opened or saved lately, and what the program starts with.
#include <QAction>
#include <QDir>
#include <QFontMetrics>
#include <QHash>
#include <QMenu>
#include <QSettings>
#include <algorithm>
#include <utility>

#include "ui/main_window_parts.h"
#include "ui/opening_guard.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {
constexpr int kRecentFiles = 20;     // that are known: of a drawing its scan and its recipe
constexpr int kRecentDrawings = 10;  // in the menu
const QString kRecentKey = QStringLiteral("recent"), kScansKey = QStringLiteral("recent-scans");

/// "coupe.png  –  ~/scans": the folder tells two files of one name apart.
QString recentText(const QString& path) {
  QString folder = shownPath(folderOf(path));
  if (const QString home = QDir::homePath(); folder == home || folder.startsWith(home + QLatin1Char('/')))
    folder.replace(0, home.size(), QLatin1Char('~'));
  const QString shown = QFontMetrics(uiFont(13)).elidedText(folder, Qt::ElideMiddle, 320);
  return QString(shownFileName(path) + QStringLiteral("  –  ") + shown).replace(QLatin1Char('&'), QStringLiteral("&&"));
}

/// Of the recent files that are recipes of scans: the scan of each. The recipe does not know it.
QHash<QString, QString> scansOfRecipes() {
  const QStringList pairs = QSettings().value(kScansKey).toStringList();
  QHash<QString, QString> scans;
  for (qsizetype i = 0; i + 1 < pairs.size(); i += 2) scans[pathFromStored(pairs[i])] = pathFromStored(pairs[i + 1]);
  return scans;
}

}  // namespace

QStringList MainWindow::recentFiles() {
  QStringList files = QSettings().value(kRecentKey).toStringList();
  for (QString& path : files) path = pathFromStored(path);
  return files;
}

void MainWindow::checkRecent(std::function<void()> then) {
  // A newer look answers for those that it overtakes.
  if (then) parts_->afterRecentCheck.push_back(std::move(then));
  // A drive that has gone to sleep or away answers after seconds.
  parts_->recentChecker->start([this, files = recentFiles(), scans = scansOfRecipes()](const CancelToken&) {
    QStringList gone;
    for (const QString& path : files) {
      const QString scan = scans.value(path);
      if (!pathExists(path) || (!scan.isEmpty() && !pathExists(scan))) gone.append(path);
    }
    parts_->inbox.post([this, gone] {
      parts_->goneFiles = gone;
      for (const auto& after : std::exchange(parts_->afterRecentCheck, {})) after();
      // Nothing moves in a menu that is open.
      if (parts_->recentMenu->isVisible())
        greyGone();
      else
        fillRecent();
    });
  });
}

// Each recipe is a piece of work and has an entry. The newest one that is there stands for its scan, too. What is gone
// is greyed, not left out: a drive may only be unplugged.
QStringList MainWindow::recentDrawings() const {
  const QStringList files = recentFiles(), &gone = parts_->goneFiles;
  const QHash<QString, QString> scans = scansOfRecipes();
  const auto recipesOf = [&](const QString& scan) {
    QStringList recipes;
    for (const QString& path : files)
      if (scans.value(path) == scan) recipes.append(path);
    return recipes;
  };
  QStringList shown;
  for (const QString& path : files) {
    const QString scan = scans.value(path);
    QString one = path;
    if (scan.isEmpty()) {
      const QStringList recipes = recipesOf(path);
      const auto there = std::ranges::find_if(recipes, [&](const QString& recipe) { return !gone.contains(recipe); });
      if (there != recipes.end())
        one = *there;
      else if (!recipes.isEmpty() && gone.contains(path))
        continue;
    } else if (gone.contains(path) && files.contains(scan) && !gone.contains(scan)) {
      continue;
    }
    if (!shown.contains(one)) shown.append(one);
  }
  return shown.mid(0, kRecentDrawings);
}

void MainWindow::rememberFile(const QString& path, const QString& scan) {
  QStringList files = recentFiles();
  const QString full = absolutePath(path);
  QHash<QString, QString> scans = scansOfRecipes();
  if (!scan.isEmpty()) scans[full] = absolutePath(scan);
  files.removeAll(full);
  files.prepend(full);
  while (files.size() > kRecentFiles) files.removeLast();
  QStringList stored, pairs;
  for (const QString& file : files) {
    stored.append(storedPath(file));
    if (scans.contains(file)) pairs << storedPath(file) << storedPath(scans[file]);
  }
  QSettings().setValue(kRecentKey, stored);
  QSettings().setValue(kScansKey, pairs);
  parts_->goneFiles.removeAll(full);
  checkRecent({});
}

void MainWindow::refreshRecent() {
  fillRecent();
  checkRecent({});  // The menu opens at once.
}

void MainWindow::fillRecent() {
  QMenu* menu = parts_->recentMenu;
  menu->clear();
  for (const QString& path : recentDrawings()) {
    QAction* entry = menu->addAction(recentText(path));
    entry->setData(path);
    entry->setToolTip(shownPath(path));
    entry->setStatusTip(shownPath(path));
    connect(entry, &QAction::triggered, this, [this, path] { openRecent(path); });
  }
  menu->setToolTipsVisible(true);
  if (menu->isEmpty()) menu->addAction(tr("No files yet"))->setEnabled(false);
  greyGone();
}

void MainWindow::greyGone() {
  for (QAction* entry : parts_->recentMenu->actions()) {
    const QString path = entry->data().toString();
    if (path.isEmpty()) continue;
    const bool isGone = parts_->goneFiles.contains(path);
    entry->setEnabled(!isGone);
    entry->setText(isGone ? recentText(path) + tr("  (not found)") : recentText(path));
  }
}

QString MainWindow::scanOfRecipe(const QString& path) { return scansOfRecipes().value(absolutePath(path)); }

// A recipe opens with its scan, as the drawing that it is.
void MainWindow::openRecent(const QString& path) {
  const QString scan = scanOfRecipe(path);
  if (scan.isEmpty()) return openPath(path);
  readRecipe(path, scan);
}

// The newest work on this scan, where another file than that work was opened.
void MainWindow::offerSavedRecipe() {
  const QString scan = absolutePath(session_.scanPath());
  const QHash<QString, QString> scans = scansOfRecipes();
  QString saved;
  for (const QString& path : recentFiles())
    if (saved.isEmpty() && scans.value(path) == scan) saved = path;
  if (saved.isEmpty() || saved == parts_->recipePath) return;
  checkRecent([this, saved, scan] {
    Parts& p = *parts_;
    const bool isElsewhere = absolutePath(session_.scanPath()) != scan || saved == p.recipePath;
    if (isElsewhere || p.goneFiles.contains(saved) || !p.errors->message().isEmpty()) return;
    p.problemOrigin.reset();
    p.dismissal = {};
    p.remedy = [this, saved] {
      parts_->errors->hide();
      openRecent(saved);
    };
    p.errors->show(
        tr("Your work on this drawing was saved as %1 in %2.").arg(shownFileName(saved), shownPath(folderOf(saved))),
        tr("Open it"));
    refreshActions();
  });
}

void MainWindow::openAtStart(const QString& sample) {
  if (offerLeftWork()) {
    parts_->sample = sample;
    return;
  }
  checkRecent([this, sample] {
    if (session_.hasScan() || session_.isBusy()) return;  // The user was faster.
    for (const QString& path : recentFiles()) {
      if (parts_->goneFiles.contains(path)) continue;
      if (OpeningGuard::hasFailed(path)) return tellNotOpened(path);
      parts_->opening->begin(path);
      return openRecent(path);
    }
    if (!sample.isEmpty()) openPath(sample);
  });
}

void MainWindow::tellNotOpened(const QString& path) {
  parts_->problemOrigin.reset();
  parts_->dismissal = {};
  parts_->remedy = [this, path] {
    parts_->errors->hide();
    parts_->opening->begin(path);
    openRecent(path);
  };
  parts_->errors->show(
      tr("Batten stopped while opening %1, so the file was not opened again.").arg(shownFileName(path)),
      tr("Open it anyway"));
  refreshActions();
}

}  // namespace batten
