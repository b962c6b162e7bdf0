// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/render_page.h"

namespace batten::test {

inline constexpr int kEllipseWidth = 400, kEllipseHeight = 300;

/// One filled ellipse.
inline const Scan& ellipseScan() {
  static const Scan scan = [] {
    const auto shape = truthShape("ellipse", kEllipseWidth, kEllipseHeight);
    return renderPage(fillCoverage(shape.outline(), kEllipseWidth, kEllipseHeight), kEllipseWidth, kEllipseHeight,
                      cleanPage());
  }();
  return scan;
}

}  // namespace batten::test
