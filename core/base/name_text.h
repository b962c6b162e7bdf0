// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace batten {

/// Names of files are bytes, and JSON is text. In the text of a name a byte that is no UTF-8 stands as \x and its two
/// hexadecimal digits, "Entw\xfcrfe", and a backslash that is followed by such digits already as \x5c. Everything else
/// stands as it is. Names that differ have texts that differ.
std::string nameText(std::string_view name);

/// The name whose text this is.
std::string nameOfText(std::string_view text);

/// The form of one byte: "\xfc".
std::string byteText(char byte);

}  // namespace batten
