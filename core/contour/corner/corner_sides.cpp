// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_sides.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/corner/side_points.h"
#include "core/polyline/circle_fit.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kBlockPx = 2.0;         // points are averaged over this much of the axis
constexpr double kGuessedWeight = 0.02;  // points known to the pixel only, or guessed
constexpr double kLeastSideWeight = 1.0 / 64.0, kMostSideWeight = 16.0;  // noise 8 times and 1/4 of the median
constexpr double kLeastSigmaPx = 1e-3;                                   // keeps the ratio of noises finite
constexpr double kSteepest = 0.8;         // slope against the axis up to which a side is a function of x
constexpr double kPriorDensity = 0.01;    // [px^2 px] noise of an edge in an ordinary scan, worth kPriorBlocks blocks
constexpr double kPriorBlocks = 3.0;      // how much it counts beside the noise that is measured
constexpr double kLeastDensity = 0.0006;  // [px^2 px] what the pixel grid leaves: .02 px over 16 px
constexpr int kShorterTenths = 7;         // of the blocks: the next shorter stretch that is tried
constexpr int kFewestBlocks = 3;          // two say nothing of a bend
constexpr int kMostGuessed = 40, kFewestKnown = 12;  // points
constexpr int kAxisPoints = 12;                      // nearest to the corner: over more a side may bend
constexpr int kOutlineGroup = 2, kStrokeGroup = 4;   // blocks: over as many points share their noise
constexpr double kTurnedBackPx = 2.0;                // along the axis: noise is less
constexpr double kMedianOfSquares = 0.455;           // of the variance, of a normal variable
constexpr double kThirdDifferences = 20.0;           // 1 + 9 + 9 + 1: variance of a third difference of unit noise
// [px] Waves shorter than these are noise: what the side may be, from scribble to spline.
constexpr double kShortestCutoffPx = 40.0, kLongestCutoffPx = 1100.0, kCutoffStep = 1.6;
constexpr double kStartPx = 100.0, kStartSlope = 2.0;  // what a side may be at its far end, along its axis

struct SideBlock {
  double x = 0.0, y = 0.0;
  double weight = 0.0;  // 1: full of ordinary points
};

struct SidePoint {
  Vec2 at = Vec2::Zero();
  double weight = 1.0;
  std::optional<float> sigmaPx;  // as in ContourPoint
};
using SidePoints = std::vector<SidePoint>;  // of one side, in order away from the corner

SidePoints collect(const Contour& contour, int index, int side, double inner, double outer) {
  SidePoints points;
  forPointsAside(contour, index, side, {inner, outer}, [&](const ContourPoint& p, double) {
    points.push_back({p.at, p.refined ? 1.0 : kGuessedWeight, p.sigmaPx});
  });
  return points;
}

// Next to a corner the points may be guessed only, laid round the turn where the two strokes are one body: they
// say nothing of the side.
void dropGuessed(SidePoints& points) {
  int first = 0, known = 0;
  while (first < std::ssize(points) && points[first].weight < 1.0) ++first;
  for (const SidePoint& p : points) known += p.weight < 1.0 ? 0 : 1;
  if (first > kMostGuessed || known < kFewestKnown) return;
  points.erase(points.begin(), points.begin() + first);
}

// Known points weigh by their own noise, against the median of the side.
void weighByNoise(SidePoints& points) {
  std::vector<double> known;
  for (const SidePoint& p : points)
    if (p.sigmaPx && p.weight >= 1.0) known.push_back(*p.sigmaPx);
  if (known.empty()) return;
  const double middle = upperMedian(known);
  for (SidePoint& p : points) {
    if (!p.sigmaPx || p.weight < 1.0) continue;
    const double ratio = middle / std::max<double>(*p.sigmaPx, kLeastSigmaPx);
    p.weight = std::clamp(ratio * ratio, kLeastSideWeight, kMostSideWeight);
  }
}

// The axis: the direction of the first few points.
Vec2 axisOf(const SidePoints& points) {
  const int n = std::min(static_cast<int>(points.size()), kAxisPoints);
  Vec2 mean = Vec2::Zero();
  for (int i = 0; i < n; ++i) mean += points[i].at;
  mean /= n;
  Vec2 direction = Vec2::Zero();
  for (int i = 0; i < n; ++i) direction += (i - 0.5 * (n - 1)) * (points[i].at - mean);
  const double length = direction.norm();
  return length > 0.0 ? Vec2(direction / length) : Vec2::Zero();
}

std::vector<SideBlock> blocksOf(const SidePoints& points, const CornerSide& frame) {
  std::vector<SideBlock> blocks;
  SideBlock sum;
  double begin = 0.0, furthest = 0.0, count = 0.0;
  const auto close = [&] {
    if (sum.weight > 0.0) blocks.push_back({sum.x / sum.weight, sum.y / sum.weight, sum.weight});
    sum = {};
  };
  for (const SidePoint& p : points) {
    const Vec2 d = p.at - frame.origin;
    const double x = d.dot(frame.along), y = d.dot(frame.across);
    if (&p == &points.front()) begin = furthest = x;
    if (x < furthest - kTurnedBackPx) break;
    furthest = std::max(furthest, x);
    while (x >= begin + kBlockPx) {
      close();
      begin += kBlockPx;
    }
    sum.x += p.weight * x;
    sum.y += p.weight * y;
    sum.weight += p.weight;
    count += 1.0;
    const auto n = std::ssize(blocks);
    if (n >= 4 && std::abs(blocks[n - 1].y - blocks[n - 4].y) > kSteepest * (blocks[n - 1].x - blocks[n - 4].x)) break;
  }
  close();
  for (SideBlock& b : blocks) b.weight *= static_cast<double>(blocks.size()) / count;
  return blocks;
}

// [px^2 px] Density of the noise: variance of the mean over a length, times the length. From third differences, which
// a smooth side leaves small, of the means of `group` blocks: neighbouring points of a centre line share their noise.
// For blocks of weight 1.
double noiseDensity(const std::vector<SideBlock>& blocks, int group) {
  struct Mean {
    double y = 0.0, weight = 0.0;
  };
  std::vector<Mean> means;
  std::vector<double> square;
  for (int i = 0; i + group <= std::ssize(blocks); i += group) {
    Mean mean;
    for (int k = i; k < i + group; ++k) {
      mean.y += blocks[k].y / group;
      mean.weight += blocks[k].weight / group;
    }
    means.push_back(mean);
  }
  for (int i = 0; i + 3 < std::ssize(means); ++i) {
    const double d = means[i + 3].y - 3.0 * means[i + 2].y + 3.0 * means[i + 1].y - means[i].y;
    const double w = (means[i].weight + 9.0 * means[i + 1].weight + 9.0 * means[i + 2].weight + means[i + 3].weight) /
                     kThirdDifferences;
    square.push_back(w * d * d / kThirdDifferences);
  }
  if (square.empty()) return kPriorDensity;
  const double middle = upperMedian(square);
  const double count = static_cast<double>(square.size()) / 3.0;  // neighbours share blocks
  const double measured = middle / kMedianOfSquares * kBlockPx * group;
  return std::max(kLeastDensity, (measured * count + kPriorDensity * kPriorBlocks) / (count + kPriorBlocks));
}

using State = Eigen::Vector4d;  // y and its derivatives 1 to 3 on the way towards the corner
using Spread = Eigen::Matrix4d;

// What a side may be: a line, an arc, or a course whose fourth derivative is white noise.
struct Model {
  enum class Kind { Line, Arc, Free } kind = Kind::Free;
  double tau2 = 0.0;  // density of that noise
};

// The circle nearest to blocks (Kasa: algebraic least squares) as a function over the axis, which a parabola is not.
class CircleBase {
 public:
  CircleBase() = default;
  explicit CircleBase(std::span<const SideBlock> blocks) {
    std::vector<Vec2> points;
    std::vector<double> weights;
    for (const SideBlock& b : blocks) {
      points.emplace_back(b.x, b.y);
      weights.push_back(b.weight);
    }
    const auto circle = algebraicCircle(points, weights);
    if (!circle) return;
    centreX_ = circle->centre.x();
    centreY_ = circle->centre.y();
    const double radius = circle->radius;
    const double far = std::max(std::abs(blocks.front().x - centreX_), std::abs(blocks.back().x - centreX_));
    if (!std::isfinite(radius) || radius > kFlattestPx || far > kWidestPart * radius) return;
    radius_ = centreY_ > blocks.front().y ? -radius : radius;
  }
  // Height and its derivatives 1 to 3 with respect to x; all 0 where the blocks lie on a line.
  State at(double x) const {
    const double radius = radius_.value_or(0.0);
    if (radius == 0.0) return State::Zero();
    const double dx = x - centreX_, root = std::sqrt(radius * radius - dx * dx), sign = radius > 0.0 ? 1.0 : -1.0;
    const double p = -dx / root, q = -(1.0 + p * p) / root, r = -3.0 * p * q / root;
    return {centreY_ + sign * root, sign * p, sign * q, sign * r};
  }

 private:
  static constexpr double kFlattestPx = 1e5;  // of the radius: a flatter circle is a line
  static constexpr double kWidestPart = 0.9;  // of it along the axis: farther out it turns round
  double centreX_ = 0.0, centreY_ = 0.0;
  std::optional<double> radius_;  // negative: of the arc below the centre
};

// What of the derivatives is open where a model begins.
State openOf(const State& start, Model::Kind kind) {
  State spread = start;
  if (kind != Model::Kind::Free) spread[3] = 0.0;
  if (kind == Model::Kind::Line) spread[2] = 0.0;
  return spread;
}

struct Followed {
  State mean = State::Zero();
  Spread spread = Spread::Zero();
  double logLikelihood = 0.0;
};

// One step of length h towards the corner.
void goTo(Followed& f, double h, double tau2) {
  Spread go = Spread::Identity();
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) go(i, j) = go(i, j - 1) * h / (j - i);
  f.mean = go * f.mean;
  f.spread = go * f.spread * go.transpose();
  if (!(tau2 > 0.0)) return;
  static constexpr double kRest[4] = {6.0, 2.0, 1.0, 1.0};  // (3 - i)!
  const double h2 = h * h, odd[7] = {h, h2, h2 * h, h2 * h2, h2 * h2 * h, h2 * h2 * h2, h2 * h2 * h2 * h};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) f.spread(i, j) += tau2 * odd[6 - i - j] / ((7 - i - j) * kRest[i] * kRest[j]);
}

void learn(Followed& f, const SideBlock& block, double perBlock) {
  const double variance = f.spread(0, 0) + perBlock / block.weight;
  const double miss = block.y - f.mean[0];
  f.logLikelihood -= 0.5 * (miss * miss / variance + std::log(variance));
  const State gain = f.spread.col(0) / variance;
  f.mean += gain * miss;
  f.spread -= gain * f.spread.row(0).eval();
}

// Through blocks from the farthest to the nearest.
// @param sums if given, raised to the logarithm of the likelihood of the blocks from each one on.
Followed follow(std::span<const SideBlock> blocks, const Model& model, const State& start, double perBlock,
                std::vector<double>* sums) {
  const CircleBase base = model.kind == Model::Kind::Arc ? CircleBase(blocks) : CircleBase();
  const auto about = [&](SideBlock b) {
    b.y -= base.at(b.x)[0];
    return b;
  };
  Followed f;
  f.mean[0] = about(blocks.back()).y;
  f.spread = openOf(start, model.kind).cwiseAbs2().asDiagonal();
  for (auto k = std::ssize(blocks) - 1; k >= 0; --k) {
    if (k + 1 < std::ssize(blocks)) goTo(f, blocks[k + 1].x - blocks[k].x, model.tau2);
    learn(f, about(blocks[k]), perBlock);
    if (sums) (*sums)[k] = std::max((*sums)[k], f.logLikelihood);
  }
  f.mean += State(1.0, -1.0, 1.0, -1.0).cwiseProduct(base.at(blocks.front().x));  // against x
  return f;
}

// The mean over all that a side may be and over how far from the corner on it is that, each as likely as the points
// make it. What lies beyond is a course of its own: a side may come round another corner.
struct Extension {
  Followed f;
  int count = 0;  // blocks of the most likely one
};

Extension extend(const std::vector<SideBlock>& blocks, double density) {
  std::vector<Model> models{{Model::Kind::Line}, {Model::Kind::Arc}};
  for (double cutoff = kShortestCutoffPx; cutoff < kLongestCutoffPx; cutoff *= kCutoffStep)
    models.push_back({Model::Kind::Free, density / std::pow(cutoff / (2.0 * std::numbers::pi), 8)});
  const double oneOfFree = std::log(static_cast<double>(models.size() - 2));
  const double perBlock = density / kBlockPx;
  // What a side and its derivatives may be at its far end: it turns by a radian or two along its way, no more, because
  // it stays a function of its axis.
  const double length = std::max(kBlockPx, blocks.back().x - blocks.front().x);
  const State start(kStartPx, kStartSlope, 2.0 / length, 4.0 / (length * length));
  std::vector<double> beyond(blocks.size() + 1, -std::numeric_limits<double>::infinity());
  beyond.back() = 0.0;
  struct Choice {
    Followed f;
    double evidence;
    int count;
  };
  std::vector<Choice> all;
  for (int count = static_cast<int>(blocks.size()); count >= kFewestBlocks; count = count * kShorterTenths / 10) {
    const bool whole = count == std::ssize(blocks);
    for (const Model& model : models) {
      const Followed f = follow(std::span(blocks).first(count), model, start, perBlock, whole ? &beyond : nullptr);
      // A line, an arc and a free course are as likely before anything is known.
      all.push_back({f, f.logLikelihood - (model.kind == Model::Kind::Free ? oneOfFree : 0.0), count});
    }
  }
  double best = -std::numeric_limits<double>::infinity();
  Extension result;
  for (Choice& c : all) {
    // A course may change anywhere; the stretches are spaced by ratios.
    if (c.count < std::ssize(blocks))
      c.evidence += beyond[c.count] + std::log(static_cast<double>(c.count) / static_cast<double>(blocks.size()));
    if (c.evidence > best) best = c.evidence, result.count = c.count;
  }
  double total = 0.0;
  for (const Choice& c : all) total += std::exp(c.evidence - best);
  // At one place for all: the nearest block.
  for (const Choice& c : all) result.f.mean += std::exp(c.evidence - best) / total * c.f.mean;
  for (const Choice& c : all) {
    const State off = c.f.mean - result.f.mean;
    result.f.spread += std::exp(c.evidence - best) / total * (c.f.spread + off * off.transpose());
  }
  return result;
}

// The cubic that goes on from the last state, as a side; the state runs against x.
void continueSide(const Followed& f, double from, double to, CornerSide& side) {
  side.from = from;
  side.to = std::max(to, from + 1.0);
  const double half = 0.5 * (side.to - side.from);  // x - from = half (z + 1)
  const double w[4] = {f.mean[0], -f.mean[1] * half, f.mean[2] / 2.0 * half * half,
                       -f.mean[3] / 6.0 * half * half * half};
  side.coefficient = {w[0] + w[1] + w[2] + w[3], w[1] + 2.0 * w[2] + 3.0 * w[3], w[2] + 3.0 * w[3], w[3]};
  const State reversed(1.0, -1.0, 1.0, -1.0);
  Eigen::Map<Spread>(side.spread.data()) = reversed.asDiagonal() * f.spread * reversed.asDiagonal();
  const State row(1.0, from, from * from / 2.0, from * from * from / 6.0);
  side.sigmaPx = std::sqrt(std::max(0.0, row.dot(f.spread * row)));
}

// What is too short to show a bend is straight.
std::optional<CornerSide> straightSide(const std::vector<SideBlock>& blocks, CornerSide side) {
  if (blocks.size() < 2) return std::nullopt;
  const double from = blocks.front().x, to = blocks.back().x;
  const State start(kStartPx, kStartSlope, 0.0, 0.0);
  continueSide(follow(blocks, {Model::Kind::Line}, start, kPriorDensity / kBlockPx, nullptr), from, to, side);
  return side;
}

}  // namespace

Vec2 CornerSide::at(double x) const {
  const double z = (2.0 * x - from - to) / (to - from);
  double y = 0.0;
  for (auto k = std::ssize(coefficient) - 1; k >= 0; --k) y = y * z + coefficient[k];
  return origin + x * along + y * across;
}

Vec2 CornerSide::derivative(double x) const {
  const double z = (2.0 * x - from - to) / (to - from);
  double slope = 0.0;
  for (auto k = std::ssize(coefficient) - 1; k >= 1; --k) slope = slope * z + static_cast<double>(k) * coefficient[k];
  return along + 2.0 * slope / (to - from) * across;
}

std::optional<CornerSide> fitCornerSide(const Contour& contour, int index, int side, double inner, double outer) {
  CornerSide best;
  best.origin = contour.points[index].at;
  SidePoints points = collect(contour, index, side, inner, outer);
  dropGuessed(points);
  weighByNoise(points);
  if (points.size() < 3) return std::nullopt;
  best.along = axisOf(points);
  best.across = Vec2(-best.along.y(), best.along.x());
  if (!(best.along.norm() > 0.5)) return std::nullopt;  // a unit vector, or none
  const std::vector<SideBlock> blocks = blocksOf(points, best);
  if (std::ssize(blocks) < kFewestBlocks) return straightSide(blocks, best);
  const double density = noiseDensity(blocks, contour.kind == ContourKind::Outline ? kOutlineGroup : kStrokeGroup);
  const Extension extension = extend(blocks, density);
  continueSide(extension.f, blocks.front().x, blocks[extension.count - 1].x, best);
  return best;
}

}  // namespace batten
