// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/figure.h"

#include <cmath>

#include "core/base/number_text.h"

namespace batten {
namespace {

constexpr double kTickStepMm = 10.0;               // of the scale bar
constexpr double kTickMm = 1.2, kEndTickMm = 2.4;  // of the scale bar
constexpr double kBarWidthMm = 0.25;               // of its line

}  // namespace

const char* figureColour(Ink ink) {
  switch (ink) {
    case Ink::Text:
      return "#1d1f21";
    case Ink::Mute:
      return "#6b6f74";
    case Ink::Grid:
      return "#dcdcd8";
    case Ink::Sketched:
      return "#8a8e93";
    case Ink::Faired:
      return "#0b6bcb";
    case Ink::Target:
      return "#b96a00";
    case Ink::Comb:
      return "#7fb2e5";
  }
  return "#000000";
}

void addScaleBar(Figure& figure, const Vec2& at, double lengthMm) {
  figure.strokes.push_back({{at, at + Vec2(lengthMm, 0)}, false, false, Ink::Text, kBarWidthMm});
  for (double x = 0.0; x <= lengthMm + 1e-9; x += kTickStepMm) {
    const bool isEnd = x == 0.0 || x > lengthMm - 1e-9;
    const Vec2 foot = at + Vec2(x, 0);
    figure.strokes.push_back(
        {{foot, foot - Vec2(0, isEnd ? kEndTickMm : kTickMm)}, false, false, Ink::Text, kBarWidthMm});
  }
  figure.texts.push_back(
      {at + Vec2(lengthMm + 2.0, 0), numberToText(lengthMm) + " mm", FigureText::Anchor::Start, Ink::Text, 2.8});
}

double roundStep(double range, int most) {
  const double least = range / most, power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-12)) return factor * power;
  return 10.0 * power;
}

}  // namespace batten
