// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace batten::cli {

/// A line of JSON as a parser takes it. A byte that is no UTF-8, as other programs leave it in a name, or write it as
/// \udc80 ... \udcff (Python's surrogateescape, PEP 383), becomes the form of nameText.
std::string parsableLine(std::string_view line);

}  // namespace batten::cli
