// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// What a line or word of a figure stands for; figureColour() says how it looks, the same on every page.
enum class Ink { Text, Mute, Grid, Sketched, Faired, Target, Comb };
/// As in HTML: "#0b6bcb".
const char* figureColour(Ink);

/// A line of a figure. Frame of the figure: mm from its upper left corner, y down.
struct FigureStroke {
  std::vector<Vec2> points;  ///< Corners; if cubic a start, then two handles and an end per cubic.
  bool isCubic = false;
  bool isDashed = false;
  Ink ink = Ink::Text;
  double widthMm = 0.2;
};
/// One line of text.
struct FigureText {
  enum class Anchor { Start, Middle, End };
  Vec2 at = Vec2::Zero();  ///< Of its base line.
  std::string text;        ///< UTF-8.
  Anchor anchor = Anchor::Start;
  Ink ink = Ink::Mute;
  double heightMm = 2.4;  ///< Of the font.
};
/// A vector picture, independent of what it is painted on.
struct Figure {
  double widthMm = 0.0, heightMm = 0.0;
  std::vector<FigureStroke> strokes;  ///< In painting order.
  std::vector<FigureText> texts;
};

/// A bar of `lengthMm` with a tick every 10 mm and its length beside it: what a print is measured by.
/// @param at its left end.
void addScaleBar(Figure&, const Vec2& at, double lengthMm);

/// A round step (1, 2 or 5 times a power of ten) with at most `most` steps in a range. @pre range > 0, most > 0.
double roundStep(double range, int most);

}  // namespace batten
