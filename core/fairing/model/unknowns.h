// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "core/curve/span_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/model/curvature_rows.h"

namespace batten {

/// Coordinates that move freely, as a null-space basis of the linear end conditions: position always, with `tangent`
/// also the direction, with `curvature` the derivative and the normal part of the second one, which fixes both.
/// Periodic points are folded (0, m-1, 1, m-2, ...), so that cyclic coupling stays within a band.
class Unknowns {
 public:
  Unknowns() = default;
  /// @param held control points that do not move at all, one entry each; empty: none.
  Unknowns(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold, const EndHold& endHold,
           const std::vector<bool>& held = {});
  int count() const { return count_; }
  int halfWidth() const { return halfWidth_; }
  int stride() const { return stride_; }  ///< Largest number of unknowns that a span depends on.
  std::span<const int> indices(int span) const { return spans_[span].index; }
  /// Whether the coordinates of a span's control points are its unknowns, in their order.
  bool isInOrder(int span) const { return spans_[span].isInOrder; }
  /// Local row over the control points of a span to values over indices(span).
  void reduce(int span, const LocalRow& local, double* values) const;
  /// Adds the displacement of the unknowns to the control points.
  void move(const Eigen::VectorXd& step, std::vector<Vec2>& points) const;

 private:
  struct Part {
    int index;
    double factor;
  };
  struct SpanMap {
    std::vector<int> index;
    std::vector<std::vector<std::pair<int, double>>> slots;  ///< Per local coordinate 2j + c: (slot, factor).
    std::vector<int> own;    ///< Where each local coordinate is an unknown of its own: the slots. Else empty.
    bool isInOrder = false;  ///< Those slots are 0, 1, 2, …
  };
  void buildBlocks(const SpanBasis& basis, const SpanCurve& curve, const EndHold& startHold, const EndHold& endHold);
  void buildPeriodic(int points);
  void hold(const std::vector<bool>& held);
  void buildSpans(const SpanBasis& basis);
  int count_ = 0, halfWidth_ = 0, stride_ = 0, degree_ = 0;
  std::vector<std::vector<Part>> coordinates_;  ///< Per coordinate 2 * point + c.
  std::vector<SpanMap> spans_;
};

}  // namespace batten
