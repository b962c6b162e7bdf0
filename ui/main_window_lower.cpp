// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAction>
#include <QSplitter>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/main_window_parts.h"
#include "ui/panels/targets/shape_window.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"

namespace batten {
namespace {

constexpr int kLowestWindow = 660;  ///< [px] Height of the window below which the plots fold.
constexpr int kUsualLower = 380;    ///< [px] Of targets and plots, where half of the window is left beside them.
constexpr double kLeastDrawingShare = 0.48;  ///< Of the window, that the drawing keeps beside a whole plot.
constexpr int kLeastDrawing = 230;           ///< [px] That the drawing keeps when targets and plots are drawn higher.

/// Curves are judged there; elsewhere targets and plots would be noise.
bool isJudging(PanelStage stage) { return stage == PanelStage::Curves || stage == PanelStage::Fairing; }

}  // namespace

bool MainWindow::isLowerWanted() const { return isJudging(stage()) ? parts_->showsLower : parts_->showsLowerHere; }

void MainWindow::followTargets() {
  const bool isCompared = parts_->shapes && parts_->shapes->isVisible();
  session_.setTargetsWanted(isJudging(stage()) || isLowerWanted() || isCompared);
}

void MainWindow::foldLower(bool shown) {
  (isJudging(stage()) ? parts_->showsLower : parts_->showsLowerHere) = shown;
  fitLower();
}

void MainWindow::fitLowerSoon() {
  if (std::exchange(parts_->isFitting, true)) return;
  QTimer::singleShot(0, this, [this] {
    parts_->isFitting = false;
    fitLower();
  });
}

void MainWindow::fitLower() {
  Parts& p = *parts_;
  const bool isWanted = isLowerWanted();
  p.foldAction->setChecked(isWanted);
  followTargets();
  const bool hasPlots = height() >= kLowestWindow;
  p.plots->setVisible(hasPlots);
  p.lower->setVisible(isWanted);
  // Half of the window is the drawing's, a little less where the axes of the plot need it; the tiles take what the
  // plot leaves of the rest.
  const int shared = p.splitter->height() - p.splitter->handleWidth();
  int room = shared - height() / 2;
  if (hasPlots) {
    const int most = shared - static_cast<int>(std::ceil(kLeastDrawingShare * height()));
    room = std::max(room, std::min(most, p.strip->flatHeight() + p.plots->goodHeight()));
  }
  p.strip->fitInto(room - (hasPlots ? p.plots->goodHeight() : 0), hasPlots);
  if (!isWanted) return;
  const int least = p.strip->height() + (hasPlots ? p.plots->minimumSizeHint().height() : 0);
  const int most = std::max(least, shared - kLeastDrawing);
  const int lower = hasPlots ? std::clamp(p.lowerPx.value_or(std::min(kUsualLower, room)), least, most) : least;
  p.splitter->setSizes({std::max(1, shared - lower), lower});
}

}  // namespace batten
