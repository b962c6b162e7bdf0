// SPDX-License-Identifier: GPL-3.0-or-later
// Pipes, devices, links and files that grow too large, in the place of ordinary files.
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "tests/cli/hostile_input.h"

namespace batten {
namespace {

using json = nlohmann::json;
using test::HostileInput;
using test::Outcome;

TEST_F(HostileInput, APipeThatNobodyReadsTakesNoResults) {
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  expectRefused("batch " + scene() + " --to " + file("out") + " --results " + file("pipe"), 5, "a pipe needs a reader");
}

TEST_F(HostileInput, OnlyOrdinaryFilesAreRead) {
  namespace fs = std::filesystem;
  const std::string start = "trace " + scene() + " -o " + file("o.svg");
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", file("endless"));
  fs::create_symlink(file("pipe"), file("to-pipe"));
  for (const std::string& name : {file("pipe"), file("to-pipe"), file("endless"), std::string("/dev/zero")}) {
    expectRefused(start + " --recipe " + name, 2, "is not a regular file");
    expectRefused("compare " + name + " " + name, 3, "is not a regular file");
    expectRefused("trace " + name + " -o " + file("p.svg"), 3, "is not a file");
  }
  expectRefused(start + " --recipe " + folder_.string(), 2, "is a folder");
  std::ofstream(file("large.json")).close();
  fs::resize_file(file("large.json"), std::uintmax_t{1} << 40);
  expectRefused(start + " --recipe " + file("large.json"), 2, "is too large");
  expectRefused("compare " + file("large.json") + " " + file("large.json"), 3, "is too large");
}

// Of those of the kernel some are ordinary by their kind, hold nothing by their size, and never end.
TEST_F(HostileInput, BatchReadsOnlyOrdinaryFilesToTheirEnd) {
  namespace fs = std::filesystem;
  const std::string scan = scene();
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  fs::create_symlink(file("pipe"), file("pipe.jsonl"));
  fs::create_symlink("/dev/zero", file("zero.jsonl"));
  const auto batch = [&](const std::string& words) {
    const int status = std::system(
        ("timeout 60 '" BATTEN_CLI "' batch " + words + " >'" + file("out.txt") + "' 2>'" + file("err.txt") + "'")
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  for (const char* manifest : {"pipe.jsonl", "zero.jsonl"}) {
    EXPECT_EQ(batch(file(manifest)), 2) << manifest;
    EXPECT_NE(test::readFile(file("err.txt")).find("is not a regular file"), std::string::npos) << manifest;
  }
  for (const std::string& name : {file("pipe"), std::string("/dev/zero"), std::string("/proc/kmsg")}) {
    EXPECT_EQ(batch(name + " --to " + file("out")), 6) << name;
    EXPECT_NE(test::readFile(file("out.txt")).find("\"failed\""), std::string::npos) << name;
    EXPECT_EQ(batch(scan + " --to " + file("out") + " --recipe " + name), 6) << name;
    write("pages.jsonl", json{{"scan", scan}, {"recipe", name}, {"outputs", {file("x.svg")}}}.dump() + "\n" +
                             json{{"scan", name}, {"outputs", {file("y.svg")}}}.dump() + "\n");
    EXPECT_EQ(batch(file("pages.jsonl")), 6) << name;
    EXPECT_NE(test::readFile(file("err.txt")).find("2 pages of 2 have failed"), std::string::npos) << name;
  }
}

TEST_F(HostileInput, EveryReaderRefusesPipesAndDevices) {
  namespace fs = std::filesystem;
  const std::string scan = scene();
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  for (const char* ending : {"dxf", "igs", "step", "svg", "csv", "txt", "json", "tif", "pdf", "png"}) {
    for (const auto& [target, name] : {std::pair<std::string, std::string>{file("pipe"), "p."}, {"/dev/zero", "z."}}) {
      const std::string link = file(name + ending);
      fs::create_symlink(target, link);
      expectRefused("trace " + link + " -o " + file("o.svg"), 3, "");
      if (std::string(ending) == "tif" || std::string(ending) == "pdf" || std::string(ending) == "png") {
        expectRefused("suggest " + link, 3, "");
        EXPECT_EQ(run("trace " + link + " --page all -o " + file("o.svg")).code, 3) << link;
      } else {
        expectRefused("trace " + scan + " --import " + link + " -o " + file("o.svg"), 3, "");
        expectRefused("compare " + link + " " + link, 3, "");
      }
    }
  }
}

TEST_F(HostileInput, OutputsThatAreOneFileByLinksAreRefused) {
  namespace fs = std::filesystem;
  const std::string scan = scene();
  fs::create_symlink("real.svg", file("one.svg"));
  fs::create_symlink("real.svg", file("two.svg"));  // neither leads to a file yet
  expectRefused("trace " + scan + " -o " + file("one.svg") + " -o " + file("two.svg"), 2, "twice");
  fs::create_symlink("b.svg", file("a.svg"));
  fs::create_symlink("a.svg", file("b.svg"));
  expectRefused("trace " + scan + " -o " + file("a.svg"), 5, "form a loop");
  EXPECT_TRUE(fs::is_symlink(file("a.svg")));
  expectRefused("batch " + scan + " --to " + file("out") + " --formats svg --sheet " + file("a.svg"), 5, "form a loop");
  EXPECT_TRUE(fs::is_empty(file("out"))) << "it is known before the work";
  expectRefused("trace " + file("a.svg") + " -o " + file("o.svg"), 3, "form a loop");
  fs::create_symlink("turn", file("turn"));
  expectRefused("trace " + scan + " -o " + file("turn/o.svg"), 5, "folder form a loop");
  fs::create_symlink("b.png", file("a.png"));
  fs::create_symlink("a.png", file("b.png"));
  expectRefused("trace " + file("a.png") + " -o " + file("o.svg"), 3, "form a loop");
}

TEST_F(HostileInput, AFileThatGrowsTooLargeGivesFiveAndKeepsTheOldOne) {
  const std::string scan = scene();
  write("o.json", "old");
  const std::string limited = "ulimit -f 1; '" BATTEN_CLI "' trace " + scan + " -o " + file("o.json");
  const int status = std::system(("sh -c \"" + limited + "\" >/dev/null 2>'" + file("err.txt") + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status)) << "ended by a signal";
  EXPECT_EQ(WEXITSTATUS(status), 5) << test::readFile(file("err.txt"));
  EXPECT_NE(test::readFile(file("err.txt")).find("exceed the file size limit"), std::string::npos);
  EXPECT_EQ(test::readFile(file("o.json")), "old");
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".batten-")) << entry.path();
}

}  // namespace
}  // namespace batten
