// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/target_tile.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/target_advice.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr double kStepPx = 1.0;        // between the points of a line
constexpr double kTitleHeight = 17.0;  // px

/// What a tile draws: the curvature, of the sketched curve or of a target, with the side up to which the curve turns
/// most. Which way it was traced is chance and must not turn the picture upside down.
std::vector<double> drawn(const TargetOutcomes& outcomes, const TargetProfile* profile) {
  const TargetSet& set = outcomes.targets;
  double turn = 0.0;
  for (const CurvatureSample& sample : set.samples) turn += std::isfinite(sample.kappa) ? sample.kappa : 0.0;
  const double sign = turn < 0.0 ? -1.0 : 1.0;
  std::vector<double> values;
  for (const auto& [perimeter, kappa] : set.samples)
    values.push_back(sign * (profile ? profile->curvatureAt(perimeter) : kappa));
  return values;
}

/// Where a share of the perimeter lies along what a tile shows: the curve, or its span.
std::optional<double> shareOfSpan(const TargetOutcomes& outcomes, double perimeter) {
  if (!outcomes.span) return perimeter;
  const double f = perimeter < outcomes.span->from ? perimeter + 1.0 : perimeter;
  const double share = (f - outcomes.span->from) / (outcomes.span->to - outcomes.span->from);
  return share <= 1.0 ? std::optional(share) : std::nullopt;
}

}  // namespace

TargetTile::TargetTile(int degree, QWidget* parent) : QAbstractButton(parent), degree_(degree) {
  setObjectName(QStringLiteral("target.%1").arg(degree));
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_Hover);
  setCursor(Qt::PointingHandCursor);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setFixedHeight(kHeight);
}

void TargetTile::show(std::shared_ptr<const TargetOutcomes> outcomes, double toleranceMm, bool chosen, bool oneCurve,
                      const QString& waiting) {
  outcomes_ = std::move(outcomes);
  waiting_ = outcomes_ ? QString() : waiting;
  toleranceMm_ = toleranceMm;
  chosen_ = chosen;
  setEnabled(outcomes_ && outcomes_->targets.profiles[degree_ - 1].valid);
  setAccessibleName(spokenText());
  setToolTip(tipText(oneCurve));
  update();
}

void TargetTile::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  const bool live = chosen_ && isEnabled();
  painter.setBrush(theme.panel);
  painter.setPen(QPen(live ? theme.accent : underMouse() && isEnabled() ? theme.mute : theme.line, live ? 2 : 1));
  painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 7, 7);
  if (hasFocus()) drawFocusRing(painter, QRectF(rect()), 8, theme);
  const QRectF inner = innerBox();
  const QRectF title(inner.left(), inner.top(), inner.width(), kTitleHeight);
  paintTitle(painter, title);
  const QRectF below(inner.left(), title.bottom() + 4, inner.width(), inner.bottom() - title.bottom() - 4);
  const QRectF figures(inner.left(), inner.bottom() - 15, inner.width(), 15);
  const QString instead = outcomes_ ? problem() : waiting_;
  if (!instead.isEmpty()) {
    painter.setFont(uiFont(11));
    painter.setPen(theme.mute);
    if (isFlat())
      painter.drawText(figures, Qt::AlignLeft | Qt::AlignVCenter,
                       painter.fontMetrics().elidedText(instead, Qt::ElideRight, static_cast<int>(figures.width())));
    else
      painter.drawText(below, Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, instead);
  }
  if (!outcomes_ || !instead.isEmpty()) return;
  if (!isFlat()) paintProfiles(painter, profileBox());
  paintFigures(painter, figures);
}

bool TargetTile::hasRoomForAdvice() const {
  const double number = QFontMetricsF(uiFont(12, QFont::Bold)).horizontalAdvance(QString::number(degree_)) + 5;
  const double name = QFontMetricsF(uiFont(12)).horizontalAdvance(degreeName(degree_)) + 6;
  const QFontMetricsF small(uiFont(11));
  const double word = std::max(small.horizontalAdvance(tr("recommended")), small.horizontalAdvance(tr("simplest fit")));
  return number + name + word <= innerBox().width();
}

void TargetTile::setAdviceInFull(bool inFull) {
  if (adviceInFull_ == inFull) return;
  adviceInFull_ = inFull;
  update();
}

bool TargetTile::hasRoomForSimilarityAbove() const {
  if (!outcomes_ || !problem().isEmpty()) return true;
  const double number = QFontMetricsF(uiFont(12, QFont::Bold)).horizontalAdvance(QString::number(degree_)) + 5;
  const double name = QFontMetricsF(uiFont(12)).horizontalAdvance(degreeName(degree_)) + 6;
  return number + name + QFontMetricsF(uiFont(11)).horizontalAdvance(figureTexts().similarity) <= innerBox().width();
}

void TargetTile::setSimilarityAbove(bool isAbove) {
  if (isSimilarityAbove_ == isAbove) return;
  isSimilarityAbove_ = isAbove;
  update();
}

void TargetTile::paintTitle(QPainter& painter, const QRectF& title) const {
  const Theme& theme = themeOf(palette());
  const QString number = QString::number(degree_);
  painter.setFont(uiFont(12, QFont::Bold));
  painter.setPen(isEnabled() ? theme.text : theme.mute);
  painter.drawText(title, Qt::AlignLeft | Qt::AlignVCenter, number);
  const double numberWidth = painter.fontMetrics().horizontalAdvance(number) + 5;
  const Advice advised = advice();
  const bool isAdvised = advised == Advice::Recommended;
  const QFontMetricsF metrics(uiFont(12)), small(uiFont(11));
  if (isSimilarityAbove_ && outcomes_ && problem().isEmpty())
    return paintTitleWithSimilarity(painter, title.adjusted(numberWidth, 0, 0, 0), isAdvised);
  const double nameWidth = metrics.horizontalAdvance(degreeName(degree_));
  QString word = isAdvised ? tr("recommended") : advised == Advice::SimplestFit ? tr("simplest fit") : QString();
  const auto hasRoom = [&](const QString& one) {
    return numberWidth + nameWidth + 6 + small.horizontalAdvance(one) <= title.width();
  };
  if (!adviceInFull_ || !hasRoom(word))
    word = word.isEmpty() ? QString() : isAdvised ? QStringLiteral("✓") : tr("simplest");
  if (!hasRoom(word) && !isAdvised) word.clear();
  const double taken = word.isEmpty() ? 0.0 : small.horizontalAdvance(word) + 6;
  painter.setFont(uiFont(12));
  painter.drawText(title.adjusted(numberWidth, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter,
                   metrics.elidedText(degreeName(degree_), Qt::ElideRight, title.width() - numberWidth - taken));
  painter.setFont(uiFont(11));
  painter.setPen(isAdvised ? theme.good : theme.mute);
  painter.drawText(title, Qt::AlignRight | Qt::AlignVCenter, word);
}

// In a narrow tile: the sign of advice beside the name, the similarity where the word would be.
void TargetTile::paintTitleWithSimilarity(QPainter& painter, const QRectF& box, bool isAdvised) const {
  constexpr double kApartPx = 6.0;  // between name and figure
  const Theme& theme = themeOf(palette());
  const QFontMetricsF metrics(uiFont(12)), small(uiFont(11));
  const QString similarity = figureTexts().similarity, sign = QStringLiteral("✓");
  const double signWidth = isAdvised ? small.horizontalAdvance(sign) + 0.5 * kApartPx : 0.0;
  const double room = box.width() - small.horizontalAdvance(similarity) - kApartPx - signWidth;
  const QString name = metrics.elidedText(degreeName(degree_), Qt::ElideRight, room);
  painter.setFont(uiFont(12));
  painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, name);
  painter.setFont(uiFont(11));
  painter.setPen(theme.mute);
  painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, similarity);
  if (!isAdvised) return;
  painter.setPen(theme.good);
  painter.drawText(box.adjusted(metrics.horizontalAdvance(name) + 0.5 * kApartPx, 0, 0, 0),
                   Qt::AlignLeft | Qt::AlignVCenter, sign);
}

QPainterPath TargetTile::pathOf(const std::vector<double>& values, const QRectF& box, double low, double high) const {
  QPainterPath path;
  bool pen = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      pen = false;
      continue;
    }
    const auto share = shareOfSpan(*outcomes_, outcomes_->targets.samples[i].perimeter);
    if (!share) {
      pen = false;
      continue;
    }
    const double t = std::clamp((values[i] - low) / (high - low), -0.04, 1.04);
    const double across = runsLeft_ ? 1.0 - *share : *share;
    const QPointF at(box.left() + across * box.width(), box.bottom() - t * box.height());
    // Steps far below a pixel make the pen leave specks beside the line.
    const bool isLast = i + 1 == values.size();
    if (pen && !isLast &&
        std::hypot(at.x() - path.currentPosition().x(), at.y() - path.currentPosition().y()) < kStepPx)
      continue;
    pen ? path.lineTo(at) : path.moveTo(at);
    pen = true;
  }
  return path;
}

std::optional<std::pair<double, double>> TargetTile::range(const std::vector<double>& sketched) const {
  // Same axes in every tile: the range of the data without its two outermost percent, so one spike cannot flatten all.
  std::vector<double> sorted;
  for (std::size_t i = 0; i < sketched.size(); ++i) {
    if (std::isfinite(sketched[i]) && shareOfSpan(*outcomes_, outcomes_->targets.samples[i].perimeter))
      sorted.push_back(sketched[i]);
  }
  if (sorted.size() < 2) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t cut = sorted.size() / 50;
  const double low = sorted[cut], high = sorted[sorted.size() - 1 - cut];
  const double pad = std::max((high - low) * 0.12, std::abs(high) * 1e-3 + 1e-12);
  return std::pair(low - pad, high + pad);
}

QRectF TargetTile::profileBox() const {
  const QRectF inner = innerBox();
  return inner.adjusted(0, kTitleHeight + 4, 0, -18);
}

QPainterPath TargetTile::sketchedPath() const {
  if (!outcomes_) return {};
  const std::vector<double> sketched = drawn(*outcomes_, nullptr);
  const auto axis = range(sketched);
  return axis ? pathOf(sketched, profileBox(), axis->first, axis->second) : QPainterPath();
}

void TargetTile::setRunsLeft(bool runsLeft) {
  if (runsLeft_ == runsLeft) return;
  runsLeft_ = runsLeft;
  update();
}

void TargetTile::paintProfiles(QPainter& painter, const QRectF& box) const {
  const Theme& theme = themeOf(palette());
  const std::vector<double> sketched = drawn(*outcomes_, nullptr);
  const auto axis = range(sketched);
  if (!axis) return;
  const auto [low, high] = *axis;
  painter.save();
  painter.setClipRect(box.adjusted(-2, -3, 2, 3));
  painter.setBrush(Qt::NoBrush);
  QColor grey = theme.mute;
  grey.setAlphaF(0.65F);
  painter.setPen(QPen(grey, 1));
  painter.drawPath(pathOf(sketched, box, low, high));
  const TargetProfile& profile = outcomes_->targets.profiles[degree_ - 1];
  painter.setPen(QPen(chosen_ ? theme.accent : theme.text, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(pathOf(drawn(*outcomes_, &profile), box, low, high));
  painter.restore();
}

TargetTile::FigureTexts TargetTile::figureTexts() const {
  const int index = degree_ - 1;
  const FairingReport& report = outcomes_->faired[index]->report;
  FigureTexts texts;
  texts.isOver = !isWithinTolerance(*outcomes_, degree_, toleranceMm_);
  texts.hasMoreExtrema = report.extremaAfter > report.extremaBefore;
  // What meeting the target takes is the number that decides; the curve itself never leaves the tolerance.
  const double needed = report.neededMm.value_or(0.0);
  const double mm = texts.isOver ? std::max(needed, report.maxDeviationMm) : report.maxDeviationMm;
  texts.similarity = QStringLiteral("S ") + similarityText(outcomes_->targets.profiles[index].similarity);
  texts.length = shortMillimetres(mm);
  const bool wouldAdd = texts.isOver && needed <= toleranceMm_;
  texts.needs = wouldAdd ? tr("in part") : texts.isOver ? tr("needs %1").arg(texts.length) : texts.length;
  texts.extrema = tr("%1 extr.").arg(report.extremaAfter);
  return texts;
}

QRectF TargetTile::innerBox() const {
  return isFlat() ? QRectF(rect()).adjusted(10, 4, -10, -4) : QRectF(rect()).adjusted(10, 7, -10, -6);
}

TargetTile::Figures TargetTile::roomFor() const {
  if (!outcomes_ || !problem().isEmpty()) return Figures::All;
  constexpr double kApartPx = 5.0;  // between two figures
  const FigureTexts texts = figureTexts();
  const QFontMetricsF metrics(uiFont(11));
  const auto width = [&](const QString& text) { return metrics.horizontalAdvance(text); };
  // The length stands in the middle between the other two.
  const double sides = 2.0 * (std::max(width(texts.similarity), width(texts.extrema)) + kApartPx);
  const double right = width(texts.extrema) + kApartPx, room = innerBox().width();
  // From the most said to the least: first the words go, which amber says too, then the similarity, which cannot
  // choose.
  if (sides + width(texts.needs) <= room) return Figures::All;
  if (sides + width(texts.length) <= room) return Figures::WithoutWords;
  if (width(texts.needs) + right <= room) return Figures::WithoutSimilarity;
  if (width(texts.length) + right <= room) return Figures::LengthAndExtrema;
  return Figures::Length;
}

void TargetTile::setFigures(Figures figures) {
  if (figures_ == figures) return;
  figures_ = figures;
  update();
}

void TargetTile::paintFigures(QPainter& painter, const QRectF& box) const {
  const Theme& theme = themeOf(palette());
  const FigureTexts texts = figureTexts();
  const bool withWords = figures_ == Figures::All || figures_ == Figures::WithoutSimilarity;
  const bool withSimilarity = figures_ == Figures::All || figures_ == Figures::WithoutWords;
  painter.setFont(uiFont(11));
  painter.setPen(texts.hasMoreExtrema ? theme.amber : theme.mute);
  if (figures_ != Figures::Length) painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, texts.extrema);
  painter.setPen(theme.mute);
  if (withSimilarity) painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, texts.similarity);
  painter.setPen(texts.isOver ? theme.amber : theme.mute);
  const QString length =
      QFontMetricsF(painter.font()).elidedText(withWords ? texts.needs : texts.length, Qt::ElideRight, box.width());
  painter.drawText(box, (withSimilarity ? Qt::AlignHCenter : Qt::AlignLeft) | Qt::AlignVCenter, length);
}

void TargetTile::enterEvent(QEnterEvent*) {
  if (isEnabled()) emit entered(degree_);
}
void TargetTile::leaveEvent(QEvent*) { emit left(); }
void TargetTile::focusInEvent(QFocusEvent* event) {
  QAbstractButton::focusInEvent(event);
  // By Tab only: after a click the mouse is what hovers.
  if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason) emit entered(degree_);
}
void TargetTile::focusOutEvent(QFocusEvent* event) {
  QAbstractButton::focusOutEvent(event);
  emit left();
}
void TargetTile::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
  if (event->key() == Qt::Key_Left) return void(focusPreviousChild());
  if (event->key() == Qt::Key_Right) return void(focusNextChild());
  QAbstractButton::keyPressEvent(event);
}

}  // namespace batten
