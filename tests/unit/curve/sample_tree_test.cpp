// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/sample_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace batten {
namespace {

/// A line that winds over a square as a boustrophedon, with some places twice.
std::vector<CurvePlace> windingPlaces(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> bulge(0.0, 2.0);
  std::vector<CurvePlace> places;
  for (int i = 0; i < count; ++i) {
    const int row = i / 50, column = row % 2 == 0 ? i % 50 : 49 - i % 50;
    places.push_back({Vec2(column, row), bulge(random)});
    if (i % 17 == 0) places.push_back(places.back());
  }
  return places;
}

double toSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double length = (b - a).squaredNorm();
  const double share = length > 0.0 ? std::min(1.0, std::max(0.0, (p - a).dot(b - a) / length)) : 0.0;
  return (p - a - share * (b - a)).norm();
}

double toChords(const std::vector<CurvePlace>& places, std::size_t i, const Vec2& p) {
  const Vec2 before = places[i > 0 ? i - 1 : i].point, behind = places[std::min(i + 1, places.size() - 1)].point;
  return std::min(toSegment(p, before, places[i].point), toSegment(p, places[i].point, behind));
}

TEST(SampleTree, AnswersAsASearchThroughAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> where(-10.0, 60.0);
  for (const int count : {1, 2, 8, 9, 100, 1500}) {
    const SampleTree tree(windingPlaces(count, random));
    const auto& places = tree.places();
    for (int query = 0; query < 200; ++query) {
      // Half of the queries lie where distances tie.
      const Vec2 p = query % 2 == 0 ? Vec2(where(random), where(random))
                                    : Vec2(0.5 * std::round(where(random)), 0.5 * std::round(where(random)));
      std::size_t nearest = 0;
      for (std::size_t i = 0; i < places.size(); ++i)
        if ((places[i].point - p).norm() < (places[nearest].point - p).norm()) nearest = i;
      EXPECT_EQ(tree.nearest(p), nearest);
      double bound = 3.0;
      std::vector<std::size_t> expected, found;
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (toChords(places, i, p) - places[i].bulge > bound) continue;
        expected.push_back(i);
        bound *= 0.9;
      }
      bound = 3.0;
      tree.within(
          p, [&] { return bound; },
          [&](std::size_t i) {
            found.push_back(i);
            bound *= 0.9;
          });
      EXPECT_EQ(found, expected);
    }
  }
}

}  // namespace
}  // namespace batten
