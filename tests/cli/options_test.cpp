// SPDX-License-Identifier: GPL-3.0-or-later
// Options of an export that can have no effect are refused, and every message says what is taken.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/exchange/format_options.h"
#include "core/exchange/model/export_settings.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Options = test::Program;

TEST_F(Options, WithoutEffectOnAnyOutputAreRefused) {
  const std::string start = "trace " + scene() + " --dpi 254 ";
  const auto refused = [&](const std::string& words, const char* ending, const std::string& says) {
    expectError(start + words + " -o " + file(std::string("a") + ending), 2, says);
    EXPECT_FALSE(std::filesystem::exists(file(std::string("a") + ending))) << words;
  };
  for (const char* words : {"--splines-only", "--chords", "--flavour cubic", "--unit in", "--joined"})
    refused(words, ".svg", "has no effect on");
  refused("--chords", ".dxf", ".dxf with --preset cnc");
  refused("--width-outline", ".pdf", ".svg");
  refused("--flavour bezier", ".dxf", ".igs, .step and .3dm");
  refused("--tolerance 0.1", ".step", "--flavour cubic");
  refused("--joined", ".csv", ".dxf, .igs, .step and .3dm");
  refused("--apart", ".dxf", ".svg, .pdf");
  refused("--unit in", ".json", ".csv");
  expectError(start + "--paper a4 -o " + file("a.svg"), 2, "--paper");
  for (const char* words : {"--scale 2", "--curves 1", "--which both", "--unit in"})
    expectError(start + words + " --report " + file("r.json"), 2, words[2] == 'u' ? "no effect" : "none is written");
}

TEST_F(Options, ALengthOnTheScanNeedsOne) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o " + file("a.dxf")).code, 0);
  expectError("trace " + file("a.dxf") + " --known-length 1,1,2,2,10mm -o " + file("b.svg"), 2, "--known-length sets");
}

TEST_F(Options, WithAnEffectOnOneOutputAreTaken) {
  const std::string start = "trace " + scene() + " --dpi 254 ";
  const auto taken = [&](const std::string& words, std::initializer_list<const char*> endings) {
    std::string all = start + words;
    for (const char* ending : endings) all += " -o " + file(std::string("a") + ending);
    const auto done = run(all);
    EXPECT_EQ(done.code, 0) << words << done.err;
  };
  taken("--unit in --joined --splines-only", {".svg", ".dxf", ".json"});
  taken("--tolerance 0.01 --flavour cubic", {".3dm"});
  taken("--tolerance 0.05 --chords --preset cnc", {".dxf"});
  taken("--apart", {".csv", ".dxf"});
  taken("--paper letter", {".svg", ".report.pdf"});
}

TEST_F(Options, StrokesAreOutlinedOnRequest) {
  // A bar 5 px high on white paper.
  std::string pixels(320 * 100, '\xff');
  for (std::size_t y = 0; y < 100; ++y)
    for (std::size_t x = 20; x < 300; ++x)
      if (y >= 58 && y <= 62) pixels[y * 320 + x] = '\x10';
  write("bar.pgm", "P5\n320 100\n255\n" + pixels);
  const std::string start = "trace " + file("bar.pgm") + " --set filter.iterations=0 --dpi 254 ";
  ASSERT_EQ(run(start + " -o " + file("plain.svg")).code, 0);
  EXPECT_EQ(test::readFile(file("plain.svg")).find("width-of"), std::string::npos);
  const auto done = run(start + " --width-outline -o " + file("wide.svg") + " -o " + file("wide.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("outlined within"));
  EXPECT_THAT(test::readFile(file("wide.svg")), HasSubstr("batten:width-of=\"curve-1\""));
  EXPECT_THAT(test::readFile(file("wide.json")), HasSubstr("\"width_mm\""));
  // The file opens again with its curves alone.
  ASSERT_EQ(run("trace " + file("wide.svg") + " -o " + file("again.json")).code, 0);
  const auto count = [&](const char* name) {
    const auto read = json::parse(test::readFile(file(name)));
    return read["curves"].size();
  };
  EXPECT_EQ(count("again.json"), count("wide.json"));
}

TEST_F(Options, APresetTakesEveryFormatOfItsReceiver) {
  const std::string start = "trace " + scene() + " --dpi 254 --preset ";
  for (const ExportPreset& preset : exportPresets()) {
    std::string words = start + preset.id;
    for (const ExportFormat format : formatsOf(preset))
      for (const char* ending : endingsOf(format)) words += " -o " + file(std::string("a") + ending);
    const auto done = run(words);
    EXPECT_EQ(done.code, 0) << preset.id << done.err;
  }
  expectError(start + "rhino -o " + file("b.svg"), 2, "end in .stp, .step, .igs, .iges, .3dm or .dxf");
  ASSERT_EQ(run(start + "icem -o " + file("c.step")).code, 0);
  EXPECT_THAT(test::readFile(file("c.step")), HasSubstr("B_SPLINE_CURVE_WITH_KNOTS"));
}

TEST_F(Options, NumbersThatAreNoneAreSaidToBe) {
  const std::string start = "trace " + scene() + " --dpi 254 -o " + file("a.svg");
  expectError(start + " --scale abc", 2,
              "--scale takes a number from 0.000001 to 1000000, such as 0.5 or 2, not \"abc\"");
  expectError(start + " --scale nan", 2, "--scale takes");
  expectError(start + " --tolerance x", 2, "--tolerance takes a length in mm, such as 0.005, not \"x\"");
}

TEST_F(Options, AFileOfWhichNothingCanBeReadIsDamaged) {
  write("nan.svg", "<svg xmlns='http://www.w3.org/2000/svg'><path d='M nan 0 L 5 5'/></svg>");
  expectError("trace " + file("nan.svg") + " -o " + file("o.dxf"), 3, "nan.svg");
  write("empty.csv", "");
  expectError("trace " + file("empty.csv") + " -o " + file("o.dxf"), 3, "the file is empty");
  write("blank.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  expectError("trace " + file("blank.svg") + " -o " + file("o.dxf"), 4, "It contains no line");
}

TEST_F(Options, ALargeScaleIsTakenByEveryFormat) {
  std::string words = "trace " + scene() + " --dpi 254 --scale 100000";
  for (const char* ending : {"svg", "json", "dxf", "igs", "step", "3dm", "poly.csv"})
    words += " -o " + file(std::string("a.") + ending);
  const auto done = run(words);
  EXPECT_EQ(done.code, 0) << done.err;
  expectError("trace " + scene() + " --dpi 254 --scale 1000000 -o " + file("a.csv"), 2, "over a million rows");
}

TEST_F(Options, FilesThatAreNotReadAndFormatsThatAreNotWrittenAreNamedAtOnce) {
  write("a.3dm", "anything");
  expectError("trace " + file("a.3dm") + " -o " + file("o.svg"), 3,
              "Curves are not read from a.3dm. Save them as one of .dxf");
  expectError("batch " + scene() + " --to " + file("out") + " --formats svg,xyz", 2,
              "there is no format \"xyz\". Formats: svg, json, dxf");
  EXPECT_FALSE(std::filesystem::exists(file("out")));
  ASSERT_EQ(run("batch " + scene() + " --dpi 254 --to " + file("out") + " --formats poly.csv").code, 0);
  EXPECT_TRUE(std::filesystem::exists(file("out/scan.poly.csv")));
}

TEST_F(Options, ResultLinesHaveSensibleDigits) {
  const auto done = run("trace " + scene() + " --dpi 254 --explain -o " + file("a.svg") + " -o " + file("a.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json said = json::parse(done.out);
  const auto decimalsOf = [](const json& number) {
    const std::string text = number.dump();
    const auto dot = text.find('.');
    return dot == std::string::npos ? 0 : static_cast<int>(text.size() - dot - 1);
  };
  EXPECT_LE(decimalsOf(said["milliseconds"]), 1) << said["milliseconds"];
  EXPECT_LE(decimalsOf(said["processor_milliseconds"]), 1) << said["processor_milliseconds"];
  for (const json& share : said["explanation"]) EXPECT_LE(decimalsOf(share), 4) << share;
  const json pairs = json::parse(run("compare " + file("a.json") + " " + file("a.svg")).out)["pairs"];
  for (const char* figure : {"similarity", "pearson", "curvature_similarity", "curvature_pearson", "shift"})
    EXPECT_LE(decimalsOf(pairs[0][figure]), 6) << figure;
  for (const json& corner : json::parse(run("suggest " + scene("car")).out)["corners"]) {
    EXPECT_LE(decimalsOf(corner["certainty"]), 3);
    EXPECT_LE(decimalsOf(corner["at"][0]), 2);
  }
}

/// "curves" are the lines of the drawing and "pieces" their parts from corner to corner, in all that one line says.
TEST_F(Options, AResultLineCallsOneThingByOneWord) {
  const std::string sample = BATTEN_SAMPLE;
  const auto done = run("trace " + sample + " --recipe " + sample.substr(0, sample.rfind('.')) + ".recipe.json -o " +
                        file("a.json") + " -o " + file("a.svg") + " -o " + file("a.dxf"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json said = json::parse(done.out);
  EXPECT_EQ(said["curves"], 7);
  EXPECT_EQ(said["pieces"], 14);
  for (const json& check : said["checks"])
    EXPECT_THAT(check.get<std::string>(), HasSubstr(": 7 curves in 14 pieces")) << check;
  const auto some = run("trace " + sample + " --curves 1 -o " + file("b.json"));
  EXPECT_EQ(json::parse(some.out)["pieces"], 1) << "what is written counts";
}

}  // namespace
}  // namespace batten
