// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/dot_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kPlaceTolerance = 0.12, kPlaceTolerancePx = 1.0;  // of a step
constexpr double kLeastDotStep = 8.0;                   // [px] closer ones are the grain of print or of the file
constexpr double kMostOfPlace = 0.05;                   // a dot takes of its place of the lattice
constexpr double kMostSizes = 2.0, kSizeErrorPx = 2.0;  // [of the area, px^2] alike
constexpr double kMostDepths = 1.8;                     // likewise
constexpr double kLeastTurn = 0.35;                     // sine of the angle between the steps, seen in perspective
constexpr double kMostSteps = 3.0;                      // one step of the other
constexpr std::size_t kNearest = 16;                    // marks that the steps are sought among
constexpr std::size_t kMostGrowths = 20;                // over each mark, on the mean: bounds the time
constexpr double kHiding = 0.4;                         // of a step: ink so near may hide a dot

bool areAlikeDots(const DotMark& a, const DotMark& b) {
  const auto [small, large] = std::minmax(a.area, b.area);
  const auto [pale, deep] = std::minmax(a.depth, b.depth);
  return large <= kMostSizes * small + kSizeErrorPx && deep <= kMostDepths * pale;
}

/// Marks by place.
class Places {
 public:
  explicit Places(const DotMarks& of)
      : of_(of),
        cell_(std::max(kLeastDotStep, std::sqrt(1.0 * of.width * of.height / static_cast<double>(of.marks.size())))),
        columns_(static_cast<int>(of.width / cell_) + 1),
        rows_(static_cast<int>(of.height / cell_) + 1),
        cells_(std::size_t(columns_) * std::size_t(rows_)) {
    for (int k = 0; k < std::ssize(of.marks); ++k) cells_[indexOf(of.marks[k].at)].push_back(k);
  }
  double cell() const { return cell_; }
  template <class Visit>
  void visit(const Vec2& at, double reach, const Visit& visit) const {
    const int i0 = columnOf(at.x() - reach), i1 = columnOf(at.x() + reach);
    const int j0 = rowOf(at.y() - reach), j1 = rowOf(at.y() + reach);
    for (int j = j0; j <= j1; ++j) {
      for (int i = i0; i <= i1; ++i) {
        for (const int k : cells_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)])
          if ((of_.marks[k].at - at).norm() <= reach) visit(k);
      }
    }
  }
  /// The nearest mark that is like another; absent: none.
  std::optional<int> nearest(const Vec2& at, double reach, const DotMark& like) const {
    std::optional<int> best;
    double least = reach;
    visit(at, reach, [&](int k) {
      const double d = (of_.marks[k].at - at).norm();
      if (areAlikeDots(of_.marks[k], like) && (!best || d < least)) best = k, least = d;
    });
    return best;
  }

 private:
  int columnOf(double x) const { return std::clamp(static_cast<int>(x / cell_), 0, columns_ - 1); }
  int rowOf(double y) const { return std::clamp(static_cast<int>(y / cell_), 0, rows_ - 1); }
  std::size_t indexOf(const Vec2& at) const {
    return std::size_t(rowOf(at.y())) * std::size_t(columns_) + std::size_t(columnOf(at.x()));
  }
  const DotMarks& of_;
  double cell_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

struct Steps {
  std::array<Vec2, 2> step{Vec2(0.0, 0.0), Vec2(0.0, 0.0)};
  double shorter() const { return std::min(step[0].norm(), step[1].norm()); }
  double tolerance() const { return kPlaceTolerance * shorter() + kPlaceTolerancePx; }
};

class Growth {
 public:
  explicit Growth(const DotMarks& marks)
      : marks_(marks), places_(marks), latticeOf_(marks.marks.size(), 0), stepsOf_(marks.marks.size()) {}

  std::optional<DotLattice> from(int seed) {
    if (latticeOf_[seed] != 0 || !marks_.marks[seed].isAlone || added_ > kMostGrowths * latticeOf_.size())
      return std::nullopt;
    const std::optional<Steps> steps = stepsAround(seed);
    if (!steps) return std::nullopt;
    DotLattice lattice;
    std::vector<double> misfits, spacings;
    ++lattice_;
    add(seed, *steps, lattice);
    for (std::size_t next = 0; next < lattice.dots.size(); ++next) {
      const int dot = lattice.dots[next];
      growAt(dot, lattice, misfits);
      spacings.push_back(stepsOf_[dot].shorter());
    }
    lattice.spacing = upperMedian(spacings);
    if (!misfits.empty()) lattice.misfit = upperMedian(misfits);
    return lattice;
  }

 private:
  void add(int mark, const Steps& steps, DotLattice& lattice) {
    latticeOf_[mark] = lattice_;
    ++added_;
    stepsOf_[mark] = steps;
    lattice.dots.push_back(mark);
  }

  /// The two shortest steps that lead to a mark on either side.
  std::optional<Steps> stepsAround(int mark) const {
    const DotMark& own = marks_.marks[mark];
    std::vector<int> near;
    constexpr double kReach = 3.0;  // cells
    places_.visit(own.at, kReach * places_.cell(), [&](int k) {
      if (k != mark && areAlikeDots(marks_.marks[k], own)) near.push_back(k);
    });
    const auto stepTo = [&](int k) { return Vec2(marks_.marks[k].at - own.at); };
    std::ranges::stable_sort(near, {}, [&](int k) { return stepTo(k).squaredNorm(); });
    if (near.size() > kNearest) near.resize(kNearest);
    std::optional<Vec2> first;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Vec2 there = stepTo(near[i]);
      if (there.norm() < kLeastDotStep) return std::nullopt;
      for (std::size_t j = i + 1; j < near.size(); ++j) {
        const Vec2 back = stepTo(near[j]);
        if ((there + back).norm() > kPlaceTolerance * there.norm() + kPlaceTolerancePx) continue;
        const Vec2 step = 0.5 * (there - back);
        if (!first) {
          first = step;
          break;
        }
        const double area = std::fabs(cross(*first, step));
        if (area < kLeastTurn * first->norm() * step.norm() || step.norm() > kMostSteps * first->norm()) continue;
        if (own.area > kMostOfPlace * area) return std::nullopt;
        return Steps{{*first, step}};
      }
    }
    return std::nullopt;
  }

  /// The marks at the four places around a dot: they join it, and its own steps become those that they show.
  void growAt(int dot, DotLattice& lattice, std::vector<double>& misfits) {
    const Vec2 at = marks_.marks[dot].at;
    const DotMark& own = marks_.marks[dot];
    Steps& steps = stepsOf_[dot];
    const Steps before = steps;
    std::array<std::array<std::optional<int>, 2>, 2> beside;
    for (const int axis : {0, 1}) {
      for (const int side : {0, 1}) {
        const Vec2 place = side == 0 ? Vec2(at + before.step[axis]) : Vec2(at - before.step[axis]);
        beside[axis][side] = places_.nearest(place, before.tolerance(), own);
        if (beside[axis][side]) {
          ++lattice.taken;
        } else if (place.x() > 0 && place.y() > 0 && place.x() < marks_.width && place.y() < marks_.height &&
                   !marks_.isHidden(place, kHiding * before.shorter(), marks_.paperAt(at))) {
          ++lattice.bare;
        }
      }
      const auto [ahead, behind] = beside[axis];
      if (ahead && behind) {
        const Vec2 a = marks_.marks[*ahead].at, b = marks_.marks[*behind].at;
        misfits.push_back((at - 0.5 * (a + b)).norm());
        steps.step[axis] = 0.5 * (a - b);
      } else if (ahead) {
        steps.step[axis] = marks_.marks[*ahead].at - at;
      } else if (behind) {
        steps.step[axis] = at - marks_.marks[*behind].at;
      }
    }
    for (const auto& pair : beside) {
      for (const auto& mark : pair)
        if (mark && latticeOf_[*mark] != lattice_) add(*mark, steps, lattice);
    }
  }

  const DotMarks& marks_;
  Places places_;
  std::vector<int> latticeOf_;  ///< The last one, from 1: a lattice of wrong steps takes no dots from the right one.
  int lattice_ = 0;
  std::size_t added_ = 0;
  std::vector<Steps> stepsOf_;
};

}  // namespace

DotLattice largestDotLattice(const DotMarks& marks) {
  DotLattice largest;
  if (marks.marks.empty()) return largest;
  Growth growth(marks);
  for (int seed = 0; seed < std::ssize(marks.marks); ++seed) {
    std::optional<DotLattice> lattice = growth.from(seed);
    if (lattice && lattice->dots.size() > largest.dots.size()) largest = std::move(*lattice);
  }
  return largest;
}

}  // namespace batten
