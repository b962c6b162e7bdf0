// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAction>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <QSplitter>
#include <algorithm>

#include "ui/main_window_parts.h"
#include "ui/panels/stages/export_panel.h"
#include "ui/plots/curve_plots.h"
#include "ui/top_bar.h"

namespace batten {
namespace {
constexpr int kRecentFiles = 10;
const QString kAngleKey = QStringLiteral("suggestion-angle"), kScaleKey = QStringLiteral("suggestion-scale"),
              kPlotKey = QStringLiteral("window/plot");
}  // namespace

ThemeChoice MainWindow::storedTheme() {
  return static_cast<ThemeChoice>(std::clamp(QSettings().value(QStringLiteral("theme"), 0).toInt(), 0, 2));
}

QStringList MainWindow::recentFiles() { return QSettings().value(QStringLiteral("recent")).toStringList(); }

void MainWindow::checkRecent(std::function<void()> then) {
  // A drive that has gone to sleep or away answers after seconds.
  parts_->recentChecker->start([this, files = recentFiles(), then = std::move(then)](const CancelToken&) {
    QStringList gone;
    for (const QString& path : files)
      if (!QFileInfo::exists(path)) gone.append(path);
    QMetaObject::invokeMethod(
        this,
        [this, gone, then] {
          parts_->goneFiles = gone;
          if (then) then();
        },
        Qt::QueuedConnection);
  });
}

void MainWindow::rememberFile(const QString& path) {
  QStringList files = recentFiles();
  const QString full = QFileInfo(path).absoluteFilePath();
  files.removeAll(full);
  files.prepend(full);
  while (files.size() > kRecentFiles) files.removeLast();
  QSettings().setValue(QStringLiteral("recent"), files);
  parts_->goneFiles.removeAll(full);
}

void MainWindow::refreshRecent() {
  QMenu* menu = parts_->recentMenu;
  menu->clear();
  checkRecent({});  // For the next time; the menu opens at once.
  for (const QString& path : recentFiles()) {
    if (parts_->goneFiles.contains(path)) continue;
    QAction* entry = menu->addAction(QFileInfo(path).fileName());
    entry->setToolTip(path);
    entry->setStatusTip(path);
    connect(entry, &QAction::triggered, this, [this, path] { openPath(path); });
  }
  menu->setToolTipsVisible(true);
  if (menu->isEmpty()) menu->addAction(tr("No files yet"))->setEnabled(false);
}

QString MainWindow::drawingName() const {
  if (session_.isBlankPage()) return tr("New drawing");
  return session_.hasScan() ? QFileInfo(session_.scanPath()).fileName() : tr("No scan");
}

void MainWindow::refreshTitle() {
  const bool unsaved = session_.hasUnsavedChanges();
  parts_->topBar->setTitle(drawingName(), unsaved, session_.scanPath());
  setWindowTitle(session_.hasScan() ? drawingName() + QStringLiteral("[*] – Batten") : QStringLiteral("Batten"));
  setWindowModified(unsaved);
}

void MainWindow::setThemeChoice(ThemeChoice choice) {
  applyTheme(choice);
  QSettings().setValue(QStringLiteral("theme"), static_cast<int>(choice));
  if (auto* entry = parts_->mainMenu->findChild<QAction*>(QStringLiteral("theme-%1").arg(static_cast<int>(choice))))
    entry->setChecked(true);
}

std::pair<QString, std::function<void()>> MainWindow::remedyFor(const Error& error, FailureOrigin origin) {
  const auto stageOf = [this](PanelStage stage) { return [this, stage] { setStage(stage); }; };
  switch (origin) {
    case FailureOrigin::OpenScan:
      return {tr("Open…"), [this] { chooseScan(); }};
    case FailureOrigin::OpenRecipe:
      if (!session_.hasScan()) return {tr("Open…"), [this] { chooseScan(); }};
      return {tr("Open recipe…"), [this] { chooseRecipe(); }};
    case FailureOrigin::SaveRecipe:
      return {tr("Save elsewhere…"), [this] { saveRecipe(); }};
    case FailureOrigin::Export:
      if (error.code == ErrorCode::NoCurve) return {tr("Show the curves"), stageOf(PanelStage::Curves)};
      return {tr("Choose a place…"), [this] {
                setStage(PanelStage::Export);
                parts_->exportPanel->browse();
              }};
    case FailureOrigin::Run:
      break;
  }
  if (error.code == ErrorCode::NoCurve) return {tr("Show the thresholds"), stageOf(PanelStage::Threshold)};
  if (error.code == ErrorCode::OutOfMemory) return {tr("Open…"), [this] { chooseScan(); }};
  if (session_.undoStack()->canUndo()) return {tr("Take the change back"), [this] { session_.undoStack()->undo(); }};
  return {tr("Show the settings"), stageOf(PanelStage::Curves)};
}

void MainWindow::showProblem(const Error& error, FailureOrigin origin) {
  auto [text, remedy] = remedyFor(error, origin);
  parts_->remedy = std::move(remedy);
  parts_->dismissal = {};
  parts_->problemOrigin = origin;
  parts_->errors->show(QString::fromStdString(error.message).simplified(), text);
  refreshActions();
}

void MainWindow::loadSettings() {
  QSettings settings;
  if (const QByteArray geometry = settings.value(QStringLiteral("window/geometry")).toByteArray();
      !geometry.isEmpty()) {
    restoreGeometry(geometry);
    // A screen that has gone must not take the window with it.
    const auto screens = QGuiApplication::screens();
    const bool visible = std::any_of(screens.begin(), screens.end(), [this](const QScreen* screen) {
      return screen->availableGeometry().intersects(frameGeometry().adjusted(40, 20, -40, -40));
    });
    if (!visible && QGuiApplication::primaryScreen())
      move(QGuiApplication::primaryScreen()->availableGeometry().topLeft());
  }
  if (const QByteArray split = settings.value(QStringLiteral("window/splitter")).toByteArray(); !split.isEmpty())
    parts_->splitter->restoreState(split);
  parts_->foldAction->setChecked(settings.value(QStringLiteral("window/plots"), true).toBool());
  settings.beginGroup(QStringLiteral("view"));
  for (const Layer layer : kLayers)
    view_.setVisible(layer, settings.value(action(showAction(layer))->objectName(), view_.isVisible(layer)).toBool());
  view_.setCombScale(settings.value(QStringLiteral("comb-scale"), view_.combScale()).toDouble());
  view_.setCombDensity(settings.value(QStringLiteral("comb-density"), view_.combDensity()).toInt());
  view_.setSuggestionAngleDeg(settings.value(kAngleKey, view_.suggestionAngleDeg()).toDouble());
  view_.setSuggestionScalePx(settings.value(kScaleKey, view_.suggestionScalePx()).toDouble());
  settings.endGroup();
  parts_->plots->setTab(static_cast<PlotTab>(std::clamp(settings.value(kPlotKey, 0).toInt(), 0, 3)));
  const ThemeChoice choice = storedTheme();
  parts_->mainMenu->findChild<QAction*>(QStringLiteral("theme-%1").arg(static_cast<int>(choice)))->setChecked(true);
}

void MainWindow::saveSettings() {
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  if (parts_->height == Parts::Height::Roomy)
    settings.setValue(QStringLiteral("window/splitter"), parts_->splitter->saveState());
  settings.setValue(QStringLiteral("window/plots"), parts_->foldAction->isChecked());
  settings.beginGroup(QStringLiteral("view"));
  for (const Layer layer : kLayers) {
    const auto& switched = parts_->stageLayers;
    const auto own = std::find_if(switched.begin(), switched.end(),
                                  [layer](const Parts::StageLayer& one) { return one.layer == layer; });
    settings.setValue(action(showAction(layer))->objectName(),
                      own == switched.end() ? view_.isVisible(layer) : own->before);
  }
  settings.setValue(QStringLiteral("comb-scale"), view_.combScale());
  settings.setValue(QStringLiteral("comb-density"), view_.combDensity());
  settings.setValue(kAngleKey, view_.suggestionAngleDeg());
  settings.setValue(kScaleKey, view_.suggestionScalePx());
  settings.endGroup();
  settings.setValue(kPlotKey, static_cast<int>(parts_->plots->tab()));
}

}  // namespace batten
