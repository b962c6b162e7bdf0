// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrow_table.h"

#include <fstream>
#include <sstream>
#include <vector>

namespace batten::test {
namespace {

std::vector<std::string> cellsOf(const std::string& row) {
  std::vector<std::string> cells;
  std::stringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
  return cells;
}

std::vector<std::string> wordsOf(const std::string& cell) {
  std::vector<std::string> words;
  std::stringstream stream(cell);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool isFullName(const std::string& name) {
  return name.starts_with("core/") || name.starts_with("ui/") || name.starts_with("app/") || name == "core" ||
         name == "ui";
}

/// "eigen expected (json qt-core)": those in brackets stay out of headers.
void readLibraries(const std::string& cell, Room& room) {
  bool hidden = false;
  for (std::string word : wordsOf(cell)) {
    if (word.front() == '(') hidden = true, word.erase(0, 1);
    const bool closes = !word.empty() && word.back() == ')';
    if (closes) word.pop_back();
    room.libraries.insert(word);
    if (!hidden) room.inHeaders.insert(word);
    if (closes) hidden = false;
  }
}

/// "core" in a row means each library of core; a room may do what its library may, but for the library's own rooms.
void complete(ArrowTable& table) {
  std::set<std::string> core;
  for (const auto& [name, room] : table)
    if (name.starts_with("core/") && libraryRoomOf(name + "/x.h") == name) core.insert(name);
  for (auto& [name, room] : table)
    if (room.rooms.erase("core") > 0) room.rooms.insert(core.begin(), core.end());
  for (auto& [name, room] : table) {
    const std::string library = libraryRoomOf(name + "/x.h");
    if (library == name || !table.contains(library)) continue;
    for (const std::string& other : table.at(library).rooms)
      if (!other.starts_with(library + "/")) room.rooms.insert(other);
    room.libraries.insert(table.at(library).libraries.begin(), table.at(library).libraries.end());
    room.inHeaders.insert(table.at(library).inHeaders.begin(), table.at(library).inHeaders.end());
  }
}

}  // namespace

std::string libraryRoomOf(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto& part : std::filesystem::path(path)) parts.push_back(part.string());
  if (parts.size() < 2) return "";
  return parts.size() == 2 ? parts[0] : parts[0] + "/" + parts[1];
}

std::string roomOf(const ArrowTable& table, const std::string& path) {
  std::string name = std::filesystem::path(path).replace_extension().generic_string();
  while (!name.empty() && !table.contains(name)) {
    const std::size_t slash = name.rfind('/');
    name = slash == std::string::npos ? "" : name.substr(0, slash);
  }
  return name;
}

ArrowTable readArrowTable(const std::filesystem::path& markdown) {
  ArrowTable table;
  std::ifstream in(markdown);
  bool inTable = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) inTable = line == "## Folders and arrows";
    if (!inTable || !line.starts_with("| `")) continue;
    const std::vector<std::string> cells = cellsOf(line);
    const std::string name = cells.at(0).substr(2, cells.at(0).rfind('`') - 2);
    Room& room = table[name];
    for (const std::string& word : wordsOf(cells.at(2)))
      room.rooms.insert(isFullName(word) ? word : libraryRoomOf(name + "/x.h") + "/" + word);
    room.ownArrows = room.rooms;
    readLibraries(cells.at(3), room);
  }
  complete(table);
  return table;
}

}  // namespace batten::test
