// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/crack_contours.h"

#include <bit>
#include <cmath>
#include <new>

namespace batten {
namespace {

// Directions of travel along the cracks, clockwise on the screen.
enum : int { kRight = 0, kDown = 1, kLeft = 2, kUp = 3 };
constexpr int kStepX[4] = {1, 0, -1, 0};  // one crack right,
constexpr int kStepY[4] = {0, 1, 0, -1};  // and down
// Pixels ahead of a corner (x, y) of the pixel grid, relative to it, on the left and on the right of travel.
constexpr int kAheadLeftX[4] = {0, 0, -1, -1};
constexpr int kAheadLeftY[4] = {-1, 0, 0, -1};   // down
constexpr int kAheadRightX[4] = {0, -1, -1, 0};  // right
constexpr int kAheadRightY[4] = {0, 0, -1, -1};  // down

constexpr std::size_t kCancelEvery = 1u << 18;  // cracks; well below 50 ms
constexpr int kRowsPerLook = 256;               // between two looks at the cancel token, where few cracks begin

struct Border {
  std::vector<Vec2> midpoints;  // reused from border to border
  std::size_t turns = 0;
  std::int64_t signedArea = 0;  // [px^2] of the pixel polygon; negative for holes

  double length() const {
    return static_cast<double>(midpoints.size() - turns) + static_cast<double>(turns) * std::sqrt(0.5);
  }
};

class CrackFollower {
 public:
  CrackFollower(const BitImage& ink, const RunContext& context)
      : ink_(ink), context_(context), visited_(ink.width, ink.height) {}

  /// Cracks at the left side of ink pixels of one word that no border has passed yet.
  std::uint64_t unvisitedLeftCracks(int y, int word) const {
    const std::uint64_t* row = ink_.row(y);
    const std::uint64_t before = word > 0 ? row[word - 1] >> 63 : 0;
    return row[word] & ~((row[word] << 1) | before) & ~visited_.row(y)[word];
  }

  /// Follows the border that passes the left side of ink pixel (px, py) upwards. False when cancelled.
  bool follow(int px, int py, Border& border) {
    border.midpoints.clear();
    border.turns = 0;
    border.signedArea = 0;
    int x = px, y = py + 1, direction = kUp;
    do {
      border.midpoints.emplace_back(x + 0.5 * kStepX[direction], y + 0.5 * kStepY[direction]);
      border.signedArea -= static_cast<std::int64_t>(y) * kStepX[direction];
      if (direction == kUp) visited_.set(x, y - 1, true);
      x += kStepX[direction];
      y += kStepY[direction];
      const int turn = turnAt(x, y, direction);
      border.turns += turn != 0;
      direction = (direction + turn) & 3;
      if (++steps_ % kCancelEvery == 0 && context_.isCancelled()) return false;
    } while (x != px || y != py + 1 || direction != kUp);
    return true;
  }

 private:
  // Ink that touches over a corner is one piece (8-connected), so a border turns left as soon as it can.
  int turnAt(int x, int y, int direction) const {
    if (ink_.at(x + kAheadLeftX[direction], y + kAheadLeftY[direction])) return 3;
    return ink_.at(x + kAheadRightX[direction], y + kAheadRightY[direction]) ? 0 : 1;
  }

  const BitImage& ink_;
  const RunContext& context_;
  BitImage visited_;
  std::size_t steps_ = 0;
};

Contour toContour(const Border& border) {
  Contour contour;
  contour.kind = ContourKind::Outline;
  contour.closed = true;
  contour.hole = border.signedArea < 0;
  contour.points = contourPoints(border.midpoints, false);
  contour.lengthPx = border.length();
  // Each of the four more outer than inner corners costs an eighth of a pixel when midpoints are joined.
  contour.areaPx = std::abs(static_cast<double>(border.signedArea) - 0.5);
  if (contour.hole) contour.areaPx = std::abs(static_cast<double>(border.signedArea) + 0.5);
  return contour;
}

Result<ContourSet> followAll(const BitImage& ink, bool internal, double minLengthPx, const RunContext& context) {
  ContourSet set;
  CrackFollower follower(ink, context);
  Border border;
  for (int y = 0; y < ink.height; ++y) {
    if (y % kRowsPerLook == 0 && context.isCancelled()) return cancelled();
    for (int word = 0; word < ink.wordsPerRow; ++word) {
      for (std::uint64_t starts = follower.unvisitedLeftCracks(y, word); starts != 0;
           starts = follower.unvisitedLeftCracks(y, word)) {
        const int x = word * 64 + std::countr_zero(starts);
        if (!follower.follow(x, y, border)) return cancelled();
        ++set.report.found;
        if (border.signedArea < 0 && !internal) {
          ++set.report.droppedHoles;
        } else if (border.length() < minLengthPx) {
          ++set.report.droppedShort;
        } else {
          set.contours.push_back(toContour(border));
        }
      }
    }
  }
  return set;
}

}  // namespace

Result<ContourSet> crackContours(const BitImage& ink, bool internal, double minLengthPx, const RunContext& context) {
  try {
    return followAll(ink, internal, minLengthPx, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to follow the contours: raise the smallest length.");
  }
}

}  // namespace batten
