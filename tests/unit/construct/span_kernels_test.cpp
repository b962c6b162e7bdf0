// SPDX-License-Identifier: GPL-3.0-or-later
// The wide loops of the light fit against the same written out plainly, and against Eigen.
#include "core/construct/light/span_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>
#include <vector>

namespace batten {
namespace {

class SpanKernels : public testing::Test {
 protected:
  double any() { return any_(random_); }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> any_{-1.0, 1.0};
};

TEST_F(SpanKernels, RowsAreSummedInTheirOrder) {
  for (const int columns : {6, 13, 16}) {
    std::vector<WeighedRow> rows(23);
    for (WeighedRow& one : rows) {
      for (double& value : one.row) value = any();
      one.weight = 1.0 + any();
      one.residual = any();
    }
    LocalSquares sums;
    sumRows(rows.data(), static_cast<int>(rows.size()), columns, sums);
    for (int c = 0; c < columns; ++c) {
      double gradient = 0.0;
      for (const WeighedRow& one : rows) gradient += one.residual * one.row[c];
      EXPECT_EQ(sums.gradient[c], gradient);
      for (int r = 0; r < columns; ++r) {
        double sum = 0.0;
        for (const WeighedRow& one : rows) sum += one.weight * one.row[c] * one.row[r];
        EXPECT_EQ(sums.squares[c][r], sum) << c << " " << r;
      }
    }
  }
}

TEST_F(SpanKernels, DerivativesAtAPlaceAreSummedPointByPoint) {
  for (const int degree : {3, 5, 7}) {
    const PlaceTable::Place place = bernsteinPlace(degree, 0.5 + 0.4 * any());
    std::array<Vec2, kSpanPoints> bezier;
    for (Vec2& point : bezier) point = Vec2(any(), any());
    const PlaceSums sums = sumPoints(place.columns, bezier, degree + 1);
    for (std::size_t order = 0; order < 4; ++order) {
      Vec2 sum = Vec2::Zero();
      for (int k = 0; k <= degree; ++k) sum += place.rows[order][k] * bezier[k];
      EXPECT_EQ(Vec2(sums[2 * order], sums[2 * order + 1]), sum) << degree << " " << order;
    }
  }
}

TEST_F(SpanKernels, SquaresAreCarriedOverToTheUnknowns) {
  for (const int points : {4, 6}) {
    const int lengths = 7, own = 3, count = 2 * points + 1;
    SpanDependence by{};
    // Rows: x and y of the Bezier points in turn, own length; columns: x, y, lengths, in their lanes.
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(count, kUnknownLanes);
    for (int k = 0; k < points; ++k) {
      for (int j = 0; j < points; ++j) {
        by.byPoint[k][j] = whole(2 * k, j) = whole(2 * k + 1, kXLanes + j) = any();
      }
      for (int i = 0; i < lengths; ++i) {
        by.xByLength[k][i] = whole(2 * k, 2 * kXLanes + i) = any();
        by.yByLength[k][i] = whole(2 * k + 1, 2 * kXLanes + i) = any();
      }
    }
    whole(2 * points, 2 * kXLanes + own) = 1.0;
    Eigen::MatrixXd factor(count, count);
    for (double& value : factor.reshaped()) value = any();
    const Eigen::MatrixXd local = factor * factor.transpose();
    LocalSquares sums{};
    for (int r = 0; r < count; ++r) {
      for (int c = 0; c < count; ++c) sums.squares[r][c] = local(std::max(r, c), std::min(r, c));
    }
    std::array<UnknownRow, kUnknownLanes> squares;
    carrySquares(sums, by, points, lengths, own, squares);
    const Eigen::MatrixXd wanted = whole.transpose() * local * whole;
    const auto expectRow = [&](int row, int columns) {
      for (int c = 0; c < columns; ++c) EXPECT_NEAR(squares[row][c], wanted(row, c), 1e-12) << row << " " << c;
    };
    for (int j = 0; j < points; ++j) {
      expectRow(j, 2 * kXLanes);
      expectRow(kXLanes + j, 2 * kXLanes);
    }
    for (int i = 0; i < lengths; ++i) expectRow(2 * kXLanes + i, 2 * kXLanes + lengths);
  }
}

TEST_F(SpanKernels, EveryLaneHasTheBezierPointsOfItsKnots) {
  for (const int degree : {3, 5}) {
    std::array<Vec2, kSpanPoints> points;
    for (Vec2& point : points) point = Vec2(any(), any());
    KnotLanes lanes;
    std::vector<SpanKnots> knots(kLengthLanes);
    for (std::size_t lane = 0; lane < knots.size(); ++lane) {
      double at = 0.0;
      for (int k = 0; k < 2 * degree; ++k) lanes[k][lane] = knots[lane][k] = at += 1.1 + any();
    }
    PointLanes x, y;
    bezierOfLanes(degree, lanes, points, x, y);
    for (std::size_t lane = 0; lane < knots.size(); ++lane) {
      std::array<Vec2, kSpanPoints> bezier;
      bezierOfSpan(degree, knots[lane], points, bezier);
      for (int k = 0; k <= degree; ++k) EXPECT_EQ(bezier[k], Vec2(x[k][lane], y[k][lane]));
    }
  }
}

}  // namespace
}  // namespace batten
