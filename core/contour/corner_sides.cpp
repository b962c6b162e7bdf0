// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner_sides.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

constexpr double kBlockPx = 2.0;           // points are averaged over this much of the axis
constexpr double kUnrefinedWeight = 0.02;  // points known to the pixel only, or guessed
constexpr double kSteepest = 0.8;          // slope against the axis up to which a side is a function of x
constexpr double kPriorDensity = 0.01;     // [px^2 px] noise of an edge in an ordinary scan, worth kPriorBlocks blocks
constexpr double kPriorBlocks = 3.0;
constexpr double kLeastDensity = 0.0064;  // [px^2 px] what the pixel grid leaves: .02 px over 16 px
constexpr double kTrendLimit = 7.8;       // chi squared of three trends: one in twenty by chance
constexpr int kTrends = 3;
constexpr double kAgree = 2.0;  // [standard deviations] by which higher orders may move the end
constexpr double kShortestPx = 8.0, kLengthStep = 1.26;

struct Block {
  double x = 0.0, y = 0.0, weight = 0.0;
};

double weightOf(const Contour& contour, std::size_t i) {
  return i < contour.refined.size() && contour.refined[i] == 0 ? kUnrefinedWeight : 1.0;
}

// The points of one side, in order away from the corner.
struct SidePoints {
  std::vector<Vec2> at;
  std::vector<double> weight;
};

SidePoints collect(const Contour& contour, int index, int side, double inner, double outer) {
  SidePoints points;
  const int n = static_cast<int>(contour.points.size());
  const int most = contour.closed ? n / 2 : n;
  double arc = 0.0;
  for (int k = 0; k < most; ++k) {
    const int i = contour.closed ? wrapIndex(index + side * k, n) : index + side * k;
    if (i < 0 || i >= n) break;
    const auto at = static_cast<std::size_t>(i);
    if (k > 0) {
      const int j = contour.closed ? wrapIndex(i - side, n) : i - side;
      arc += (contour.points[at] - contour.points[static_cast<std::size_t>(j)]).norm();
    }
    if (arc > outer) break;
    if (arc < inner) continue;
    points.at.push_back(contour.points[at]);
    points.weight.push_back(weightOf(contour, at));
  }
  return points;
}

// The axis: the direction of the first few points.
Vec2 axisOf(const SidePoints& points) {
  const std::size_t n = std::min<std::size_t>(points.at.size(), 12);
  Vec2 mean = Vec2::Zero();
  for (std::size_t i = 0; i < n; ++i) mean += points.at[i];
  mean /= static_cast<double>(n);
  Vec2 direction = Vec2::Zero();
  for (std::size_t i = 0; i < n; ++i)
    direction += (static_cast<double>(i) - 0.5 * static_cast<double>(n - 1)) * (points.at[i] - mean);
  const double length = direction.norm();
  return length > 0.0 ? Vec2(direction / length) : Vec2::Zero();
}

std::vector<Block> blocksOf(const SidePoints& points, const CornerSide& frame) {
  std::vector<Block> blocks;
  Block sum;
  double begin = 0.0, furthest = 0.0;
  const auto close = [&] {
    if (sum.weight > 0.0) blocks.push_back({sum.x / sum.weight, sum.y / sum.weight, sum.weight});
    sum = {};
  };
  for (std::size_t i = 0; i < points.at.size(); ++i) {
    const Vec2 d = points.at[i] - frame.origin;
    const double x = d.dot(frame.along), y = d.dot(frame.across);
    if (i == 0) begin = furthest = x;
    if (x < furthest - 2.0) break;  // turned back
    furthest = std::max(furthest, x);
    while (x >= begin + kBlockPx) {
      close();
      begin += kBlockPx;
    }
    sum.x += points.weight[i] * x;
    sum.y += points.weight[i] * y;
    sum.weight += points.weight[i];
    const std::size_t n = blocks.size();
    if (n >= 4 && std::abs(blocks[n - 1].y - blocks[n - 4].y) > kSteepest * (blocks[n - 1].x - blocks[n - 4].x)) break;
  }
  close();
  return blocks;
}

// [px^2 px] Density of the noise: variance of the mean over a length, times the length. From third differences, which
// a smooth side leaves small, of the means of `group` blocks: neighbouring points of a centre line share their noise.
double noiseDensity(const std::vector<Block>& blocks, std::size_t group) {
  std::vector<double> mean, square;
  for (std::size_t i = 0; i + group <= blocks.size(); i += group) {
    double sum = 0.0;
    for (std::size_t k = i; k < i + group; ++k) sum += blocks[k].y / static_cast<double>(group);
    mean.push_back(sum);
  }
  for (std::size_t i = 0; i + 3 < mean.size(); ++i) {
    const double d = mean[i + 3] - 3.0 * mean[i + 2] + 3.0 * mean[i + 1] - mean[i];
    square.push_back(d * d / 20.0);
  }
  if (square.empty()) return kPriorDensity;
  // The median of squares of a normal variable is .455 of its variance.
  const auto middle = square.begin() + static_cast<std::ptrdiff_t>(square.size() / 2);
  std::nth_element(square.begin(), middle, square.end());
  const double count = static_cast<double>(square.size()) / 3.0;  // neighbours share blocks
  const double measured = *middle / 0.455 * kBlockPx * static_cast<double>(group);
  return std::max(kLeastDensity, (measured * count + kPriorDensity * kPriorBlocks) / (count + kPriorBlocks));
}

constexpr int kMostTerms = CornerSide::kMostDegree + kTrends + 1;

void legendre(double z, int terms, double* p) {
  p[0] = 1.0;
  if (terms > 1) p[1] = z;
  for (int k = 2; k < terms; ++k) p[k] = ((2 * k - 1) * z * p[k - 1] - (k - 1) * p[k - 2]) / k;
}

struct Candidate {
  Eigen::VectorXd coefficient;  // of Legendre polynomials over the stretch
  double end = 0.0;             // [px] at x = 0
  double variance = -1.0;       // [px^2] of that; < 0: no fit
  bool describes = false;       // its points, and where they lead, as well as higher orders do
  double from = 0.0, to = 0.0;  // [px]
};

Candidate fitDegree(const std::vector<Block>& blocks, std::size_t count, int degree, double density) {
  Candidate result;
  const int terms = degree + 1;
  const int all = std::min<int>(terms + kTrends, static_cast<int>(count));
  if (static_cast<int>(count) < terms + 1) return result;
  const double a = blocks.front().x, b = blocks[count - 1].x;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(all);
  double p[kMostTerms];
  double mean = 0.0;
  for (std::size_t i = 0; i < count; ++i) mean += blocks[i].weight / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    legendre((2.0 * blocks[i].x - a - b) / (b - a), all, p);
    const Eigen::Map<Eigen::VectorXd> row(p, all);
    const double w = blocks[i].weight / mean;
    normal.noalias() += w * row * row.transpose();
    right.noalias() += w * blocks[i].y * row;
  }
  const Eigen::LDLT<Eigen::MatrixXd> small(normal.topLeftCorner(terms, terms));
  if (small.info() != Eigen::Success || !(small.vectorD().minCoeff() > 1e-9 * small.vectorD().maxCoeff()))
    return result;
  result.coefficient = small.solve(right.head(terms));
  const double perBlock = density / kBlockPx;
  legendre((-a - b) / (b - a), terms, p);
  const Eigen::Map<Eigen::VectorXd> end(p, terms);
  result.variance = perBlock * end.dot(small.solve(end));
  result.end = end.dot(result.coefficient);
  result.from = a;
  result.to = b;
  // What the further terms explain, in units of the noise, and how far they move the end.
  result.describes = true;
  double ends[kMostTerms];
  legendre((-a - b) / (b - a), all, ends);
  for (int more = terms + 1; more <= all && result.describes; ++more) {
    const Eigen::LDLT<Eigen::MatrixXd> large(normal.topLeftCorner(more, more));
    const Eigen::VectorXd wide = large.solve(right.head(more));
    const Eigen::Map<Eigen::VectorXd> wideEnd(ends, more);
    const double chi = (wide.dot(right.head(more)) - result.coefficient.dot(right.head(terms))) / perBlock;
    const double change = wideEnd.dot(wide) - result.end;
    const double spread = perBlock * wideEnd.dot(large.solve(wideEnd)) - result.variance;
    result.describes = chi <= kTrendLimit && change * change <= kAgree * kAgree * spread;
  }
  return result;
}

// Legendre polynomials to powers of z.
void toPowers(const Eigen::VectorXd& legendre, CornerSide& side) {
  static constexpr double kPowers[CornerSide::kMostDegree + 1][CornerSide::kMostDegree + 1] = {
      {1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {-0.5, 0, 1.5, 0, 0}, {0, -1.5, 0, 2.5, 0}, {0.375, 0, -3.75, 0, 4.375}};
  side.coefficient = {};
  for (Eigen::Index k = 0; k < legendre.size(); ++k)
    for (std::size_t j = 0; j < side.coefficient.size(); ++j)
      side.coefficient[j] += legendre[k] * kPowers[static_cast<std::size_t>(k)][j];
}

// Among all orders over all stretches.
Candidate bestOf(const std::vector<Block>& blocks, double density) {
  Candidate best;
  for (double length = kShortestPx;; length *= kLengthStep) {
    std::size_t count = 0;
    while (count < blocks.size() && blocks[count].x <= blocks.front().x + length) ++count;
    for (int degree = 1; degree <= CornerSide::kMostDegree; ++degree) {
      Candidate c = fitDegree(blocks, count, degree, density);
      if (c.variance < 0.0) continue;
      // Something first, then anything that describes its points, then the better known one.
      if (best.variance >= 0.0 && !(c.describes && (!best.describes || c.variance < best.variance))) continue;
      best = std::move(c);
    }
    if (count == blocks.size()) break;
  }
  return best;
}

}  // namespace

Vec2 CornerSide::at(double x) const {
  const double z = (2.0 * x - from - to) / (to - from);
  double y = 0.0;
  for (std::size_t k = coefficient.size(); k-- > 0;) y = y * z + coefficient[k];
  return origin + x * along + y * across;
}

Vec2 CornerSide::derivative(double x) const {
  const double z = (2.0 * x - from - to) / (to - from);
  double slope = 0.0;
  for (std::size_t k = coefficient.size(); k-- > 1;) slope = slope * z + static_cast<double>(k) * coefficient[k];
  return along + 2.0 * slope / (to - from) * across;
}

CornerSide fitCornerSide(const Contour& contour, int index, int side, double inner, double outer) {
  CornerSide best;
  best.origin = contour.points[static_cast<std::size_t>(index)];
  const SidePoints points = collect(contour, index, side, inner, outer);
  if (points.at.size() < 3) return best;
  best.along = axisOf(points);
  best.across = Vec2(-best.along.y(), best.along.x());
  if (!(best.along.norm() > 0.5)) return best;
  const std::vector<Block> blocks = blocksOf(points, best);
  const double density = noiseDensity(blocks, contour.kind == ContourKind::Outline ? 2 : 4);
  const Candidate candidate = bestOf(blocks, density);
  const Candidate* chosen = &candidate;
  if (candidate.variance < 0.0) return best;
  best.degree = static_cast<int>(chosen->coefficient.size()) - 1;
  best.from = chosen->from;
  best.to = chosen->to;
  best.sigmaPx = std::sqrt(chosen->variance);
  toPowers(chosen->coefficient, best);
  return best;
}

}  // namespace batten
