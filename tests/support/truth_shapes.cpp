// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/truth_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "tests/support/angles.h"

namespace batten::test {
namespace {

using Profile = std::function<double(double)>;  ///< Curvature over 0..1 of the perimeter, any scale.
using Course = std::function<Vec2(double)>;

/// The curve with this curvature profile (turning by its integral), laid from a to b by a similarity, which keeps the
/// shape of the profile. Integrated with the midpoint rule on 20000 steps: far below the accuracies measured.
TruthPiece fromProfile(const Profile& profile, double length, const Vec2& a, const Vec2& b) {
  const int steps = 20000;
  std::vector<Vec2> raw{Vec2::Zero()};
  double angle = 0.0;
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const double k = profile((i + 0.5) / steps) / length;
    raw.push_back(raw.back() + h * std::sin(0.5 * k * h + 1e-300) / (0.5 * k * h + 1e-300) *
                                   Vec2(std::cos(angle + 0.5 * k * h), std::sin(angle + 0.5 * k * h)));
    angle += k * h;
  }
  const Vec2 chord = raw.back(), wanted = b - a;
  const double scale = wanted.norm() / chord.norm();
  const double turn = std::atan2(wanted.y(), wanted.x()) - std::atan2(chord.y(), chord.x());
  const Eigen::Matrix2d map = scale * Eigen::Rotation2Dd(turn).toRotationMatrix();
  TruthPiece piece;
  for (int i = 0; i <= steps; ++i) {
    piece.points.push_back(a + map * raw[i]);
    piece.kappa.push_back(profile(static_cast<double>(i) / steps) / length / scale);
  }
  piece.points.back() = b;
  return piece;
}

/// A smooth parametric course, curvature by central differences of fourth order.
TruthPiece fromCourse(const Course& course, double t0, double t1, int steps = 40000) {
  TruthPiece piece;
  const double h = 1e-3 * (t1 - t0);
  for (int i = 0; i <= steps; ++i) {
    const double t = t0 + (t1 - t0) * i / steps;
    const Vec2 p0 = course(t), m2 = course(t - 2 * h), m1 = course(t - h), p1 = course(t + h), p2 = course(t + 2 * h);
    const Vec2 d = (m2 - 8 * m1 + 8 * p1 - p2) / (12 * h), dd = (-m2 + 16 * m1 - 30 * p0 + 16 * p1 - p2) / (12 * h * h);
    piece.points.push_back(p0);
    piece.kappa.push_back(cross(d, dd) / std::pow(d.norm(), 3));
  }
  return piece;
}

TruthPiece straight(const Vec2& a, const Vec2& b) {
  return fromProfile([](double) { return 0.0; }, 1.0, a, b);
}

/// Pieces end to end; the meeting points are the corners.
TruthShape loop(std::string name, std::vector<TruthPiece> pieces) {
  TruthShape shape{std::move(name), true, std::move(pieces), {}};
  for (const TruthPiece& piece : shape.pieces) shape.corners.push_back(piece.points.front());
  return shape;
}

TruthShape smoothLoop(std::string name, const Course& course) {
  TruthShape shape{std::move(name), true, {fromCourse(course, 0.0, 2.0 * kPi)}, {}};
  shape.pieces[0].points.pop_back();  // the loop's end is its start
  shape.pieces[0].kappa.pop_back();
  return shape;
}

double bump(double x, double centre, double width) { return std::exp(-0.5 * std::pow((x - centre) / width, 2)); }

/// Sides of a shape with corners, each bowed by a constant or a linear curvature.
TruthShape polygonOfArcs(std::string name, const std::vector<Vec2>& corners, const std::vector<double>& bend,
                         const std::vector<double>& slope) {
  std::vector<TruthPiece> pieces;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double k = bend[i], c = slope[i];
    pieces.push_back(fromProfile([k, c](double f) { return k + c * (f - 0.5); }, 1.0, corners[i],
                                 corners[(i + 1) % corners.size()]));
  }
  return loop(std::move(name), std::move(pieces));
}

TruthShape car(double w, double h) {
  const Vec2 nose(0.08 * w, 0.70 * h), tail(0.93 * w, 0.46 * h), rear(0.90 * w, 0.72 * h), chin(0.14 * w, 0.76 * h);
  // y points down: a roof that bows upwards turns clockwise on paper, which is positive in these coordinates.
  const Profile roof = [](double f) {
    return 1.2 + 6.0 * bump(f, 0.10, 0.06) - 2.6 * bump(f, 0.34, 0.07) + 2.4 * bump(f, 0.56, 0.10) -
           1.2 * bump(f, 0.90, 0.08);
  };
  return loop("car",
              {fromProfile(roof, 1.0, nose, tail), fromProfile([](double f) { return 0.5 + 0.7 * f; }, 1.0, tail, rear),
               fromProfile([](double f) { return 0.25 * std::sin(kPi * f); }, 1.0, rear, chin),
               fromProfile([](double f) { return 0.6 - 0.3 * f; }, 1.0, chin, nose)});
}

}  // namespace

double TruthShape::diagonal() const {
  Eigen::AlignedBox2d box;
  for (const TruthPiece& piece : pieces)
    for (const Vec2& p : piece.points) box.extend(p);
  return box.diagonal().norm();
}

std::vector<Vec2> TruthShape::outline() const {
  std::vector<Vec2> all;
  for (const TruthPiece& piece : pieces) {
    const std::size_t count = piece.points.size() - (corners.empty() ? 0 : 1);
    all.insert(all.end(), piece.points.begin(), piece.points.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

std::vector<ProfileExtremum> extremaOf(const std::vector<double>& kappa, double prominence, bool periodic) {
  // Turning points of the profile once every wiggle below the prominence is ignored (hysteresis).
  std::vector<ProfileExtremum> found;
  const std::size_t n = kappa.size();
  if (n < 3) return found;
  const std::size_t begin = periodic ? std::max_element(kappa.begin(), kappa.end()) - kappa.begin() : 0;
  std::size_t low = begin, high = begin;
  int direction = 0;
  for (std::size_t i = 1; i < n + (periodic ? 1 : 0); ++i) {
    const std::size_t at = (begin + i) % n;
    const double k = kappa[at];
    if (k < kappa[low]) low = at;
    if (k > kappa[high]) high = at;
    if (direction >= 0 && k < kappa[high] - prominence) {
      if (direction > 0) found.push_back({high, true});
      direction = -1;
      low = at;
    } else if (direction <= 0 && k > kappa[low] + prominence) {
      if (direction < 0) found.push_back({low, false});
      direction = 1;
      high = at;
    }
    if (direction < 0) high = low;
    if (direction > 0) low = high;
  }
  // The periodic walk starts and ends on the largest maximum, which the hysteresis itself does not see turn.
  if (periodic && !found.empty()) found.push_back({begin, true});
  return found;
}

int countExtrema(const std::vector<double>& kappa, double prominence, bool periodic) {
  return static_cast<int>(extremaOf(kappa, prominence, periodic).size());
}

std::vector<TruthShape> truthShapes(int widthPx, int heightPx) {
  const double w = widthPx, h = heightPx, r = std::min(w, h);
  const Vec2 centre(0.5 * w + 0.37, 0.5 * h + 0.21);
  std::vector<TruthShape> shapes;
  const auto ellipse = [&](std::string name, double a, double b, double tilt) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(tilt).toRotationMatrix();
    return smoothLoop(std::move(name),
                      [=](double t) { return Vec2(centre + turn * Vec2(a * std::cos(t), b * std::sin(t))); });
  };
  shapes.push_back(ellipse("circle", 0.38 * r, 0.38 * r, 0.0));
  shapes.push_back(ellipse("ellipse", 0.40 * w, 0.33 * h, 0.14));
  const Vec2 left(0.10 * w, 0.72 * h), right(0.90 * w, 0.60 * h);
  const auto lid = [&](std::string name, const Profile& profile) {  // one curved side, one straight
    return loop(std::move(name), {fromProfile(profile, 1.0, left, right), straight(right, left)});
  };
  shapes.push_back(lid("clothoid", [](double f) { return 0.3 + 2.6 * f; }));
  shapes.push_back(lid("logspiral", [](double f) { return 1.0 / (0.28 + 0.95 * f); }));
  shapes.push_back(
      loop("scurve",
           {fromProfile([](double f) { return 2.2 * std::sin(2.0 * kPi * f); }, 1.0, left, Vec2(0.90 * w, 0.35 * h)),
            straight(Vec2(0.90 * w, 0.35 * h), Vec2(0.90 * w, 0.90 * h)),
            straight(Vec2(0.90 * w, 0.90 * h), Vec2(0.10 * w, 0.90 * h)), straight(Vec2(0.10 * w, 0.90 * h), left)}));
  // Smooth superellipse-like loop in polar form, free of the kinks that |x|^2.5 has on the axes.
  shapes.push_back(smoothLoop("superell", [=](double t) {
    const double radius = 1.0 / std::pow(std::pow(std::cos(t), 4) + std::pow(std::sin(t), 4), 0.25);
    return Vec2(centre + radius * Vec2(0.38 * w * std::cos(t), 0.36 * h * std::sin(t)));
  }));
  shapes.push_back(car(w, h));
  const auto at = [&](double x, double y) { return Vec2(x * w, y * h); };
  shapes.push_back(polygonOfArcs("K",
                                 {at(.22, .08), at(.36, .09), at(.365, .44), at(.64, .08), at(.80, .09), at(.50, .50),
                                  at(.82, .91), at(.66, .92), at(.365, .57), at(.36, .92), at(.22, .91)},
                                 {.04, .02, .08, .10, .30, .35, .08, .25, .06, .03, -.03},
                                 {0, 0, 0, 0, .3, 0, 0, 0, 0, 0, 0}));
  shapes.push_back(polygonOfArcs(
      "crown", {at(.12, .85), at(.08, .22), at(.30, .56), at(.50, .12), at(.70, .56), at(.92, .22), at(.88, .85)},
      {.15, -.35, -.40, -.40, -.35, .15, .20}, {0, .2, .2, -.2, -.2, 0, 0}));
  return shapes;
}

TruthShape truthShape(const std::string& name, int widthPx, int heightPx) {
  for (TruthShape& shape : truthShapes(widthPx, heightPx))
    if (shape.name == name) return std::move(shape);
  throw std::invalid_argument("no truth shape named " + name);
}

}  // namespace batten::test
