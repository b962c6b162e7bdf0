// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/document/report_pages/report_content.h"

namespace batten {

/// The report as one page for the browser that needs no other file: the drawing 1:1 when printed at 100 %, figures as
/// inline SVG in mm, the whole recipe below.
std::string reportHtml(const ReportContent&);

}  // namespace batten
