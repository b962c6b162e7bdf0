// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/sample_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Straight lines across a square, from one random place to the next.
std::vector<CurvePlace> scribbledPlaces(int lines, std::mt19937& random) {
  constexpr int kPerLine = 40;
  std::uniform_real_distribution<double> where(0.0, 50.0);
  std::vector<CurvePlace> places;
  Vec2 from(where(random), where(random));
  for (int line = 0; line < lines; ++line) {
    const Vec2 to(where(random), where(random));
    for (int k = 0; k < kPerLine; ++k) places.push_back({from + (to - from) * (1.0 * k / kPerLine), 0.01});
    from = to;
  }
  return places;
}

/// What `within` has to visit where the bound shrinks to nine tenths at each.
std::vector<std::size_t> visitsThroughAll(const std::vector<CurvePlace>& places, const Vec2& p, double bound) {
  const auto isNear = [&](std::size_t i) { return toChords(places, i, p) - places[i].bulge <= bound; };
  std::vector<std::size_t> near, visits;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (isNear(i)) near.push_back(i);
  if (near.size() > SampleTree::kFew) {
    visits.push_back(*std::min_element(near.begin(), near.end(), [&](std::size_t i, std::size_t j) {
      return toChords(places, i, p) - places[i].bulge < toChords(places, j, p) - places[j].bulge;
    }));
    bound *= 0.9;
  }
  for (const std::size_t i : near) {
    if ((!visits.empty() && near.size() > SampleTree::kFew && i == visits.front()) || !isNear(i)) continue;
    visits.push_back(i);
    bound *= 0.9;
  }
  return visits;
}

TEST(SampleTree, AnswersAsASearchThroughAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> where(-10.0, 60.0);
  std::vector<std::vector<CurvePlace>> lines;
  for (const int count : {1, 2, 8, 9, 100, 1500}) lines.push_back(windingPlaces(count, random));
  lines.push_back(scribbledPlaces(50, random));
  for (const std::vector<CurvePlace>& line : lines) {
    const SampleTree tree(line);
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
      std::vector<std::size_t> found;
      tree.within(
          p, [&] { return bound; },
          [&](std::size_t i) {
            found.push_back(i);
            bound *= 0.9;
          });
      EXPECT_EQ(found, visitsThroughAll(places, p, 3.0));
    }
  }
}

TEST(SampleTree, LooksAtFewBoxesWhereALineCrossesItselfEverywhere) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> where(5.0, 45.0);
  const SampleTree tree(scribbledPlaces(1000, random));
  int asked = 0;
  constexpr int kQueries = 100;
  for (int query = 0; query < kQueries; ++query) {
    tree.within(
        Vec2(where(random), where(random)),
        [&] {
          ++asked;
          return 0.01;
        },
        [](std::size_t) {});
  }
  EXPECT_LT(asked / kQueries, 1000) << "of 40000 places";
}

}  // namespace
}  // namespace batten
