// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/exchange/cad/iges_reader.h"
#include "core/exchange/cad/step_reader.h"
#include "core/exchange/occt/open_cascade.h"
#include "tests/unit/exchange/import_folder.h"

namespace batten {
namespace {

using test::damage;
using test::exported;

TEST(IgesReader, SurvivesDamage) {
  if (!hasOpenCascade()) return;  // nothing to damage; what others write is read below
  const std::string whole = exported(".igs");
  for (std::size_t length = 0; length + 160 < whole.size(); length += 97)
    EXPECT_FALSE(parseIges(whole.substr(0, length))) << length;
  damage(
      whole, [](const std::string& text) { return parseIges(text); }, 331);
}

/// A file of lines for the sections; the data of every entity begin in a line of their own.
std::string igesOf(const std::vector<std::pair<std::string, std::string>>& entities,
                   const std::string& unit = "2,2HMM") {
  const auto line = [](std::string text, char section, std::size_t number) {
    text.resize(72, ' ');
    std::string digits = std::to_string(number);
    return text + section + std::string(7 - std::min<std::size_t>(7, digits.size()), ' ') + digits + "\n";
  };
  const auto field = [](const std::string& text) {
    return std::string(8 - std::min<std::size_t>(8, text.size()), ' ') + text;
  };
  std::string file = line("made by hand", 'S', 1);
  file += line("1H,,1H;,4Hself,5Ha.igs,4Htest,4Htest,32,38,6,308,15,4Hself,1.," + unit + ",1,0.01,", 'G', 1);
  file += line("15H20260101.000000,1E-6,1000.,2Hme,2Hme,11,0,15H20260101.000000;", 'G', 2);
  constexpr std::size_t kColumns = 64;  // of data in a line
  std::string data;
  std::size_t next = 1;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const std::string& parameters = entities[i].second;
    const std::size_t lines = (parameters.size() + kColumns - 1) / kColumns;
    const std::string type = entities[i].first.substr(0, entities[i].first.find(' '));
    const std::string matrix = entities[i].first.find(' ') == std::string::npos
                                   ? "0"
                                   : entities[i].first.substr(entities[i].first.find(' ') + 1);
    file += line(field(type) + field(std::to_string(next)) + field("0") + field("0") + field("0") + field("0") +
                     field(matrix) + field("0") + field("00000000"),
                 'D', 2 * i + 1);
    file += line(field(type) + field("0") + field("0") + field(std::to_string(lines)) + field("0") + field("") +
                     field("") + field("") + field("0"),
                 'D', 2 * i + 2);
    for (std::size_t k = 0; k < lines; ++k) data += line(parameters.substr(k * kColumns, kColumns), 'P', next + k);
    next += lines;
  }
  return file + data + line("S      1G      2D      2P      1", 'T', 1);
}

TEST(IgesReader, ReadsWhatOthersWrite) {
  const auto drawing =
      parseIges(igesOf({{"110", "110,0.,0.,0.,10.,5.,0.;"},
                        {"100", "100,0.,1.,1.,3.,1.,1.,3.;"},
                        {"110 7", "110,0.,0.,0.,1.D0,0.,0.;"},
                        {"124", "124,0.,-1.,0.,5.,1.,0.,0.,7.,0.,0.,1.,0.;"},
                        {"106", "106,1,3,0.,0.,0.,1.,1.,2.,0.;"},
                        {"104", "104,.25,0.,1.,0.,0.,-1.,0.,2.,0.,0.,1.;"},
                        {"112", "112,3,1,2,1,0.,2.,1.,3.,0.,0.,5.,0.,1.,0.,0.,0.,0.,0.;"},
                        {"108", "108,1.,0.,0.,0.,0;"},
                        {"126", "126,1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,4.,4.,0.,.25,1.,0.,0.,1.;"},
                        {"406", "406,1,4Hname;"}},
                       "1,2HIN"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 25.4);
  EXPECT_EQ(drawing->left, 1) << "the plane";
  ASSERT_EQ(drawing->entities.size(), 7u);
  EXPECT_LT((std::get<CadLine>(drawing->entities[0].shape).to - Vec2(10, 5)).norm(), 1e-12);
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[1].shape).sweepRad, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_LT((pointAt(drawing->entities[2].shape, 1.0) - Vec2(5, 8)).norm(), 1e-12) << "turned and moved";
  EXPECT_EQ(std::get<CadPolyline>(drawing->entities[3].shape).vertices.size(), 3u);
  EXPECT_LT((pointAt(drawing->entities[4].shape, 0.0) - Vec2(2, 0)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[4].shape, 1.0) - Vec2(0, 1)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[5].shape, 0.5) - Vec2(4, 6)).norm(), 1e-12) << "1 + 3 t, 5 + t^2 at 1";
  EXPECT_LT((pointAt(drawing->entities[6].shape, 0.0) - Vec2(1, 1)).norm(), 1e-12) << "cut to its parameters";
}

TEST(IgesReader, RefusesCountsThatCannotBe) {
  for (const char* data :
       {"126,2000000000,5,0,0,1,0,0.;", "126,-1,5,0,0,1,0,0.;", "106,2,999999999,0.;", "112,3,1,2,99999999,0.;",
        "126,1,1,0,0,1,0,nan,0.,1.,1.,1.,1.,0.,0.,0.,4.,4.,0.,0.,1.,0.,0.,1.;", "110,0.,0.;"}) {
    const std::string type = std::string(data).substr(0, 3);
    const auto drawing = parseIges(igesOf({{type, data}}));
    if (drawing) {
      EXPECT_EQ(drawing->left, 1) << data;
    }
  }
  EXPECT_FALSE(parseIges(igesOf({{"102", "102,2000000000,1;"}})));
  EXPECT_FALSE(parseIges(igesOf({{"110 1", "110,0.,0.,0.,1.,1.,0.;"}}))) << "its own matrix";
  EXPECT_FALSE(parseIges(igesOf({{"110 999", "110,0.,0.,0.,1.,1.,0.;"}})));
  EXPECT_FALSE(parseIges(igesOf({{"110", "110,9999H0.,0.;"}})));
  // Matrices in a ring.
  EXPECT_FALSE(
      parseIges(igesOf({{"110 3", "110,0.,0.,0.,1.,1.,0.;"}, {"124 3", "124,1.,0.,0.,0.,0.,1.,0.,0.,0.,0.,1.,0.;"}})));
  for (const char* text : {"", "hello", "S", "\n\n"}) EXPECT_FALSE(parseIges(text));
}

std::string stepOf(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nFILE_NAME('a','','','','','','');\nENDSEC;\nDATA;\n" + data +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

TEST(StepReader, SurvivesDamage) {
  if (!hasOpenCascade()) return;
  const std::string whole = exported(".step");
  for (std::size_t length = 0; length + 60 < whole.size(); length += 97)
    EXPECT_FALSE(parseStep(whole.substr(0, length))) << length;
  damage(
      whole, [](const std::string& text) { return parseStep(text); }, 331);
}

TEST(StepReader, CompositesThatMultiplyComeToAnEnd) {
  constexpr int kDeep = 14, kWide = 12;
  std::string data;
  for (int depth = 0; depth < kDeep; ++depth) {
    const int id = 1000 * (depth + 1);
    std::string parts;
    for (int i = 1; depth + 1 < kDeep && i <= kWide; ++i) {
      data += "#" + std::to_string(id + i) + "=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#" + std::to_string(id + 1000) +
              ");\n";
      parts += (i > 1 ? ",#" : "#") + std::to_string(id + i);
    }
    data += "#" + std::to_string(id) + "=COMPOSITE_CURVE('',(" + parts + "),.F.);\n";
  }
  EXPECT_FALSE(parseStep(stepOf(data)));
}

TEST(StepReader, ReadsWhatOthersWrite) {
  const auto drawing = parseStep(stepOf(
      "#1=(CONVERSION_BASED_UNIT('INCH',#2)LENGTH_UNIT()NAMED_UNIT(#9));\n"
      "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#3);\n#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"
      "\n"
      "#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));\n"
      "#10=CARTESIAN_POINT('',(0.,0.,0.));#11=CARTESIAN_POINT('',(4.,0.,0.));/* between "
      "*/#12=CARTESIAN_POINT('',(0.,4.,0.));\n"
      "#13=DIRECTION('',(0.,0.,1.));#14=DIRECTION('',(1.,0.,0.));#15=AXIS2_PLACEMENT_3D('',#10,#13,#14);\n"
      "#16=CIRCLE('a',#15,4.);#17=TRIMMED_CURVE('It''s',#16,(#11),(#12),.T.,.CARTESIAN.);\n"
      "#18=TRIMMED_CURVE('',#16,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n"
      "#19=VECTOR('',#14,2.);#20=LINE('',#10,#19);"
      "#21=TRIMMED_CURVE('',#20,(PARAMETER_VALUE(1.)),(PARAMETER_VALUE(3.)),.T.,.PARAMETER.);\n"
      "#22=POLYLINE('\\X2\\6F22\\X0\\',(#10,#11,#12));\n"
      "#23=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#11,#30,#12),.UNSPECIFIED.,.F.,.F.)B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.)"
      ",.UNSPECIFIED.)"
      "CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((1.,0.70710678118654752,1.))REPRESENTATION_ITEM('"
      "r'));\n"
      "#24=ELLIPSE('',#15,4.,2.);#25=BEZIER_CURVE('',3,(#10,#11,#30,#12),.UNSPECIFIED.,.F.,.F.);\n"
      "#30=CARTESIAN_POINT('',(4.,4.,0.));\n"
      "#40=GEOMETRIC_CURVE_SET('',(#17,#18,#21,#22,#23,#24,#25,#99,#10));\n"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_EQ(drawing->mmPerUnit, 25.4);
  ASSERT_EQ(drawing->entities.size(), 7u);
  EXPECT_EQ(drawing->entities[0].name, "It's");
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[0].shape).sweepRad, 0.5 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(std::get<CadArc>(drawing->entities[1].shape).sweepRad, 1.0, 1e-12);
  EXPECT_LT((std::get<CadLine>(drawing->entities[2].shape).from - Vec2(2, 0)).norm(), 1e-12);
  EXPECT_LT((std::get<CadLine>(drawing->entities[2].shape).to - Vec2(6, 0)).norm(), 1e-12);
  EXPECT_EQ(drawing->entities[3].name, "漢");
  for (int i = 0; i <= 10; ++i)
    EXPECT_NEAR(pointAt(drawing->entities[4].shape, 0.1 * i).norm(), 4.0, 1e-12) << "a quarter";
  EXPECT_LT((pointAt(drawing->entities[5].shape, 0.25) - Vec2(0, 2)).norm(), 1e-12);
  EXPECT_LT((pointAt(drawing->entities[6].shape, 1.0) - Vec2(0, 4)).norm(), 1e-12);
}

TEST(StepReader, ReadsTheEdgesOfAWireframe) {
  const auto drawing = parseStep(
      stepOf("#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(4.,0.,0.));#3=DIRECTION('',(1.,0.,0.));#4="
             "VECTOR('',#3,1.);\n"
             "#5=LINE('',#1,#4);#6=VERTEX_POINT('',#1);#7=VERTEX_POINT('',#2);#8=EDGE_CURVE('',#6,#7,#5,.T.);\n"
             "#9=DIRECTION('',(0.,0.,-1.));#10=AXIS2_PLACEMENT_3D('',#1,#9,#3);#11=CIRCLE('',#10,4.);\n"
             "#12=CARTESIAN_POINT('',(0.,-4.,0.));#13=VERTEX_POINT('',#12);#14=EDGE_CURVE('',#7,#13,#11,.T.);\n"));
  ASSERT_TRUE(drawing) << drawing.error().message;
  EXPECT_FALSE(drawing->mmPerUnit);
  ASSERT_EQ(drawing->entities.size(), 2u);
  // Seen from below the circle turns the other way: the quarter through (2.8, -2.8).
  const Vec2 middle = pointAt(drawing->entities[1].shape, 0.5);
  EXPECT_LT((middle - Vec2(4.0, -4.0) / std::sqrt(2.0)).norm(), 1e-9);
}

TEST(StepReader, RefusesWhatCannotBe) {
  for (const char* data :
       {"#1=LINE('',(", "#1=LINE('','it", "#=LINE();", "#1=LINE('',#2,#3)", "#1=LINE(1e999);", "#1=(A()B(;",
        "#1=A();#1=B();", "#99999999999999999999999=A();", "LINE();", "#1=A(,);", "#1=A(.T);"}) {
    const auto drawing = parseStep(stepOf(data));
    EXPECT_FALSE(drawing) << data;
  }
  EXPECT_FALSE(parseStep(stepOf("#1=A(" + std::string(100000, '(') + ");")));
  // A composite of itself, a curve trimmed of itself, and one that doubles with every level.
  const auto ring =
      parseStep(stepOf("#1=TRIMMED_CURVE('',#1,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);"
                       "#2=GEOMETRIC_CURVE_SET('',(#1));"));
  ASSERT_TRUE(ring);
  EXPECT_EQ(ring->left, 1);
  std::string bomb = "#1=CARTESIAN_POINT('',(0.,0.));#2=CARTESIAN_POINT('',(1.,0.));#100=POLYLINE('',(#1,#2));";
  for (int i = 1; i < 15; ++i) {
    const std::string n = std::to_string(100 + i), segment = std::to_string(200 + i);
    bomb += "#" + segment + "=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#" + std::to_string(99 + i) + ");#" + n +
            "=COMPOSITE_CURVE('',(";
    for (int k = 0; k < 8; ++k) bomb += (k > 0 ? ",#" : "#") + segment;
    bomb += "),.F.);";
  }
  const auto grown = parseStep(stepOf(bomb + "#300=GEOMETRIC_CURVE_SET('',(#114));"));
  if (grown) {
    EXPECT_LE(grown->entities.size(), 200001u);
  }
  for (const char* text : {"", "hello", "ISO-10303-21;", "ISO-10303-21;DATA;"}) EXPECT_FALSE(parseStep(text));
}

}  // namespace
}  // namespace batten
