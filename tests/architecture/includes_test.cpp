// SPDX-License-Identifier: GPL-3.0-or-later
// The house's rules about what may include what. Folder names alone keep no rule.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "core/pipeline/parameter_table.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = BATTEN_SOURCE_DIR;

struct Rule {
  std::set<std::string> folders;    ///< Project folders it may include, beside itself.
  std::set<std::string> libraries;  ///< Third-party families it may include at all.
  std::set<std::string> inHeaders;  ///< Those that may show in its headers too.
};

/// The allowed arrows. "qt-core", "qt-gui" and "qt-widgets" grow into each other in that order.
const std::map<std::string, Rule>& rules() {
  static const std::set<std::string> core = {"core/base",     "core/solve",     "core/image",   "core/contour",
                                             "core/curve",    "core/construct", "core/fairing", "core/pipeline",
                                             "core/exchange", "core/document"};
  static const auto with = [](std::set<std::string> folders, std::initializer_list<const char*> more) {
    for (const char* folder : more) folders.insert(folder);
    return folders;
  };
  static const std::set<std::string> window = {"qt-core", "qt-gui", "qt-widgets"};
  static const std::map<std::string, Rule> table = {
      {"core/base", {{}, {"eigen", "expected", "openssl"}, {"eigen", "expected"}}},
      {"core/image", {{"core/base"}, {"eigen", "expected", "opencv"}, {"eigen", "expected"}}},
      {"core/contour", {{"core/base", "core/image"}, {"eigen", "expected", "opencv"}, {"eigen", "expected"}}},
      {"core/curve", {{"core/base"}, {"eigen", "expected"}, {"eigen", "expected"}}},
      {"core/solve", {{"core/base"}, {"eigen"}, {"eigen"}}},
      {"core/construct",
       {{"core/base", "core/solve", "core/contour", "core/curve"}, {"eigen", "expected"}, {"eigen", "expected"}}},
      {"core/fairing", {{"core/base", "core/solve", "core/curve"}, {"eigen", "expected"}, {"eigen", "expected"}}},
      {"core/pipeline",
       {{"core/base", "core/solve", "core/image", "core/contour", "core/curve", "core/construct", "core/fairing"},
        {"eigen", "expected", "json"},
        {"eigen", "expected"}}},
      {"core/exchange",
       {{"core/base", "core/curve"}, {"eigen", "expected", "json", "qt-core", "qt-gui"}, {"eigen", "expected"}}},
      {"core/document",
       {{"core/base", "core/solve", "core/image", "core/contour", "core/curve", "core/construct", "core/fairing",
         "core/pipeline", "core/exchange"},
        {"eigen", "expected", "json", "qt-core"},
        {"eigen", "expected"}}},
      {"app/cli",
       {core,
        {"eigen", "expected", "json", "cli11", "qt-core", "qt-gui"},
        {"eigen", "expected", "json", "cli11", "qt-core"}}},
      {"ui/session", {core, {"eigen", "expected", "qt-core", "qt-gui"}, {"eigen", "expected", "qt-core", "qt-gui"}}},
      {"ui/theme", {{}, window, window}},
      {"ui/commands", {with(core, {"ui/session"}), window, window}},
      {"ui/canvas",
       {with(core, {"ui/session", "ui/commands", "ui/theme"}), with(window, {"eigen", "expected"}),
        with(window, {"eigen", "expected"})}},
      {"ui/panels",
       {with(core, {"ui/session", "ui/commands", "ui/theme"}), with(window, {"eigen", "expected"}),
        with(window, {"eigen", "expected"})}},
      {"ui/plots",
       {with(core, {"ui/session", "ui/theme"}), with(window, {"eigen", "expected", "qcustomplot"}),
        with(window, {"eigen", "expected"})}},
      {"ui",
       {with(core, {"ui/session", "ui/commands", "ui/canvas", "ui/panels", "ui/plots", "ui/theme"}),
        with(window, {"expected"}), with(window, {"expected"})}},
      {"app/gui", {with(core, {"ui", "ui/session"}), window, window}},
  };
  return table;
}

/// "core/image" for core/image/scan.h; deeper folders belong to their second level; files directly in ui are "ui".
std::string folderOf(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto& part : fs::path(path)) parts.push_back(part.string());
  if (parts.size() < 2) return "";
  return parts.size() == 2 ? parts[0] : parts[0] + "/" + parts[1];
}

/// The family a header belongs to: empty for the standard library and the system, "unknown" for what no rule names.
std::string libraryOf(const std::string& header) {
  static const std::set<std::string> widgets = {"QApplication", "QMainWindow", "QDialog", "QMessageBox",
                                                "QFileDialog",  "QLabel",      "QMenu",   "QToolTip"};
  static const std::set<std::string> gui = {"QUndoStack",   "QUndoCommand", "QImage",         "QImageReader",
                                            "QImageWriter", "QColor",       "QPainter",       "QPainterPath",
                                            "QPixmap",      "QFont",        "QFontMetricsF",  "QKeySequence",
                                            "QTransform",   "QPolygonF",    "QGuiApplication"};
  if (header.starts_with("opencv2/")) return "opencv";
  if (header.starts_with("Eigen/")) return "eigen";
  if (header.starts_with("tl/")) return "expected";
  if (header.starts_with("openssl/")) return "openssl";
  if (header.starts_with("nlohmann/")) return "json";
  if (header.starts_with("CLI/")) return "cli11";
  if (header == "qcustomplot.h") return "qcustomplot";
  if (widgets.contains(header) || header.find("Widget") != std::string::npos || header.starts_with("QtWidgets"))
    return "qt-widgets";
  if (gui.contains(header) || header.starts_with("QtGui")) return "qt-gui";
  if (header.size() > 1 && header[0] == 'Q' &&
      (std::isupper(static_cast<unsigned char>(header[1])) != 0 || header[1] == 't'))
    return "qt-core";
  if (header.starts_with("sys/") || header == "unistd.h" || header == "fcntl.h") return "";  // the system
  const bool isStandard = std::all_of(header.begin(), header.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_';
  });
  return isStandard ? "" : "unknown";
}

std::vector<fs::path> sources() {
  std::vector<fs::path> files;
  for (const char* top : {"core", "ui", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string slurp(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> includesOf(const std::string& text) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^">]+)[">])re", std::regex::multiline);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

/// The folders of the first cycle found, by depth-first search; empty if there is none.
std::string cycleFrom(const std::string& folder, const std::map<std::string, std::set<std::string>>& arrows,
                      std::vector<std::string>& way, std::set<std::string>& done) {
  if (const auto seen = std::find(way.begin(), way.end(), folder); seen != way.end()) {
    std::string cycle;
    for (auto it = seen; it != way.end(); ++it) cycle += *it + " ";
    return cycle + folder;
  }
  if (!arrows.contains(folder) || !done.insert(folder).second) return "";
  way.push_back(folder);
  for (const std::string& target : arrows.at(folder)) {
    if (const std::string cycle = cycleFrom(target, arrows, way, done); !cycle.empty()) return cycle;
  }
  way.pop_back();
  return "";
}

std::string cycleIn(const std::map<std::string, std::set<std::string>>& arrows) {
  std::set<std::string> done;
  for (const auto& [folder, targets] : arrows) {
    std::vector<std::string> way;
    if (const std::string cycle = cycleFrom(folder, arrows, way, done); !cycle.empty()) return cycle;
  }
  return "";
}

/// A widget-level Qt class is allowed wherever "qt-widgets" is, and so on down.
bool allows(const std::set<std::string>& libraries, const std::string& library) {
  if (libraries.contains(library)) return true;
  if (library == "qt-core") return libraries.contains("qt-gui") || libraries.contains("qt-widgets");
  return library == "qt-gui" && libraries.contains("qt-widgets");
}

/// The headers that another folder than their own includes.
std::set<std::string> headersForOthers() {
  std::set<std::string> shown;
  for (const fs::path& file : sources()) {
    const std::string folder = folderOf(fs::relative(file, kRoot).generic_string());
    for (const std::string& header : includesOf(slurp(file)))
      if (folderOf(header) != folder) shown.insert(header);
  }
  return shown;
}

}  // namespace

TEST(Architecture, EveryFolderHasARule) {
  for (const fs::path& file : sources()) {
    const std::string folder = folderOf(fs::relative(file, kRoot).generic_string());
    EXPECT_TRUE(rules().contains(folder)) << file << " lies in " << folder << ", for which no arrow is stated";
  }
}

TEST(Architecture, FoldersIncludeOnlyWhatTheirArrowsAllow) {
  const std::set<std::string> shown = headersForOthers();
  for (const fs::path& file : sources()) {
    const std::string relative = fs::relative(file, kRoot).generic_string(), folder = folderOf(relative);
    if (!rules().contains(folder)) continue;
    const Rule& rule = rules().at(folder);
    for (const std::string& header : includesOf(slurp(file))) {
      if (header.starts_with("core/") || header.starts_with("ui/") || header.starts_with("app/")) {
        const std::string target = folderOf(header);
        EXPECT_TRUE(target == folder || rule.folders.contains(target)) << relative << " includes " << header;
      } else if (const std::string library = libraryOf(header); !library.empty()) {
        ASSERT_NE(library, "unknown") << relative << " includes <" << header << ">, for which no rule is stated";
        EXPECT_TRUE(allows(rule.libraries, library)) << relative << " includes <" << header << "> (" << library << ")";
        if (file.extension() == ".h") {
          const bool staysHere = library == "qcustomplot" && !shown.contains(relative);
          EXPECT_TRUE(staysHere || allows(rule.inHeaders, library))
              << relative << " shows <" << header << "> to whoever includes it";
        }
      }
    }
  }
}

TEST(Architecture, AHeaderIsTheFirstIncludeOfItsSource) {
  // So every such header is compiled with nothing before it; headers without a source are compiled on their own.
  int pairs = 0;
  for (const fs::path& file : sources()) {
    if (file.extension() != ".cpp") continue;
    const fs::path header = fs::path(file).replace_extension(".h");
    if (!fs::exists(header)) continue;
    const auto includes = includesOf(slurp(file));
    ASSERT_FALSE(includes.empty()) << file;
    EXPECT_EQ(includes.front(), fs::relative(header, kRoot).generic_string()) << file;
    ++pairs;
  }
  EXPECT_GT(pairs, 50);
}

TEST(Architecture, FoldersHaveNoCycle) {
  std::map<std::string, std::set<std::string>> arrows;
  for (const auto& [folder, rule] : rules()) arrows[folder] = rule.folders;
  EXPECT_EQ(cycleIn(arrows), "");
}

TEST(Architecture, ACycleOfAnyLengthIsFound) {
  EXPECT_EQ(cycleIn({{"a", {"b", "c"}}, {"b", {"c", "d"}}, {"c", {"d"}}, {"d", {}}}), "");
  EXPECT_EQ(cycleIn({{"a", {"b"}}, {"b", {"a"}}}), "a b a");
  EXPECT_EQ(cycleIn({{"a", {"b"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}}), "b c d b");
}

TEST(Architecture, EveryHeaderBelongsToSomeone) {
  EXPECT_EQ(libraryOf("boost/version.hpp"), "unknown");
  EXPECT_EQ(libraryOf("zlib.h"), "unknown");
  EXPECT_EQ(libraryOf("format"), "");
  EXPECT_EQ(libraryOf("QVariantAnimation"), "qt-core");
}

TEST(Architecture, NoUmbrellaHeadersAndNoOutputFromTheEngine) {
  static const std::regex umbrella(R"(#include <Qt(Core|Gui|Widgets)>)");
  static const std::regex output(R"(\b(std::cout|std::cerr|qDebug|printf|puts)\b\s*[(<])");
  for (const fs::path& file : sources()) {
    const std::string text = slurp(file), relative = fs::relative(file, kRoot).generic_string();
    EXPECT_FALSE(std::regex_search(text, umbrella)) << relative;
    if (relative.starts_with("core/")) {
      EXPECT_FALSE(std::regex_search(text, output)) << relative << " prints";
    }
  }
}

TEST(Architecture, EverySourceNamesItsLicence) {
  for (const fs::path& file : sources())
    EXPECT_TRUE(slurp(file).starts_with("// SPDX-License-Identifier: GPL-3.0-or-later")) << file;
}

TEST(Architecture, NothingStandsAtTheTopThatDoesNotBelongThere) {
  static const std::set<std::string> allowed = {"CMakeLists.txt",
                                                "CMakePresets.json",
                                                "README.md",
                                                "ARCHITECTURE.md",
                                                "CONTRIBUTING.md",
                                                "LICENSE",
                                                "app",
                                                "core",
                                                "ui",
                                                "resources",
                                                "tests",
                                                "packaging",
                                                "build",
                                                "out"};  // the last two are made, and in no commit
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name.front() == '.' || allowed.contains(name)) << name;
  }
}

TEST(Architecture, NoUnitTestIsLeftOutOfTheBuild) {
  // tests/CMakeLists.txt takes unit/<folder>/*.cpp of the folders it lists; anything else would silently not run.
  const std::set<std::string> listed = {"base",      "solve",   "image",    "contour",  "curve",
                                        "construct", "fairing", "pipeline", "exchange", "document"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests" / "unit")) {
    if (entry.path().extension() != ".cpp") continue;
    const fs::path inner = fs::relative(entry.path(), kRoot / "tests" / "unit");
    EXPECT_TRUE(std::distance(inner.begin(), inner.end()) == 2 && listed.contains(inner.begin()->string())) << inner;
  }
}

TEST(Architecture, EveryParameterThatATextNamesExists) {
  std::string stages;
  for (const batten::Parameter& p : batten::parameterTable()) {
    const std::string stage = p.name.substr(0, p.name.find('.'));
    if (("|" + stages + "|").find("|" + stage + "|") == std::string::npos)
      stages += (stages.empty() ? "" : "|") + stage;
  }
  // Names in the literals of the programs; in the window those beside other words, as a lone word names a widget.
  const std::regex literal(R"re("((?:[^"\\\n]|\\.)*)")re"), named("\\b(?:" + stages + ")\\.[a-z][a-z0-9_]*");
  const std::regex include("#include[^\n]*");
  int found = 0;
  const auto check = [&](const std::string& text, const std::string& where) {
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it, ++found)
      EXPECT_NE(batten::findParameter(it->str()), nullptr) << where << " names " << it->str() << ": " << text;
  };
  for (const fs::path& file : sources()) {
    const std::string text = std::regex_replace(slurp(file), include, ""),
                      relative = fs::relative(file, kRoot).generic_string();
    for (std::sregex_iterator it(text.begin(), text.end(), literal), end; it != end; ++it) {
      const std::string words = (*it)[1];
      if (relative.starts_with("ui/") && words.find(' ') == std::string::npos) continue;
      check(words, relative);
    }
  }
  EXPECT_GT(found, 60);
}

TEST(Architecture, NoLineOfTheProgramsIsLongerThanTheFormatAllows) {
  for (const fs::path& file : sources()) {
    const std::string relative = fs::relative(file, kRoot).generic_string();
    std::ifstream in(file);
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      // Bytes that continue a UTF-8 character take no place.
      const auto shown = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LE(shown, 120) << relative << ":" << number;
    }
  }
}
