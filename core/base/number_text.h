// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace batten {

/// The shortest text that reads back to exactly the same number; C locale whatever the program's locale is.
std::string numberToText(double value);
/// A whole text as a finite number, C locale, blanks at the ends allowed; nullopt for anything else.
std::optional<double> numberFromText(std::string_view text);
/// Same for whole numbers.
std::optional<int> integerFromText(std::string_view text);
/// Without blanks at the ends.
std::string_view trimmed(std::string_view text);

}  // namespace batten
