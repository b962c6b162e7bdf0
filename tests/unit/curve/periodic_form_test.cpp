// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/periodic_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace batten {
namespace {

/// Closed, and smooth but at the seam, where it has a corner.
NurbsCurve drop(int points) {
  std::vector<Vec2> control;
  for (int i = 0; i < points; ++i) {
    const double t = 2.0 * std::numbers::pi * i / (points - 1.0);
    control.emplace_back(20.0 * (1.0 - std::cos(t)) + 0.3 * std::sin(7.0 * t), 9.0 * std::sin(t) * (1.0 - std::cos(t)));
  }
  control[1] += Vec2(1.0, 2.0);
  control.back() = control.front();
  std::vector<double> knots(6, 0.0);
  for (int i = 1; i <= points - 6; ++i) knots.push_back(i + 0.3 * std::sin(2.0 * i));
  knots.insert(knots.end(), 6, points - 5.0);
  return NurbsCurve::make(5, knots, control).value();
}

/// The square of the distance at equal parameters, integrated by the midpoint rule at twice the degree and two places a
/// span.
double misfit(const NurbsCurve& curve, const PeriodicForm& form) {
  const NurbsCurve periodic = fromPeriodic(form, curve).value();
  const std::vector<double> breaks = curve.breaks();
  double sum = 0.0;
  for (std::size_t s = 0; s + 1 < breaks.size(); ++s) {
    for (int i = 0; i < 12; ++i) {
      const double width = breaks[s + 1] - breaks[s], u = breaks[s] + (i + 0.5) / 12.0 * width;
      sum += width * (curve.point(u) - periodic.point(u)).squaredNorm();
    }
  }
  return sum;
}

TEST(PeriodicForm, IsTheNearestWhereTheCurveDoesNotMeetItselfSmoothly) {
  for (const int points : {9, 12, 40}) {
    const NurbsCurve curve = drop(points);
    const PeriodicForm form = toPeriodic(curve).value();
    const double least = misfit(curve, form);
    EXPECT_GT(least, 1e-3) << "the seam is to cost something";
    constexpr double kMove = 1e-3;
    for (std::size_t j = 0; j < form.points.size(); ++j) {
      for (const Vec2& way : {Vec2(kMove, 0.0), Vec2(-kMove, 0.0), Vec2(0.0, kMove), Vec2(0.0, -kMove)}) {
        PeriodicForm moved = form;
        moved.points[j] += way;
        EXPECT_GT(misfit(curve, moved), least) << points << " points, point " << j;
      }
    }
  }
}

TEST(PeriodicForm, IsTheCurveItselfWhereItIsPeriodic) {
  const NurbsCurve curve = drop(30);
  const NurbsCurve smooth = fromPeriodic(toPeriodic(curve).value(), curve).value();
  const NurbsCurve again = fromPeriodic(toPeriodic(smooth).value(), smooth).value();
  for (int i = 0; i < smooth.controlPointCount(); ++i)
    EXPECT_LT((again.controlPoints()[i] - smooth.controlPoints()[i]).norm(), 1e-10);
}

}  // namespace
}  // namespace batten
