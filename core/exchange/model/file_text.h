// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/page_frame.h"

namespace batten {

/// Numbers and texts as files hold them, whatever the program's language. Rounded numbers: roundedText().

/// The shortest text that reads back to exactly the same number.
std::string exactNumber(double value);
/// Text for XML: markup escaped; control characters, which XML forbids, become spaces.
std::string xmlText(const std::string& text);
/// A field of a CSV: in quotes where it holds a comma, a quote or a line end.
std::string csvField(const std::string& text);
/// The fields of one line of a CSV, quotes taken off.
std::vector<std::string> csvFields(std::string_view line);
/// A sentence without the full stop behind it, to be set into another one.
std::string withoutFullStop(std::string sentence);
/// Where coordinates are measured from, for the header of a table: the page, or, as imported curves keep the origin of
/// their file and so come to lie where they were, that file.
std::string originOf(const PageFrame&);
/// All numbers of a text; blanks and commas part them.
std::vector<double> numbersIn(std::string_view text);

}  // namespace batten
