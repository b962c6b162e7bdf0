// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAction>
#include <QGuiApplication>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <algorithm>

#include "ui/main_window_parts.h"
#include "ui/panels/stages/export/export_panel.h"
#include "ui/plots/curve_plots.h"
#include "ui/session/files/path_text.h"
#include "ui/top_bar.h"

namespace batten {
namespace {
const QString kLowerKey = QStringLiteral("window/lower-height"), kPlotKey = QStringLiteral("window/plot");

}  // namespace

ThemeChoice MainWindow::storedTheme() {
  return static_cast<ThemeChoice>(std::clamp(QSettings().value(QStringLiteral("theme"), 0).toInt(), 0, 2));
}

QString MainWindow::drawingName() const {
  // A drawing without a scan is called as the file that holds it, or that its lines came from.
  if (session_.isBlankPage()) {
    if (!parts_->recipePath.isEmpty()) return shownFileName(parts_->recipePath);
    const auto& imports = session_.recipe().imports;
    return imports.empty() ? tr("New drawing") : QString::fromStdString(imports.front().source);
  }
  return session_.hasScan() ? shownFileName(session_.scanPath()) : tr("No scan");
}

void MainWindow::refreshTitle() {
  const bool unsaved = session_.hasUnsavedChanges();
  parts_->topBar->setTitle(drawingName(), unsaved,
                           shownPath(session_.isBlankPage() ? parts_->recipePath : session_.scanPath()));
  // With the dash that Qt puts before the name of the program in the titles of dialogs.
  setWindowTitle(session_.hasScan() ? drawingName() + QStringLiteral("[*] — Batten") : QStringLiteral("Batten"));
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
      return {tr("Save elsewhere…"), [this] { saveRecipeAs(); }};
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
  if (session_.undoStack()->canUndo()) return {tr("Undo the change"), [this] { session_.undoStack()->undo(); }};
  return {tr("Show the settings"), stageOf(PanelStage::Curves)};
}

void MainWindow::showProblem(const Error& error, FailureOrigin origin) {
  auto [text, remedy] = remedyFor(error, origin);
  parts_->remedy = std::move(remedy);
  parts_->dismissal = [this] { leaveProblem(); };
  parts_->problemOrigin = origin;
  parts_->errors->show(QString::fromStdString(error.message).simplified(), text);
  refreshActions();
}

// An offer of unsaved work that the problem had covered comes back.
void MainWindow::leaveProblem() {
  const bool wasProblem = parts_->problemOrigin.has_value();
  parts_->problemOrigin.reset();
  parts_->errors->hide();
  if (wasProblem && parts_->leftWork) offerLeftWork();
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
  if (settings.contains(kLowerKey)) parts_->lowerPx = settings.value(kLowerKey).toInt();
  parts_->showsLower = settings.value(QStringLiteral("window/plots"), true).toBool();
  settings.beginGroup(QStringLiteral("view"));
  for (const Layer layer : kLayers)
    view_.setVisible(layer, settings.value(action(showAction(layer))->objectName(), view_.isVisible(layer)).toBool());
  view_.setCombScale(settings.value(QStringLiteral("comb-scale"), view_.combScale()).toDouble());
  view_.setCombDensity(settings.value(QStringLiteral("comb-density"), view_.combDensity()).toInt());
  view_.setCombShowsRadius(settings.value(QStringLiteral("comb-radius"), view_.combShowsRadius()).toBool());
  view_.setRadiusIsLinear(settings.value(QStringLiteral("radius-linear"), view_.radiusIsLinear()).toBool());
  settings.endGroup();
  parts_->plots->setTab(static_cast<PlotTab>(std::clamp(settings.value(kPlotKey, 0).toInt(), 0, kPlotTabs - 1)));
  const ThemeChoice choice = storedTheme();
  parts_->mainMenu->findChild<QAction*>(QStringLiteral("theme-%1").arg(static_cast<int>(choice)))->setChecked(true);
}

void MainWindow::saveSettings() {
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  if (parts_->lowerPx) settings.setValue(kLowerKey, *parts_->lowerPx);
  settings.setValue(QStringLiteral("window/plots"), parts_->showsLower);
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
  settings.setValue(QStringLiteral("comb-radius"), view_.combShowsRadius());
  settings.setValue(QStringLiteral("radius-linear"), view_.radiusIsLinear());
  settings.endGroup();
  settings.setValue(kPlotKey, static_cast<int>(parts_->plots->tab()));
}

}  // namespace batten
