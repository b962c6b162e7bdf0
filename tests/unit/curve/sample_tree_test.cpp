// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/sample_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace batten {
namespace {

/// A line that winds over a square as a boustrophedon, with some places twice.
std::vector<CurvePlace> windingPlaces(int count, std::mt19937& random) {
  std::uniform_real_distribution<double> reach(0.0, 2.0);
  std::vector<CurvePlace> places;
  for (int i = 0; i < count; ++i) {
    const int row = i / 50, column = row % 2 == 0 ? i % 50 : 49 - i % 50;
    places.push_back({Vec2(column, row), reach(random)});
    if (i % 17 == 0) places.push_back(places.back());
  }
  return places;
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
        if ((places[i].point - p).norm() - places[i].reach > bound) continue;
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
