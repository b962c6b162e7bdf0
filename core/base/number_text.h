// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace batten {

/// The shortest text that reads back to exactly the same number; C locale whatever the program's locale is.
std::string numberToText(double value);
/// A number for a message or a file: rounded to so many digits behind the point, without zeros that end it, never an
/// exponent nor a minus zero; C locale. "7", "0.25".
std::string roundedText(double value, int decimals);
/// The same, rounded to so many digits that count: "0.00123", "9.36", "1200".
std::string significantText(double value, int digits);
/// A share 0..1 for a message, in percent: "12"; below one percent "0.6"; no share above 0 reads "0": "less than 0.1".
std::string percentText(double share);
/// "1 line was", "4 lines were".
std::string counted(int count, std::string_view one, std::string_view many);
/// A whole text as a finite number, C locale, blanks at the ends allowed; nullopt for anything else.
std::optional<double> numberFromText(std::string_view text);
/// Same for whole numbers.
std::optional<int> integerFromText(std::string_view text);
/// Without blanks at the ends.
std::string_view trimmed(std::string_view text);

}  // namespace batten
