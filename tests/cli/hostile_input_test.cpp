// SPDX-License-Identifier: GPL-3.0-or-later
// Input that was made to hang, to crash or to take all memory, and names that are no text.
#include <nlohmann/json.hpp>

#include "tests/cli/hostile_input.h"

namespace batten {
namespace {

using json = nlohmann::json;
using test::HostileInput;
using test::Outcome;

TEST_F(HostileInput, NestedJsonIsRefused) {
  const std::string deep = std::string(80'000, '[') + std::string(80'000, ']');
  write("recipe.json", R"({"format":"batten-recipe","version":)" + deep + "}");
  write("curves.json", R"({"format":"batten-curves","version":)" + deep + "}");
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " --recipe ";
  expectRefused(start + file("recipe.json"), 2, "nested more than 64 levels deep");
  expectRefused("compare " + file("curves.json") + " " + file("curves.json"), 3, "nested more than 64 levels deep");
  write("manifest.jsonl", R"({"scan":"a.png","outputs":)" + deep + "}\n");
  expectRefused("batch " + file("manifest.jsonl"), 2, "Line 1 of the manifest: it is nested more than 64 levels deep");
  write("open.json", std::string(5'000'000, '['));
  expectRefused(start + file("open.json"), 2, "nested more than 64 levels deep");
}

TEST_F(HostileInput, ManyNamesTakeNoTime) {
  std::string text = R"({"format":"batten-recipe","version":1)";
  for (int i = 0; i < 200'000; ++i) text += ",\"k" + std::to_string(i) + "\":0";
  write("keys.json", text + "}");
  expectRefused("trace " + scene() + " -o " + file("o.svg") + " --recipe " + file("keys.json"), 2, "1000 names");
}

TEST_F(HostileInput, LongNamesAndValuesAreQuotedInShort) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " --recipe ";
  const std::string longest(2'000'000, 'n'), most(1000, 'n');
  const auto expectShort = [&](const std::string& words, int code, const std::string& says) {
    expectRefused(words, code, says);
    EXPECT_LT(run(words).err.size(), 500u) << words.substr(0, 200);
  };
  const std::string head = R"({"format":"batten-recipe","version":1,)";
  write("r.json", head + "\"" + longest + "\":0}");
  expectShort(start + file("r.json"), 2, "a name of more than 1000 bytes");
  write("r.json", head + "\"" + most + "\":0}");
  expectShort(start + file("r.json"), 2, "n…\", which this version of Batten does not know");
  write("r.json", head + "\"a\\u0007\\u001b[31m\":0}");
  expectShort(start + file("r.json"), 2, "\"a??[31m\"");
  for (const std::string parameter : {"construct.method", "inks.drop", "fairing.profile"}) {
    write("r.json", head + R"("parameters":{")" + parameter + "\":\"" + longest + "\"}}");
    expectShort(start + file("r.json"), 2, "");
  }
  write("r.json", head + R"("parameters":{")" + most + "\":1}}");
  expectShort(start + file("r.json"), 2, "There is no parameter \"nnn");
  write("c.json", R"({"format":"batten-curves","version":")" + longest + "\"}");
  expectShort("compare " + file("c.json") + " " + file("c.json"), 3, "it is of version");
  expectShort(start + file("r.json") + " --set " + std::string(100'000, 'n') + "=1", 2, "n…\"");
  write("m.jsonl", "{\"" + most + "\":0}\n");
  expectShort("batch " + file("m.jsonl"), 2, "there is no \"nnn");
}

TEST_F(HostileInput, MoreThanADrawingHasIsRefusedAtOnce) {
  const auto listOf = [](int count, const std::string& one) {
    std::string text = one;
    for (int i = 1; i < count; ++i) text += "," + one;
    return "[" + text + "]}";
  };
  const std::string start = R"({"format":"batten-recipe","version":1,"parameters":{},"page":[200,200],)";
  const std::string trace = "trace --recipe " + file("r.json") + " -o " + file("o.svg");
  write("r.json", start + R"("corners":)" + listOf(1'400'000, "[1,2]"));
  expectRefused(trace, 2, "it holds more than 4000000 values");
  write("r.json", start + R"("corners":)" + listOf(100'001, "[1,2]"));
  expectRefused(trace, 2, "It holds 100001 corner marks; at most 100000 can be used.");
  write("r.json", start + R"("strokes":)" + listOf(100'001, R"({"points":[[1,2],[3,4]]})"));
  expectRefused(trace, 2, "It holds 100001 pen strokes; at most 100000 can be used.");
  write("r.json", start + R"("junctions":)" + listOf(100'001, R"({"at":[1,2],"pairs":[]})"));
  expectRefused(trace, 2, "It holds 100001 paired junctions; at most 100000 can be used.");
  std::string pairs = listOf(101, "[[1,2],[3,4]]");
  pairs.pop_back();
  write("r.json", start + R"("junctions":[{"at":[1,2],"pairs":)" + pairs + "}]}");
  expectRefused(trace, 2, "A paired junction holds 101 pairs; at most 100 can be used.");
}

TEST_F(HostileInput, NamesAreBytes) {
  const std::string scan = scene();
  // Two outputs whose names differ in bytes that are no UTF-8 alone.
  const Outcome two = run("trace " + scan + " -o '" + file("\xff.svg") + "' -o '" + file("\xfe.svg") + "'");
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_NE(test::readFile(file("\xff.svg")), "");
  EXPECT_NE(test::readFile(file("\xfe.svg")), "");
  EXPECT_EQ(json::parse(two.out)["files"], json::array({file("\\xff.svg"), file("\\xfe.svg")}));
  for (const char* mark : {"\xef\xbf\xbd", "\\udc"}) EXPECT_EQ(two.out.find(mark), std::string::npos) << two.out;
  write("\xfd.png", test::readFile(scan));
  const Outcome own = run("trace '" + file("\xfd.png") + "' -o '" + file("\xfd.json") + "'");
  ASSERT_EQ(own.code, 0) << own.err;
  EXPECT_EQ(json::parse(own.out)["scan"], (folder_ / "\\xfd.png").string());
  EXPECT_EQ(json::parse(own.out)["checks"][0].get<std::string>().find("\\xfd.json: "), 0u) << own.out;
  // A scan whose name is what a lossy reading would make of another name.
  const std::string lossy = file("\xef\xbf\xbd.png"), bytes = test::readFile(scan);
  write("\xef\xbf\xbd.png", bytes);
  ASSERT_EQ(run("trace '" + lossy + "' --dump 'log=" + file("\xff.png") + "'").code, 0);
  EXPECT_EQ(test::readFile(lossy), bytes);
  // A plain name in a folder whose name is Latin-1.
  std::filesystem::create_directory(file("Entw\xfcrfe"));
  const Outcome inside = run("trace " + scan + " -o '" + file("Entw\xfcrfe/o.svg") + "'");
  EXPECT_EQ(inside.code, 0) << inside.err;
  EXPECT_NE(test::readFile(file("Entw\xfcrfe/o.svg")), "");
  const std::string there = "cd '" + file("Entw\xfcrfe") + "' && '" BATTEN_CLI "' trace '" + scan + "' -o plain.svg";
  EXPECT_EQ(std::system((there + " >'" + file("out.txt") + "'").c_str()), 0);
  EXPECT_NE(test::readFile(file("Entw\xfcrfe/plain.svg")), "");
}

TEST_F(HostileInput, ManyNotesOfAKindAreCounted) {
  const std::string scan = scene();
  json recipe = {{"format", "batten-recipe"}, {"version", 1}, {"parameters", json::object()}};
  json& corners = recipe["corners"] = json::array();
  for (int i = 0; i < 3000; ++i) corners.push_back({1.0 + i % 20, 1.0 + 0.01 * (i / 20)});
  write("many.json", recipe.dump());
  const Outcome done = run("trace " + scan + " --recipe " + file("many.json") + " -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json notes = json::parse(done.out)["notes"];
  EXPECT_LT(notes.size(), 20u) << notes.dump().substr(0, 2000);
  EXPECT_NE(done.out.find("No line lies near 2989 more corners."), std::string::npos) << done.out.substr(0, 3000);
}

TEST_F(HostileInput, TinyFilesTakeLittleMemory) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
  json recipe = {{"format", "batten-recipe"}, {"version", 1}, {"parameters", json::object()}, {"page", {2000, 2000}}};
  for (int i = 0; i < 200; ++i) {
    const json points = {{-1e6, -1e6 + i}, {1e6, 1e6 - i}};
    recipe["strokes"].push_back({{"closed", false}, {"points", points}});
  }
  write("far.json", recipe.dump());
  json large = {{"format", "batten-recipe"}, {"version", 1}, {"parameters", json::object()}, {"page", {20000, 20000}}};
  large["strokes"].push_back({{"closed", false}, {"points", {{100, 100}, {5000, 7000}, {15000, 9000}}}});
  write("page.json", large.dump());
  const Outcome page = run("trace --recipe " + file("page.json") + " -o " + file("page.svg"));
  ASSERT_EQ(page.code, 0) << page.err;
  constexpr std::uint64_t kPagePixels = 20000 * 20000;
  EXPECT_LT(json::parse(page.out)["peak_memory_bytes"].get<std::uint64_t>(), kPagePixels) << "a byte a pixel";
  const Outcome far = run("trace --recipe " + file("far.json") + " -o " + file("far.svg"));
  ASSERT_EQ(far.code, 0) << far.err;
  EXPECT_LT(json::parse(far.out)["peak_memory_bytes"].get<std::uint64_t>(), kMostBytes);
  std::string lines = "0\nSECTION\n2\nENTITIES\n";
  for (int i = 0; i < 200; ++i) {
    const std::string y = std::to_string(i);
    lines += "0\nLINE\n8\n0\n10\n-100000\n20\n" + y + "\n11\n100000\n21\n" + y + "\n";
  }
  write("far.dxf", lines + "0\nENDSEC\n0\nEOF\n");
  const Outcome over =
      run("trace " + scene() + " --dpi 300 --import " + file("far.dxf") + " --import-unit mm -o " + file("over.svg"));
  ASSERT_EQ(over.code, 0) << over.err;
  EXPECT_LT(json::parse(over.out)["peak_memory_bytes"].get<std::uint64_t>(), kMostBytes);
}

TEST_F(HostileInput, ControlCharactersOfANameStayInTheName) {
  const std::string name = file("a\x1b[31m\xc2\x9b\x7f\n\xe2\x80\xae.png");
  write(std::filesystem::path(name).filename().string(), test::readFile(scene()));
  const auto isClean = [](const std::string& text) {
    return text.find('\x1b') == std::string::npos && text.find("\xc2\x9b") == std::string::npos &&
           text.find('\x7f') == std::string::npos && text.find("\xe2\x80\xae") == std::string::npos;
  };
  const Outcome done = run("trace '" + name + "' -o " + file("o.svg"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(isClean(done.out)) << done.out;
  EXPECT_EQ(json::parse(done.out)["scan"], name) << "escaped, not lost";
  const std::string svg = test::readFile(file("o.svg"));
  EXPECT_TRUE(isClean(svg));
  EXPECT_NE(svg.find("<title>a?[31m????.png</title>"), std::string::npos) << svg.substr(0, 600);
  const Outcome missing = run("trace '" + name + "x' -o " + file("o.svg"));
  EXPECT_EQ(missing.code, 3);
  EXPECT_TRUE(isClean(missing.err)) << missing.err;
  // A batch says the same of its pages, wherever its lines go.
  const std::string batch = "batch '" + name + "' --formats svg --to " + file("out");
  const Outcome told = run(batch);
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_TRUE(isClean(told.out)) << told.out;
  EXPECT_EQ(json::parse(told.out)["scan"], name);
  const Outcome manifest = run(batch + " --write-manifest -");
  EXPECT_TRUE(isClean(manifest.out)) << manifest.out;
  write("m.jsonl", manifest.out);
  ASSERT_EQ(run("batch " + file("m.jsonl") + " --results " + file("r.jsonl") + " --existing overwrite").code, 0);
  EXPECT_TRUE(isClean(test::readFile(file("r.jsonl"))));
  EXPECT_EQ(json::parse(test::readFile(file("r.jsonl")))["scan"], name);
}

TEST_F(HostileInput, AFailingDiskGivesFive) {
  const std::string scan = scene();
  write("o.svg", "old");
  const std::string words =
      "LD_PRELOAD='" BATTEN_FAILING_SYNC "' '" BATTEN_CLI "' trace " + scan + " -o " + file("o.svg");
  const int status = std::system((words + " >/dev/null 2>'" + file("err.txt") + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5) << test::readFile(file("err.txt"));
  EXPECT_NE(test::readFile(file("err.txt")).find("disk or its connection failed"), std::string::npos);
  EXPECT_EQ(test::readFile(file("o.svg")), "old");
}

TEST_F(HostileInput, NumbersAreNumbersAndRangesAreTaken) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " ";
  for (const char* dpi : {"0x60", "\"\"", "\" \"", "1e", "300dpi", "3,5", "nan", "inf", "0x1p3"})
    expectRefused(start + "--dpi " + dpi, 2, "--dpi takes a number from 1 to 100000");
  for (const char* dpi : {"0", "0.99", "100001", "-3"})
    expectRefused(start + "--dpi=" + dpi, 2, "between 1 and 100000 dpi");
  for (const char* dpi : {"1", "100000", "+300", "3e2"}) EXPECT_EQ(run(start + "--dpi " + dpi).code, 0) << dpi;
  for (const char* threads : {"0x2", "\"\"", "1.5", "-1", "1025", "two"})
    expectRefused(start + "--threads " + threads, 2, "--threads takes a whole number from 0 to 1024");
  for (const char* threads : {"0", "1", "1024"}) EXPECT_EQ(run(start + "--threads " + threads).code, 0) << threads;
}

TEST_F(HostileInput, EveryNumberIsReadInOneWay) {
  const std::string scan = scene(), start = "trace " + scan + " -o " + file("o.svg") + " ";
  struct Option {
    std::string words, says;
  };
  const Option options[] = {
      {start + "--page ", "--page takes the number of a page, 1 to 100000, or all"},
      {"suggest " + scan + " --page ", "--page takes the number of a page, 1 to 100000, not"},
      {start + "--dpi ", "--dpi takes a number from 1 to 100000"},
      {start + "--threads ", "--threads takes a whole number from 0 to 1024"},
      {"suggest " + scan + " --threads ", "--threads takes a whole number from 0 to 1024"},
      {start + "--scale ", "--scale takes a number from 0.000001 to 1000000"},
      {start + "--tolerance ", "--tolerance takes a length in mm"},
      {start + "--curves ", "umbers such as 1,3-5"},
      {start + "--corner ", "--corner takes X,Y"},
      {start + "--segment-point ", "--segment-point takes X,Y"},
      {start + "--outline ", "--outline takes X,Y"},
      {start + "--centreline ", "--centreline takes X,Y"},
      {start + "--direction ", "--direction takes X,Y,X,Y"},
      {start + "--start ", "--start takes X,Y"},
      {start + "--roi ", "--roi takes X,Y,WIDTH,HEIGHT"},
      {start + "--known-length ", "--known-length takes X,Y,X,Y,LENGTH"},
      {start + "--set fairing.tolerance=", "fairing.tolerance cannot be"},
      {"suggest " + scan + " --set edges.merge=", "edges.merge cannot be"},
      {"batch " + scan + " --to " + file("out") + " --dpi ", "--dpi takes a number from 1 to 100000"},
      {"batch " + scan + " --to " + file("out") + " --jobs ", "--jobs takes a whole number from 0 to 1024"},
      {"batch " + scan + " --to " + file("out") + " --first-line ", "--first-line takes a whole number"},
      {"batch " + scan + " --to " + file("out") + " --page-timeout ", "--page-timeout takes seconds"},
      {"batch " + scan + " --to " + file("out") + " --max-failures ", "--max-failures takes a fraction"},
  };
  for (const auto& [words, says] : options) {
    for (const char* value : {"\"\"", "0x10", "1e999", "nan", "inf", "1.2.3", "five"})
      expectRefused(words + value, 2, says);
  }
  const std::string pdf = file("scan.pdf");
  write("scan.pdf", "%PDF-1.4\n");
  for (const char* dpi : {"19.9", "4801", "\"\"", "0x60"})
    expectRefused("trace " + pdf + " -o " + file("o.svg") + " --dpi " + dpi, 2, "--dpi takes a number from 20 to 4800");
  for (const char* page : {"0", "-1", "100001", "1.5"}) {
    expectRefused(start + "--page=" + page, 2, "1 to 100000, or all");
    expectRefused("suggest " + scan + " --page=" + page, 2, "1 to 100000, not");
  }
  expectRefused("suggest " + scan + " --page all", 2, "1 to 100000, not");
  EXPECT_EQ(run("suggest " + scan + " --page ' +1 '").code, 0) << "blanks and a plus sign are taken, as in recipes";
}

TEST_F(HostileInput, GoesOnWithTheThreadsThereAre) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return;  // they take more memory than is left here
#endif
  const std::string scan = scene();
  ASSERT_EQ(run("trace " + scan + " -o " + file("all.json")).code, 0);
  // Room for the program, and for some of sixty-four stacks.
  const std::string words = "ulimit -v 600000; '" BATTEN_CLI "' trace " + scan + " --threads 64 -o " + file("few.json");
  const int status = std::system(("sh -c \"" + words + "\" >/dev/null 2>'" + file("err.txt") + "'").c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << test::readFile(file("err.txt"));
  EXPECT_EQ(test::readFile(file("few.json")), test::readFile(file("all.json")));
}

TEST_F(HostileInput, SaysWhatFairingRefusedOrLeft) {
  // A profile of constant curvature is out of reach for half an ellipse within a hundredth of a millimetre.
  const Outcome done =
      run("trace " + scene() + " -o " + file("o.svg") +
          " --set fairing.mode=target --set fairing.target=1 --set fairing.tolerance=0.01 --set fairing.spans=whole");
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("Curve 1, fairing: "), std::string::npos) << done.out;
  const Outcome plain = run("trace " + scene() + " -o " + file("o.svg"));
  EXPECT_EQ(plain.out.find("fairing: "), std::string::npos) << plain.out;
  const json line = {{"points", {{20, 20}, {300, 60}}}};
  json recipe = {{"format", "batten-recipe"}, {"version", 1}, {"page", {400, 300}}, {"strokes", json::array({line})}};
  recipe["parameters"]["fairing.mode"] = "tolerance";
  write("line.json", recipe.dump());
  const Outcome left = run("trace --recipe " + file("line.json") + " -o " + file("o.svg"));
  EXPECT_NE(left.out.find("Curve 1, fairing: Unchanged: exact line."), std::string::npos) << left.out << left.err;
}

TEST_F(HostileInput, TargetsAreInTheReportOnlyWhenAskedFor) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " --report " + file("r.json");
  ASSERT_EQ(run(start).code, 0);
  EXPECT_FALSE(json::parse(test::readFile(file("r.json")))["curves"][0].contains("targets"));
  ASSERT_EQ(run(start + " --report-targets").code, 0);
  EXPECT_EQ(json::parse(test::readFile(file("r.json")))["curves"][0]["targets"].size(), 6u);
  expectRefused("trace " + file("scan.png") + " -o " + file("o.svg") + " --report-targets", 2, "--report");
}

}  // namespace
}  // namespace batten
