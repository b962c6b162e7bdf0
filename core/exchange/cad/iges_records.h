// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace batten {

/// A file of IGES, taken apart into what its sections hold.
struct IgesDirectoryEntry {
  int type = 0, form = 0;                     ///< Numbers of the kind of entity, as IGES has them.
  int parameterLine = 0, parameterLines = 0;  ///< Where its data begin, counted from 1, and how many lines they take.
  std::optional<int> matrix;                  ///< Directory line of its transformation.
  int level = 0;                              ///< Layer; negative: a list of several.
  int status = 0;                             ///< Eight digits: blank, subordinate, use, hierarchy.
  std::string label;
  std::size_t line = 0;  ///< In the file, from 1, for messages.
};
struct IgesRecords {
  std::vector<std::string> global;          ///< The parameters of the global section, from its third on ….
  std::vector<IgesDirectoryEntry> entries;  ///< Entry i stands at directory line 2 i + 1.
  std::vector<std::string_view> data;       ///< Lines of the parameter section, their data alone.
  char delimiter = ',', end = ';';
};

/// @return BadParameter with the line if a section is missing or is invalid.
Result<IgesRecords> readIgesRecords(std::string_view text);

/// The parameters of an entry, the number of its type first. Reads at most `charactersLeft` characters and takes them
/// off it.
/// @return BadParameter if its lines are not there, or the characters do not suffice.
Result<std::vector<std::string>> parametersOf(const IgesRecords&, const IgesDirectoryEntry&,
                                              std::size_t& charactersLeft);

/// A number as IGES writes it: "1.5D+02" as well as "150."; a field left empty is 0. nullopt for anything else.
std::optional<double> igesNumber(std::string_view field);

/// BadParameter: what is wrong, and in which line of the file, counted from 1.
tl::unexpected<Error> igesDamaged(std::size_t line, const std::string& what);

}  // namespace batten
