// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QFont>
#include <QIcon>
#include <QPalette>
#include <QString>
#include <array>

class QPainter;
class QRectF;

namespace batten {

/// The colours of the window. One accent that means "selected or live"; amber only for "over tolerance" and "stale",
/// green only for "done" and "recommended", red only for "failed".
struct Theme {
  bool dark = false;
  QColor background, panel, line, text, mute, accent, onAccent, selection, hover, good, amber, bad;
  /// The targets in a plot, two degrees each: far from each other, from grey, accent and amber, for colour-blind eyes
  /// too.
  std::array<QColor, 3> targets;
};

enum class ThemeChoice { System, Light, Dark };

const Theme& lightTheme();
const Theme& darkTheme();
/// The theme that belongs to a widget's palette: dark when its window colour is.
const Theme& themeOf(const QPalette&);

/// Sets palette, style sheet and base font of the whole program. System keeps to the desktop's own light or dark.
void applyTheme(ThemeChoice);

/// The base font at another size or weight: 13 px is the base, 12 px for figures, 11 px for captions.
QFont uiFont(int pixelSize = 13, QFont::Weight weight = QFont::Normal);

/// An icon of the resources in the text colour of the palette (icons are drawn in black).
QIcon themedIcon(const QString& name, const QPalette&);

/// The ring that shows which control has the keyboard.
void drawFocusRing(QPainter&, const QRectF&, double radius, const Theme&);

}  // namespace batten
