// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_lattice.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/solve/small_least_squares.h"

namespace batten {
namespace {

constexpr double kSmallestSpacing = 5.0;   // [grid]
constexpr double kLeastShareOfPage = 0.5;  // that the lattice fills, both ways
constexpr int kLeastLines = 5;             // of a ruling
constexpr int kMostMissing = 3;            // lines between two that are seen
constexpr double kChainReach = 0.2;        // of the spacing: where the next line is looked for
constexpr double kLatticeReach = 0.18;     // of the spacing: how far a stretch may lie off its line
constexpr double kFollowReach = 0.25;  // of the spacing: how far a line may lie off its direction, a strip farther on
constexpr double kLeastReach = 1.2;    // [grid]
constexpr double kPrintReach = 2.5;    // [grid] printed lines lie nearer to the lattice
constexpr double kLeastOfLine = 0.5;   // of the strips: a line is seen
constexpr double kPairReach = 0.04;    // of the spacing: half width of what counts as one distance
constexpr double kAlmostBest = 0.6;    // of the pairs at the best spacing: a smaller one that has so many is the line's
constexpr double kRefineReach = 0.75, kRefineStep = 0.05;  // [grid] the spacing is sought finer than whole numbers
constexpr double kStepLearned = 0.15;                      // of what one line of a chain says of the step to the next
constexpr double kLeastStepShare = 0.3,
                 kMostStepShare = 3.0;  // of the spacing: a lattice with such steps has gone astray
constexpr double kMostJump = 50.0;      // [lines] in one step of Newton
constexpr int kNewtonRounds = 6;        // limits the steps of Newton
// A prior of the terms, per stretch: none of place, spacing and slope; on the bends two thousandths of what the
// stretches say; those that are held do not move.
constexpr double kFreeTerm = 1e-6, kBendingTerm = 2e-3, kHeldTerm = 1e9;
constexpr int kMatchRounds = 4;  // of matching lines to the lattice

constexpr int kTerms = RulingLattice::kTerms, kCubicTerms = 10;
using Terms = Eigen::Matrix<double, kTerms, 1>;

/// Perspective and curl bend lines along x; across them spacing changes little. The first ten are a cubic.
Terms termsOf(double k, double x) {
  const double kk = k * k, xx = x * x;
  return (Terms() << 1.0, k, x, kk, k * x, xx, kk * k, kk * x, k * xx, xx * x,  //
          xx * xx, xx * xx * x, k * xx * x, k * xx * xx, kk * xx, kk * xx * x, kk * k * x, kk * k * xx)
      .finished();
}

/// Where a line is expected in a strip.
struct Expected {
  int line = 0;
  double place = 0.0;
};

struct LatticeMember {
  int strip = 0, line = 0;
  double x = 0.0, y = 0.0;
};

/// How often stretches of a strip lie `spacing` apart.
double pairsAt(const RulingStretches& found, double spacing) {
  double sum = 0.0;
  const double reach = std::max(kLeastReach, kPairReach * spacing);
  for (const auto& strip : found.strips) {
    for (std::size_t i = 0, j = 0; i < strip.size(); ++i) {
      const double next = strip[i].place + spacing;
      while (j < strip.size() && strip[j].place < next - reach) ++j;
      for (std::size_t m = j; m < strip.size() && strip[m].place <= next + reach; ++m)
        sum += 1.0 - std::fabs(strip[m].place - next) / (reach + 1e-9);
    }
  }
  return sum;
}

/// The distance at which most stretches have a neighbour: the smallest of its kind, not a multiple.
double commonSpacing(const RulingStretches& found, double height, const RunContext& context) {
  std::vector<double> pairs;
  const int most = static_cast<int>(height / 4.0);
  double best = 0.0;
  for (int spacing = 0; spacing <= most; ++spacing) {
    if (context.isCancelled()) return 0.0;
    pairs.push_back(spacing >= kSmallestSpacing ? pairsAt(found, spacing) : 0.0);
    best = std::max(best, pairs.back());
  }
  for (int spacing = static_cast<int>(kSmallestSpacing); spacing < most; ++spacing) {
    const double sum = pairs[spacing];
    if (sum < kAlmostBest * best || sum < pairs[spacing - 1] || sum < pairs[spacing + 1]) continue;
    double refined = spacing, top = 0.0;
    for (double near = spacing - kRefineReach; near <= spacing + kRefineReach; near += kRefineStep) {
      const double here = pairsAt(found, near) + pairsAt(found, 2.0 * near);
      if (here > top) {
        top = here;
        refined = near;
      }
    }
    return refined;
  }
  return 0.0;
}

/// The longest run of equally spaced stretches in one strip, as (line number from 0, place).
std::vector<std::pair<int, double>> longestChain(const std::vector<RulingStretch>& stretches, double spacing) {
  std::vector<std::pair<int, double>> best;
  for (std::size_t start = 0; start < stretches.size(); ++start) {
    std::vector<std::pair<int, double>> chain{{0, stretches[start].place}};
    double step = spacing;
    for (std::size_t i = start + 1; i < stretches.size(); ++i) {
      const double away = stretches[i].place - chain.back().second;
      const double lines = std::round(away / step);
      if (lines > kMostMissing + 1) break;
      if (lines < 1.0 || std::fabs(away - lines * step) > std::max(kLeastReach, kChainReach * spacing)) continue;
      chain.emplace_back(chain.back().first + static_cast<int>(lines), stretches[i].place);
      step += kStepLearned * (away / lines - step);
    }
    if (chain.size() > best.size()) best = std::move(chain);
    if (best.size() + start >= stretches.size()) break;
  }
  return best;
}

class LatticeFit {
 public:
  LatticeFit(const RulingStretches& found, double spacing, const RunContext& context)
      : found_(found), spacing_(spacing), context_(context) {}

  std::optional<RulingLattice> run() {
    std::size_t seed = 0;
    std::vector<std::pair<int, double>> chain;
    for (std::size_t s = 0; s < found_.strips.size(); ++s) {
      if (context_.isCancelled()) return std::nullopt;
      auto here = longestChain(found_.strips[s], spacing_);
      if (here.size() <= chain.size()) continue;
      chain = std::move(here);
      seed = s;
    }
    if (std::ssize(chain) < kLeastLines) return std::nullopt;
    lattice_.slope = found_.slope;
    lattice_.fromX = found_.fromX;
    lattice_.halfWidth = 0.5 * found_.stripWidth * static_cast<double>(found_.strips.size());
    lattice_.middle = 0.5 * chain.back().first;
    lattice_.reach = std::max(1.0, lattice_.middle);
    for (const auto& [line, y] : chain) members_.push_back({static_cast<int>(seed), line, xOf(seed), y});
    grow(static_cast<int>(seed));
    fit(kCubicTerms);
    for (int round = 0; round < kMatchRounds; ++round) {
      if (context_.isCancelled()) return std::nullopt;
      matchAll(round + 1 == kMatchRounds);
      if (std::ssize(members_) < kLeastLines) return std::nullopt;
      fit(round == 0 ? kCubicTerms : kTerms);
    }
    return judged();
  }

 private:
  double xOf(std::size_t strip) const { return found_.middleOf(strip); }
  double reach() const { return std::max(kLeastReach, kLatticeReach * spacing_); }

  /// Follows the lines of the seed strip by strip, in the direction they have there, so that a bend is followed.
  void grow(int seed) {
    std::vector<Expected> lines;
    for (const LatticeMember& m : members_) {
      for (int k = lines.empty() ? m.line : lines.back().line + 1; k <= m.line; ++k) {
        const double share = lines.empty() ? 1.0 : 1.0 / (m.line - k + 1);
        lines.push_back({k, lines.empty() ? m.y : lines.back().place + share * (m.y - lines.back().place)});
      }
    }
    for (const int direction : {-1, 1}) follow(seed, direction, lines);
  }

  /// Lines that are hidden in a strip go on beyond it.
  void follow(int from, int direction, std::vector<Expected> lines) {
    const int strips = static_cast<int>(found_.strips.size());
    for (int s = from + direction; s >= 0 && s < strips && !context_.isCancelled(); s += direction) {
      const auto& strip = found_.strips[s];
      for (Expected& line : lines) {
        const double half = 0.5 * direction * found_.stripWidth;
        line.place += half * (found_.slopeAt(s - direction, line.place) - found_.slope);
        line.place += half * (found_.slopeAt(s, line.place) - found_.slope);
        const auto away = [&](const RulingStretch& stretch) { return std::fabs(stretch.place - line.place); };
        const auto nearest = std::ranges::min_element(strip, {}, away);
        if (nearest == strip.end() || away(*nearest) > std::max(kLeastReach, kFollowReach * spacing_)) continue;
        line.place = nearest->place;
        members_.push_back({s, line.line, xOf(s), line.place});
      }
    }
  }

  /// @param isLast what lies off its line by more than print does is none of it.
  void matchAll(bool isLast) {
    members_.clear();
    const double share = isLast ? std::min(kLatticeReach, kPrintReach / spacing_) : kLatticeReach;
    for (int s = 0; s < static_cast<int>(found_.strips.size()); ++s) match(s, share);
  }

  /// Adds the stretches of a strip that lie on the lattice, at most one a line.
  void match(int strip, double share) {
    const double x = xOf(strip);
    const std::size_t before = members_.size();
    for (const RulingStretch& stretch : found_.strips[strip]) {
      const double y = stretch.place;
      const double k = std::round(lineAt(x, y));
      const double off = y - lattice_.at(k, x) + lattice_.slope * x;
      if (std::fabs(off) > std::max(kLeastReach, share * spacing_)) continue;
      const LatticeMember member{strip, static_cast<int>(k), x, y};
      if (members_.size() > before && members_.back().line == member.line) {
        const double other = members_.back().y - lattice_.at(k, x) + lattice_.slope * x;
        if (std::fabs(off) < std::fabs(other)) members_.back() = member;
        continue;
      }
      members_.push_back(member);
    }
  }

  /// The line number, as a real, at a place of a strip (y without the slope).
  double lineAt(double x, double y) const {
    double k = lattice_.middle + (y - lattice_.at(lattice_.middle, x) + lattice_.slope * x) / spacing_;
    for (int round = 0; round < kNewtonRounds; ++round) {
      const double here = lattice_.at(k, x) - lattice_.slope * x;
      const double step = lattice_.at(k + 0.5, x) - lattice_.at(k - 0.5, x);
      if (step < kLeastStepShare * spacing_ || step > kMostStepShare * spacing_) break;
      k += std::clamp((y - here) / step, -kMostJump, kMostJump);
    }
    return k;
  }

  /// @param terms how many of the terms move; higher ones are held back so that few stretches do not bend the page.
  void fit(int terms) {
    const auto count = static_cast<double>(members_.size());
    Terms prior;
    for (int i = 0; i < kTerms; ++i) prior[i] = (i >= terms ? kHeldTerm : i < 3 ? kFreeTerm : kBendingTerm) * count;
    SmallLeastSquares<kTerms> equations;
    equations.hold(prior);
    for (const LatticeMember& m : members_) {
      const Terms t =
          termsOf((m.line - lattice_.middle) / lattice_.reach, (m.x - lattice_.fromX) / lattice_.halfWidth - 1.0);
      equations.add(t, m.y);
    }
    const Terms fitted = equations.solve();
    std::copy(fitted.begin(), fitted.end(), lattice_.coefficients.begin());
  }

  std::optional<RulingLattice> judged() {
    const auto [low, high] =
        std::minmax_element(members_.begin(), members_.end(),
                            [](const LatticeMember& a, const LatticeMember& b) { return a.line < b.line; });
    const int first = low->line, count = high->line - first + 1;
    std::vector<int> strips(count, 0);
    std::vector<double> off;
    for (const LatticeMember& m : members_) {
      ++strips[m.line - first];
      off.push_back(std::fabs(m.y - lattice_.at(m.line, m.x) + lattice_.slope * m.x));
    }
    const auto isLine = [&](int n) { return n >= kLeastOfLine * static_cast<double>(found_.strips.size()); };
    int from = 0, to = count - 1;
    while (from <= to && !isLine(strips[from])) ++from;
    while (to >= from && !isLine(strips[to])) --to;
    if (to - from + 1 < kLeastLines) return std::nullopt;
    lattice_.first = first + from;
    lattice_.last = first + to;
    int seen = 0, stretches = 0;
    for (int i = from; i <= to; ++i) {
      lattice_.isSeen.push_back(isLine(strips[i]));
      if (!lattice_.isSeen.back()) continue;
      ++seen;
      stretches += strips[i];
    }
    lattice_.seen = seen / static_cast<double>(to - from + 1);
    lattice_.coverage = stretches / (static_cast<double>(seen) * static_cast<double>(found_.strips.size()));
    const double middle = lattice_.fromX + lattice_.halfWidth;
    const double extent = lattice_.at(lattice_.last, middle) - lattice_.at(lattice_.first, middle);
    lattice_.spacing = extent / std::max(1, lattice_.last - lattice_.first);
    lattice_.misfit = upperMedian(off);
    // How many of the stretches over the lattice lie on its lines.
    std::size_t within = 0;
    for (std::size_t s = 0; s < found_.strips.size(); ++s) {
      for (const RulingStretch& stretch : found_.strips[s]) {
        const double k = lineAt(xOf(s), stretch.place);
        within += k > lattice_.first - 0.5 && k < lattice_.last + 0.5 ? 1 : 0;
      }
    }
    lattice_.selective = static_cast<double>(members_.size()) / static_cast<double>(std::max<std::size_t>(1, within));
    if (seen < kLeastLines || lattice_.seen <= 0.5 || lattice_.spacing < kSmallestSpacing) return std::nullopt;
    if (extent + 2.0 * lattice_.spacing < kLeastShareOfPage * found_.height) return std::nullopt;
    return lattice_;
  }

  const RulingStretches& found_;
  double spacing_;
  const RunContext& context_;
  RulingLattice lattice_;
  std::vector<LatticeMember> members_;
};

}  // namespace

double RulingLattice::at(double k, double x) const {
  const Terms t = termsOf((k - middle) / reach, (x - fromX) / halfWidth - 1.0);
  return Eigen::Map<const Terms>(coefficients.data()).dot(t) + slope * x;
}

std::optional<RulingLattice> findRulingLattice(const RulingStretches& found, const RunContext& context) {
  if (context.isCancelled() || found.strips.empty()) return std::nullopt;
  const double spacing = commonSpacing(found, found.height, context);
  if (spacing <= 0.0) return std::nullopt;
  return LatticeFit(found, spacing, context).run();
}

}  // namespace batten
