// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/method_truths.h"

#include <cmath>
#include <functional>
#include <random>

#include "tests/support/angles.h"

namespace batten::test {
namespace {

constexpr double kStep = 0.25;
constexpr std::size_t kStride = 4;

/// By its curvature over arc length: circular arcs of 1/40 of a step would change the tenth digit.
OpenTruth fromProfile(std::string name, double length, const std::function<double(double)>& kappaAt) {
  constexpr int kFine = 8;
  OpenTruth truth{std::move(name), {}, {}};
  const int steps = static_cast<int>(length / kStep);
  const double h = kStep / kFine;
  Vec2 p(100.0, 100.0);
  double angle = 0.2;
  for (int i = 0; i <= steps * kFine; ++i) {
    const double s = i * h;
    if (i % kFine == 0) {
      truth.points.push_back(p);
      truth.kappa.push_back(kappaAt(s / length));
    }
    const double turn = h * kappaAt((s + 0.5 * h) / length);
    p += h * Vec2(std::cos(angle + 0.5 * turn), std::sin(angle + 0.5 * turn));
    angle += turn;
  }
  return truth;
}

/// By a course; its derivatives in closed form are not needed at this density.
OpenTruth fromCourse(std::string name, double from, double to, const std::function<Vec2(double)>& at) {
  OpenTruth truth{std::move(name), {}, {}};
  const double h = 1e-3 * (to - from);
  double t = from;
  while (t <= to) {
    const Vec2 d = (at(t - 2 * h) - 8 * at(t - h) + 8 * at(t + h) - at(t + 2 * h)) / (12 * h);
    const Vec2 dd = (-at(t + 2 * h) + 16 * at(t + h) - 30 * at(t) + 16 * at(t - h) - at(t - 2 * h)) / (12 * h * h);
    truth.points.push_back(at(t));
    truth.kappa.push_back(cross(d, dd) / std::pow(d.norm(), 3));
    t += kStep / d.norm();
  }
  return truth;
}

}  // namespace

std::vector<OpenTruth> openTruths() {
  std::vector<OpenTruth> all;
  all.push_back(fromCourse("ellipse", 0.1, 1.45, [](double a) { return Vec2(300 * std::cos(a), 150 * std::sin(a)); }));
  all.push_back(fromProfile("clothoid", 500.0, [](double f) { return 0.001 + 0.007 * f; }));
  all.push_back(fromProfile("s-curve", 600.0, [](double f) { return -0.006 * std::cos(kPi * f); }));
  all.push_back(fromProfile("spiral", 500.0, [](double f) { return 1.0 / (300.0 - 220.0 * f); }));
  all.push_back(fromCourse("roof", 0.0, 900.0, [](double x) {
    return Vec2(x, 60 * std::exp(-std::pow((x - 300) / 120, 2)) + 40 * std::exp(-std::pow((x - 650) / 90, 2)));
  }));
  // The last point is one that is seen: a line is not measured where nothing was said of it.
  for (OpenTruth& truth : all) {
    truth.points.resize((truth.points.size() - 1) / kStride * kStride + 1);
    truth.kappa.resize(truth.points.size());
  }
  return all;
}

std::vector<Vec2> noisyPoints(const OpenTruth& truth, double noisePx, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noisePx);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < truth.points.size(); i += kStride) {
    const double x = normal(random), y = normal(random);
    points.push_back(truth.points[i] + Vec2(x, y));
  }
  return points;
}

}  // namespace batten::test
