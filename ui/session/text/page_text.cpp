// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/text/page_text.h"

#include <cmath>

namespace batten {

QString resolutionText(double dpi) {
  constexpr double kWhole = 0.05;  // what one decimal does not show
  return QString::number(dpi, 'f', std::abs(dpi - std::round(dpi)) < kWhole ? 0 : 1);
}

QString pageSizeText(const PageFrame& frame) {
  return QStringLiteral("%1 × %2 mm")
      .arg(frame.lengthToModel(frame.widthPx), 0, 'f', 1)
      .arg(frame.lengthToModel(frame.heightPx), 0, 'f', 1);
}

}  // namespace batten
