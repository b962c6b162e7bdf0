// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace batten::test {

/// One row of the table of arrows in ARCHITECTURE.md.
struct Room {
  std::set<std::string> rooms;      ///< Other rooms it may include, full names: "core/contour/outline".
  std::set<std::string> ownArrows;  ///< Those that its own row names; "core" as it stands there.
  std::set<std::string> libraries;  ///< Third-party families it may include at all.
  std::set<std::string> inHeaders;  ///< Those that may show in headers that other rooms include.
};
/// By name. "core/contour/contour_set" may stand for the files of that name.
using ArrowTable = std::map<std::string, Room>;

/// The rows of the table below "## Folders and arrows". A name without core/, ui/ or app/ is relative to the library of
/// its row; "core" stands for every folder directly below core/. What a library's row allows, its rooms may do too,
/// but for its own rooms. Empty if there is no such table.
ArrowTable readArrowTable(const std::filesystem::path& markdown);

/// "core/contour" of "core/contour/outline/soft_edges.h"; "ui" of a file directly in ui/.
std::string libraryRoomOf(const std::string& path);
/// The room of a file (path without its ending): the longest name that is the file itself or one of its folders.
std::string roomOf(const ArrowTable& table, const std::string& path);

}  // namespace batten::test
