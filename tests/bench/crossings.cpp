// SPDX-License-Identifier: GPL-3.0-or-later
// Lines that cross, meet at shallow angles and branch off: how many are found whole, and how often a found line passes
// from one drawn line to another.
//
//   bench_crossings [--seeds N] [--open]    open: junctions that are doubtful end all their strokes

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "tests/bench/traced_lines.h"
#include "tests/support/dense_page.h"
#include "tests/support/ink_page.h"

using namespace batten;
using namespace batten::test;

namespace {

using Line = std::vector<Vec2>;
constexpr int kWidth = 900, kHeight = 700;
constexpr double kMarginPx = 30.0;
constexpr double kLeastRadiusPx = 60.0, kMostRadiusPx = 250.0;  // by which lines that touch bend apart
constexpr std::size_t kBesidePoints = 5;

struct Drawn {
  Line points;
  double widthPx = 4.0;
};

bool isOnPage(const Line& line) {
  return std::all_of(line.begin(), line.end(), [](const Vec2& p) {
    return p.x() > kMarginPx && p.y() > kMarginPx && p.x() < kWidth - kMarginPx && p.y() < kHeight - kMarginPx;
  });
}

// An arc whose curvature changes evenly along it, through `at`; points 1 px apart.
Line clothoid(const Vec2& at, double angle, double length, double curvature, double slope) {
  Line line;
  for (const double side : {-1.0, 1.0}) {
    Vec2 p = at;
    double direction = angle;
    Line half;
    for (double s = 0.0; s < 0.5 * length; s += 1.0) {
      half.push_back(p);
      const double k = curvature + slope * side * s;
      p += side * Vec2(std::cos(direction), std::sin(direction));
      direction += side * k;
    }
    if (side < 0.0) {
      line.assign(half.rbegin(), half.rend() - 1);
    } else {
      line.insert(line.end(), half.begin(), half.end());
    }
  }
  return line;
}

class Random {
 public:
  explicit Random(std::uint32_t seed) : generator_(seed) {}
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator_); }

 private:
  std::mt19937 generator_;
};

Line anyLine(Random& random) {
  for (;;) {
    const double curvature = random.between(-1.0, 1.0) / 200.0;
    const double length = random.between(250.0, 520.0);
    Line line =
        clothoid({random.between(0.0, kWidth), random.between(0.0, kHeight)}, random.between(0.0, std::numbers::pi),
                 length, curvature, random.between(-1.0, 1.0) / 200.0 / length);
    if (isOnPage(line)) return line;
  }
}

struct Kind {
  std::string name;
  std::vector<double> widthsPx;  // in turn
  double leastDeg = 0.0, mostDeg = 90.0;
  bool isBranch = false;     // the second line of a pair begins on the first one
  bool isTouching = false;   // the second one bends away from the first at either side
  bool areTogether = false;  // for so long that they cannot be told apart there
};

Vec2 directionAt(const Line& line, std::size_t i) {
  const Vec2 d = line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0];
  return d / d.norm();
}

// [1/px] Positive where the line turns from x to y.
double curvatureAt(const Line& line, std::size_t i) {
  const Vec2 a = directionAt(line, i - kBesidePoints), b = directionAt(line, i + kBesidePoints);
  return cross(a, b) / (2.0 * static_cast<double>(kBesidePoints));
}

// Pairs of lines that meet in their middles under an angle of the kind, pairs apart from one another.
std::vector<Drawn> pairsOf(const Kind& kind, Random& random) {
  std::vector<Drawn> drawn;
  for (int tries = 0; tries < 400 && drawn.size() < 8; ++tries) {
    const Line first = anyLine(random);
    const std::size_t middle = first.size() / 2;
    const Vec2 d = directionAt(first, middle);
    const double turn = random.between(kind.leastDeg, kind.mostDeg) * std::numbers::pi / 180.0;
    const double angle = std::atan2(d.y(), d.x()) + (random.between(0.0, 1.0) < 0.5 ? turn : -turn);
    Line second = clothoid(first[middle], angle, random.between(250.0, 450.0), random.between(-1.0, 1.0) / 250.0, 0.0);
    if (kind.isTouching) {
      const double away = (random.between(0.0, 1.0) < 0.5 ? 1.0 : -1.0) / random.between(kLeastRadiusPx, kMostRadiusPx);
      second = clothoid(first[middle], std::atan2(d.y(), d.x()), random.between(150.0, 300.0),
                        curvatureAt(first, middle) + away, 0.0);
    }
    if (kind.isBranch) second.erase(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(second.size() / 2));
    if (!isOnPage(second)) continue;
    const auto isNear = [](const Line& a, const Line& b) {
      for (std::size_t i = 0; i < a.size(); i += 5) {
        for (std::size_t k = 0; k < b.size(); k += 5) {
          if ((a[i] - b[k]).norm() < 40.0) return true;
        }
      }
      return false;
    };
    if (std::any_of(drawn.begin(), drawn.end(),
                    [&](const Drawn& other) { return isNear(other.points, first) || isNear(other.points, second); }))
      continue;
    drawn.push_back({first, kind.widthsPx[0]});
    drawn.push_back({second, kind.widthsPx.back()});
  }
  return drawn;
}

double distanceTo(const Line& line, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& q : line) least = std::min(least, (p - q).norm());
  return least;
}

// Of `points` so much lies within `tolerancePx` of one of the lines. Points 1 px apart; every second one is looked at.
double shareOn(const Line& points, const std::vector<Line>& lines, double tolerancePx) {
  int on = 0, looked = 0;
  for (std::size_t i = 0; i < points.size(); i += 2) {
    ++looked;
    on += std::ranges::any_of(lines, [&](const Line& line) { return distanceTo(line, points[i]) <= tolerancePx; });
  }
  return static_cast<double>(on) / std::max(1, looked);
}

// Lines that lie on one another for long cannot be told apart there, so that scoreDense() would take a found line for
// now the one, now the other. Whole is here: one found line lies on this one all along, and covers it. A found line
// that needs two of the drawn ones to lie on has passed from one to the other.
DenseScore scoreTogether(const std::vector<Line>& truth, const std::vector<Line>& found, double tolerancePx) {
  constexpr double kAll = 0.95;
  DenseScore score;
  score.drawn = static_cast<int>(truth.size());
  for (const Line& line : truth) {
    const bool isWhole = std::ranges::any_of(found, [&](const Line& f) {
      return shareOn(f, {line}, tolerancePx) >= kAll && shareOn(line, {f}, tolerancePx) >= kAll;
    });
    if (isWhole) {
      ++score.whole;
    } else if (shareOn(line, found, tolerancePx) >= 0.5) {
      ++score.inPieces;
    }
  }
  for (const Line& f : found) {
    const bool isOnOne =
        std::ranges::any_of(truth, [&](const Line& line) { return shareOn(f, {line}, tolerancePx) >= kAll; });
    score.bridges += !isOnOne && shareOn(f, truth, tolerancePx) >= kAll;
  }
  return score;
}

// Of the places where two lines meet: how many are right, both lines whole and none passing to the other, and where a
// junction is shown as doubtful.
struct Places {
  int right = 0, rightShown = 0, wrong = 0, wrongShown = 0;
  void add(const Places& o) {
    right += o.right;
    rightShown += o.rightShown;
    wrong += o.wrong;
    wrongShown += o.wrongShown;
  }
};

struct CrossingScore {
  DenseScore lines;
  Places places;
};

DenseScore scoreLines(const std::vector<Line>& truth, const std::vector<Line>& found, double widest, bool together) {
  return together ? scoreTogether(truth, found, 0.5 * widest) : scoreDense(truth, found, widest, 3.0 * widest);
}

Places placesOf(const std::vector<Line>& truth, const PipelineOutput& out, double widest, bool together) {
  Places places;
  const std::vector<Line> found = linesOf(out);
  for (std::size_t k = 0; k + 1 < truth.size(); k += 2) {
    const std::vector<Line> two = {truth[k], truth[k + 1]};
    const DenseScore score = scoreLines(two, found, widest, together);
    const bool isShown =
        out.contours && std::ranges::any_of(out.contours->junctions, [&](const StrokeJunction& j) {
          return j.isDoubtful && std::min(distanceTo(two[0], j.positionPx), distanceTo(two[1], j.positionPx)) < widest;
        });
    const bool isRight = score.whole == 2 && score.bridges == 0;
    ++(isRight ? places.right : places.wrong);
    (isRight ? places.rightShown : places.wrongShown) += isShown ? 1 : 0;
  }
  return places;
}

// Every doubtful junction left open.
Recipe withDoubtOpen(const PipelineOutput& out) {
  Recipe recipe;
  for (const StrokeJunction& j : out.contours->junctions)
    if (j.isDoubtful) recipe.edges.junctions.push_back({j.positionPx, {}});
  return recipe;
}

CrossingScore scoreOf(const std::vector<Drawn>& drawn, std::uint32_t seed, bool together, bool isDoubtOpen) {
  std::vector<float> cover(std::ptrdiff_t{kWidth} * kHeight, 0.0f);
  std::vector<Line> truth;
  double widest = 0.0;
  for (const Drawn& d : drawn) {
    inkOver(cover, coverageOf({d.points}, d.widthPx, kWidth, kHeight));
    truth.push_back(d.points);
    widest = std::max(widest, d.widthPx);
  }
  const Scan scan = scanOfLines(std::move(cover), kWidth, kHeight, seed);
  PipelineOutput out = tracedPage(scan, {});
  const Places places = placesOf(truth, out, widest, together);
  if (isDoubtOpen && out.contours) out = tracedPage(scan, withDoubtOpen(out));
  return {scoreLines(truth, linesOf(out), widest, together), places};
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 6;
  bool isDoubtOpen = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--seeds" && i + 1 < argc) seeds = std::max(1, std::atoi(argv[i + 1]));
    isDoubtOpen = isDoubtOpen || std::string(argv[i]) == "--open";
  }
  std::vector<Kind> kinds;
  for (const auto& [widths, name] : {std::pair<std::vector<double>, std::string>{{4.0}, "4 and 4 px"},
                                     {{8.0}, "8 and 8 px"},
                                     {{3.0, 8.0}, "3 and 8 px"}}) {
    kinds.push_back({"touching, " + name, widths, 0.0, 0.0, false, true, true});
    kinds.push_back({"crossing, " + name, widths, 5.0, 10.0, false, false, true});
    for (const double angle : {10.0, 20.0, 35.0, 60.0})
      kinds.push_back({"crossing, " + name, widths, angle, angle + 10.0});
    for (const double angle : {15.0, 30.0, 60.0})
      kinds.push_back({"branch, " + name, {widths.rbegin(), widths.rend()}, angle, angle + 15.0, true});
  }
  std::printf("%-24s %10s %14s %8s %8s %8s\n", "", "angle", "whole", "pieces", "lost", "switches");
  DenseScore all;
  Places places;
  for (const Kind& kind : kinds) {
    DenseScore sum;
    for (int seed = 1; seed <= seeds; ++seed) {
      Random random(static_cast<std::uint32_t>(seed));
      const CrossingScore score =
          scoreOf(pairsOf(kind, random), static_cast<std::uint32_t>(seed), kind.areTogether, isDoubtOpen);
      const DenseScore& s = score.lines;
      places.add(score.places);
      for (DenseScore* to : {&sum, &all}) {
        to->drawn += s.drawn;
        to->whole += s.whole;
        to->inPieces += s.inPieces;
        to->bridges += s.bridges;
      }
    }
    std::printf("%-24s %4.0f to %2.0f %6d of %4d %8d %8d %8d\n", kind.name.c_str(), kind.leastDeg, kind.mostDeg,
                sum.whole, sum.drawn, sum.inPieces, sum.drawn - sum.whole - sum.inPieces, sum.bridges);
    std::fflush(stdout);
  }
  std::printf("%-24s %10s %6d of %4d %8d %8d %8d\n", "all", "", all.whole, all.drawn, all.inPieces,
              all.drawn - all.whole - all.inPieces, all.bridges);
  std::printf("shown as doubtful: %d of %d places that are wrong, %d of %d that are right\n", places.wrongShown,
              places.wrong, places.rightShown, places.right);
  return 0;
}
