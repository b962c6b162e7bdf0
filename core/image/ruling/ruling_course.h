// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/grey_image.h"
#include "core/image/ruling/rulings.h"

namespace batten {

/// Where one line of a ruling lies on a picture, on which it runs along x, in blocks of 32 px along it. The picture may
/// change meanwhile.
class RulingCourse {
 public:
  RulingCourse(const GreyImage& image, const RulingFamily& family, const RulingLine& line);

  int from() const { return from_; }  ///< [px] The columns that the line runs through are from() .. to() - 1.
  int to() const { return to_; }
  int blocks() const { return blocks_; }
  int begin(int block) const;
  int end(int block) const;
  /// [px] y of the line's middle at a column.
  double at(int x) const { return course_[x]; }
  /// Grey at an offset across the line, between pixel centres; absent beyond the picture.
  std::optional<float> greyAt(int x, double offset) const;
  /// Of values at the blocks' middles: linear between them.
  double atBlocks(const std::vector<double>& values, int x) const;

  /// Moves the course to where the line is darkest, block by block, smoothly. Towards its ends, where no blocks follow,
  /// a line that leaves its course goes on as straight as it does there.
  void straighten();

 private:
  std::optional<double> shiftOf(int block) const;
  double beyondBlocks(const std::vector<double>& values, int x) const;

  const GreyImage& image_;
  double spacingPx_, widthPx_, depth_;
  bool isDark_ = false;  ///< And whole, as of a grid.
  int from_ = 0, to_ = 1, blocks_ = 1;
  std::vector<double> course_;  ///< [px] Per column.
};

/// y at x of the straight line that half of the points lie about, whatever the others are; 0 without any.
double onLineThrough(std::span<const Vec2> points, double x);

}  // namespace batten
