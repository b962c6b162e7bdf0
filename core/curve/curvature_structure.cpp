// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/curvature_structure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace batten {
namespace {

/// Turns of the profile: places where a rise ends or a fall ends; plateaus count at their middle.
CurvatureStructure allExtrema(std::span<const double> kappa, bool closed) {
  CurvatureStructure result;
  const int count = static_cast<int>(kappa.size());
  std::vector<int> moves;  // samples before which the value changes, with the sign of the change
  std::vector<int> signs;
  for (int i = closed ? 0 : 1; i < count; ++i) {
    const double step = kappa[i] - kappa[(i + count - 1) % count];
    if (step == 0.0) continue;
    moves.push_back(i);
    signs.push_back(step > 0.0 ? 1 : -1);
  }
  if (moves.empty()) return result;
  result.rising = signs.front() > 0;
  const std::size_t changes = moves.size();
  for (std::size_t k = closed ? 0 : 1; k < changes; ++k) {
    const std::size_t before = (k + changes - 1) % changes;
    if (signs[k] == signs[before]) continue;
    const int from = moves[before], to = moves[k] > from ? moves[k] : moves[k] + count;
    result.extrema.push_back({(from + (to - 1 - from + 1) / 2) % count, signs[before] > 0});
  }
  if (closed) {
    std::sort(result.extrema.begin(), result.extrema.end(),
              [](const auto& a, const auto& b) { return a.sample < b.sample; });
  }
  if (!result.extrema.empty()) result.rising = result.extrema.front().maximum;
  return result;
}

/// Sign of the regression line: the ends alone may be all noise.
bool risesOnTheWhole(std::span<const double> s, std::span<const double> kappa) {
  double meanS = 0.0, meanK = 0.0, slope = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    meanS += s[i] / static_cast<double>(s.size());
    meanK += kappa[i] / static_cast<double>(s.size());
  }
  for (std::size_t i = 0; i < s.size(); ++i) slope += (s[i] - meanS) * (kappa[i] - meanK);
  return slope > 0.0;
}

/// One candidate for removal.
struct Removal {
  std::size_t first = 0;
  int count = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Simplifier {
 public:
  Simplifier(std::span<const double> s, std::span<const double> kappa, double length, bool closed)
      : s_(s), kappa_(kappa), length_(length), closed_(closed), now_(allExtrema(kappa, closed)) {}

  std::vector<StructureLevel> levels(CancelCheck check) {
    std::vector<StructureLevel> result{{now_, 0.0}};
    double worst = 0.0;
    while (!now_.extrema.empty() && !check.isCancelled()) {
      const Removal best = cheapest();
      if (best.count == 0) break;
      remove(best);
      worst = std::max(worst, best.cost);
      result.push_back({now_, worst});
    }
    return result;
  }

 private:
  double moveOf(int a, int b) const {
    double width = s_[b] - s_[a];
    if (width < 0.0) width += length_;
    return std::abs(kappa_[b] - kappa_[a]) * width * width / (2.0 * std::numbers::pi * std::numbers::pi);
  }

  Removal cheapest() const {
    const auto& e = now_.extrema;
    Removal best;
    const auto offer = [&](std::size_t first, int count, double cost) {
      if (cost < best.cost) best = {first, count, cost};
    };
    if (closed_) {
      if (e.size() <= 4) return best;
      for (std::size_t i = 0; i < e.size(); ++i) offer(i, 2, moveOf(e[i].sample, e[(i + 1) % e.size()].sample));
      return best;
    }
    for (std::size_t i = 0; i + 1 < e.size(); ++i) offer(i, 2, moveOf(e[i].sample, e[i + 1].sample));
    offer(0, 1, moveOf(0, e.front().sample));
    offer(e.size() - 1, 1, moveOf(e.back().sample, static_cast<int>(kappa_.size()) - 1));
    return best;
  }

  void remove(const Removal& removal) {
    auto& e = now_.extrema;
    if (closed_ && removal.first + 1 == e.size()) {
      e.pop_back();
      e.erase(e.begin());
    } else {
      const auto from = e.begin() + static_cast<std::ptrdiff_t>(removal.first);
      e.erase(from, from + removal.count);
    }
    now_.rising = e.empty() ? risesOnTheWhole(s_, kappa_) : e.front().maximum;
  }

  std::span<const double> s_, kappa_;
  double length_;
  bool closed_;
  CurvatureStructure now_;
};

}  // namespace

std::vector<StructureLevel> structureLevels(std::span<const double> s, std::span<const double> kappa, double length,
                                            bool closed, CancelCheck check) {
  return Simplifier(s, kappa, length, closed).levels(check);
}

CurvatureStructure structureAt(std::span<const double> kappa, const CurvatureStructure& all,
                               std::span<const int> samples, bool closed) {
  CurvatureStructure result;
  const int count = static_cast<int>(kappa.size());
  std::vector<std::size_t> chosen;
  for (const int sample : samples) {
    std::size_t best = all.extrema.size();
    int nearest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < all.extrema.size(); ++i) {
      int distance = std::abs(all.extrema[i].sample - sample);
      if (closed) distance = std::min(distance, count - distance);
      if (distance < nearest) nearest = distance, best = i;
    }
    if (best < all.extrema.size()) chosen.push_back(best);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    result.extrema.push_back(all.extrema[chosen[k]]);
    const bool last = k + 1 == chosen.size();
    if (last && !closed) break;
    const std::size_t next = last ? chosen.front() + all.extrema.size() : chosen[k + 1];
    const StructureExtremum& here = all.extrema[chosen[k]];
    if (all.extrema[next % all.extrema.size()].maximum != here.maximum) continue;
    // Two of a kind: between them the profile must turn once, where it goes farthest the other way.
    std::size_t between = all.extrema.size();
    for (std::size_t i = chosen[k] + 1; i < next; ++i) {
      const std::size_t j = i % all.extrema.size();
      if (all.extrema[j].maximum == here.maximum) continue;
      const double value = kappa[all.extrema[j].sample];
      const bool farther = between == all.extrema.size() || (here.maximum ? value < kappa[all.extrema[between].sample]
                                                                          : value > kappa[all.extrema[between].sample]);
      if (farther) between = j;
    }
    if (between < all.extrema.size()) result.extrema.push_back(all.extrema[between]);
  }
  if (closed) {
    std::sort(result.extrema.begin(), result.extrema.end(),
              [](const auto& a, const auto& b) { return a.sample < b.sample; });
  }
  result.rising = result.extrema.empty() ? kappa.back() > kappa.front() : result.extrema.front().maximum;
  return result;
}

}  // namespace batten
