// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/construct.h"

#include <gtest/gtest.h>

#include "core/curve/closest_point.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

TEST(Construct, SaysWhichParameterIsWrong) {
  ConstructParams params;
  EXPECT_FALSE(validate(params));
  params.derivativeMagnitude = 5.0;
  ASSERT_TRUE(validate(params));
  EXPECT_NE(validate(params)->message.find("derivative_magnitude"), std::string::npos);
  params = {};
  params.degree = 6;
  ASSERT_TRUE(validate(params));
  EXPECT_EQ(validate(params)->message, "construct.degree is 6; it must lie between 2 and 5.");
  params.degree = 7;
  ASSERT_TRUE(validate(params));
  EXPECT_EQ(validate(params)->message, "construct.degree is 7; it must lie between 2 and 5.");
  params = {};
  params.extremumSignificance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(validate(params));
  EXPECT_FALSE(construct({}, params, {}));
}

class EachMethod : public testing::TestWithParam<std::tuple<ConstructMethod, ConstructStart>> {
 protected:
  static ConstructParams paramsOfTest() {
    ConstructParams params;
    std::tie(params.method, params.start) = GetParam();
    return params;
  }
};

TEST_P(EachMethod, FollowsAnEllipseInPiecesOrClosed) {
  ConstructContour contour;
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.1, 1.45, 10, false));
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.0, 2 * std::numbers::pi, 30, true));
  contour.pieces[0].startIsCorner = contour.pieces[0].endIsCorner = true;
  const ConstructParams params = paramsOfTest();
  const auto one = construct(contour, params, {});
  RunContext threads;
  threads.threads = 3;
  const auto many = construct(contour, params, threads);
  ASSERT_TRUE(one && many) << (one ? "" : one.error().message);
  ASSERT_EQ(one->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*one)[i].curve, (*many)[i].curve);
    EXPECT_LT(deviation((*one)[i].curve, positionsOf(contour.pieces[i].points), true).max, 3.0);
  }
  const auto& open = (*one)[0].curve;
  EXPECT_LT((open.point(open.start()) - contour.pieces[0].points.front().at).norm(), 1e-9);
  EXPECT_LT((open.point(open.end()) - contour.pieces[0].points.back().at).norm(), 1e-9);
}

TEST_P(EachMethod, CancelsAndRefusesNothingness) {
  ConstructContour contour;
  contour.pieces.push_back(test::pieceOf(test::ellipsePoint, 0.1, 1.45, 10, false));
  const ConstructParams params = paramsOfTest();
  RunContext context;
  context.cancel.cancel();
  const auto result = construct(contour, params, context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
  contour.pieces.push_back({});
  const auto nothing = construct(contour, params, {});
  EXPECT_TRUE(nothing || nothing.error().code == ErrorCode::Numerical);
}

INSTANTIATE_TEST_SUITE_P(Methods, EachMethod,
                         testing::Combine(testing::Values(ConstructMethod::Nurbs, ConstructMethod::Bezier,
                                                          ConstructMethod::Typical, ConstructMethod::ControlPolygon),
                                          testing::Values(ConstructStart::Line, ConstructStart::Fit)));

}  // namespace
}  // namespace batten
