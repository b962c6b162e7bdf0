// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a library are compiled in groups, so that a name of one file is seen in others. Two things of one name go
// unnoticed until they meet in a group; a constant then takes the place of the other without an error.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "arrow_table.h"

namespace {

using namespace batten;
const std::filesystem::path kSources = BATTEN_SOURCE_DIR;

/// Constants, structs and classes that a file defines outside all functions and classes: their lines are not indented.
std::set<std::string> namesDefinedIn(const std::string& text) {
  static const std::regex constants(
      R"re(^(?:inline )?(?:static )?(?:constexpr|const) (?!char\*)[^(\n]*?\bk[A-Z][^;]*)re", std::regex::multiline);
  static const std::regex constant(R"re(\b(k[A-Z]\w*)(?:\[\w*\])?\s*(?:=|\{))re");
  static const std::regex type(R"re(^(?:struct|class) (\w+)(?: final)?(?: : [^\n{]*)? \{)re", std::regex::multiline);
  std::set<std::string> names;
  for (std::sregex_iterator line(text.begin(), text.end(), constants), end; line != end; ++line) {
    const std::string definition = line->str();
    for (std::sregex_iterator it(definition.begin(), definition.end(), constant); it != end; ++it)
      names.insert((*it)[1]);
  }
  for (std::sregex_iterator it(text.begin(), text.end(), type), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

TEST(Names, OfConstantsAndTypesAreFound) {
  const auto names = namesDefinedIn(
      "constexpr double kOne = 1.0, kTwo = 2.0;  // [px]\n"
      "inline constexpr std::array<int, 2> kThree = {1,\n  2};\n"
      "struct Four {\n  static constexpr int kInside = 3;\n};\nclass Declared;\n");
  EXPECT_EQ(names, (std::set<std::string>{"kOne", "kTwo", "kThree", "Four"}));
}

TEST(Names, OfALibraryStandForOneThing) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> filesOf;  // by library and name
  for (const char* top : {"core", "ui", "app"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kSources / top)) {
      const std::filesystem::path& file = entry.path();
      if (file.extension() != ".h" && file.extension() != ".cpp") continue;
      if (file.filename() == "platform_windows.cpp") continue;  // stands for platform.cpp on another system
      std::ifstream in(file);
      const std::string text{std::istreambuf_iterator<char>(in), {}},
          path = std::filesystem::relative(file, kSources).generic_string();
      for (const std::string& name : namesDefinedIn(text)) filesOf[test::libraryRoomOf(path)][name].insert(path);
    }
  }
  ASSERT_GT(filesOf.size(), 10u);
  for (const auto& [library, names] : filesOf) {
    for (const auto& [name, files] : names) {
      std::string list;
      for (const std::string& file : files) list += " " + file;
      EXPECT_EQ(files.size(), 1u) << name << " is defined in" << list;
    }
  }
}

}  // namespace
