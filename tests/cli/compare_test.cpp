// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using Compare = test::Program;

TEST_F(Compare, TheSameShapeAtAnotherScaleIsTheSameAndAnotherShapeIsNot) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o " + file("a.json")).code, 0);
  ASSERT_EQ(run("trace " + scene() + " --dpi 100 --set fairing.mode=monotone -o " + file("b.json")).code, 0);
  const auto done = run("compare " + file("a.json") + " " + file("b.json"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json same = json::parse(done.out);
  ASSERT_EQ(same["pairs"].size(), 1u);
  EXPECT_GT(same["pairs"][0]["similarity"].get<double>(), 0.999);
  EXPECT_GT(same["pairs"][0]["pearson"].get<double>(), 0.99);
  EXPECT_EQ(same["pairs"][0]["first"], "curve-1");
  ASSERT_EQ(run("trace " + scene("car") + " -o " + file("c.json")).code, 0);
  const json other = json::parse(run("compare " + file("a.json") + " " + file("c.json")).out);
  EXPECT_LT(other["pairs"][0]["pearson"].get<double>(), 0.9);
}

TEST_F(Compare, ReadsEveryFormatThatHoldsTheCurvesThemselves) {
  const std::string words = "trace " + scene() + " --dpi 254 --unit in -o " + file("a.json") + " -o " + file("a.svg") +
                            " -o " + file("a.dxf") + " -o " + file("a.igs") + " -o " + file("a.step");
  ASSERT_EQ(run(words).code, 0);
  for (const char* other : {"a.svg", "a.dxf", "a.igs", "a.step"}) {
    const auto done = run("compare " + file("a.json") + " " + file(other));
    ASSERT_EQ(done.code, 0) << other << done.err;
    EXPECT_GT(json::parse(done.out)["pairs"][0]["similarity"].get<double>(), 0.999999) << other;
  }
}

TEST_F(Compare, SaysWhatIsWrong) {
  write("broken.json", "{");
  expectError("compare " + file("broken.json") + " " + file("broken.json"), 3,
              "broken.json: The curve file cannot be read: it is incomplete or was not written by "
              "Batten. Create it again");
  expectError("compare " + file("none.json") + " " + file("none.json"), 3, "does not exist. Check the name.\n");
  write("broken.dxf", "bad");
  expectError("compare " + file("broken.dxf") + " " + file("broken.dxf"), 3, "a group code was expected.\n");
  expectError("compare " + file("a.csv") + " " + file("a.csv"), 3, "Use a .json, .svg, .dxf, .igs or .step file.\n");
  expectError("compare " + file("none.json"), 2, "second");
}

}  // namespace
}  // namespace batten
