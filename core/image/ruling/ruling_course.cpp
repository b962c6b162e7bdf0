// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/image/ruling/find_rulings.h"

namespace batten {
namespace {

constexpr int kBlockPx = 32;             // [px] along a line: one paper level, one place and one profile
constexpr int kCalmBlocks = 3;           // to either side, which say where the line lies
constexpr int kCalmBlocksAtEnd = 2;      // likewise: most of them lie where the line bends away
constexpr double kLeastSeenDepth = 0.2;  // of the depth of its family: what is fainter is not the line
constexpr double kBeyondBlocks = 1.0;    // from the middle of the last one

double medianY(std::span<const Vec2> points) {
  std::vector<double> values;
  for (const Vec2& p : points) values.push_back(p.y());
  return upperMedian(values);
}

}  // namespace

RulingCourse::RulingCourse(const GreyImage& image, const RulingFamily& family, const RulingLine& line)
    : image_(image),
      spacingPx_(family.spacingPx),
      widthPx_(family.widthPx),
      depth_(family.depth),
      isDark_(family.depth > kDarkRuling && !family.isBroken) {
  const auto place = [&](std::size_t i) {
    const Vec2& p = line.coursePx[i];
    return family.runsDown ? Vec2(p.y(), p.x()) : p;
  };
  course_.resize(image.width);
  std::size_t at = 0;
  for (int x = 0; x < image.width; ++x) {
    while (at + 2 < line.coursePx.size() && place(at + 1).x() < x + 0.5) ++at;
    const Vec2 a = place(at), b = place(std::min(at + 1, line.coursePx.size() - 1));
    const double share = b.x() > a.x() ? (x + 0.5 - a.x()) / (b.x() - a.x()) : 0.0;
    course_[x] = a.y() + share * (b.y() - a.y());
  }
  from_ = std::clamp(static_cast<int>(std::lround(place(0).x())), 0, image.width - 1);
  to_ = std::clamp(static_cast<int>(std::lround(place(line.coursePx.size() - 1).x())), from_ + 1, image.width);
  blocks_ = std::max(1, (to_ - from_) / kBlockPx);
}

int RulingCourse::begin(int block) const { return from_ + block * kBlockPx; }

int RulingCourse::end(int block) const { return block + 1 == blocks_ ? to_ : from_ + (block + 1) * kBlockPx; }

std::optional<float> RulingCourse::greyAt(int x, double offset) const {
  const double place = course_[x] + offset - 0.5;
  const int y = static_cast<int>(std::floor(place));
  if (y < 0 || y + 1 >= image_.height) return std::nullopt;
  const auto share = static_cast<float>(place - y);
  return (1.0f - share) * static_cast<float>(image_.row(y)[x]) + share * static_cast<float>(image_.row(y + 1)[x]);
}

/// Where the line lies off its course in one block: the middle of what is at least half as dark as its darkest place.
/// Absent where nothing is dark enough for the line.
std::optional<double> RulingCourse::shiftOf(int block) const {
  const int steps = std::max(2, static_cast<int>(2.0 * std::min(0.25 * spacingPx_, 3.0 + widthPx_)));
  std::vector<float> levels, column;
  for (int o = -steps; o <= steps; ++o) {
    column.clear();
    for (int x = begin(block); x < end(block); ++x) {
      if (const auto level = greyAt(x, 0.5 * o)) column.push_back(*level);
    }
    levels.push_back(column.empty() ? 65535.0f : upperMedian(column));
  }
  const auto darkest = std::min_element(levels.begin(), levels.end());
  const float paper = *std::max_element(levels.begin(), levels.end()), half = 0.5f * (paper + *darkest);
  const float least = isDark_ ? 0.0f : static_cast<float>(kLeastSeenDepth * depth_) * paper;
  if (paper - *darkest <= least) return std::nullopt;
  auto from = darkest, to = darkest;
  while (from != levels.begin() && *(from - 1) < half) --from;
  while (to + 1 != levels.end() && *(to + 1) < half) ++to;
  double sum = 0.0, weight = 0.0;
  for (auto it = from; it <= to; ++it) {
    const double darker = static_cast<double>(half - *it) + 1.0;
    sum += darker * static_cast<double>(it - levels.begin());
    weight += darker;
  }
  return 0.5 * (sum / weight - steps);
}

double onLineThrough(std::span<const Vec2> points, double x) {
  std::vector<double> slopes, levels;
  for (const Vec2& p : points) {
    std::vector<double> ofThis;
    for (const Vec2& q : points)
      if (q.x() != p.x()) ofThis.push_back((q.y() - p.y()) / (q.x() - p.x()));
    if (!ofThis.empty()) slopes.push_back(upperMedian(ofThis));
  }
  const double slope = slopes.empty() ? 0.0 : upperMedian(slopes);
  for (const Vec2& p : points) levels.push_back(p.y() + slope * (x - p.x()));
  return levels.empty() ? 0.0 : upperMedian(levels);
}

void RulingCourse::straighten() {
  // Blocks that the line has left, as of a rotated page, or in which it is not seen, tell nothing.
  std::vector<Vec2> shifts;
  for (int b = 0; b < blocks_; ++b) {
    const double middle = course_[(begin(b) + end(b)) / 2];
    const auto shift = isDark_ || (middle > 0.0 && middle < image_.height) ? shiftOf(b) : std::nullopt;
    if (shift || isDark_) shifts.emplace_back(b, shift.value_or(0.0));
  }
  if (shifts.empty()) return;
  std::vector<double> calm;
  const auto known = static_cast<int>(shifts.size());
  for (int b = 0, place = 0; b < blocks_; ++b) {
    while (place + 1 < known && shifts[place].x() < b) ++place;
    const int atEnd = std::min(place, known - 1 - place);
    // Ink beside a dark line of a grid is as dark as the line: a direction of few blocks may be that of a box.
    const int half = isDark_ ? kCalmBlocks : std::clamp(atEnd, kCalmBlocksAtEnd, kCalmBlocks);
    const int most = isDark_ ? known - 1 : std::max(0, known - 2 * half - 1);
    const int from = std::clamp(place - half, 0, most);
    const int to = std::min(known, isDark_ ? place + half + 1 : from + 2 * half + 1);
    const auto around = std::span(shifts).subspan(from, to - from);
    const double inside = std::clamp<double>(b, shifts.front().x(), shifts.back().x());
    calm.push_back(isDark_ ? medianY(around) : onLineThrough(around, inside));
  }
  for (int x = 0; x < image_.width; ++x) course_[x] += isDark_ ? atBlocks(calm, x) : beyondBlocks(calm, x);
}

/// As atBlocks, straight on beyond the middle of the first and of the last block.
double RulingCourse::beyondBlocks(const std::vector<double>& values, int x) const {
  const double last = blocks_ - 1.0, place = (x - from_ + 0.5) / kBlockPx - 0.5;
  const double inside = std::clamp(place, 0.0, last);
  const int i = std::min(static_cast<int>(inside), std::max(0, blocks_ - 2)), j = std::min(i + 1, blocks_ - 1);
  const double beyond = std::clamp(place, -kBeyondBlocks, last + kBeyondBlocks);
  return values[i] + (beyond - i) * (values[j] - values[i]);
}

double RulingCourse::atBlocks(const std::vector<double>& values, int x) const {
  const double place = (x - from_ + 0.5) / kBlockPx - 0.5;
  const double low = std::clamp(std::floor(place), 0.0, static_cast<double>(values.size() - 1));
  const int i = static_cast<int>(low), j = std::min(i + 1, static_cast<int>(values.size()) - 1);
  return values[i] + std::clamp(place - low, 0.0, 1.0) * (values[j] - values[i]);
}

}  // namespace batten
