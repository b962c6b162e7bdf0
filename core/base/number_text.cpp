// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace batten {

std::string numberToText(double value) {
  std::array<char, 40> buffer;
  // The shortest form would write 100000 as 1e+05, which is unusual in messages.
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e15);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::general;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
  return {buffer.data(), end};
}

std::string roundedText(double value, int decimals) {
  if (!std::isfinite(value)) return std::isnan(value) ? "no number" : value > 0.0 ? "infinity" : "-infinity";
  std::array<char, 400> buffer;  // the largest double has 309 digits
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals).ptr;
  std::string text(buffer.data(), end);
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string significantText(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return roundedText(value, 0);
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return roundedText(value, std::max(0, digits - 1 - magnitude));
}

std::string percentText(double share) {
  constexpr double kOneDecimalBelow = 0.01, kLeastSaid = 0.001;
  if (share > 0.0 && share < kLeastSaid) return "less than " + roundedText(100.0 * kLeastSaid, 1);
  return roundedText(100.0 * share, share < kOneDecimalBelow ? 1 : 0);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string counted(int count, std::string_view one, std::string_view many) {
  return std::to_string(count).append(" ").append(count == 1 ? one : many);
}

namespace {

template <class T>
std::optional<T> wholeText(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars takes no plus sign
  T value{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> numberFromText(std::string_view text) {
  const auto value = wholeText<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> integerFromText(std::string_view text) { return wholeText<int>(text); }

}  // namespace batten
