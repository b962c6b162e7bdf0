// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/rulings.h"

namespace batten {
namespace {

constexpr int kBlockPx = 32;       // [px] along a line: one paper level, one place and one profile
constexpr int kProfileBlocks = 2;  // to either side, for the profile of a line
constexpr int kBinsPerPx = 2;
constexpr int kMostReachPx = 24;      // [px] across a line
constexpr double kRimShare = 0.25;    // of the spacing: beyond lies paper
constexpr double kPaperRank = 0.7;    // of the pixels beside a line: ink is darker
constexpr double kFoot = 0.1;         // of the depth: where a line ends across
constexpr double kMostSupport = 0.4;  // of the spacing: wider is no ruled line
constexpr double kLeastDepthSeen = 0.01;
constexpr double kPresence = 0.35;    // of the line's depth: fainter stretches are gaps
constexpr double kSolidLight = 0.35;  // less light comes through a dark line: what is over it cannot be told
constexpr double kSnapShare = 0.35;   // of the depth: what is left of a line after it is divided out
constexpr double kSnapPerNoise = 2.5;
constexpr double kLeastStroke = 0.12;    // of the paper's light: what a stroke across takes at least
constexpr double kSteepestStroke = 2.0;  // [px along / px across]
constexpr int kStrokeSteps = 8;          // to either side

GreyImage transposedGrey(const GreyImage& in, const RunContext& context) {
  GreyImage out(in.height, in.width);
  parallelFor(context, out.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < out.width; ++x) out.row(y)[x] = in.row(x)[y];
    }
  });
  return out;
}

/// One line that runs along x, taken out of the picture.
class RulingEraser {
 public:
  RulingEraser(GreyImage& image, const RulingFamily& family, const RulingLine& line) : image_(image), family_(family) {
    const double limit = std::min<double>(kMostReachPx, 0.5 * family.spacingPx - 0.5);
    reach_ = std::max(2, static_cast<int>(limit));
    rim_ =
        std::min(static_cast<double>(reach_) - 1.0, std::max(0.5 * family.widthPx + 1.5, kRimShare * family.spacingPx));
    course_.resize(static_cast<std::size_t>(image.width));
    std::size_t at = 0;
    for (int x = 0; x < image.width; ++x) {
      const auto place = [&](std::size_t i) {
        const Vec2& p = line.coursePx[i];
        return family.runsDown ? Vec2(p.y(), p.x()) : p;
      };
      while (at + 2 < line.coursePx.size() && place(at + 1).x() < x + 0.5) ++at;
      const Vec2 a = place(at), b = place(std::min(at + 1, line.coursePx.size() - 1));
      const double share = b.x() > a.x() ? (x + 0.5 - a.x()) / (b.x() - a.x()) : 0.0;
      course_[x] = a.y() + share * (b.y() - a.y());
    }
    blocks_ = std::max(1, image.width / kBlockPx);
  }

  void erase() {
    straightenCourse();
    measurePaper();
    whole_ = profileOf(0, blocks_);
    depth_ = 1.0 - *std::min_element(whole_.begin(), whole_.end());
    if (depth_ < kLeastDepthSeen || !findSupport()) return;
    measureRims();
    isSolid_ = 1.0 - depth_ < kSolidLight;
    for (int b = 0; b < blocks_; ++b) eraseBlock(b);
  }

 private:
  int begin(int block) const { return block * kBlockPx; }
  int end(int block) const { return block + 1 == blocks_ ? image_.width : (block + 1) * kBlockPx; }
  int bins() const { return 2 * kBinsPerPx * reach_ + 1; }

  /// Calls f(x, y, offset of the pixel's centre from the line) for the pixels of a band.
  template <class F>
  void forBand(int fromX, int toX, double low, double high, F&& f) const {
    for (int x = fromX; x < toX; ++x) {
      const int y0 = std::max(0, static_cast<int>(std::ceil(course_[x] + low - 0.5)));
      const int y1 = std::min(image_.height - 1, static_cast<int>(std::floor(course_[x] + high - 0.5)));
      for (int y = y0; y <= y1; ++y) f(x, y, y + 0.5 - course_[x]);
    }
  }

  /// Moves the course to where the line is darkest, block by block, smoothly.
  void straightenCourse() {
    const int most = std::max(1, static_cast<int>(std::min(0.25 * family_.spacingPx, 3.0 + family_.widthPx)));
    std::vector<double> shifts;
    std::vector<float> column;
    for (int b = 0; b < blocks_; ++b) {
      std::vector<double> levels;
      for (int o = -most - 1; o <= most + 1; ++o) {
        column.clear();
        for (int x = begin(b); x < end(b); ++x) {
          const int y = static_cast<int>(std::floor(course_[x])) + o;
          if (y >= 0 && y < image_.height) column.push_back(static_cast<float>(image_.row(y)[x]));
        }
        levels.push_back(column.empty() ? 65535.0 : static_cast<double>(upperMedian(column)));
      }
      const auto darkest = std::min_element(levels.begin() + 1, levels.end() - 1) - levels.begin();
      const double bend = levels[darkest - 1] - 2.0 * levels[darkest] + levels[darkest + 1];
      const double part = bend > 0.0 ? 0.5 * (levels[darkest - 1] - levels[darkest + 1]) / bend : 0.0;
      shifts.push_back(static_cast<double>(darkest) - most - 1 + std::clamp(part, -0.5, 0.5));
    }
    std::vector<double> calm(shifts.size());
    for (std::ptrdiff_t i = 0; i < std::ssize(shifts); ++i) {
      std::vector<double> near;
      for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - 3); j <= std::min(std::ssize(shifts) - 1, i + 3); ++j)
        near.push_back(shifts[j]);
      calm[i] = upperMedian(near);
    }
    for (int x = 0; x < image_.width; ++x) {
      // floor() lost half a pixel on average, since a pixel's centre lies there.
      course_[x] = std::floor(course_[x]) + 0.5 + atBlocks(calm, x);
    }
    smoothCourse();
  }

  /// The steps that floor() left are taken out again.
  void smoothCourse() {
    std::vector<double> sums(course_.size() + 1, 0.0);
    for (std::size_t i = 0; i < course_.size(); ++i) sums[i + 1] = sums[i] + course_[i];
    constexpr std::ptrdiff_t kHalf = kBlockPx / 2;
    for (std::ptrdiff_t x = 0; x < std::ssize(course_); ++x) {
      const std::ptrdiff_t half = std::min({kHalf, x, std::ssize(course_) - 1 - x});
      course_[x] = (sums[x + half + 1] - sums[x - half]) / static_cast<double>(2 * half + 1);
    }
  }

  /// Values at the blocks' middles, linear between them.
  double atBlocks(const std::vector<double>& values, int x) const {
    const double place = (x + 0.5) / kBlockPx - 0.5;
    const double low = std::clamp(std::floor(place), 0.0, static_cast<double>(values.size() - 1));
    const auto i = static_cast<std::size_t>(low);
    const std::size_t j = std::min(i + 1, values.size() - 1);
    return values[i] + std::clamp(place - low, 0.0, 1.0) * (values[j] - values[i]);
  }

  void measurePaper() {
    std::vector<float> levels;
    for (int b = 0; b < blocks_; ++b) {
      levels.clear();
      forBand(begin(b), end(b), -reach_, reach_, [&](int x, int y, double offset) {
        if (std::fabs(offset) >= rim_) levels.push_back(static_cast<float>(image_.row(y)[x]));
      });
      const double level = levels.empty() ? 0.0 : static_cast<double>(lowerQuantile(levels, kPaperRank));
      paper_.push_back(level > 1.0 ? level : paper_.empty() ? 65535.0 : paper_.back());
    }
    for (int b = 0; b < blocks_; b += 3) {
      forBand(begin(b), end(b), -reach_, reach_, [&](int x, int y, double offset) {
        if (std::fabs(offset) >= rim_) noise_.push_back(lightAt(x, y) - 1.0);
      });
    }
    noiseLevel_ = robustSigma(noise_);
  }

  double lightAt(int x, int y) const { return image_.row(y)[x] / atBlocks(paper_, x); }

  /// Light that comes through the line, per half pixel across: medians over blocks, so that strokes across do not
  /// count.
  std::vector<double> profileOf(int fromBlock, int toBlock) const {
    std::vector<std::vector<float>> light(static_cast<std::size_t>(bins()));
    forBand(begin(fromBlock), end(toBlock - 1), -reach_, reach_, [&](int x, int y, double offset) {
      const auto bin = std::lround((offset + reach_) * kBinsPerPx);
      light[static_cast<std::size_t>(std::clamp<long>(bin, 0, bins() - 1))].push_back(
          static_cast<float>(lightAt(x, y)));
    });
    std::vector<double> profile;
    for (auto& values : light)
      profile.push_back(values.empty() ? 1.0 : std::min(1.0, static_cast<double>(upperMedian(values))));
    return profile;
  }

  double at(const std::vector<double>& profile, double offset) const {
    const double place = std::clamp((offset + reach_) * kBinsPerPx, 0.0, bins() - 1.0);
    const auto i = static_cast<std::size_t>(place);
    const std::size_t j = std::min(i + 1, profile.size() - 1);
    return profile[i] + (place - static_cast<double>(i)) * (profile[j] - profile[i]);
  }

  /// How far the line reaches to either side of its middle; false if that is no line.
  bool findSupport() {
    const auto darkest = std::min_element(whole_.begin(), whole_.end()) - whole_.begin();
    auto from = darkest, to = darkest;
    const double foot = 1.0 - kFoot * depth_;
    while (from > 0 && whole_[from - 1] < foot) --from;
    while (to + 1 < std::ssize(whole_) && whole_[to + 1] < foot) ++to;
    low_ = static_cast<double>(from) / kBinsPerPx - reach_ - 1.0;
    high_ = static_cast<double>(to) / kBinsPerPx - reach_ + 1.0;
    return high_ - low_ - 1.0 <= std::max(3.0, kMostSupport * family_.spacingPx) && from > 0 &&
           to + 1 < std::ssize(whole_);
  }

  /// What strokes take of the light just above and just below the line.
  void measureRims() {
    const auto darkness = [&](int x, double offset) {
      const double place = course_[x] + offset - 0.5;
      const int y = static_cast<int>(std::floor(place));
      if (y < 0 || y + 1 >= image_.height) return 0.0;
      const double share = place - y;
      const double light = (1.0 - share) * lightAt(x, y) + share * lightAt(x, y + 1);
      return std::clamp(1.0 - light, 0.0, 1.0);
    };
    for (int x = 0; x < image_.width; ++x) {
      above_.push_back(darkness(x, low_ - 0.5));
      below_.push_back(darkness(x, high_ + 0.5));
    }
  }

  /// What a straight stroke through a pixel of the line takes of the light: seen on both sides of the line, at any
  /// slope.
  double strokeAt(int x, double offset) const {
    const double up = offset - low_ + 0.5, down = high_ + 0.5 - offset;
    double most = 0.0;
    for (int i = -kStrokeSteps; i <= kStrokeSteps; ++i) {
      const double slope = kSteepestStroke * i / kStrokeSteps;
      const auto a = x - std::lround(slope * up), b = x + std::lround(slope * down);
      if (a < 0 || b < 0 || a >= image_.width || b >= image_.width) continue;
      most = std::max(most, std::min(above_[a], below_[b]));
    }
    return most;
  }

  void eraseBlock(int block) {
    const int from = std::max(0, block - kProfileBlocks), to = std::min(blocks_, block + kProfileBlocks + 1);
    std::vector<double> profile = profileOf(from, to);
    const double depthHere = 1.0 - *std::min_element(profile.begin(), profile.end());
    if (depthHere < kPresence * depth_) return;
    // A stroke that runs along the line is no part of it.
    for (std::size_t i = 0; i < profile.size(); ++i)
      profile[i] = std::max({profile[i], 1.0 - 1.35 * (1.0 - whole_[i]) - 0.02, 0.0});
    const double leastStroke = std::max(kLeastStroke, 3.0 * noiseLevel_);
    const double snap = std::max(kSnapPerNoise * noiseLevel_, kSnapShare * depth_);
    forBand(begin(block), end(block), low_, high_, [&](int x, int y, double offset) {
      const double paper = atBlocks(paper_, x), light = image_.row(y)[x] / paper;
      const double stroke = strokeAt(x, offset);
      double left = 1.0;
      if (isSolid_) {
        if (stroke > leastStroke) left = std::max(light, 1.0 - stroke);
      } else {
        left = std::min(1.0, light / std::max(kSolidLight, at(profile, offset)));
        if (1.0 - left <= snap && stroke <= leastStroke) left = 1.0;
      }
      if (left > light) image_.row(y)[x] = static_cast<std::uint16_t>(std::clamp(left * paper, 0.0, 65535.0));
    });
  }

  GreyImage& image_;
  const RulingFamily& family_;
  int reach_ = 2, blocks_ = 1;
  double rim_ = 1.0;
  std::vector<double> course_;  ///< [px] The line's middle at every column.
  std::vector<double> paper_;   ///< [0..65535] per block.
  std::vector<double> noise_, whole_, above_, below_;
  double noiseLevel_ = 0.0, depth_ = 0.0;
  double low_ = 0.0, high_ = 0.0;  ///< [px] What the line covers, from its middle.
  bool isSolid_ = false;
};

}  // namespace

GreyImage withoutRulings(const GreyImage& image, const std::vector<RulingFamily>& families, const RunContext& context) {
  GreyImage out = image;
  for (const RulingFamily& family : families) {
    if (family.runsDown) out = transposedGrey(out, context);
    // Every second line, then the others: neighbours may read what the other one writes.
    const int count = static_cast<int>(family.lines.size());
    for (int parity = 0; parity < 2; ++parity) {
      parallelFor(context, (count + 1 - parity) / 2, 1, [&](int begin, int end) {
        for (int i = begin; i < end && !context.isCancelled(); ++i)
          RulingEraser(out, family, family.lines[2 * i + parity]).erase();
      });
    }
    if (family.runsDown) out = transposedGrey(out, context);
    if (context.isCancelled()) return {};
  }
  return out;
}

}  // namespace batten
