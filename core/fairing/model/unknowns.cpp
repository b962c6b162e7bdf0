// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/unknowns.h"

#include <algorithm>
#include <cmath>

#include "core/solve/banded_matrix.h"
#include "core/solve/dense_solve.h"

namespace batten {
namespace {

/// Linear end conditions on the coordinates (2j + c) of the points of one span, as rows.
Eigen::MatrixXd endConditions(const SpanBasis& basis, const SpanCurve& curve, const SpanPlace& place,
                              const EndHold& hold) {
  const int p = basis.degree();
  const SpanRow row = basis.row(place, 2);
  const Jet jet = curve.at(place, 1);
  const Vec2 n = leftNormal(jet[1].norm() > 0.0 ? Vec2(jet[1].normalized()) : Vec2(Vec2::UnitX()));
  const int count = hold.curvature ? 5 : hold.tangent ? 3 : 2;
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(count, 2 * (p + 1));
  for (int j = 0; j <= p; ++j) {
    c(0, 2 * j) = c(1, 2 * j + 1) = row.d[0][j];
    if (hold.curvature) {
      c(2, 2 * j) = c(3, 2 * j + 1) = row.d[1][j];
      c.block(4, 2 * j, 1, 2) = row.d[2][j] * n.transpose();
    } else if (hold.tangent) {
      c.block(2, 2 * j, 1, 2) = row.d[1][j] * n.transpose();
    }
  }
  for (int i = 0; i < count; ++i) {
    const double size = c.row(i).norm();
    if (size > 0.0) c.row(i) /= size;
  }
  return c;
}

struct Block {
  int first = 0, last = -1;  ///< Points.
  Eigen::MatrixXd free;      ///< Columns: the null space of the conditions over 2 (last - first + 1) coordinates.
};

/// Range of the local points that conditions touch.
std::pair<int, int> touched(const Eigen::MatrixXd& c) {
  int low = static_cast<int>(c.cols()) / 2, high = -1;
  for (int j = 0; j < c.cols() / 2; ++j) {
    if (c.middleCols(2 * j, 2).cwiseAbs().maxCoeff() > 1e-14) {
      low = std::min(low, j);
      high = std::max(high, j);
    }
  }
  return {low, high};
}

std::vector<Block> endBlocks(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold,
                             const EndHold& endHold) {
  const int last = basis.spanCount() - 1, shift = basis.point(last, 0);
  const Eigen::MatrixXd a = endConditions(basis, curve, {0, 0.0}, startHold);
  const Eigen::MatrixXd b = endConditions(basis, curve, {last, 1.0}, endHold);
  const auto [a0, a1] = touched(a);
  const auto [b0, b1] = touched(b);
  if (a1 < b0 + shift) {
    return {{a0, a1, nullSpace(a.middleCols(2 * a0, 2 * (a1 - a0 + 1)))},
            {b0 + shift, b1 + shift, nullSpace(b.middleCols(2 * b0, 2 * (b1 - b0 + 1)))}};
  }
  const int first = std::min(a0, b0 + shift), end = std::max(a1, b1 + shift), count = end - first + 1;
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), 2 * count);
  both.block(0, 2 * (a0 - first), a.rows(), 2 * (a1 - a0 + 1)) = a.middleCols(2 * a0, 2 * (a1 - a0 + 1));
  both.block(a.rows(), 2 * (b0 + shift - first), b.rows(), 2 * (b1 - b0 + 1)) = b.middleCols(2 * b0, 2 * (b1 - b0 + 1));
  return {{first, end, nullSpace(both)}};
}

}  // namespace

Unknowns::Unknowns(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold, const EndHold& endHold,
                   const std::vector<bool>& held)
    : degree_(basis.degree()) {
  coordinates_.resize(2 * basis.pointCount());
  if (basis.isPeriodic()) {
    buildPeriodic(basis.pointCount());
  } else {
    buildBlocks(basis, curve, startHold, endHold);
  }
  if (!held.empty()) hold(held);
  buildSpans(basis);
}

/// An end's points share their unknowns: they are free together or not at all.
void Unknowns::hold(const std::vector<bool>& held) {
  std::vector<bool> isHeld(count_, false);
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    if (!held[i / 2]) continue;
    for (const Part& part : coordinates_[i]) isHeld[part.index] = true;
  }
  std::vector<int> place(count_, 0);
  int count = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (!isHeld[i]) place[i] = count++;
  for (auto& parts : coordinates_) {
    std::erase_if(parts, [&](const Part& part) { return isHeld[part.index]; });
    for (Part& part : parts) part.index = place[part.index];
  }
  count_ = count;
}

void Unknowns::buildPeriodic(int points) {
  for (int j = 0; j < points; ++j) {
    const int folded = foldedPlace(j, points);
    for (int c = 0; c < 2; ++c) coordinates_[2 * j + c].push_back({2 * folded + c, 1.0});
  }
  count_ = 2 * points;
}

void Unknowns::buildBlocks(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold,
                           const EndHold& endHold) {
  const std::vector<Block> blocks = endBlocks(basis, curve, startHold, endHold);
  for (int j = 0; j < basis.pointCount(); ++j) {
    const auto block =
        std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) { return j >= b.first && j <= b.last; });
    if (block == blocks.end()) {
      for (int c = 0; c < 2; ++c) coordinates_[2 * j + c].push_back({count_++, 1.0});
      continue;
    }
    if (j > block->first) continue;
    const auto columns = static_cast<int>(block->free.cols());
    for (int i = 0; i < 2 * (block->last - block->first + 1); ++i) {
      for (int k = 0; k < columns; ++k) {
        const double factor = block->free(i, k);
        if (factor != 0.0) coordinates_[2 * block->first + i].push_back({count_ + k, factor});
      }
    }
    count_ += columns;
  }
}

void Unknowns::buildSpans(const SpanBasis& basis) {
  spans_.resize(basis.spanCount());
  for (int s = 0; s < basis.spanCount(); ++s) {
    SpanMap& map = spans_[s];
    for (int j = 0; j <= degree_; ++j) {
      for (int c = 0; c < 2; ++c) {
        for (const Part& part : coordinates_[2 * basis.point(s, j) + c]) {
          map.index.push_back(part.index);
        }
      }
    }
    std::sort(map.index.begin(), map.index.end());
    map.index.erase(std::unique(map.index.begin(), map.index.end()), map.index.end());
    map.slots.resize(2 * (degree_ + 1));
    for (int j = 0; j <= degree_; ++j) {
      for (int c = 0; c < 2; ++c) {
        for (const Part& part : coordinates_[2 * basis.point(s, j) + c]) {
          const auto at = std::lower_bound(map.index.begin(), map.index.end(), part.index);
          map.slots[2 * j + c].emplace_back(static_cast<int>(at - map.index.begin()), part.factor);
        }
      }
    }
    const auto isOwn = [](const auto& slots) { return slots.size() == 1 && slots.front().second == 1.0; };
    if (map.index.size() == map.slots.size() && std::all_of(map.slots.begin(), map.slots.end(), isOwn))
      for (const auto& slots : map.slots) map.own.push_back(slots.front().first);
    map.isInOrder = !map.own.empty() && std::is_sorted(map.own.begin(), map.own.end());
    stride_ = std::max(stride_, static_cast<int>(map.index.size()));
    if (!map.index.empty()) halfWidth_ = std::max(halfWidth_, map.index.back() - map.index.front());
  }
}

void Unknowns::reduce(int span, const LocalRow& local, double* values) const {
  const SpanMap& map = spans_[span];
  if (map.isInOrder) {  // the usual case
    for (std::size_t j = 0; 2 * j < map.own.size(); ++j) Eigen::Map<Vec2>(values + 2 * j) = local[j];
    return;
  }
  if (!map.own.empty()) {
    for (std::size_t i = 0; i < map.own.size(); ++i)
      values[map.own[i]] = local[i / 2][static_cast<Eigen::Index>(i % 2)];
    return;
  }
  std::fill(values, values + map.index.size(), 0.0);
  for (std::size_t i = 0; i < map.slots.size(); ++i) {
    const double value = local[i / 2][static_cast<Eigen::Index>(i % 2)];
    for (const auto& [slot, factor] : map.slots[i]) values[slot] += factor * value;
  }
}

void Unknowns::move(const Eigen::VectorXd& step, std::vector<Vec2>& points) const {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    double sum = 0.0;
    for (const Part& part : coordinates_[i]) sum += part.factor * step[part.index];
    points[i / 2][static_cast<Eigen::Index>(i % 2)] += sum;
  }
}

}  // namespace batten
