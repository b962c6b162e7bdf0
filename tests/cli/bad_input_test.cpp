// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace batten {
namespace {

using BadInput = test::Program;
using test::Outcome;

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
  }
  return ~crc;
}

std::string bigEndian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

/// A valid PNG head that promises a size, and nothing behind it.
std::string pngHead(std::uint32_t width, std::uint32_t height) {
  const std::string chunk = "IHDR" + bigEndian(width) + bigEndian(height) + std::string("\x08\x00\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" + bigEndian(13) + chunk + bigEndian(crc32(chunk));
}

/// A whole PNG of 100 x 100 grey pixels that holds ten rows only: the decoder itself complains.
std::string pngOfTenRows() {
  const auto chunk = [](const std::string& name, const std::string& data) {
    return bigEndian(static_cast<std::uint32_t>(data.size())) + name + data + bigEndian(crc32(name + data));
  };
  // A zlib stream of one stored block: 1010 zeros, whose Adler-32 is 1010 << 16 | 1.
  const std::string stored = std::string("\x78\x01\x01\xf2\x03\x0d\xfc", 7) + std::string(1010, '\0');
  return pngHead(100, 100) + chunk("IDAT", stored + bigEndian((1010u << 16) | 1u)) + chunk("IEND", "");
}

TEST_F(BadInput, FilesThatAreNoScanGiveThree) {
  const std::string out = " -o " + file("o.svg");
  const std::string good = test::readFile(scene());
  expectError("trace " + file("missing.png") + out, 3, "missing.png");
  expectError("trace " + folder_.string() + out, 3, "");
  write("empty.png", "");
  expectError("trace " + file("empty.png") + out, 3, "empty");
  write("text.png", "This is a letter, not a picture.\n");
  expectError("trace " + file("text.png") + out, 3, "");
  for (const std::size_t length : {std::size_t{4}, std::size_t{20}, std::size_t{40}, good.size() / 2}) {
    write("cut.png", good.substr(0, length));
    expectError("trace " + file("cut.png") + out, 3, "");
  }
  write("short.png", pngOfTenRows());
  expectError("trace " + file("short.png") + out, 3, "damaged");
  write("huge.png", pngHead(30000, 30000));
  expectError("trace " + file("huge.png") + out, 3, "");
  write("absurd.png", pngHead(0x7fffffff, 0x7fffffff));
  expectError("trace " + file("absurd.png") + out, 3, "");
  EXPECT_FALSE(std::filesystem::exists(file("o.svg")));
}

TEST_F(BadInput, PicturesWithoutALineGiveFour) {
  const std::string out = " -o " + file("o.svg");
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 7}, {200, 150}}) {
    write("white.png", pngOf(GreyImage(width, height, 65535)));
    expectError("trace " + file("white.png") + out, 4, "");
    write("black.png", pngOf(GreyImage(width, height, 0)));
    expectError("trace " + file("black.png") + out, 4, "");
  }
  EXPECT_FALSE(std::filesystem::exists(file("o.svg")));
}

TEST_F(BadInput, WithoutACurveReportAndDumpsStillShowWhy) {
  write("white.png", pngOf(GreyImage(200, 150, 65535)));
  expectError("trace " + file("white.png") + " -o " + file("o.svg") + " --report " + file("r.json") +
                  " --dump log=" + file("l.png"),
              4, "");
  const auto report = nlohmann::json::parse(test::readFile(file("r.json")));
  EXPECT_TRUE(report.contains("error"));
  // Even the stage that failed says how long it took.
  EXPECT_EQ(report["stages"].back()["stage"], report["error"]["stage"]);
  for (const auto& stage : report["stages"]) EXPECT_GT(stage["milliseconds"].get<double>(), 0.0) << stage;
  EXPECT_TRUE(std::filesystem::exists(file("l.png")));
}

TEST_F(BadInput, WrongWordsGiveTwo) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " ";
  expectError("", 2, "Name a command: trace, suggest, batch, parameters and compare.");
  expectError("trase scan.png", 2, "There is no command trase. Did you mean trace?");
  expectError("frobnicate", 2, "There is no command frobnicate. There are trace");
  expectError("trace", 2, "");
  expectError("paint", 2, "");
  expectError("trace " + file("scan.png"), 2, "-o");
  expectError("trace " + file("scan.png") + " -o " + file("o.dwg"), 2, ".svg");
  expectError("trace " + file("scan.png") + " -o " + file("scan.png"), 2, "");
  expectError(start + "--unknown", 2, "--unknown");
  expectError(start + "-o " + file("o.svg"), 2, "twice");
  expectError(start + "--set filter.coefficient", 2, "value");
  expectError(start + "--set filter.coefficient=9", 2, "filter.coefficient");
  expectError(start + "--set filter.coeficient=2", 2, "Did you mean filter.coefficient?");
  expectError(start + "--set coefficient=2", 2, "Did you mean filter.coefficient?");
  expectError(start + "--set foo.bar=2", 2, "There is no parameter \"foo.bar\". batten-cli parameters lists them all.");
  expectError(start + "--corner 12", 2, "X,Y");
  expectError(start + "--corner a,b", 2, "X,Y");
  expectError(start + "--dpi -3", 2, "dpi");
  expectError(start + "--dpi nan", 2, "");
  expectError(start + "--threads -1", 2, "");
  expectError(start + "--dump nothing=" + file("a.png"), 2, "thresholds");
  expectError(start + "--dump log=" + file("a.jpg"), 2, ".png");
  expectError(start + "--recipe " + file("none.json"), 2, "none.json");
  write("broken.json", "{\"format\":\"batten-recipe\",");
  expectError(start + "--recipe " + file("broken.json"), 2, "damaged");
}

TEST_F(BadInput, PlacesOffEveryPageAreRefused) {
  const std::string start = "trace " + scene("car") + " -o " + file("o.svg") + " ";
  for (const char* at : {"5000000000,5", "1e10,1e10", "-1e12,3", "1e300,0", "3,-1e300"})
    expectError(start + "--corner=" + at, 2, "corner mark has an invalid position");
  expectError(start + "--corner=1e10,3,2", 2, "corner mark has an invalid position");
  expectError(start + "--segment-point=1e300,0", 2, "segment point has an invalid position");
  expectError(start + "--outline=1e300,0", 2, "trace mode choice has an invalid position");
  expectError(start + "--centreline=7", 2, "X,Y");
  expectError(start + "--roi=-1e10,0,50,50", 2, "region has an invalid position");
  for (const std::string entry :
       {R"("corners":[[1e10,3.0]])", R"("corners":[{"at":[1e10,3],"round":2}])", R"("segment_points":[[1e10,3]])",
        R"("extrema":[{"at":[-1e300,3],"keep":true}])", R"("regions":[[[0,0],[9,1e10],[9,9]]])",
        R"("strokes":[{"points":[[1,1],[5,1e10]]}])", R"("ways":[{"at":[1e10,3],"mode":"outline"}])",
        R"("painted":[{"mode":"outline","radius":3,"course":[[1,1],[1,1e10]]}])", R"("choices":[{"anchor":[1e10,3]}])",
        R"("choices":[{"anchor":[1,1],"keep":[[1e10,3]]}])", R"("choices":[{"anchor":[1,1],"splits":[[0,-1e10]]}])"}) {
    write("far.json", R"({"format":"batten-recipe","version":1,)" + entry + "}");
    expectError(start + "--recipe " + file("far.json"), 2, "1000000 px");
  }
  for (const char* at : {"nan,5", "5,inf", "-nan,nan"}) expectError(start + "--corner=" + at, 2, "X,Y");
  // Far away, but a place: there is merely no line.
  const Outcome done = run(start + "--corner=999999,-999999");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("No line lies near the corner"), std::string::npos) << done.out;
}
TEST_F(BadInput, NothingIsWrittenOverTheScanOrTheRecipe) {
  namespace fs = std::filesystem;
  const std::string scan = scene(), bytes = test::readFile(scan);
  ASSERT_EQ(run("trace " + scan + " --save-recipe " + file("r.json")).code, 0);
  const std::string recipe = test::readFile(file("r.json"));
  fs::create_symlink(scan, file("link.png"));
  fs::create_hard_link(scan, file("hard.png"));
  fs::create_directory_symlink(folder_, file("same"));
  fs::create_symlink(file("r.json"), file("linked.json"));
  for (const std::string& name :
       {file("link.png"), file("hard.png"), file("same/scan.png"), file("./no/../scan.png")}) {
    expectError("trace " + scan + " --dump log=" + name, 2, "is the scan itself");
    expectError("trace " + name + " --dump log=" + scan, 2, "is the scan itself");
  }
  // One name relative to the present folder, the other absolute.
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  expectError("trace scan.png --dump log=" + scan, 2, "is the scan itself");
  expectError("trace " + scan + " --dump log=scan.png", 2, "is the scan itself");
  expectError("trace scan.png --recipe r.json -o " + file("r.json"), 2, "is the recipe itself");
  expectError("trace scan.png -o o.svg -o " + file("o.svg"), 2, "twice");
  fs::current_path(before);
  expectError("trace " + scan + " --recipe " + file("r.json") + " -o " + file("r.json"), 2, "is the recipe itself");
  expectError("trace " + scan + " --recipe " + file("linked.json") + " --report " + file("r.json"), 2, "recipe itself");
  EXPECT_EQ(test::readFile(scan), bytes);
  EXPECT_EQ(test::readFile(file("r.json")), recipe);
  // A recipe may be brought up to date in its place.
  const Outcome done = run("trace " + scan + " --recipe " + file("r.json") +
                           " --set filter.iterations=4 --save-recipe " + file("r.json"));
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(test::readFile(file("r.json")), recipe);
}

TEST_F(BadInput, AStdoutThatTakesNothingGivesFive) {
  const std::string scan = scene();
  ASSERT_EQ(run("trace " + scan + " -o " + file("a.json")).code, 0);
  for (const char* where : {">/dev/full", ">&-"}) {
    for (const std::string& words :
         {"trace " + scan + " -o " + file("o.svg"), "compare " + file("a.json") + " " + file("a.json"),
          std::string("parameters"), std::string("parameters --json"), std::string("--help"),
          std::string("--version")}) {
      const Outcome done = runInto(where, words);
      EXPECT_EQ(done.code, 5) << words << " " << where;
      EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
      EXPECT_NE(done.err.find("stdout"), std::string::npos) << done.err;
    }
  }
}

TEST_F(BadInput, NumbersThatDoNotFitAreNotCutToFit) {
  const std::string start = "trace " + scene() + " -o " + file("o.svg") + " --recipe " + file("r.json");
  for (const char* number : {"4294967297", "-4294967295", "18446744073709551617", "18446744073709551615"}) {
    for (const std::string& entry : {"\"choices\":[{\"anchor\":[1,1],\"target\":" + std::string(number) + "}]",
                                     "\"choices\":[{\"anchor\":[1,1],\"keep_extrema\":" + std::string(number) + "}]",
                                     "\"page\":[" + std::string(number) + ",400]",
                                     "\"parameters\":{\"filter.coefficient\":" + std::string(number) + "}"}) {
      write("r.json", "{\"format\":\"batten-recipe\",\"version\":1," + entry + "}");
      expectError(start, 2, "recipe");
    }
    write("r.json", "{\"format\":\"batten-recipe\",\"version\":" + std::string(number) + "}");
    expectError(start, 2, "recipe");
  }
}

TEST_F(BadInput, PlacesThatTakeNoFileGiveFive) {
  const std::string scan = scene();
  expectError("trace " + scan + " -o " + file("no/such/o.svg"), 5, "does not exist");
  std::filesystem::create_directories(file("folder.svg"));
  expectError("trace " + scan + " -o " + file("folder.svg"), 5, "folder");
  expectError("trace " + scan + " -o " + file("o.svg") + " --report " + file("no/r.json"), 5, "does not exist");
  EXPECT_FALSE(std::filesystem::exists(file("o.svg"))) << "it is known before the work";
}

TEST_F(BadInput, AFolderWithoutPermissionIsKnownBeforeTheWork) {
  namespace fs = std::filesystem;
  const fs::path locked = file("locked");
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  // For the administrator, who may write anywhere else, a folder of the system.
  const bool isAdministrator = std::ofstream(locked / "probe").is_open();
  const std::string place = isAdministrator ? "/sys/kernel/" : locked.string() + "/";
  const std::string curves = "trace " + scene() + " -o " + file("o.svg");
  write("o.svg", "old");
  for (const std::string& words :
       {" -o " + place + "a.dxf", " -o " + place + "a.report.html", " --dump edges=" + place + "a.png",
        " --report " + place + "a.json", " --save-recipe " + place + "r.json"}) {
    expectError(curves + words, 5, "Choose another place");
    EXPECT_EQ(test::readFile(file("o.svg")), "old") << "nothing was begun: " << words;
  }
  fs::permissions(locked, fs::perms::owner_all);
  // The check leaves nothing and keeps what is there: here the work comes to no curve.
  write("blank.png", pngOf(GreyImage(100, 80, 65535)));
  fs::create_directory(file("out"));
  write("out/b.svg", "old");
  expectError("trace " + file("blank.png") + " -o " + file("out/b.svg") + " -o " + file("out/b.json"), 4, "");
  EXPECT_EQ(test::readFile(file("out/b.svg")), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(file("out")), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace batten
