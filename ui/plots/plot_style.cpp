// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_style.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/theme/minus_sign.h"

namespace batten {
namespace {

/// Fewer labels than this do not touch at the smallest height of the plot.
constexpr int kMostTicks = 5;
constexpr double kFewestDecades = 4.0;  // on an axis whose labels are powers of ten alone

/// Two degrees share a colour; the even ones are dashed, finer than the target that is chosen.
QPen penOfTarget(int degree, const Theme& theme) {
  const auto colours = static_cast<int>(theme.targets.size());
  QPen pen(theme.targets[std::clamp((degree - 1) / 2, 0, colours - 1)], 1.4);
  if (degree % 2 == 0) pen.setDashPattern({3, 2});
  return pen;
}

}  // namespace

QPen penOf(PlotRole role, const Theme& theme, std::optional<int> degree) {
  const QColor grey = theme.mute;
  QPen dashed(theme.amber, 2.4);
  dashed.setDashPattern({5, 3.5});
  switch (role) {
    case PlotRole::Target:
      return penOfTarget(degree.value_or(1), theme);
    case PlotRole::HoveredTarget:
      return {theme.text, 2.2};
    case PlotRole::ChosenTarget:
      return dashed;
    case PlotRole::DrawnTarget:
      return {theme.amber, 2, Qt::DotLine, Qt::RoundCap};
    case PlotRole::Tolerance:
      return {theme.amber, 1, Qt::DashLine};
    case PlotRole::Faired:
      return {theme.accent, 2};
    case PlotRole::Joint:
      return {theme.text, 1};
    case PlotRole::Sketched:
      break;
  }
  return {grey, 1.8};
}

QString quantityText(PlotTab tab) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("CurvePlots", text); };
  switch (tab) {
    case PlotTab::Radius:
      return tr("R, mm");
    case PlotTab::Curvature:
      return tr("κ, 1/mm");
    case PlotTab::CurvatureSlope:
      return tr("dκ/ds, 1/mm²");
    case PlotTab::Speed:
      return tr("|R′(u)|, mm per unit of u");
    case PlotTab::Deviation:
      return tr("off the sketched curve, mm");
  }
  return {};
}

QVector<double> RoundLogTicker::createTickVector(double, const QCPRange& range) {
  if (!(range.lower > 0.0) || !(range.upper > range.lower)) return {};
  const double whole = std::log(range.upper / range.lower), gap = whole / kMostTicks;
  QVector<double> round;
  if (whole < std::log(4.0)) {
    // Less than a decade's worth: even steps.
    const double raw = (range.upper - range.lower) / kMostTicks;
    const double ten = std::pow(10.0, std::floor(std::log10(raw))), share = raw / ten;
    const double step = ten * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
    for (double tick = std::ceil(range.lower / step) * step; tick <= range.upper; tick += step) round.append(tick);
  } else {
    const bool areDecadesEnough = whole >= kFewestDecades * std::log(10.0);
    for (int e = static_cast<int>(std::floor(std::log10(range.lower))); std::pow(10.0, e) <= range.upper; ++e)
      for (const double m : {1.0, 2.0, 5.0}) {
        const double tick = m * std::pow(10.0, e);
        if (tick >= range.lower && tick <= range.upper && (m == 1.0 || !areDecadesEnough)) round.append(tick);
      }
  }
  QVector<double> apart;
  for (const double tick : round)
    if (apart.isEmpty() || std::log(tick / apart.last()) >= 0.8 * gap) apart.append(tick);
  return apart;
}

QString RoundLogTicker::getTickLabel(double tick, const QLocale&, QChar, int) {
  constexpr int kDigits = 6;  // without zeros behind them: "0.1", "0.25", "5", "1000"
  return QString::number(tick, 'g', kDigits);
}

double PlainTicker::getTickStep(const QCPRange& range) {
  // 1, 2 or 5 of a power of ten: a step of 0.025 would be written as 0.02, 0.05, 0.08.
  step_ = QCPAxisTicker::getTickStep(range);
  const double ten = std::pow(10.0, std::floor(std::log10(step_) + 1e-9)), share = step_ / ten;
  step_ = ten * (share < 1.5 ? 1.0 : share < 3.0 ? 2.0 : share < 7.0 ? 5.0 : 10.0);
  return step_;
}

QString PlainTicker::getTickLabel(double tick, const QLocale&, QChar, int) {
  if (std::abs(tick) < 1e-6 * step_) return QStringLiteral("0");
  const int decimals = static_cast<int>(std::ceil(-std::log10(step_) - 1e-9));
  // What would be all zeros is written with its power.
  if (decimals > 4 || std::abs(tick) >= 1e6) {
    const int digits = 1 + static_cast<int>(std::ceil(std::log10(std::abs(tick) / step_) - 1e-9));
    return withMinusSign(
        QString::number(tick, 'e', std::clamp(digits - 1, 0, 4)).replace(QStringLiteral("e-0"), QStringLiteral("e-")));
  }
  return withMinusSign(QString::number(tick, 'f', std::max(0, decimals)));
}

QVector<double> LengthTicker::createTickVector(double, const QCPRange& range) {
  shown_ = range;
  return {range.lower, 0.5 * (range.lower + range.upper), range.upper};
}

QString LengthTicker::getTickLabel(double tick, const QLocale&, QChar, int) {
  const double size = shown_.size();
  const int decimals = size >= 20.0 ? 0 : size >= 2.0 ? 1 : 2;
  const QString number = QString::number(tick, 'f', tick == 0.0 ? 0 : decimals);
  if (std::abs(tick - shown_.center()) > 1e-6 * size) return number;
  const QString length = number + QStringLiteral(" mm");
  return reversed_ ? QStringLiteral("← ") + length : length + QStringLiteral(" →");
}

}  // namespace batten
