// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <pty.h>
#include <sys/file.h>

#include <map>

#include "tests/cli/batch_program.h"

namespace batten {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::linesIn;
using test::readFile;
using test::Running;
using test::waitUntil;

/// What batch writes, and over what it does not.
class BatchFiles : public test::Batch {
 protected:
  static int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  }
  /// A picture as the pages of a TIFF, uncompressed: one strip of grey bytes each.
  static std::string tiffOf(const std::vector<GreyImage>& pages) {
    std::string bytes("II\x2a\0", 4);
    const auto add = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
    };
    std::size_t link = bytes.size();
    add(0, 4);
    for (const GreyImage& page : pages) {
      const auto strip = static_cast<std::uint32_t>(bytes.size()),
                 area = static_cast<std::uint32_t>(page.width * page.height);
      for (int y = 0; y < page.height; ++y) {
        for (int x = 0; x < page.width; ++x) bytes.push_back(static_cast<char>(page.row(y)[x] / 257));
      }
      if (bytes.size() % 2 != 0) bytes.push_back(0);
      const auto directory = static_cast<std::uint32_t>(bytes.size());
      for (int i = 0; i < 4; ++i) bytes[link + i] = static_cast<char>(directory >> (8 * i) & 0xffu);
      const std::vector<std::pair<std::uint32_t, std::uint32_t>> tags = {{256, static_cast<std::uint32_t>(page.width)},
                                                                         {257, static_cast<std::uint32_t>(page.height)},
                                                                         {258, 8},
                                                                         {259, 1},
                                                                         {262, 1},
                                                                         {273, strip},
                                                                         {277, 1},
                                                                         {278, static_cast<std::uint32_t>(page.height)},
                                                                         {279, area}};
      add(static_cast<std::uint32_t>(tags.size()), 2);
      for (const auto& [tag, value] : tags) {
        add(tag, 2), add(4, 2), add(1, 4), add(value, 4);
      }
      link = bytes.size();
      add(0, 4);
    }
    return bytes;
  }
  static GreyImage greyOf(const std::string& shape) {
    const auto truth = test::truthShape(shape, 480, 320);
    return test::renderPage(test::fillCoverage(truth.outline(), 480, 320), 480, 320, test::scannedPage(3)).grey;
  }
};

TEST_F(BatchFiles, SideFilesAreWrittenOverNothing) {
  drawPage("a");
  write("r.json", R"({"format":"batten-recipe","version":1})");
  write("pages.jsonl", line("a", {{"recipe", file("r.json")}}));
  fs::create_symlink(file("a.png"), file("link.html"));
  fs::create_hard_link(file("a.png"), file("hard.jsonl"));
  fs::create_symlink(file("a.svg"), file("later.html"));
  fs::create_symlink(folder_, file("folder"));
  std::map<std::string, std::string> before;
  for (const char* name : {"a.png", "r.json", "pages.jsonl"}) before[name] = readFile(file(name));
  for (const char* option : {"--sheet", "--results", "--failures", "--write-manifest"}) {
    for (const char* name : {"a.png", "r.json", "pages.jsonl", "link.html", "hard.jsonl", "later.html", "a.svg",
                             "a.json", "folder/a.png", "a.svg.batch.json"}) {
      expectError("batch " + file("pages.jsonl") + " " + option + " " + file(name), 2,
                  std::string(option) + ": the file");
    }
  }
  expectError("batch " + file("pages.jsonl") + " --results " + file("x") + " --failures " + file("folder/x"), 2,
              "--results");
  expectError("batch " + file("a.png") + " --to " + file("out") + " --sheet " + file("a.png"), 2, "is the scan");
  expectError("batch " + file("pages.jsonl") + " --sheet -", 2, "needs the name of a file");
  for (const auto& [name, bytes] : before) EXPECT_EQ(readFile(file(name)), bytes) << name;
  EXPECT_FALSE(fs::exists(file("a.svg"))) << "nothing is done before";
  EXPECT_FALSE(fs::exists(file("out")));
  const auto listed = run("batch " + file("a.png") + " --to " + file("out") + " --write-manifest -");
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_EQ(linesOf(listed.out).at(0)["scan"], file("a.png"));
  EXPECT_FALSE(fs::exists("-"));
}

TEST_F(BatchFiles, OutputsThatAreOneFileAreRefused) {
  drawPage("a");
  fs::create_directory(file("d"));
  fs::create_symlink(file("d"), file("same"));
  fs::create_symlink(file("d/o.svg"), file("link.svg"));
  const auto refused = [&](const std::vector<std::string>& outputs, const std::string& says) {
    json names = json::array();
    for (const std::string& one : outputs) names.push_back(file(one));
    write("pages.jsonl", line("a", {{"outputs", names}}));
    expectError("batch " + file("pages.jsonl"), 2, says);
  };
  refused({"d/o.svg", "same/o.svg"}, "is written by line 1 as well");
  refused({"d/o.svg", "link.svg"}, "is written by line 1 as well");
  refused({"d/o.svg", "d/o.svg.batch.json"}, "which is kept beside the output, is written by line 1");
  fs::create_symlink(file("a.png"), file("scan.svg"));
  refused({"scan.svg"}, "is a scan or a recipe");
  write("d/r.svg.batch.json", "{}");
  write("pages.jsonl", line("a", {{"outputs", {file("d/r.svg")}}, {"recipe", file("d/r.svg.batch.json")}}));
  expectError("batch " + file("pages.jsonl"), 2, "is a scan or a recipe");
}

TEST_F(BatchFiles, NamesAreTheirBytes) {
  // Latin-1, as old archives have it, and what JSON itself writes in its own way.
  const std::string name = "Entw\xfcrfe \"1\"\\\xf0\x9f\x9a\x97 \xc3\xbc";
  fs::create_directory(file("in"));
  drawPage("in/" + name);
  const auto done =
      run("batch " + file("in") + " --to " + file("out") + " --sheet " + file("s.html") + " --results " + file("r"));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(fs::exists(file("out/" + name + ".svg")));
  EXPECT_EQ(count(readFile(file("s.html")), "figure class=\"done\""), 1);
  EXPECT_NE(readFile(file("s.html")).find("out/Entw%FCrfe%20%221%22%5C%F0%9F%9A%97%20%C3%BC.svg"), std::string::npos);
  EXPECT_NE(readFile(file("r")).find("Entw\\\\xfcrfe"), std::string::npos) << readFile(file("r"));
  ASSERT_EQ(run("batch " + file("in") + " --to " + file("out") + " --write-manifest " + file("m.jsonl")).code, 0);
  EXPECT_NE(readFile(file("m.jsonl")).find("Entw\\\\xfcrfe"), std::string::npos);
  EXPECT_EQ(run("batch " + file("m.jsonl") + " --results " + file("r")).code, 0);
  EXPECT_EQ(linesIn(file("r")), 1) << "the manifest names the same files";
  for (const json& each : linesOf(readFile(file("r")))) EXPECT_TRUE(each["scan"].is_string());
  // Manifests of other programs: with the bytes themselves, and as Python writes them.
  const std::string ours = readFile(file("m.jsonl")), form = "\\\\xfc";
  for (const std::string& theirs : {std::string("\xfc"), std::string("\\udcfc")}) {
    std::string raw = ours;
    while (raw.find(form) != std::string::npos) raw.replace(raw.find(form), form.size(), theirs);
    write("m.jsonl", raw);
    EXPECT_EQ(run("batch " + file("m.jsonl") + " --results " + file("r")).code, 0);
    EXPECT_EQ(linesIn(file("r")), 1) << theirs;
  }
}

TEST_F(BatchFiles, ANameThatLooksLikeABytesFormIsAnother) {
  fs::create_directory(file("in"));
  drawPage("in/\xff");
  drawPage("in/\\xff");
  const auto done = run("batch " + file("in") + " --to " + file("out"));
  ASSERT_EQ(done.code, 0) << done.err;
  std::set<std::string> scans;
  for (const json& each : linesOf(done.out)) scans.insert(fs::path(each["scan"].get<std::string>()).filename());
  EXPECT_EQ(scans, (std::set<std::string>{"\\xff.png", "\\x5cxff.png"}));
  EXPECT_TRUE(fs::exists(file("out/\xff.svg")));
  EXPECT_TRUE(fs::exists(file("out/\\xff.svg")));
}

TEST_F(BatchFiles, TwoCallsShareThePagesAndTellEachOnce) {
  std::string pages;
  for (int i = 0; i < 8; ++i) {
    drawPage("p" + std::to_string(i), i % 2 == 0 ? "ellipse" : "car");
    pages += line("p" + std::to_string(i));
  }
  write("pages.jsonl", pages);
  const std::vector<std::string> words{"batch", file("pages.jsonl"), "--jobs", "2", "--results", file("r.jsonl")};
  const Running one(words), other(words), third(words);
  for (const Running* each : {&one, &other, &third}) {
    const int status = each->wait();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  std::multiset<std::string> scans;
  for (const json& each : linesOf(readFile(file("r.jsonl")))) {
    EXPECT_EQ(each["status"], "done");
    scans.insert(each["scan"].get<std::string>());
  }
  EXPECT_EQ(scans.size(), 8u);
  EXPECT_EQ(std::set<std::string>(scans.begin(), scans.end()).size(), 8u);
  for (const std::string& name : filesIn(folder_)) EXPECT_FALSE(name.ends_with(".lock")) << name;
}

TEST_F(BatchFiles, APageOnWhichAnotherCallWorksIsWaitedFor) {
  drawPage("a");
  drawPage("b");
  write("pages.jsonl", line("a") + line("b"));
  const int lock = open(file("a.svg.batch.json.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  const Running program({"batch", file("pages.jsonl"), "--results", file("r.jsonl")});
  ASSERT_TRUE(waitUntil([&] { return linesIn(file("r.jsonl")) == 1; }));
  EXPECT_NE(readFile(file("r.jsonl")).find("b.png"), std::string::npos) << "the others go on";
  EXPECT_FALSE(fs::exists(file("a.svg")));
  close(lock);
  program.wait();
  EXPECT_EQ(linesIn(file("r.jsonl")), 2);
  EXPECT_TRUE(fs::exists(file("a.svg")));
  EXPECT_FALSE(fs::exists(file("a.svg.batch.json.lock")));
  // What was removed is made anew, and told once all the same.
  fs::remove(file("a.svg"));
  EXPECT_EQ(run("batch " + file("pages.jsonl") + " --results " + file("r.jsonl")).code, 0);
  EXPECT_TRUE(fs::exists(file("a.svg")));
  EXPECT_EQ(linesIn(file("r.jsonl")), 2);
}

TEST_F(BatchFiles, ATerminationOfTheGroupFailsNoPage) {
  std::string pages;
  for (int i = 0; i < 8; ++i) {
    drawPage("p" + std::to_string(i));
    pages += line("p" + std::to_string(i));
  }
  write("pages.jsonl", pages);
  const Running program({"batch", file("pages.jsonl"), "--jobs", "2", "--results", file("r.jsonl")});
  ASSERT_TRUE(waitUntil([&] { return linesIn(file("r.jsonl")) >= 1; }));
  program.sendToGroup(SIGTERM);
  const int status = program.wait();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7);
  for (const json& one : linesOf(readFile(file("r.jsonl")))) EXPECT_EQ(one["status"], "done") << one;
}

TEST_F(BatchFiles, EveryPageOfAFileIsTracedAndShown) {
  fs::create_directory(file("in"));
  write("in/two.tif", tiffOf({greyOf("ellipse"), greyOf("car")}));
  write("in/one.tif", tiffOf({greyOf("ellipse")}));
  const auto done =
      run("batch " + file("in") + " --to " + file("out") + " --dpi 254 --formats svg --sheet " + file("s.html"));
  ASSERT_EQ(done.code, 0) << done.err << done.out;
  EXPECT_EQ(linesOf(done.out).size(), 3u);
  EXPECT_EQ(done.out.find("Use --page"), std::string::npos) << "all pages are traced: " << done.out;
  EXPECT_NE(readFile(file("out/two-p1.svg")), readFile(file("out/two-p2.svg")));
  EXPECT_TRUE(fs::exists(file("out/one.svg")));
  const std::string html = readFile(file("s.html"));
  EXPECT_NE(html.find("<b>two.tif, page 1</b>"), std::string::npos);
  EXPECT_NE(html.find("<b>two.tif, page 2</b>"), std::string::npos);
  EXPECT_NE(html.find("<b>one.tif</b>"), std::string::npos);
  std::set<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(file("s_files"))) pictures.insert(readFile(entry.path()));
  EXPECT_EQ(filesIn(file("s_files")).size(), 3u);
  EXPECT_EQ(pictures.size(), 2u) << "the first pages are alike, the second is not";
  write("pages.jsonl",
        json{{"scan", file("in/two.tif")}, {"outputs", {file("x.svg")}}, {"page", "all"}, {"dpi", 254}}.dump() + "\n");
  EXPECT_EQ(run("batch " + file("pages.jsonl")).code, 0);
  EXPECT_EQ(readFile(file("x-p2.svg")).size(), readFile(file("out/two-p2.svg")).size());
}

TEST_F(BatchFiles, TheSheetTellsWhatIsDoneFromWhatIsNot) {
  drawPage("a");
  drawPage("b");
  drawPage("c");
  const std::string first = json{{"scan", file("a.png")}, {"outputs", {file("a.dxf")}}, {"dpi", 254}}.dump() + "\n";
  write("pages.jsonl", first + line("b") + line("c"));
  ASSERT_EQ(run("batch " + file("pages.jsonl")).code, 0);
  drawPage("b", "car");  // changed, and not traced since
  write("a.png", "no picture");
  drawPage("d");
  write("more.jsonl", first + line("b") + line("c") + line("d"));
  const auto stopped = run("batch " + file("more.jsonl") + " --jobs 1 --max-failures 0 --sheet " + file("s.html"));
  EXPECT_EQ(stopped.code, 7) << stopped.err;
  const std::string html = readFile(file("s.html"));
  EXPECT_NE(html.find("1 done, 0 without a curve, 1 failed, 2 not reached"), std::string::npos) << html.substr(0, 2000);
  EXPECT_EQ(count(html, "<figure class=\"waiting\">"), 2);
  drawPage("a");
  ASSERT_EQ(run("batch " + file("pages.jsonl") + " --sheet " + file("s.html")).code, 0);
  EXPECT_EQ(count(readFile(file("s.html")), "The picture shows only the scan"), 1) << "of a DXF no curve is drawn";
}

TEST_F(BatchFiles, ALongSheetIsSplit) {
  std::string pages;
  for (int i = 0; i < 501; ++i) {
    json page{{"scan", file("none.png")}, {"outputs", {file("o" + std::to_string(i) + ".svg")}}};
    pages += page.dump() + "\n";
  }
  write("pages.jsonl", pages);
  run("batch " + file("pages.jsonl") + " --jobs 1 --max-failures 0 --sheet " + file("s.html"));
  const std::string html = readFile(file("s.html")), second = readFile(file("s_files/sheet-2.html"));
  EXPECT_EQ(count(html, "<figure "), 500);
  EXPECT_EQ(count(second, "<figure "), 1);
  EXPECT_NE(html.find("<a href=\"s_files/sheet-2.html\">501–501</a>"), std::string::npos);
  EXPECT_NE(second.find("<a href=\"../s.html\">1–500</a>"), std::string::npos);
}

TEST_F(BatchFiles, PatternsReachIntoFolders) {
  for (const char* folder : {"in/g1", "in/g2/deep", "in/h"}) fs::create_directories(file(folder));
  for (const char* name : {"in/top", "in/g1/a", "in/g2/a", "in/g2/deep/b", "in/h/a"}) drawPage(name);
  const auto scansOf = [&](const std::string& pattern) {
    const auto listed = run("batch '" + file(pattern) + "' --to " + file("out") + " --write-manifest -");
    std::map<std::string, std::string> scans;
    for (const json& one : linesOf(listed.out)) {
      scans[one["scan"].get<std::string>().substr(file("in").size() + 1)] =
          one["outputs"][0].get<std::string>().substr(file("out").size() + 1);
    }
    return scans;
  };
  using Scans = std::map<std::string, std::string>;
  EXPECT_EQ(scansOf("in/g?/*.png"), (Scans{{"g1/a.png", "g1/a.svg"}, {"g2/a.png", "g2/a.svg"}}));
  EXPECT_EQ(scansOf("in/**/*.png").size(), 5u);
  EXPECT_EQ(scansOf("in/**/b.png"), (Scans{{"g2/deep/b.png", "g2/deep/b.svg"}}));
  EXPECT_EQ(scansOf("in/*.png"), (Scans{{"top.png", "top.svg"}}));
}

TEST_F(BatchFiles, NumbersThatAreNoneAreRefused) {
  drawPage("a");
  write("pages.jsonl", line("a"));
  for (const char* words :
       {"--max-failures nan", "--page-timeout nan", "--dpi nan", "--max-failures 1.5", "--page-timeout 0",
        "--page-timeout inf", "--dpi 0x60", "--dpi ''", "--dpi 0", "--jobs ''", "--jobs 0x2", "--jobs 1.5", "--jobs -1",
        "--first-line 0x2", "--max-failures 0x1", "--page-timeout ''"}) {
    const std::string name = std::string(words).substr(0, std::string(words).find(' '));
    expectError("batch " + file("pages.jsonl") + " " + words, 2, name + " takes ");
    std::string value = std::string(words).substr(name.size() + 1);
    if (value == "''") value.clear();
    expectError("batch " + file("pages.jsonl") + " " + words, 2, ", not \"" + value + "\"");
  }
  EXPECT_FALSE(fs::exists(file("a.svg")));
}

TEST_F(BatchFiles, APartOfAManifestHasTheNumbersOfTheWhole) {
  drawPage("a");
  write("pages.jsonl", line("a") + "broken\n");
  expectError("batch " + file("pages.jsonl") + " --first-line 41", 2, "Line 42 of the manifest");
  write("pages.jsonl", "\n" + line("a"));
  EXPECT_EQ(linesOf(run("batch " + file("pages.jsonl") + " --first-line 41").out).at(0)["line"], 42);
}

TEST_F(BatchFiles, AnEndedPageKeepsNoOutput) {
  // The second output cannot be written: the first, which the call has written by then, goes with the page.
  drawPage("a");
  write("pages.jsonl", line("a", {{"outputs", {file("a.svg"), file("none/a.json")}}}));
  EXPECT_EQ(run("batch " + file("pages.jsonl")).code, 6);
  EXPECT_FALSE(fs::exists(file("a.svg")));
  EXPECT_EQ(filesIn(folder_), (std::set<std::string>{"a.png", "pages.jsonl"}));
}

TEST_F(BatchFiles, OnATerminalTheLinesStandByThemselves) {
  drawPage("a");
  write("pages.jsonl", line("a"));
  int terminal = -1;
  std::string words[] = {BATTEN_CLI, "batch", file("pages.jsonl")};
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl(words[0].c_str(), words[0].c_str(), words[1].c_str(), words[2].c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  ASSERT_GT(child, 0);
  std::string shown;
  char block[4096];
  for (ssize_t got = 0; (got = read(terminal, block, sizeof block)) > 0;) shown.append(block, got);
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const auto at = shown.find("{\"line\"");
  ASSERT_NE(at, std::string::npos) << shown;
  ASSERT_GE(at, 4u);
  EXPECT_EQ(shown.substr(at - 4, 4), "\r\033[K") << "the progress before it is taken away";
}

}  // namespace
}  // namespace batten
