// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/paper_faces.h"

#include <algorithm>
#include <cmath>

#include "core/base/vec2.h"
#include "core/image/bits/bit_steps.h"

namespace batten {
namespace {

constexpr double kWithinOthersWidths = 0.5;  // [stroke widths] at an end in another stroke: the half of that one
// From the middle to the paper: the ink may be broader on one side.
constexpr double kFaceReachRadii = 1.5, kFaceReachPx = 2.0;
constexpr double kStepPx = 0.5;  // of the search for paper: no pixel on the way is left out by half
constexpr int kChordPoints = 2;  // to either side: a single step of a skeleton has eight directions

// [px] from the start to every point.
std::vector<double> arcsOf(const StrokePath& stroke) {
  std::vector<double> arcs(stroke.points.size(), 0.0);
  for (std::size_t i = 1; i < arcs.size(); ++i)
    arcs[i] = arcs[i - 1] + (stroke.points[i].at - stroke.points[i - 1].at).norm();
  return arcs;
}

}  // namespace

bool PaperFaces::isFound() {
  if (!pieces_) {
    pieces_ = findPieces(paperOf(ink_), Connectivity::Four, context_);
    area_.assign(pieces_->runs.size(), 0);
    for (std::size_t i = 0; i < pieces_->runs.size(); ++i)
      area_[pieces_->piece[i]] += pieces_->runs[i].x1 - pieces_->runs[i].x0;
  }
  return !context_.isCancelled();
}

// Of the nearest paper in a direction.
std::optional<int> PaperFaces::faceBeside(const StrokePathPoint& from, const Vec2& towards) const {
  const double reach = kFaceReachRadii * static_cast<double>(from.radius) + kFaceReachPx;
  for (double away = 0.0; away <= reach; away += kStepPx) {
    const Vec2 at = from.at + away * towards;
    const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
    if (x < 0 || y < 0 || x >= ink_.width || y >= ink_.height) return {};
    if (!ink_.at(x, y)) return pieceAt(*pieces_, x, y);
  }
  return {};
}

// To the left and to the right of a point.
std::array<std::optional<int>, 2> PaperFaces::facesBeside(const std::vector<StrokePathPoint>& points, int i) const {
  const int n = static_cast<int>(points.size());
  const Vec2 along = points[std::min(i + kChordPoints, n - 1)].at - points[std::max(i - kChordPoints, 0)].at;
  if (!(along.norm() > 0.0)) return {};
  const Vec2 normal = leftNormal(along.normalized());
  return {faceBeside(points[i], normal), faceBeside(points[i], -normal)};
}

bool PaperFaces::arePartedBy(const StrokePath& stroke) {
  const int n = static_cast<int>(stroke.points.size());
  if (n < 3 || !isFound()) return false;
  const std::vector<double> arcs = arcsOf(stroke);
  const double within = stroke.closed ? -1.0 : kWithinOthersWidths * stroke.widthPx();
  int parted = 0, alike = 0;
  for (int i = 0; i < n; ++i) {
    if (std::min(arcs[i], arcs.back() - arcs[i]) <= within) continue;
    const auto [left, right] = facesBeside(stroke.points, i);
    if (!left || !right) continue;
    const bool areFaces = static_cast<double>(std::min(area_[*left], area_[*right])) >= leastArea_;
    ++(areFaces && *left != *right ? parted : alike);
  }
  return parted > alike;
}

}  // namespace batten
