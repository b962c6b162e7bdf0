// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/text/fairness_text.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double kPlaces = 1000.0;  // parts that are shown of 1
/// A log-aesthetic curve as near as this is worth naming.
constexpr double kLikeLogAesthetic = 0.98;

QString fairnessTr(const char* text) { return QCoreApplication::translate("Fairness", text); }

QString threePlaces(double s) { return QString::number(std::floor(s * kPlaces + 1e-6) / kPlaces, 'f', 3); }

}  // namespace

QString fairnessBadge(const CurveFairness& fairness) {
  QString s = threePlaces(fairness.similarity);
  if (s.startsWith(QLatin1String("0."))) s.remove(0, 1);
  return QStringLiteral("M ") + s;
}

QString fairnessSentence(const CurveFairness& fairness) {
  QString text = fairnessTr("Monotone: M %1, likeness to the nearest curve whose curvature only rises or only falls")
                     .arg(threePlaces(fairness.similarity));
  if (fairness.logAesthetic) {
    text += fairnessTr(", %1 to the nearest log-aesthetic one").arg(threePlaces(std::max(0.0, *fairness.logAesthetic)));
    if (fairness.alpha && *fairness.logAesthetic >= kLikeLogAesthetic)
      text += fairnessTr(" (alpha %1)").arg(*fairness.alpha, 0, 'f', 1);
  }
  return text + fairnessTr(
                    "; extrema of the curvature: %1, control points: %2. M is of the shape as a whole: smoothing takes "
                    "extrema "
                    "away but may lower M, where it makes an intended bend clearer.")
                    .arg(fairness.extrema)
                    .arg(fairness.controlPoints);
}

QString fairnessLine(const CurveFairness& fairness) {
  return fairnessTr("%1 · extrema: %2 · control points: %3")
      .arg(fairnessBadge(fairness))
      .arg(fairness.extrema)
      .arg(fairness.controlPoints);
}

}  // namespace batten
