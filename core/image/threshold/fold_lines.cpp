// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/fold_lines.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "core/solve/small_least_squares.h"

namespace batten {
namespace {

constexpr int kAngles = 720;               // of half a degree: the side of the bright paper counts
constexpr int kAngleSpread = 8;            // [bins] uncertainty of a gradient's direction
constexpr double kRhoStep = 3.0;           // [px of the plane]
constexpr double kBesideSteps = 8.0;       // two peaks nearer than this are of one course, which bends a little
constexpr std::size_t kMostVoters = 8000;  // bounds the time
constexpr int kMostLines = 12;             // that are looked at closely: bounds the time
constexpr double kLeastShare = 0.2;        // of the crests that a line from border to border would have
constexpr double kLeastChord = 0.5;        // of the page's smaller side
constexpr double kSameDirection = 0.9;     // cosine of the angle between gradient and normal: 25 degrees

struct Voter {
  Vec2 p;          // from the middle of the plane
  Vec2 direction;  // of the gradient, unit
};

Vec2 gradientAt(const Plane& u, int x, int y) {
  return {static_cast<double>(u.row(y)[x + 1] - u.row(y)[x - 1]),
          static_cast<double>(u.row(y + 1)[x] - u.row(y - 1)[x])};
}

std::vector<Voter> votersOf(const Plane& u, const InkEdges& edges) {
  const std::size_t stride = edges.crests.size() / kMostVoters + 1;
  const Vec2 middle(0.5 * u.width, 0.5 * u.height);
  std::vector<Voter> voters;
  voters.reserve(edges.crests.size() / stride + 1);
  for (std::size_t i = 0; i < edges.crests.size(); i += stride) {
    const EdgePoint& e = edges.crests[i];
    const Vec2 g = gradientAt(u, e.x, e.y);
    const double length = g.norm();
    if (length > 0.0) voters.push_back({Vec2(e.x + 0.5, e.y + 0.5) - middle, g / length});
  }
  return voters;
}

/// The course along a straight line, clipped by the page. Empty if it misses the page.
std::optional<FoldCourse> courseOn(const Plane& u, double angle, double rho) {
  FoldCourse c;
  c.normal = Vec2(std::cos(angle), std::sin(angle));
  c.along = Vec2(-c.normal.y(), c.normal.x());
  c.origin = Vec2(0.5 * u.width, 0.5 * u.height) + rho * c.normal;
  c.from = -1e9;
  c.to = 1e9;
  const double size[2] = {static_cast<double>(u.width), static_cast<double>(u.height)};
  for (int axis = 0; axis < 2; ++axis) {
    const double o = c.origin[axis], a = c.along[axis];
    if (std::fabs(a) < 1e-12) {
      if (o < 0.0 || o > size[axis]) return std::nullopt;
      continue;
    }
    const double t0 = -o / a, t1 = (size[axis] - o) / a;
    c.from = std::max(c.from, std::min(t0, t1));
    c.to = std::min(c.to, std::max(t0, t1));
  }
  if (c.to - c.from < kLeastChord * std::min(u.width, u.height)) return std::nullopt;
  return c;
}

class Accumulator {
 public:
  Accumulator(const Plane& u, const std::vector<Voter>& voters)
      : half_(static_cast<int>(0.5 * std::hypot(u.width, u.height) / kRhoStep) + 2),
        columns_(2 * half_ + 1),
        counts_(std::ptrdiff_t{kAngles} * columns_, 0) {
    std::vector<Vec2> normals;
    normals.reserve(kAngles);
    for (int a = 0; a < kAngles; ++a) normals.emplace_back(std::cos(angleOf(a)), std::sin(angleOf(a)));
    for (const Voter& v : voters) {
      const double angle = std::atan2(v.direction.y(), v.direction.x());
      const int middle = static_cast<int>(std::lround(angle * kAngles / (2.0 * std::numbers::pi)));
      for (int k = middle - kAngleSpread; k <= middle + kAngleSpread; ++k) {
        const int a = (k + 2 * kAngles) % kAngles;
        const double rho = v.p.dot(normals[a]);
        ++at(a, static_cast<int>(std::floor(rho / kRhoStep)) + half_);
      }
    }
  }
  struct Peak {
    int angle = 0, column = 0, votes = 0;
  };
  /// Bins with at least this many votes, the fullest first. Two neighbouring columns count together: a line seldom
  /// lies in the middle of one.
  std::vector<Peak> peaks(double leastVotes) const {
    std::vector<Peak> found;
    for (int a = 0; a < kAngles; ++a) {
      for (int c = 0; c + 1 < columns_; ++c) {
        const int votes = get(a, c) + get(a, c + 1);
        if (votes >= leastVotes) found.push_back({a, c, votes});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Peak& a, const Peak& b) { return a.votes > b.votes; });
    return found;
  }
  bool isBeside(const Peak& p, const Peak& q) const {
    const int apart = std::abs(p.angle - q.angle);
    return std::min(apart, kAngles - apart) <= 2 * kAngleSpread &&
           std::fabs(rhoOf(p) - rhoOf(q)) < kBesideSteps * kRhoStep;
  }
  static double angleOf(int a) { return 2.0 * std::numbers::pi * a / kAngles; }
  double rhoOf(const Peak& p) const { return (p.column - half_ + 1) * kRhoStep; }

 private:
  std::uint16_t get(int a, int c) const { return counts_[std::ptrdiff_t{a} * columns_ + c]; }
  std::uint16_t& at(int a, int c) { return counts_[std::ptrdiff_t{a} * columns_ + c]; }
  int half_, columns_;
  std::vector<std::uint16_t> counts_;
};

/// Bends the course to the crests near it, nearer from round to round.
bool bendToCrests(const Plane& u, const std::vector<Voter>& voters, FoldCourse& c) {
  constexpr std::array kReaches = {12.0, 6.0, 3.0};       // [px]
  constexpr int kFewestVoters = 20;                       // near a course, to bend it
  constexpr double kFreePrior = 1e-9, kBendPrior = 1e-2;  // of the voters' weight: few of them do not bend a course
  const Vec2 middle(0.5 * u.width, 0.5 * u.height);
  const double scale = c.scale();
  for (const double reach : kReaches) {
    SmallLeastSquares<4> fit;
    int near = 0;
    for (const Voter& v : voters) {
      if (v.direction.dot(c.normal) < kSameDirection) continue;
      const Vec2 p = v.p + middle - c.origin;
      const double t = p.dot(c.along), d = p.dot(c.normal), off = d - c.bendAt(t);
      if (std::fabs(off) > reach) continue;
      const double s = t / scale, weight = std::pow(1.0 - off * off / (reach * reach), 2);
      fit.add({1.0, s, s * s, s * s * s}, d, weight);
      ++near;
    }
    if (near < kFewestVoters) return false;
    const double weights = fit.normal()(0, 0);
    fit.hold(Eigen::Vector4d(kFreePrior, kFreePrior, kBendPrior, kBendPrior) * weights);
    const Eigen::Vector4d bend = fit.solve();
    if (!bend.allFinite()) return false;
    for (int k = 0; k < 4; ++k) c.bend[k] = bend[k];
  }
  return true;
}

}  // namespace

std::vector<FoldCourse> findFoldLines(const Plane& u, const InkEdges& edges, const RunContext& context) {
  std::vector<FoldCourse> lines;
  if (u.width < 64 || u.height < 64) return lines;
  const std::vector<Voter> voters = votersOf(u, edges);
  const double density =
      static_cast<double>(voters.size()) / std::max<double>(1.0, static_cast<double>(edges.crests.size()));
  const double leastVotes = kLeastShare * kLeastChord * std::min(u.width, u.height) * density;
  if (static_cast<double>(voters.size()) < leastVotes) return lines;
  const Accumulator votes(u, voters);
  std::vector<Accumulator::Peak> tried;
  for (const Accumulator::Peak& peak : votes.peaks(leastVotes)) {
    if (static_cast<int>(tried.size()) >= kMostLines || context.isCancelled()) break;
    if (std::any_of(tried.begin(), tried.end(), [&](const auto& t) { return votes.isBeside(t, peak); })) continue;
    std::optional<FoldCourse> course = courseOn(u, Accumulator::angleOf(peak.angle), votes.rhoOf(peak));
    if (!course || peak.votes < kLeastShare * (course->to - course->from) * density) continue;
    tried.push_back(peak);
    if (bendToCrests(u, voters, *course)) lines.push_back(*course);
  }
  return lines;
}

}  // namespace batten
