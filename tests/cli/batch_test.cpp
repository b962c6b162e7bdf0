// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <set>

#include "tests/cli/batch_program.h"

namespace batten {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Batch;
using test::linesIn;
using test::Running;
using test::waitUntil;

TEST_F(Batch, GivesWhatSingleCallsGiveAndLeavesUnchangedPages) {
  drawPage("a");
  drawPage("b", "car");
  write("pages.jsonl",
        line("a") + "\n" + line("b", {{"set", {{"fairing.mode", "tolerance"}, {"fairing.tolerance", 0.2}}}}));
  const auto done = run("batch " + file("pages.jsonl") + " --jobs 2");
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_EQ(statusesOf(done.out), (Statuses{"a done", "b done"}));
  for (const json& one : linesOf(done.out)) {
    EXPECT_EQ(one["line"], one["scan"] == file("a.png") ? 1 : 3) << "blank lines count";
    EXPECT_EQ(one["exit"], 0);
    EXPECT_EQ(one["curves"], 1);
    EXPECT_GT(one["seconds"].get<double>(), 0.0);
    EXPECT_GT(one["peak_memory_bytes"].get<double>(), 1e6);
  }
  ASSERT_EQ(
      run("trace " + file("a.png") + " --dpi 254 -o " + file("single-a.svg") + " -o " + file("single-a.json")).code, 0);
  ASSERT_EQ(run("trace " + file("b.png") + " --dpi 254 --set fairing.mode=tolerance --set fairing.tolerance=0.2 -o " +
                file("single-b.svg") + " -o " + file("single-b.json"))
                .code,
            0);
  for (const char* name : {"a.svg", "a.json", "b.svg", "b.json"}) {
    EXPECT_EQ(test::readFile(file(name)), test::readFile(file(std::string("single-") + name))) << name;
  }
  const auto written = fs::last_write_time(file("a.svg"));
  const auto again = run("batch - <" + file("pages.jsonl"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(statusesOf(again.out), (Statuses{"a unchanged", "b unchanged"}));
  EXPECT_EQ(fs::last_write_time(file("a.svg")), written);
  for (const json& one : linesOf(again.out)) EXPECT_EQ(one["curves"], 1) << "as known from before";
}

TEST_F(Batch, WhatHasChangedIsMadeAnew) {
  for (const char* name : {"a", "b", "c", "d", "e"}) drawPage(name);
  write("r.json", R"({"format":"batten-recipe","version":1,"parameters":{"fairing.mode":"tolerance"}})");
  const std::string same = line("a") + line("b", {{"recipe", file("r.json")}});
  write("pages.jsonl", same + line("c") + line("d") + line("e"));
  ASSERT_EQ(run("batch " + file("pages.jsonl")).code, 0);
  write("r.json", R"({"format":"batten-recipe","version":1,"parameters":{"fairing.mode":"none"}})");
  drawPage("c", "car");
  fs::remove(file("d.svg"));
  write("pages.jsonl", same + line("c") + line("d") + line("e", {{"dpi", 300}}));
  const auto done = run("batch " + file("pages.jsonl"));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(statusesOf(done.out), (Statuses{"a unchanged", "b done", "c done", "d done", "e done"}));
  EXPECT_TRUE(fs::exists(file("d.svg")));
}

TEST_F(Batch, WhatSomebodyHasChangedIsNotOverwritten) {
  drawPage("a");
  write("pages.jsonl", line("a"));
  ASSERT_EQ(run("batch " + file("pages.jsonl")).code, 0);
  write("a.svg", test::readFile(file("a.svg")) + "<!-- a label was set by hand -->");
  const std::string edited = test::readFile(file("a.svg"));
  const auto kept = run("batch " + file("pages.jsonl"));
  EXPECT_EQ(kept.code, 6);
  EXPECT_EQ(statusesOf(kept.out), Statuses{"a failed"});
  EXPECT_EQ(linesOf(kept.out).at(0)["exit"], 5);
  EXPECT_NE(kept.out.find("was changed after batch"), std::string::npos) << kept.out;
  // A new scan is no reason to overwrite it either.
  drawPage("a", "car");
  EXPECT_EQ(statusesOf(run("batch " + file("pages.jsonl")).out), Statuses{"a failed"});
  EXPECT_EQ(test::readFile(file("a.svg")), edited);
  fs::rename(file("a.svg"), file("mine.svg"));
  EXPECT_EQ(statusesOf(run("batch " + file("pages.jsonl")).out), Statuses{"a done"});
  write("a.svg", edited);
  EXPECT_EQ(statusesOf(run("batch " + file("pages.jsonl") + " --existing overwrite").out), Statuses{"a done"});
}

TEST_F(Batch, APatternMayHoldASetOfLetters) {
  for (const char* name : {"s1", "s2", "s3", "sx"}) drawPage(name);
  const auto scansOf = [&](const std::string& pattern) {
    const auto done = run("batch '" + file(pattern) + "' --to " + file("out") + " --write-manifest -");
    std::string scans;
    for (const json& one : linesOf(done.out)) scans += fs::path(one["scan"].get<std::string>()).stem().string() + " ";
    return scans;
  };
  EXPECT_EQ(scansOf("s[12].png"), "s1 s2 ");
  EXPECT_EQ(scansOf("s[1-3].png"), "s1 s2 s3 ");
  EXPECT_EQ(scansOf("s[!1-3].png"), "sx ");
  EXPECT_EQ(scansOf("[s]*[3x].p?g"), "s3 sx ");
  fs::copy_file(file("s1.png"), file("page[1].png"));
  EXPECT_EQ(scansOf("page[1].png"), "page[1] ") << "a name that is there is no pattern";
}

TEST_F(Batch, FailuresAreToldApartAndHoldNothingUp) {
  drawPage("good");
  drawPage("nowhere");
  write("empty.png", pngOf(GreyImage(200, 150, 65535)));
  write("damaged.png", "This is a letter, not a picture.\n");
  json nowhere = json::parse(line("nowhere"));
  nowhere["outputs"] = {file("no/such/o.svg")};
  write("pages.jsonl", line("damaged") + line("empty") + nowhere.dump() + "\n" + line("missing") + line("good"));
  const auto done = run("batch " + file("pages.jsonl") + " --failures " + file("failed.jsonl"));
  EXPECT_EQ(done.code, 6);
  EXPECT_EQ(done.err, "batten-cli: 3 pages of 5 have failed; the lines with \"status\":\"failed\" say why.\n");
  EXPECT_EQ(statusesOf(done.out),
            (Statuses{"damaged failed", "empty empty", "nowhere failed", "missing failed", "good done"}));
  for (const json& one : linesOf(done.out)) {
    if (one["status"] == "done") continue;
    const auto single =
        run("trace " + one["scan"].get<std::string>() + " --dpi 254 -o " + one["outputs"][0].get<std::string>());
    EXPECT_EQ(one["exit"], single.code) << one;
    EXPECT_EQ("batten-cli: " + one["error"].get<std::string>() + "\n", single.err);
  }
  EXPECT_FALSE(fs::exists(file("damaged.svg.batch.json"))) << "nothing was made, so nothing is kept";
  const std::string failed = test::readFile(file("failed.jsonl"));
  EXPECT_EQ(std::count(failed.begin(), failed.end(), '\n'), 3);
  // The pages that failed are a manifest; mended, they are done.
  drawPage("damaged");
  drawPage("missing");
  fs::create_directories(file("no/such"));
  const auto mended = run("batch " + file("failed.jsonl"));
  EXPECT_EQ(mended.code, 0) << mended.err;
  EXPECT_EQ(statusesOf(mended.out), (Statuses{"damaged done", "nowhere done", "missing done"}));
  // All that was asked for is known by now, the empty page too.
  EXPECT_EQ(run("batch " + file("pages.jsonl") + " --max-failures 0").code, 0);
}

TEST_F(Batch, TooManyFailuresOrTooMuchTimeEndIt) {
  for (const char* name : {"a", "b", "c", "d"}) write(std::string(name) + ".png", "no picture");
  drawPage("e");
  write("pages.jsonl", line("a") + line("b") + line("c") + line("d") + line("e"));
  const auto first = run("batch " + file("pages.jsonl") + " --jobs 1 --max-failures 0");
  EXPECT_EQ(first.code, 7);
  EXPECT_NE(first.err.find("1 page of 5 has failed"), std::string::npos) << first.err;
  const auto few = run("batch " + file("pages.jsonl") + " --jobs 1 --max-failures 0.2");
  EXPECT_EQ(few.code, 7);
  EXPECT_NE(few.err.find("2 pages of 5 have failed"), std::string::npos) << few.err;
  EXPECT_EQ(statusesOf(few.out), (Statuses{"a failed", "b failed"}));
  write("slow.jsonl", line("e"));
  const auto slow = run("batch " + file("slow.jsonl") + " --page-timeout 0.001");
  EXPECT_EQ(slow.code, 6);
  EXPECT_NE(slow.out.find("longer than 0.001 s"), std::string::npos) << slow.out;
  EXPECT_FALSE(linesOf(slow.out).at(0).contains("exit")) << "it did not end by itself";
  EXPECT_FALSE(fs::exists(file("e.svg")));
}

TEST_F(Batch, FilesOfOthersAreNotTouchedUnlessAsked) {
  drawPage("a");
  write("a.svg", "mine");
  write("pages.jsonl", line("a"));
  const auto kept = run("batch " + file("pages.jsonl"));
  EXPECT_EQ(kept.code, 6);
  EXPECT_NE(kept.out.find("--existing overwrite"), std::string::npos) << kept.out;
  expectError("batch " + file("pages.jsonl") + " --existing abort", 5, "already exists");
  EXPECT_EQ(test::readFile(file("a.svg")), "mine");
  EXPECT_EQ(run("batch " + file("pages.jsonl") + " --existing overwrite").code, 0);
  EXPECT_NE(test::readFile(file("a.svg")), "mine");
  EXPECT_EQ(statusesOf(run("batch " + file("pages.jsonl") + " --existing overwrite").out), Statuses{"a done"});
  EXPECT_EQ(statusesOf(run("batch " + file("pages.jsonl") + " --existing overwrite --resume").out),
            Statuses{"a unchanged"});
}

TEST_F(Batch, WrongManifestsAreRefusedWithTheirLine) {
  drawPage("a");
  const auto refused = [&](const std::string& text, const std::string& says) {
    write("pages.jsonl", line("a") + text);
    expectError("batch " + file("pages.jsonl"), 2, says);
  };
  refused("{\"scan\":", "Line 2 of the manifest: not a JSON object");
  refused("[1,2]", "not a JSON object");
  refused("{\"outputs\":[\"x.svg\"]}", "\"scan\" is missing");
  refused("{\"scan\":\"x.png\"}", "\"outputs\" is missing");
  refused("{\"scan\":\"x.png\",\"outputs\":[]}", "\"outputs\" takes");
  refused("{\"scan\":\"x.png\",\"outputs\":\"x.svg\"}", "\"outputs\" takes");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"x.svg\"],\"recpe\":\"r\"}", "there is no \"recpe\"");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"x.svg\"],\"dpi\":\"300\"}", "\"dpi\" takes a number");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"x.svg\"],\"page\":0}", "\"page\" takes");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"x.svg\"],\"set\":{\"a\":[]}}", "\"set\" takes");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"" + file("./a.svg") + "\"]}", "is written by line 1 as well");
  refused("{\"scan\":\"x.png\",\"outputs\":[\"" + file("a.png") + "\"]}", "is a scan or a recipe");
  write("pages.jsonl", "\n");
  expectError("batch " + file("pages.jsonl"), 2, "is empty");
  expectError("batch " + file("none.jsonl"), 2, "cannot be read");
  expectError("batch " + file("none") + " --to " + file("out"), 2, "There is no scan in");
  expectError("batch " + file("a.png"), 2, "--to FOLDER");
  expectError("batch " + file("a.png") + " --to " + file("out") + " --formats svg,", 2, "--formats");
  expectError("batch " + file("pages.jsonl") + " " + file("a.png"), 2, "one manifest");
  EXPECT_FALSE(fs::exists(file("a.svg")));
}

TEST_F(Batch, FoldersAndPatternsBecomeAManifest) {
  for (const char* folder : {"in/deep", "out"}) fs::create_directories(file(folder));
  for (const char* name : {"in/b", "in/a", "in/deep/a", "in/other"}) drawPage(name);
  fs::copy_file(file("in/a.png"), file("in/a.bmp"));  // told by its bytes, not by its name
  write("in/notes.txt", "no scan");
  write("in/b.recipe.json", R"({"format":"batten-recipe","version":1,"dpi":200})");
  ASSERT_EQ(run("batch " + file("in") + " --to " + file("out") + " --write-manifest " + file("m.jsonl")).code, 0);
  std::map<std::string, json> pages;
  for (const json& one : linesOf(test::readFile(file("m.jsonl")))) pages[one["scan"]] = one;
  ASSERT_EQ(pages.size(), 5u);
  EXPECT_EQ(pages[file("in/deep/a.png")]["outputs"], (json{file("out/deep/a.svg"), file("out/deep/a.json")}));
  EXPECT_EQ(pages[file("in/a.png")]["outputs"][0], file("out/a.png.svg")) << "a.bmp would write the same";
  EXPECT_EQ(pages[file("in/b.png")]["recipe"], file("in/b.recipe.json"));
  EXPECT_FALSE(pages[file("in/other.png")].contains("recipe"));
  // A pattern, with what is common to all pages; the folder of the outputs is none of the scans'.
  const auto done = run("batch '" + file("in/[ab].png") + "' '" + file("in/?.png") + "' --to " + file("in/curves") +
                        " --formats svg --dpi 254");
  EXPECT_EQ(done.code, 2) << "no scan is named [ab].png: " << done.out;
  const auto two = run("batch '" + file("in/?.png") + "' --to " + file("in/curves") + " --formats svg --dpi 254");
  EXPECT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(filesIn(file("in/curves")),
            (std::set<std::string>{"a.svg", "a.svg.batch.json", "b.svg", "b.svg.batch.json"}));
  EXPECT_NE(test::readFile(file("in/curves/b.svg")).find("width=\"48mm\""), std::string::npos);
}

TEST_F(Batch, AKillLosesNoPageAndTellsNoneTwice) {
  std::string pages;
  std::set<std::string> expected{"pages.jsonl", "results.jsonl"};
  for (int i = 0; i < 6; ++i) {
    const std::string name = "p" + std::to_string(i);
    drawPage(name, i % 2 == 0 ? "ellipse" : "car");
    pages += line(name);
    for (const char* end : {".png", ".svg", ".json", ".svg.batch.json"}) expected.insert(name + end);
  }
  write("pages.jsonl", pages);
  const std::vector<std::string> words{"batch", file("pages.jsonl"), "--jobs", "2", "--results", file("results.jsonl")};
  for (std::ptrdiff_t after : {1, 3}) {
    const Running program(words);
    ASSERT_TRUE(waitUntil([&] { return linesIn(file("results.jsonl")) >= after; }));
    program.send(SIGKILL);
    program.wait();
  }
  const std::string before = test::readFile(file("results.jsonl"));
  const Running program(words);
  const int status = program.wait();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const std::string results = test::readFile(file("results.jsonl"));
  EXPECT_TRUE(results.starts_with(before)) << "lines are added only";
  std::multiset<std::string> scans;
  for (const json& one : linesOf(results)) scans.insert(one["scan"].get<std::string>());
  EXPECT_EQ(scans.size(), 6u);
  EXPECT_EQ(std::set<std::string>(scans.begin(), scans.end()).size(), 6u);
  EXPECT_EQ(filesIn(folder_), expected) << "no half file is left";
  for (int i = 0; i < 6; ++i) {
    const std::string name = "p" + std::to_string(i);
    ASSERT_EQ(run("trace " + file(name + ".png") + " --dpi 254 -o " + file("single.json")).code, 0);
    EXPECT_EQ(test::readFile(file(name + ".json")), test::readFile(file("single.json"))) << name;
  }
}

TEST_F(Batch, AnInterruptEndsAfterTheRunningPages) {
  std::string pages;
  for (int i = 0; i < 8; ++i) {
    drawPage("p" + std::to_string(i));
    pages += line("p" + std::to_string(i));
  }
  write("pages.jsonl", pages);
  const std::vector<std::string> words{"batch", file("pages.jsonl"), "--jobs", "1", "--results", file("results.jsonl")};
  const Running program(words);
  ASSERT_TRUE(waitUntil([&] { return linesIn(file("results.jsonl")) >= 2; }));
  program.send(SIGINT);
  const int status = program.wait();
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  const auto ended = linesOf(test::readFile(file("results.jsonl")));
  EXPECT_LT(ended.size(), 8u);
  for (const json& one : ended) EXPECT_EQ(one["status"], "done") << "the running page was not cut off";
  EXPECT_EQ(run("batch " + file("pages.jsonl") + " --results " + file("results.jsonl")).code, 0);
  EXPECT_EQ(linesIn(file("results.jsonl")), 8);
}

TEST_F(Batch, LinesThatWereLostOrTornComeBack) {
  drawPage("a");
  drawPage("b");
  write("pages.jsonl", line("a") + line("b"));
  const std::string words = "batch " + file("pages.jsonl") + " --jobs 1 --results " + file("results.jsonl");
  ASSERT_EQ(run(words).code, 0);
  const std::string whole = test::readFile(file("results.jsonl"));
  write("results.jsonl", whole.substr(0, whole.size() - 20));  // as on a disk that was full
  ASSERT_EQ(run(words).code, 0);
  const std::string again = test::readFile(file("results.jsonl"));
  EXPECT_EQ(std::count(again.begin(), again.end(), '\n'), 3);
  const json last = json::parse(again.substr(again.rfind('\n', again.size() - 2) + 1));
  EXPECT_EQ(last["scan"], file("b.png"));
  EXPECT_EQ(last["status"], "unchanged");
  EXPECT_EQ(last["curves"], 1);
  ASSERT_EQ(run(words).code, 0);
  EXPECT_EQ(test::readFile(file("results.jsonl")), again) << "nothing is told twice";
}

TEST_F(Batch, TheContactSheetShowsEveryPage) {
  fs::create_directories(file("with blank & sign"));
  drawPage("a");
  drawPage("with blank & sign/b", "car");
  write("empty.png", pngOf(GreyImage(200, 150, 65535)));
  write("damaged.png", "no picture");
  json second = json::parse(line("with blank & sign/b"));
  second["outputs"] = {file("with blank & sign/b.svg")};
  write("pages.jsonl", line("a") + second.dump() + "\n" + line("empty") + line("damaged"));
  EXPECT_EQ(run("batch " + file("pages.jsonl") + " --sheet " + file("sheet.html")).code, 6);
  const std::string html = test::readFile(file("sheet.html"));
  const auto count = [&](const std::string& what) {
    int found = 0;
    for (auto at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<figure class=\"done\">"), 2);
  EXPECT_EQ(count("<figure class=\"empty\">"), 1);
  EXPECT_EQ(count("<figure class=\"failed\">"), 1);
  EXPECT_EQ(count("<svg "), 2) << "curves of a .json and of an .svg";
  EXPECT_EQ(count("<img "), 3);
  EXPECT_EQ(count("<small>1 curve in "), 2);
  EXPECT_NE(html.find("href=\"with%20blank%20%26%20sign/b.svg\""), std::string::npos);
  EXPECT_NE(html.find("2 done, 1 without a curve, 1 failed, 0 not reached"), std::string::npos);
  EXPECT_EQ(filesIn(file("sheet_files")).size(), 3u);
  // The curve of the picture lies where that of the output does: its points are within the shape's box.
  const auto path = html.find("<path d=\"M");
  ASSERT_NE(path, std::string::npos);
  double x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(html.c_str() + path, "<path d=\"M%lf %lf", &x, &y), 2);
  const auto truth = test::truthShape("ellipse", 480, 320).outline();
  double nearest = 1e9;
  for (const Vec2& p : truth) nearest = std::min(nearest, (Vec2(x * 0.48, y * 0.48) - p).norm());
  EXPECT_LT(nearest, 0.5) << "px";
}

TEST_F(Batch, AStdoutThatTakesNothingEndsIt) {
  for (const char* name : {"a", "b", "c", "d"}) drawPage(name);
  write("pages.jsonl", line("a") + line("b") + line("c") + line("d"));
  const auto done = runInto(">/dev/full", "batch " + file("pages.jsonl") + " --jobs 1");
  EXPECT_EQ(done.code, 5) << "an output is lost, as elsewhere";
  EXPECT_NE(done.err.find("stdout"), std::string::npos) << done.err;
  EXPECT_FALSE(fs::exists(file("d.svg")));
  const auto results = run("batch " + file("pages.jsonl") + " --jobs 1 --results /dev/full");
  EXPECT_EQ(results.code, 5);
  EXPECT_NE(results.err.find("disk is full"), std::string::npos) << results.err;
  // Through a pipe: a file for what it says would have the same limit.
  const std::string limited = "(ulimit -f 0; '" BATTEN_CLI "' batch " + file("pages.jsonl") + " --jobs 1 --results " +
                              file("r.jsonl") + " 2>&1; echo code $?) | cat >'" + file("limit.txt") + "'";
  ASSERT_EQ(std::system(limited.c_str()), 0);
  const std::string says = test::readFile(file("limit.txt"));
  EXPECT_NE(says.find("file size limit"), std::string::npos) << says;
  EXPECT_NE(says.find("code 5"), std::string::npos) << says;
}

TEST_F(Batch, RunsAsManyPagesAsTheSystemStarts) {
  for (const char* name : {"a", "b", "c"}) drawPage(name);
  write("pages.jsonl", line("a") + line("b") + line("c"));
  // A system that starts no second process while a first one runs.
  const std::string words = "LD_PRELOAD='" BATTEN_FEW_PROCESSES "' '" BATTEN_CLI "' batch " + file("pages.jsonl") +
                            " --existing overwrite --jobs 8 >'" + file("out.txt") + "' 2>'" + file("err.txt") + "'";
  const int status = std::system(words.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << test::readFile(file("err.txt"));
  EXPECT_EQ(statusesOf(test::readFile(file("out.txt"))), (Statuses{"a done", "b done", "c done"}));
  // And one that starts none: the pages are traced one after the other, with the same outputs.
  const std::string before = test::readFile(file("a.svg"));
  ASSERT_FALSE(before.empty());
  const int none = std::system(("BATTEN_NO_PROCESSES=1 " + words).c_str());
  ASSERT_TRUE(WIFEXITED(none));
  EXPECT_EQ(WEXITSTATUS(none), 0) << test::readFile(file("err.txt"));
  EXPECT_EQ(statusesOf(test::readFile(file("out.txt"))), (Statuses{"a done", "b done", "c done"}));
  EXPECT_EQ(test::readFile(file("err.txt")), "");
  EXPECT_EQ(test::readFile(file("a.svg")), before);
  // Nothing ends a page here that takes too long.
  const int timed = std::system(("BATTEN_NO_PROCESSES=1 " + words + " --page-timeout 60").c_str());
  ASSERT_TRUE(WIFEXITED(timed));
  EXPECT_EQ(WEXITSTATUS(timed), 6);
  EXPECT_NE(test::readFile(file("out.txt")).find("leave these out"), std::string::npos);
}

}  // namespace
}  // namespace batten
