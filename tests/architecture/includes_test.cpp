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
#include <utility>
#include <vector>

#include "arrow_table.h"
#include "core/pipeline/recipe/parameter_table.h"

namespace {

using namespace batten;
namespace fs = std::filesystem;
const fs::path kRoot = BATTEN_SOURCE_DIR;
/// Another system's side of platform.h and platform_memory.h.
constexpr const char* kWindows = "core/base/platform_windows.cpp";
const std::set<std::string> kCallsTheSystem = {"core/base/platform.cpp", "core/base/platform_memory.cpp", kWindows};
/// Sources without a header of their name: members of one class that are too many for one file, and its header.
const std::map<std::string, std::string> kMembersOf = {
    {"ui/main_window_actions.cpp", "ui/main_window_parts.h"},
    {"ui/main_window_files.cpp", "ui/main_window_parts.h"},
    {"ui/main_window_lower.cpp", "ui/main_window_parts.h"},
    {"ui/main_window_recent.cpp", "ui/main_window_parts.h"},
    {"ui/main_window_settings.cpp", "ui/main_window_parts.h"},
    {"ui/panels/targets/target_tile_words.cpp", "ui/panels/targets/target_tile.h"},
    {"ui/session/session_runner_pages.cpp", "ui/session/session_runner.h"},
};

const test::ArrowTable& rooms() {
  static const test::ArrowTable table = test::readArrowTable(kRoot / "ARCHITECTURE.md");
  return table;
}

/// Headers of POSIX and of Windows. Any other name with an ending that no rule states is "unknown" and refused.
bool isOfTheSystem(const std::string& header) {
  static const std::set<std::string> names = {"unistd.h", "dlfcn.h",   "fcntl.h", "malloc.h",
                                              "io.h",     "windows.h", "psapi.h"};
  return header.starts_with("sys/") || names.contains(header);
}

/// Something in the text that only one system has, though no header of its own is included for it: a call, a signal
/// that is not of standard C, a path, or a question which system it is. Empty if there is nothing.
std::string systemWordIn(const std::string& text) {
  static const std::regex words(
      R"re((?:^|[^\w:>.])::(?:open|read|write|close|stat|lstat|fstat|unlink|rename|fork|exec\w+|kill|pipe|dup2?|mmap|flock)\()re"
      R"re(|\b(?:isatty|fileno|getpid|geteuid|sysconf|getrusage|fdatasync|fsync|popen|setenv|sigaction|dlopen|nanosleep)\s*\()re"
      R"re(|(?:^|[^\w.>:])kill\(|\b(?:pid_t|mode_t|ssize_t|off_t)\b|\bSIG(?!INT\b|TERM\b|ABRT\b|SEGV\b|FPE\b|ILL\b|_)[A-Z0-9]+\b|"/(?:proc|dev|sys|tmp)/)re"
      R"re(|\b(?:_WIN32|_MSC_VER|__linux__|__unix__|__APPLE__|Q_OS_\w+)\b)re");
  std::smatch found;
  return std::regex_search(text, found, words) ? found.str() : "";
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
  if (header == "png.h" || header == "turbojpeg.h") return "pictures";
  if (header.starts_with("Eigen/")) return "eigen";
  if (header.starts_with("tl/")) return "expected";
  if (header.starts_with("openssl/")) return "openssl";
  if (header == "immintrin.h") return "intrinsics";
  if (header.starts_with("nlohmann/")) return "json";
  if (header.starts_with("CLI/")) return "cli11";
  if (header == "qcustomplot.h") return "qcustomplot";
  if (header.starts_with("dxflib/")) return "dxflib";
  if (header.ends_with(".hxx")) return "occt";
  if (header.starts_with("poppler")) return "poppler";
  if (widgets.contains(header) || header.find("Widget") != std::string::npos || header.starts_with("QtWidgets"))
    return "qt-widgets";
  if (gui.contains(header) || header.starts_with("QtGui")) return "qt-gui";
  if (header.size() > 1 && header[0] == 'Q' &&
      (std::isupper(static_cast<unsigned char>(header[1])) != 0 || header[1] == 't'))
    return "qt-core";
  if (isOfTheSystem(header)) return "";
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

std::string pathOf(const fs::path& file) { return fs::relative(file, kRoot).generic_string(); }

/// The headers that another room than their own includes.
std::set<std::string> headersForOthers() {
  std::set<std::string> shown;
  for (const fs::path& file : sources()) {
    const std::string room = test::roomOf(rooms(), pathOf(file));
    for (const std::string& header : includesOf(slurp(file)))
      if (test::roomOf(rooms(), header) != room) shown.insert(header);
  }
  return shown;
}

}  // namespace

TEST(Architecture, EveryFileHasARoom) {
  ASSERT_GT(rooms().size(), 40u) << "the table of arrows in ARCHITECTURE.md is not found";
  for (const fs::path& file : sources())
    EXPECT_NE(test::roomOf(rooms(), pathOf(file)), "") << file << " lies in no row of the table of arrows";
}

TEST(Architecture, EveryRoomHoldsAFile) {
  std::set<std::string> used;
  for (const fs::path& file : sources()) {
    used.insert(test::roomOf(rooms(), pathOf(file)));
    used.insert(test::libraryRoomOf(pathOf(file)));  // a library may hold nothing but rooms
  }
  for (const auto& [name, room] : rooms()) {
    EXPECT_TRUE(used.contains(name)) << name << " is empty";
    for (const std::string& other : room.rooms) EXPECT_TRUE(rooms().contains(other)) << name << " names " << other;
  }
}

TEST(Architecture, EveryFolderBelowALibraryIsARoom) {
  for (const fs::path& file : sources()) {
    const std::string folder = fs::path(pathOf(file)).parent_path().generic_string();
    EXPECT_TRUE(rooms().contains(folder)) << folder << " has no row of its own";
  }
}

TEST(Architecture, RoomsIncludeOnlyWhatTheirArrowsAllow) {
  const std::set<std::string> shown = headersForOthers();
  for (const fs::path& file : sources()) {
    const std::string relative = pathOf(file), name = test::roomOf(rooms(), relative);
    if (!rooms().contains(name)) continue;
    const test::Room& room = rooms().at(name);
    for (const std::string& header : includesOf(slurp(file))) {
      if (header.starts_with("core/") || header.starts_with("ui/") || header.starts_with("app/")) {
        const std::string target = test::roomOf(rooms(), header);
        // Rooms of another library are reached through that library.
        const std::string library = test::libraryRoomOf(header);
        const bool sameLibrary = library == test::libraryRoomOf(relative);
        EXPECT_TRUE(target == name || room.rooms.contains(target) || (!sameLibrary && room.rooms.contains(library)))
            << relative << " includes " << header;
      } else if (const std::string library = libraryOf(header); !library.empty()) {
        ASSERT_NE(library, "unknown") << relative << " includes <" << header << ">, for which no rule is stated";
        EXPECT_TRUE(allows(room.libraries, library)) << relative << " includes <" << header << "> (" << library << ")";
        if (file.extension() == ".h" && shown.contains(relative)) {
          EXPECT_TRUE(allows(room.inHeaders, library))
              << relative << " shows <" << header << "> to whoever includes it";
        }
      }
    }
  }
}

TEST(Architecture, NoArrowIsUnused) {
  std::set<std::pair<std::string, std::string>> used;  // from a room, and from its library, to a room and its library
  for (const fs::path& file : sources()) {
    const std::string relative = pathOf(file);
    for (const std::string& header : includesOf(slurp(file))) {
      const std::string target = test::roomOf(rooms(), header), library = test::libraryRoomOf(header);
      for (const std::string& from : {test::roomOf(rooms(), relative), test::libraryRoomOf(relative)})
        for (const std::string& to : {target, library}) used.emplace(from, to);
    }
  }
  for (const auto& [name, room] : rooms())
    for (const std::string& arrow : room.ownArrows)
      if (arrow != "core") {
        EXPECT_TRUE(used.contains({name, arrow})) << name << " includes nothing of " << arrow;
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

TEST(Architecture, ASourceHasTheHeaderOfItsName) {
  // What a source file offers stands where its name says, and not in the header of a neighbour.
  for (const fs::path& file : sources()) {
    const std::string path = pathOf(file);
    if (file.extension() != ".cpp" || path == kWindows) continue;
    if (file.filename() == "main.cpp") continue;  // of a program: offers nothing
    const bool hasHeader = fs::exists(fs::path(file).replace_extension(".h"));
    EXPECT_NE(hasHeader, kMembersOf.contains(path)) << path << (hasHeader ? " is no exception" : " has no header");
  }
  for (const auto& [path, header] : kMembersOf) {
    const auto includes = includesOf(slurp(kRoot / path));
    EXPECT_TRUE(std::find(includes.begin(), includes.end(), header) != includes.end()) << path << " and " << header;
  }
}

TEST(Architecture, RoomsHaveNoCycle) {
  std::map<std::string, std::set<std::string>> arrows;
  for (const auto& [name, room] : rooms()) arrows[name] = room.rooms;
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

TEST(Architecture, ThePlatformAloneCallsTheSystem) {
  // So that another system than this one is a matter of a few files.
  for (const fs::path& file : sources()) {
    const std::string relative = pathOf(file), text = slurp(file);
    if (kCallsTheSystem.contains(relative)) {
      EXPECT_NE(systemWordIn(text), "") << relative;
      continue;
    }
    for (const std::string& header : includesOf(text))
      EXPECT_FALSE(isOfTheSystem(header)) << relative << " includes <" << header << ">";
    // QProcess itself has one call on each system to say what a child is to do first.
    const bool mayAsk = relative == "app/cli/batch/page_call.cpp";
    const std::string word = systemWordIn(text);
    EXPECT_TRUE(word.empty() || (mayAsk && word.find("Q_OS_") != std::string::npos)) << relative << ": " << word;
  }
}

TEST(Architecture, WordsOfOneSystemAreFound) {
  for (const char* text : {"x = ::open(path)", "if (isatty (2))", "signal(SIGPIPE, f)", "in(\"/proc/meminfo\")",
                           "#if defined(Q_OS_WIN)", "return getpid();", "if (kill(number, 0) == 0)"})
    EXPECT_NE(systemWordIn(text), "") << text;
  for (const char* text : {"RegularFile::open(path)", "file.open(path)", "signal(SIGINT, SIG_IGN)", "Lines::read(text)",
                           "\"/usr/share/batten\"", "SIGTERM", "process_.kill()"})
    EXPECT_EQ(systemWordIn(text), "") << text;
}

TEST(Architecture, EverySourceNamesItsLicence) {
  for (const fs::path& file : sources())
    EXPECT_TRUE(slurp(file).starts_with("// SPDX-License-Identifier: GPL-3.0-or-later")) << file;
}

TEST(Architecture, NothingStandsAtTheTopThatDoesNotBelongThere) {
  static const std::set<std::string> allowed = {
      "CMakeLists.txt",
      "CMakePresets.json",
      "README.md",
      "ARCHITECTURE.md",
      "CONTRIBUTING.md",
      "CHANGELOG.md",
      "compile_commands.json",
      "LICENSE",
      "app",
      "core",
      "ui",
      "resources",
      "tests",
      "packaging",
      "build",
      "out"};  // the last two and compile_commands.json are made, and in no commit
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name.front() == '.' || allowed.contains(name)) << name;
  }
}

TEST(Architecture, NoUnitTestIsLeftOutOfTheBuild) {
  // tests/CMakeLists.txt takes all below unit/<folder> of the folders it lists; anything else would silently not run.
  const std::set<std::string> listed = {"base",      "solve",   "polyline", "image",    "contour", "curve",
                                        "construct", "fairing", "pipeline", "exchange", "document"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests" / "unit")) {
    if (entry.path().extension() != ".cpp") continue;
    const fs::path inner = fs::relative(entry.path(), kRoot / "tests" / "unit");
    EXPECT_TRUE(listed.contains(inner.begin()->string())) << inner;
    EXPECT_TRUE(fs::is_directory(kRoot / "core" / inner.parent_path()))
        << inner << " lies in a folder that core has not";
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
