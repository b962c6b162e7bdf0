// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace batten::cli {

/// Of one kind at most so many are named; a page may have a hundred thousand marks.
inline constexpr std::size_t kMostNamed = 12;

/// How many of `count` are named before "and N more": all, or one less than the most.
inline std::size_t namedOf(std::size_t count) { return count <= kMostNamed ? count : kMostNamed - 1; }

/// Adds one note for each of `things`, but of many only the first, and how many more there are: noteOf(thing) and
/// moreOf("99989").
template <typename Things, typename NoteOf, typename MoreOf>
void addNotes(std::vector<std::string>& list, const Things& things, NoteOf noteOf, MoreOf moreOf) {
  const std::size_t named = namedOf(things.size());
  std::size_t done = 0;
  for (const auto& thing : things) {
    if (done++ == named) break;
    list.push_back(noteOf(thing));
  }
  if (named < things.size()) list.push_back(moreOf(std::to_string(things.size() - named)));
}

}  // namespace batten::cli
