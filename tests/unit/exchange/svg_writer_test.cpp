// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <locale>
#include <sstream>

#include "core/curve/closest_point.h"
#include "core/exchange/svg/svg_check.h"
#include "core/exchange/svg/svg_writer.h"
#include "core/exchange/text/curve_json.h"
#include "tests/support/comma_locale.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

using test::exportOfAllKinds;

struct ReadPath {
  std::vector<std::vector<Vec2>> cubics;  ///< Four points each.
  bool closed = false;
};

/// A parser of its own for the subset M, C, Z; anything else is a failure.
ReadPath parsePath(const std::string& data) {
  ReadPath path;
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  Vec2 at = Vec2::Zero();
  const auto point = [&] {
    Vec2 p;
    char comma = 0;
    in >> p.x() >> comma >> p.y();
    EXPECT_EQ(comma, ',');
    return p;
  };
  in >> std::ws;
  EXPECT_EQ(in.get(), 'M');
  at = point();
  for (char command; in >> command;) {
    if (command == 'Z') {
      path.closed = true;
    } else if (command == 'M') {
      at = point();
    } else if (command == 'C') {
      const Vec2 a = point(), b = point(), c = point();
      path.cubics.push_back({at, a, b, c});
      at = c;
    } else {
      ADD_FAILURE() << "unexpected command " << command;
      break;
    }
  }
  return path;
}

std::vector<ReadPath> readPaths(const std::string& svg) {
  std::vector<ReadPath> paths;
  for (std::size_t i = svg.find(" d=\""); i != std::string::npos; i = svg.find(" d=\"", i + 1)) {
    paths.push_back(parsePath(svg.substr(i + 4, svg.find('"', i + 4) - i - 4)));
  }
  return paths;
}

Vec2 evaluate(const std::vector<Vec2>& c, double t) {
  std::vector<Vec2> p = c;  // de Casteljau
  for (std::size_t level = p.size() - 1; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
  }
  return p[0];
}

Vec2 fromPage(const Vec2& page, const PageFrame& frame) {
  return {page.x(), frame.heightPx * frame.mmPerPx - page.y()};
}

/// Largest distance of dense samples of the path from the exact curves.
double pathError(const ReadPath& path, const ExportCurve& exact, const PageFrame& frame) {
  double worst = 0.0;
  for (const auto& cubic : path.cubics) {
    for (int i = 0; i <= 40; ++i) {
      const Vec2 p = fromPage(evaluate(cubic, i / 40.0), frame);
      double nearest = std::numeric_limits<double>::infinity();
      for (const ExportPiece& piece : exact.pieces) nearest = std::min(nearest, closestPoint(piece.curve, p).distance);
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

/// Largest distance of dense samples of the exact curves from the path, by brute force.
double curveError(const ReadPath& path, const ExportCurve& exact, const PageFrame& frame) {
  std::vector<Vec2> dense;
  for (const auto& cubic : path.cubics) {
    for (int i = 0; i <= 200; ++i) dense.push_back(fromPage(evaluate(cubic, i / 200.0), frame));
  }
  double worst = 0.0;
  for (const ExportPiece& piece : exact.pieces) {
    for (int k = 0; k <= 200; ++k) {
      const Vec2 p = piece.curve.point(piece.curve.start() + (piece.curve.end() - piece.curve.start()) * k / 200.0);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i < dense.size(); ++i) {
        const Vec2 d = dense[i] - dense[i - 1];
        const double t = d.squaredNorm() > 0 ? std::clamp((p - dense[i - 1]).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, (p - dense[i - 1] - t * d).norm());
      }
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

TEST(SvgWriter, LiesWithinTheToleranceItStatesBothWays) {
  const ExportDocument document = exportOfAllKinds();
  int before = 0;
  for (const double tolerance : {0.05, 0.002, 0.0001}) {
    const auto svg = writeSvg(document, {tolerance, 0.1});
    ASSERT_TRUE(svg) << svg.error().message;
    EXPECT_LE(svg->largestErrorMm, tolerance);
    EXPECT_GT(svg->cubics, before) << "a finer tolerance takes more cubics";
    before = svg->cubics;
    const auto paths = readPaths(svg->text);
    ASSERT_EQ(paths.size(), document.curves.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      EXPECT_EQ(paths[i].closed, document.curves[i].closed);
      worst = std::max(worst, pathError(paths[i], document.curves[i], document.frame));
      EXPECT_LE(curveError(paths[i], document.curves[i], document.frame), 1.05 * tolerance + 2e-5) << "curve " << i;
    }
    // The stated error is measured, so that it is neither exceeded nor a mere bound.
    EXPECT_LE(worst, 1.02 * svg->largestErrorMm + 1e-7);
  }
}

TEST(SvgWriter, TangentsAgreeAtSmoothJointsAndClosedPathsEndWhereTheyStart) {
  const ExportDocument document = exportOfAllKinds();
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg);
  const auto paths = readPaths(svg->text);
  for (const std::size_t smooth : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    const auto& cubics = paths[smooth].cubics;
    const bool loop = document.curves[smooth].closed;
    for (std::size_t i = loop ? 0 : 1; i < cubics.size(); ++i) {
      const auto& last = cubics[(i + cubics.size() - 1) % cubics.size()];
      const Vec2 in = (last[3] - last[2]).normalized(), out = (cubics[i][1] - cubics[i][0]).normalized();
      EXPECT_LT(std::abs(cross(in, out)), 1e-5);
      EXPECT_GT(in.dot(out), 0.0);
    }
  }
  for (const std::size_t closed : {std::size_t{3}, std::size_t{5}}) {
    EXPECT_EQ(paths[closed].cubics.front()[0], paths[closed].cubics.back()[3]);
  }
}

TEST(SvgWriter, KeepsTheCornerOfABezierChain) {
  const ExportDocument document = exportOfAllKinds();
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg);
  const Vec2 corner = test::bezierChain().point(20.0);
  double nearest = 1e9;
  const auto paths = readPaths(svg->text);
  for (const auto& cubic : paths[2].cubics) {
    nearest = std::min(nearest, (fromPage(cubic[3], document.frame) - corner).norm());
  }
  EXPECT_LT(nearest, 1e-6);
}

/// Two lines at right angles, 3 mm apart; one curve that jumps by 3 mm.
ExportDocument broken() {
  const auto line = [](const Vec2& a, const Vec2& b) { return test::made(1, {0, 0, 30, 30}, {a, b}); };
  ExportDocument document = exportOfAllKinds();
  document.curves = {
      {"curve-1", false, {{line({10, 10}, {40, 10})}, {line({43, 10}, {43, 40})}}},
      {"curve-2", false, {{test::made(1, {0, 0, 30, 30, 60, 60}, {{50, 50}, {60, 50}, {63, 50}, {63, 60}})}}}};
  return document;
}

TEST(SvgWriter, LeavesAGapWhereTheCurvesLeaveOne) {
  const ExportDocument document = broken();
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_LT(svg->largestErrorMm, 1e-6);
  const auto paths = readPaths(svg->text);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    EXPECT_LT(pathError(paths[i], document.curves[i], document.frame), 1e-6) << i;
    EXPECT_LT(curveError(paths[i], document.curves[i], document.frame), 1e-6) << i;
    EXPECT_FALSE(paths[i].closed);
  }
  EXPECT_TRUE(checkSvg(svg->text, document)) << "reads back";
}

TEST(SvgWriter, RefusesToCloseWhatDoesNotMeet) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    ExportDocument document = broken();
    document.curves[i].closed = true;
    const auto svg = writeSvg(document, {});
    ASSERT_FALSE(svg);
    EXPECT_NE(svg.error().message.find("do not meet"), std::string::npos);
    EXPECT_FALSE(writeCurveJson(document));
  }
}

TEST(SvgWriter, CountsTheRoundingOfASeamAsError) {
  ExportDocument document = exportOfAllKinds();
  const Vec2 a(10, 10), b(40, 10), off(1e-5, 0.0), c(40, 40);
  document.curves = {
      {"curve-1", false, {{test::made(1, {0, 0, 1, 1}, {a, b})}, {test::made(1, {0, 0, 1, 1}, {b + off, c})}}}};
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_EQ(svg->text.find(" M"), std::string::npos) << "one line";
  EXPECT_NEAR(svg->largestErrorMm, 1e-5, 2e-6);
}

TEST(SvgWriter, StatesMillimetresErrorAndExactData) {
  const auto svg = writeSvg(exportOfAllKinds(), {});
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->text.find("width=\"120mm\" height=\"100mm\" viewBox=\"0 0 120 100\""), std::string::npos);
  EXPECT_NE(svg->text.find("inkscape:groupmode=\"layer\""), std::string::npos);
  EXPECT_NE(
      svg->text.find("<batten:piece degree=\"5\" knots=\"0 0 0 0 0 0 30 30 30 30 30 30\" control-points=\"10,10 16,18"),
      std::string::npos);
  EXPECT_NE(svg->text.find("Süße &lt;Linie&gt; &amp; &quot;漢字&quot;.png"), std::string::npos);
  EXPECT_EQ(svg->text.find("nan"), std::string::npos);
  for (std::size_t i = svg->text.find(" d=\""); i != std::string::npos; i = svg->text.find(" d=\"", i + 1)) {
    const std::string data = svg->text.substr(i + 4, svg->text.find('"', i + 4) - i - 4);
    EXPECT_EQ(data.find_first_not_of("MCZ0123456789.,- "), std::string::npos) << "an exponent or worse";
  }
}

TEST(SvgWriter, IsIndependentOfTheLocale) {
  const auto before = writeSvg(exportOfAllKinds(), {});
  const auto json = writeCurveJson(exportOfAllKinds());
  ASSERT_TRUE(before && json);
  const test::CommaLocale locale;
  std::ostringstream commas;
  commas << 1234.5;
  ASSERT_EQ(commas.str(), "1.234,5") << "the locale holds";
  const auto after = writeSvg(exportOfAllKinds(), {});
  const auto jsonAfter = writeCurveJson(exportOfAllKinds());
  ASSERT_TRUE(after && jsonAfter);
  EXPECT_EQ(before->text, after->text);
  EXPECT_EQ(*json, *jsonAfter);
  const auto read = readCurveJson(*json);
  ASSERT_TRUE(read);
  EXPECT_EQ(*writeCurveJson(*read), *json);
  EXPECT_TRUE(checkSvg(before->text, exportOfAllKinds()));
}

TEST(SvgWriter, TakesTinyAndHugeCoordinates) {
  ExportDocument document = exportOfAllKinds();
  document.frame = {120000, 100000, 0.1};
  document.curves = {
      {"curve-1", false, {{test::oneSpan().mapped(200.0 * Eigen::Matrix2d::Identity(), {1e-17, -1e-17})}}}};
  const auto svg = writeSvg(document, {});
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_LE(pathError(readPaths(svg->text)[0], document.curves[0], document.frame), 0.002 * 1.02);
}

TEST(SvgWriter, RefusesNothingAndNonsense) {
  ExportDocument empty = exportOfAllKinds();
  empty.curves.clear();
  ASSERT_FALSE(writeSvg(empty, {}));
  EXPECT_EQ(writeSvg(empty, {}).error().code, ErrorCode::NoCurve);
  EXPECT_FALSE(writeSvg(exportOfAllKinds(), {0.0, 0.1}));
  EXPECT_FALSE(writeSvg(exportOfAllKinds(), {0.002, std::numeric_limits<double>::quiet_NaN()}));
  ExportDocument frameless = exportOfAllKinds();
  frameless.frame.mmPerPx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(writeSvg(frameless, {}));
  ExportDocument hollow = exportOfAllKinds();
  hollow.curves[0].pieces[0].curve = NurbsCurve();
  EXPECT_FALSE(writeSvg(hollow, {}));
}

}  // namespace
}  // namespace batten
