// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QRgb>

/// The canvas has its own colours, the same in the light and the dark theme: what was drawn must not change its look.
/// Only what surrounds the page follows the theme, so that it does not dazzle in a dark room.
namespace batten::colors {

inline QRgb desk(bool isDark) { return isDark ? qRgb(46, 48, 51) : qRgb(218, 216, 211); }  ///< Around the page.
inline constexpr QRgb kPaper = qRgb(252, 251, 248);  ///< The page where no picture of it is shown.
inline constexpr QRgb kMask = qRgb(0, 110, 116);     // ink
inline constexpr QRgb kEdges = qRgb(176, 36, 142);   // the picture of edges
inline constexpr QRgb kMissed = qRgb(236, 112, 0);   ///< Ink that no curve explains.

inline QColor sketched() { return {88, 88, 88, 210}; }
inline QColor sketchedFaint() { return {96, 96, 96, 150}; }
inline QColor target() { return {200, 112, 0}; }
inline QColor accent() { return {11, 107, 203}; }
inline QColor halo() { return {11, 107, 203, 56}; }
inline QColor casing() { return {255, 255, 255, 185}; }  ///< Around a line that lies on ink.
inline QColor corner() { return {201, 60, 16}; }
inline QColor lost() { return {196, 0, 0}; }
inline QColor pinned() { return {132, 58, 186}; }  ///< A result set aside.
inline QColor uniform() { return {200, 112, 0}; }  ///< A control polygon without repeated knots.
inline QColor pen() { return {60, 60, 72, 150}; }  ///< What was drawn by hand.
inline QColor segment() { return {20, 130, 80}; }
inline QColor strokeInk() { return {0, 128, 132}; }    ///< Ink that is traced by its centre line,
inline QColor shapeInk() { return {206, 104, 0}; }     ///< by its outline,
inline QColor pageInk() { return {110, 110, 118}; }    ///< or as the page.
inline QColor invented() { return {190, 0, 140}; }     ///< A stretch of a curve without ink.
inline QColor ruling() { return {70, 150, 210, 70}; }  ///< A printed line that was left out.
inline QColor grid() { return {40, 40, 40, 70}; }

}  // namespace batten::colors
