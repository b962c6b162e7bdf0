// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/page_frame.h"
#include "core/document/report_values.h"

namespace batten {

/// What the report says of one line. @param index from 0.
ReportJson contourToJson(const Contour& contour, std::ptrdiff_t index, const PageFrame& frame);

}  // namespace batten
