// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/target_strip.h"

#include <QHBoxLayout>
#include <QPainter>
#include <algorithm>
#include <memory>
#include <optional>

#include "core/fairing/fairing.h"
#include "core/fairing/profile/target_degrees.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {
constexpr int kAbove = 8, kBelow = 7, kAroundTiles = kAbove + kBelow;  // [px] of the strip
/// The target that the curve follows has the figures of the curve that is drawn, not of the one before it was made
/// light.
std::shared_ptr<const TargetOutcomes> withTheCurveItself(const EditorSession& session, const TracedCurve& curve,
                                                         const std::shared_ptr<const TargetOutcomes>& targets) {
  const FairingParams& used = curve.fairingUsed;
  const bool isFollowed = used.mode == FairingMode::Target && isPolynomial(used.target) && used.spanTargets.empty() &&
                          !session.pointedSpan() && !session.isStale(StageId::Faired) && !curve.faired.isEmpty();
  const std::optional<int> degree = curve.fairing.targetDegree;
  if (!isFollowed || !degree || !targets->faired[*degree - 1]) return targets;
  auto shown = std::make_shared<TargetOutcomes>(*targets);
  shown->faired[*degree - 1]->report = curve.fairing;
  return shown;
}

}  // namespace

TargetStrip::TargetStrip(EditorSession& session, QWidget* parent) : QWidget(parent), session_(session) {
  setObjectName(QStringLiteral("targetStrip"));
  setAccessibleName(tr("Six targets for the selected curve"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(8, kAbove, 8, kBelow);
  layout->setSpacing(6);
  for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
    auto* tile = new TargetTile(degree, this);
    tiles_[degree - 1] = tile;
    layout->addWidget(tile, 1);
    connect(tile, &QAbstractButton::clicked, this, [this, degree] { chooseTarget(session_, targetOfDegree(degree)); });
    connect(tile, &TargetTile::entered, this, [this](int hovered) {
      session_.hoverTarget(hovered);
      emit hint(tr("Hover a target to see its curve; click to apply it."));
    });
    connect(tile, &TargetTile::left, this, [this] {
      session_.hoverTarget(std::nullopt);
      emit hint({});
    });
  }
  setTileHeight(TargetTile::kHeight);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::targetsChanged, &EditorSession::runFinished})
    connect(&session_, signal, this, &TargetStrip::refresh);
  connect(&session_, &EditorSession::workingChanged, this, &TargetStrip::refresh);
  refresh();
}

void TargetStrip::fitInto(int height, bool hasPlots) {
  const int tile = height - kAroundTiles;
  setTileHeight(tile >= TargetTile::kHeight                   ? TargetTile::kHeight
                : tile >= TargetTile::kLowHeight || !hasPlots ? TargetTile::kLowHeight
                                                              : TargetTile::kFlatHeight);
}

int TargetStrip::flatHeight() { return TargetTile::kFlatHeight + kAroundTiles; }

void TargetStrip::setTileHeight(int height) {
  if (this->height() == height + kAroundTiles) return;
  for (TargetTile* one : tiles_) one->setFixedHeight(height);
  setFixedHeight(height + kAroundTiles);
  refresh();
}

void TargetStrip::setRunsLeft(bool runsLeft) {
  for (TargetTile* one : tiles_) one->setRunsLeft(runsLeft);
}

void TargetStrip::refresh() {
  const TracedCurve* curve = session_.selected();
  const auto targets = session_.targets();
  std::optional<int> chosen;
  double tolerance = session_.recipe().fairing.toleranceMm;
  if (curve) {
    const FairingParams used = fairingAsked(session_);
    tolerance = used.toleranceMm;
    if (session_.pointedSpan())
      chosen = chosenSpanTarget(session_);
    else if (used.mode == FairingMode::Target && isPolynomial(used.target) && curve->fairingUsed.spanTargets.empty())
      chosen = degreeOf(used.target) || !targets ? degreeOf(used.target) : targets->recommendedDegree;
  }
  const QString waiting = !curve                   ? QString()
                          : session_.isTargeting() ? tr("computing…")
                          : session_.isStopped()   ? tr("stopped")
                                                   : QString();
  const auto shown = curve && targets ? withTheCurveItself(session_, *curve, targets) : nullptr;
  for (int degree = 1; degree <= kMostTargetDegree; ++degree)
    tiles_[degree - 1]->show(shown, tolerance, degree == chosen, choosesForOneCurve(session_), waiting);
  alignFigures();
}

void TargetStrip::alignFigures() {
  TargetTile::Figures least = TargetTile::Figures::All;
  for (const TargetTile* tile : tiles_) least = std::max(least, tile->roomFor());
  for (TargetTile* tile : tiles_) tile->setFigures(least);
  const bool isAbove = least >= TargetTile::Figures::WithoutSimilarity &&
                       std::all_of(tiles_.begin(), tiles_.end(),
                                   [](const TargetTile* tile) { return tile->hasRoomForSimilarityAbove(); });
  for (TargetTile* tile : tiles_) tile->setSimilarityAbove(isAbove);
  // The advice looks alike on whichever tile it stands.
  const bool inFull = std::all_of(tiles_.begin(), tiles_.end(), [](auto* tile) { return tile->hasRoomForAdvice(); });
  for (TargetTile* tile : tiles_) tile->setAdviceInFull(inFull);
}

void TargetStrip::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  alignFigures();
}

void TargetStrip::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.fillRect(rect(), theme.background);
  painter.fillRect(0, 0, width(), 1, theme.line);
}

}  // namespace batten
