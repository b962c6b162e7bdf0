// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// One cubic Bézier; lines and arcs are given as cubics too.
struct SvgCubic {
  Vec2 p[4];
  Vec2 at(double t) const;
  Vec2 derivative(double t) const;
  Vec2 second(double t) const;
};

/// One subpath, all transforms applied, in px of the picture that the file describes (y down).
struct SvgPath {
  std::string group;  ///< Id of the innermost group that has one.
  std::vector<SvgCubic> segments;
  bool closed = false;
};

/// Reads what vector tracers write and drawings hold: groups, transforms, `path` elements with all commands but smooth
/// quadratics. Lengths with units count as px of 96 dpi (pt: 4/3). Unknown elements are passed over.
std::vector<SvgPath> readSvgPaths(const std::string& text);

/// Width of the picture in px; 0 if the file does not say.
double svgWidthPx(const std::string& text);

}  // namespace batten::test
