// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/centreline_graph.h"

namespace batten {
namespace {

struct FreeEnd {
  int strand = 0, side = 0;  ///< side 0: the start.
  Vec2 at = Vec2::Zero();
  Vec2 out = Vec2::Zero();  ///< Unit direction in which the stroke would go on.
  double width = 1.0;
  int best = -1;
  double bestCost = 0.0;
};

// Direction of a free end; the last pixels of a skeleton turn to a corner of the pen's end and are left out.
Vec2 endDirection(const Strand& s, int side, double width) {
  const auto n = static_cast<double>(s.points.size());
  const auto at = [&](double k) {
    const auto i = static_cast<std::size_t>(std::clamp(k, 0.0, n - 1.0));
    return s.points[side == 0 ? i : s.points.size() - 1 - i].at;
  };
  const double near = std::min(0.5 * width + 1.0, 0.3 * n), far = near + std::max(4.0, 3.0 * width);
  const Vec2 d = at(near) - at(far);
  return d.norm() > 0.0 ? Vec2(d / d.norm()) : Vec2::Zero();
}

std::vector<FreeEnd> freeEnds(const std::vector<Strand>& strands) {
  std::vector<FreeEnd> ends;
  for (int i = 0; i < static_cast<int>(strands.size()); ++i) {
    const Strand& s = strands[static_cast<std::size_t>(i)];
    if (s.closed || s.points.size() < 3) continue;
    const double width = s.widthPx();
    for (int side = 0; side < 2; ++side) {
      if (!s.tip[side]) continue;
      const Vec2 at = side == 0 ? s.points.front().at : s.points.back().at;
      ends.push_back({i, side, at, endDirection(s, side, width), width});
    }
  }
  std::sort(ends.begin(), ends.end(), [](const FreeEnd& a, const FreeEnd& b) {
    return a.at.x() != b.at.x() ? a.at.x() < b.at.x() : (a.at.y() != b.at.y() ? a.at.y() < b.at.y() : a.side < b.side);
  });
  return ends;
}

// Cost of joining two ends, < 0: do not. They must look at each other unless the gap is no longer than the pen is wide.
double joinCost(const FreeEnd& a, const FreeEnd& b, double gapFactor) {
  const double width = 0.5 * (a.width + b.width);
  const Vec2 d = b.at - a.at;
  const double gap = d.norm();
  if (gap > gapFactor * width + 2.0) return -1.0;
  const double turn = std::acos(std::clamp(-a.out.dot(b.out), -1.0, 1.0));
  const double deg = std::numbers::pi / 180.0;
  if (gap <= 1.5 * width) return turn <= 60.0 * deg && d.dot(a.out) >= -0.5 * width ? gap + width * turn : -1.0;
  const double limit = std::cos(30.0 * deg) * gap;
  if (d.dot(a.out) < limit || -d.dot(b.out) < limit) return -1.0;
  return gap + width * turn;
}

void join(std::vector<Strand>& strands, const FreeEnd& a, const FreeEnd& b) {
  Strand& first = strands[static_cast<std::size_t>(a.strand)];
  Strand& second = strands[static_cast<std::size_t>(b.strand)];
  const auto radius = static_cast<float>(0.25 * (a.width + b.width));
  std::vector<StrandPoint> bridge;
  for (const Vec2& at : cubicBetween(a.at, a.out, b.at, -b.out)) bridge.push_back({at, radius, StrandPart::Bridge});
  if (a.strand == b.strand) {
    if (a.side == 0) std::reverse(bridge.begin(), bridge.end());
    first.points.insert(first.points.end(), bridge.begin(), bridge.end());
    first.closed = true;
    return;
  }
  if (a.side == 0) {
    std::reverse(first.points.begin(), first.points.end());
    std::swap(first.tip[0], first.tip[1]);
  }
  if (b.side == 1) {
    std::reverse(second.points.begin(), second.points.end());
    std::swap(second.tip[0], second.tip[1]);
  }
  first.points.insert(first.points.end(), bridge.begin(), bridge.end());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  first.tip[1] = second.tip[1];
  second = Strand{};
}

}  // namespace

void bridgeGaps(std::vector<Strand>& strands, const EdgeParams& params, const RunContext& context) {
  constexpr int kRounds = 4;
  if (!(params.gapFactor > 0.0)) return;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<FreeEnd> ends = freeEnds(strands);
    double widest = 1.0;
    for (const FreeEnd& e : ends) widest = std::max(widest, e.width);
    const double farthest = params.gapFactor * widest + 2.0;
    const auto offer = [](FreeEnd& e, int other, double cost) {
      if (e.best < 0 || cost < e.bestCost) {
        e.best = other;
        e.bestCost = cost;
      }
    };
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if ((i & 255) == 0 && context.isCancelled()) return;
      for (std::size_t j = i + 1; j < ends.size() && ends[j].at.x() - ends[i].at.x() <= farthest; ++j) {
        FreeEnd &a = ends[i], &b = ends[j];
        const bool tooShort = a.strand == b.strand && strands[static_cast<std::size_t>(a.strand)].length() <
                                                          6.0 * a.width + (a.at - b.at).norm();
        const double cost = tooShort ? -1.0 : joinCost(a, b, params.gapFactor);
        if (cost < 0.0) continue;
        offer(a, static_cast<int>(j), cost);
        offer(b, static_cast<int>(i), cost);
      }
    }
    bool joined = false;
    std::vector<bool> moved(strands.size(), false);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const FreeEnd& a = ends[i];
      if (a.best <= static_cast<int>(i) || ends[static_cast<std::size_t>(a.best)].best != static_cast<int>(i)) continue;
      const FreeEnd& b = ends[static_cast<std::size_t>(a.best)];
      // A strand is turned at most once a round, so that the sides noted above stay true.
      const auto s = static_cast<std::size_t>(a.strand), t = static_cast<std::size_t>(b.strand);
      if (moved[s] || moved[t]) {
        joined = true;
        continue;
      }
      moved[s] = moved[t] = joined = true;
      join(strands, a, b);
    }
    if (!joined) break;
  }
  std::erase_if(strands, [](const Strand& s) { return s.points.empty(); });
}

}  // namespace batten
