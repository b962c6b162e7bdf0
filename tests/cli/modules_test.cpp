// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the program that lie in files of their own: what it says where they are missing.
#include <gmock/gmock.h>

#include "core/exchange/occt/open_cascade.h"
#include "tests/cli/program.h"

namespace batten {
namespace {

using testing::HasSubstr;

/// The program in a folder without the files that it loads when it needs them.
class WithoutModules : public test::Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::filesystem::create_directories(file("bin"));
    std::filesystem::copy_file(BATTEN_CLI, file("bin/batten-cli"));
    write("roof.csv", "curve,x_mm,y_mm\nroof,0,0\nroof,30,12\nroof,60,15\nroof,90,10\n");
  }
  test::Outcome traceTo(const std::string& name) const {
    return runProgram(file("bin/batten-cli"), "trace '" + file("roof.csv") + "' -o '" + file(name) + "'");
  }
  void expectRefused(const std::string& name) const {
    const auto outcome = traceTo(name);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(name + ": IGES and STEP need the program's file libbatten-cad"));
    EXPECT_THAT(outcome.err, HasSubstr("Install Batten again, or export to DXF or 3DM."));
    EXPECT_FALSE(std::filesystem::exists(file(name)));
  }
};

TEST_F(WithoutModules, IgesAndStepAreRefusedAndOtherFormatsWritten) {
  if (!hasOpenCascade()) GTEST_SKIP() << "built without Open CASCADE";
  expectRefused("roof.igs");
  expectRefused("roof.step");
  for (const char* name : {"roof.dxf", "roof.3dm"}) {
    const auto outcome = traceTo(name);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(file(name)));
  }
}

TEST_F(WithoutModules, AFileThatIsNoneCountsAsMissing) {
  if (!hasOpenCascade()) GTEST_SKIP() << "built without Open CASCADE";
  std::filesystem::create_directories(file("lib/batten/modules"));
  write("lib/batten/modules/libbatten-cad.so", "no library\n");
  expectRefused("roof.igs");
}

}  // namespace
}  // namespace batten
