// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/base/page_frame.h"

namespace batten {

/// A resolution as the window writes it: "300", "299.7". [dpi]
QString resolutionText(double dpi);
/// The size of a page as the window writes it: "210.0 × 297.0 mm".
QString pageSizeText(const PageFrame&);

}  // namespace batten
