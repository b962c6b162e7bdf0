// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/width_page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/render_page.h"

namespace batten::test {
namespace {

/// A course by its parameter 0..1, dense, with the arc length; `width` of the fraction of the length.
WidthStroke strokeOf(const std::string& name, bool closed, const std::function<Vec2(double)>& at,
                     const std::function<double(double)>& width) {
  constexpr int kSteps = 4000;
  WidthStroke stroke{name, closed, {}};
  double s = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const Vec2 p = at(static_cast<double>(i) / kSteps);
    if (i > 0) s += (p - stroke.places.back().at).norm();
    stroke.places.push_back({p, s, 0.0});
  }
  for (WidthStroke::Place& place : stroke.places) place.width = width(place.s / s);
  return stroke;
}

Vec2 sideAt(const WidthStroke& stroke, std::size_t i) {
  const std::size_t n = stroke.places.size();
  std::size_t before = i == 0 ? 0 : i - 1, behind = std::min(i + 1, n - 1);
  if (stroke.closed && (i == 0 || i + 1 == n)) {
    before = n - 2;
    behind = 1;
  }
  const Vec2 along = (stroke.places[behind].at - stroke.places[before].at).normalized();
  return {-along.y(), along.x()};
}

double shoelace(const std::vector<Vec2>& border) {
  double twice = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Vec2 &a = border[i], &b = border[(i + 1) % border.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * std::abs(twice);
}

}  // namespace

double WidthStroke::length() const { return places.back().s; }

double WidthStroke::widthAt(double s) const {
  const auto found =
      std::lower_bound(places.begin(), places.end(), s, [](const Place& place, double at) { return place.s < at; });
  return found == places.end() ? places.back().width : found->width;
}

std::vector<std::vector<Vec2>> WidthStroke::borders() const {
  std::vector<std::vector<Vec2>> sides(2);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2 off = 0.5 * places[i].width * sideAt(*this, i);
    sides[0].push_back(places[i].at + off);
    sides[1].push_back(places[i].at - off);
  }
  if (closed) return sides;
  // Round the end, back on the other side, round the start.
  std::vector<Vec2> border = sides[0];
  const auto cap = [&](std::size_t i) {
    const Vec2 from = border.back() - places[i].at;
    constexpr int kCapSteps = 64;
    for (int k = 1; k < kCapSteps; ++k) {
      const double angle = -std::numbers::pi * k / kCapSteps;
      border.push_back(places[i].at + Vec2(std::cos(angle) * from.x() - std::sin(angle) * from.y(),
                                           std::sin(angle) * from.x() + std::cos(angle) * from.y()));
    }
  };
  cap(places.size() - 1);
  border.insert(border.end(), sides[1].rbegin(), sides[1].rend());
  cap(0);
  return {border};
}

double WidthStroke::area() const {
  const auto all = borders();
  return all.size() == 1 ? shoelace(all[0]) : std::abs(shoelace(all[0]) - shoelace(all[1]));
}

std::vector<WidthStroke> widthStrokes() {
  const auto swelling = [](double mean, double swing, double waves) {
    return [=](double f) { return mean + swing * std::sin(2.0 * std::numbers::pi * waves * f); };
  };
  return {
      strokeOf(
          "taper", false,
          [](double t) { return Vec2(60.3 + 700.0 * t, 120.4 + 40.0 * std::sin(std::numbers::pi * t)); },
          [](double f) { return 11.0 - 8.0 * f; }),
      strokeOf(
          "calligraphic", false,
          [](double t) { return Vec2(60.7 + 760.0 * t, 300.2 + 70.0 * std::sin(2.0 * std::numbers::pi * t)); },
          swelling(8.0, 3.5, 3.0)),
      strokeOf(
          "tips", false, [](double t) { return Vec2(90.1 + 640.0 * t, 470.6 - 50.0 * std::sin(std::numbers::pi * t)); },
          [](double f) {
            return 7.0 * std::min({1.0, f * 6.0, (1.0 - f) * 6.0});
          }),
      strokeOf(
          "ring", true,
          [](double t) {
            return Vec2(450.4 + 220.0 * std::cos(2.0 * std::numbers::pi * t),
                        680.8 + 140.0 * std::sin(2.0 * std::numbers::pi * t));
          },
          swelling(7.0, 2.0, 2.0))};
}

std::vector<float> widthCoverage(const std::vector<WidthStroke>& strokes) {
  std::vector<float> page(std::ptrdiff_t{kWidthPagePx} * kWidthPagePx, 0.0f);
  for (const WidthStroke& stroke : strokes) {
    const auto borders = stroke.borders();
    std::vector<float> own = fillCoverage(borders[0], kWidthPagePx, kWidthPagePx);
    if (borders.size() == 2) {
      const std::vector<float> hole = fillCoverage(borders[1], kWidthPagePx, kWidthPagePx);
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = std::abs(own[i] - hole[i]);
    }
    for (std::size_t i = 0; i < page.size(); ++i) page[i] = std::max(page[i], own[i]);
  }
  return page;
}

}  // namespace batten::test
