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
#include "ui/top_bar.h"

namespace batten {
namespace {
constexpr int kRecentFiles = 10;
}

ThemeChoice MainWindow::storedTheme() {
  return static_cast<ThemeChoice>(std::clamp(QSettings().value(QStringLiteral("theme"), 0).toInt(), 0, 2));
}

QStringList MainWindow::recentFiles() {
  QStringList files = QSettings().value(QStringLiteral("recent")).toStringList();
  files.erase(std::remove_if(files.begin(), files.end(), [](const QString& path) { return !QFileInfo::exists(path); }),
              files.end());
  return files;
}

void MainWindow::rememberFile(const QString& path) {
  QStringList files = recentFiles();
  const QString full = QFileInfo(path).absoluteFilePath();
  files.removeAll(full);
  files.prepend(full);
  while (files.size() > kRecentFiles) files.removeLast();
  QSettings().setValue(QStringLiteral("recent"), files);
}

void MainWindow::refreshRecent() {
  QMenu* menu = parts_->recentMenu;
  menu->clear();
  for (const QString& path : recentFiles()) {
    QAction* entry = menu->addAction(QFileInfo(path).fileName());
    entry->setToolTip(path);
    entry->setStatusTip(path);
    connect(entry, &QAction::triggered, this, [this, path] { openPath(path); });
  }
  menu->setToolTipsVisible(true);
  if (menu->isEmpty()) menu->addAction(tr("No files yet"))->setEnabled(false);
}

void MainWindow::refreshTitle() {
  const QString path = session_.scanPath();
  const QString name = session_.isBlankPage() ? tr("New drawing")
                       : session_.hasScan()   ? QFileInfo(path).fileName()
                                              : tr("No scan");
  parts_->topBar->setTitle(name, path);
  setWindowTitle(session_.hasScan() ? name + QStringLiteral(" – Batten") : QStringLiteral("Batten"));
}

void MainWindow::setThemeChoice(ThemeChoice choice) {
  applyTheme(choice);
  QSettings().setValue(QStringLiteral("theme"), static_cast<int>(choice));
  if (auto* entry = parts_->mainMenu->findChild<QAction*>(QStringLiteral("theme-%1").arg(static_cast<int>(choice))))
    entry->setChecked(true);
}

void MainWindow::showProblem(const QString& message) {
  using Remedy = Parts::Remedy;
  Remedy remedy = Remedy::None;
  QString text;
  if (!session_.hasScan()) {
    remedy = Remedy::OpenScan;
    text = tr("Open…");
  } else if (session_.output().error && session_.output().error->code == ErrorCode::NoCurve) {
    remedy = Remedy::Thresholds;
    text = tr("Show the thresholds");
  }
  parts_->remedy = remedy;
  parts_->errors->show(message, text);
  refreshActions();
}

void MainWindow::actOnProblem() {
  using Remedy = Parts::Remedy;
  switch (parts_->remedy) {
    case Remedy::OpenScan:
      return chooseScan();
    case Remedy::Thresholds:
      return setStage(PanelStage::Threshold);
    case Remedy::Export:
      return setStage(PanelStage::Export);
    case Remedy::None:
      return;
  }
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
  settings.endGroup();
  const ThemeChoice choice = storedTheme();
  parts_->mainMenu->findChild<QAction*>(QStringLiteral("theme-%1").arg(static_cast<int>(choice)))->setChecked(true);
}

void MainWindow::saveSettings() {
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
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
  settings.endGroup();
}

}  // namespace batten
