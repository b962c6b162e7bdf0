// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAction>
#include <QSplitter>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "ui/main_window_parts.h"
#include "ui/panels/targets/target_strip.h"
#include "ui/plots/curve_plots.h"

namespace batten {
namespace {

/// Heights of the window below which the strip shrinks, and the plots fold.
constexpr int kLowWindow = 760, kLowestWindow = 660;
/// The drawing keeps this much of the height between the bars.
constexpr int kLeastDrawing = 230;

/// Curves are judged there; elsewhere targets and plots would be noise.
bool isJudging(PanelStage stage) { return stage == PanelStage::Curves || stage == PanelStage::Fairing; }

}  // namespace

bool MainWindow::isLowerWanted() const { return isJudging(stage()) ? parts_->showsLower : parts_->showsLowerHere; }

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
  p.strip->setLow(height() < kLowWindow);
  p.plots->setVisible(height() >= kLowestWindow);
  p.lower->setVisible(isWanted);
  if (!isWanted) return;
  const int least = p.strip->height() + (p.plots->isHidden() ? 0 : p.plots->minimumSizeHint().height());
  const bool isLow = height() < kLowWindow;
  const int most = std::max(least, p.splitter->height() - kLeastDrawing);
  const int lower = isLow ? least : std::clamp(p.lowerPx, least, most);
  p.splitter->setSizes({std::max(1, p.splitter->height() - lower), lower});
}

}  // namespace batten
