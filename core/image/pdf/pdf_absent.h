// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// What a build without Poppler compiles in place of pdf_page.cpp: hasPdf() is false.
inline constexpr const char* kPdfPackage = "libpoppler-qt6-dev";

}  // namespace batten
