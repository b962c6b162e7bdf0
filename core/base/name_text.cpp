// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/name_text.h"

#include <algorithm>
#include <optional>

#include "core/base/shown_text.h"

namespace batten {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";
constexpr std::size_t kFormBytes = 4;  // of \xHH

/// The byte of the form that begins the text; nullopt where none does. Bytes below 0x80 are text and have none, but for
/// the backslash.
std::optional<char> byteOfForm(std::string_view text) {
  if (text.size() < kFormBytes || !text.starts_with("\\x")) return std::nullopt;
  const auto high = kDigits.find(text[2]), low = kDigits.find(text[3]);
  if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
  const std::size_t byte = high * kDigits.size() + low;
  if (byte < 0x80 && byte != '\\') return std::nullopt;
  return static_cast<char>(byte);
}

}  // namespace

std::string byteText(char byte) {
  const unsigned value = static_cast<unsigned char>(byte);
  return {'\\', 'x', kDigits[value >> 4], kDigits[value & 15]};
}

std::string nameText(std::string_view name) {
  std::string text;
  while (!name.empty()) {
    const std::size_t length = characterBytes(name);
    if (length == 0 || byteOfForm(name))
      text += byteText(name.front());
    else
      text.append(name.substr(0, length));
    name.remove_prefix(std::max<std::size_t>(1, length));
  }
  return text;
}

std::string nameOfText(std::string_view text) {
  std::string name;
  while (!text.empty()) {
    const auto byte = byteOfForm(text);
    name.push_back(byte.value_or(text.front()));
    text.remove_prefix(byte ? kFormBytes : 1);
  }
  return name;
}

}  // namespace batten
