// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/remove_rulings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/ruling/line_runs.h"
#include "core/image/ruling/ruling_course.h"

namespace batten {
namespace {

constexpr int kSampledBlocks = 3;         // one in so many tells the noise
constexpr int kProfileBlocks = 2;         // to either side, for the profile of a line
constexpr int kBinsPerPx = 2;             // of the profile across a line
constexpr double kLeastOfColumns = 0.15;  // that must meet a place of a profile
constexpr int kMostReachPx = 24;          // [px] across a line
constexpr double kRimShare = 0.25;        // of the spacing: beyond lies paper
constexpr double kPaperRank = 0.7;        // of the pixels beside a line: ink is darker
constexpr double kMostOfFamily = 2.0;     // of its depth: a block of a pale line that is darker is drawn on
constexpr double kOwnRank = 0.15;         // of the blocks of a line, by depth: some are not drawn on
constexpr double kWiderThanLine = 1.5;    // than a dark line, of ink that is not its own
constexpr double kPaperAlong = 0.9;       // rank along a dark line, of its blocks: some show paper
constexpr double kLeastPaperAlong = 0.5;  // of that: what is darker is ink
constexpr double kFoot = 0.1;             // of the depth: where a line ends across
constexpr double kMostSupport = 0.4;      // of the spacing: wider is no ruled line
constexpr double kLeastDepthSeen = 0.01;  // of the paper: a fainter line is left alone
constexpr double kPresence = 0.35;        // of the line's depth: fainter stretches are gaps
constexpr double kSolidLight = 0.35;      // less light comes through a dark line: what is over it cannot be told
constexpr double kSnapShare = 0.35;       // of the depth: what is left of a line after it is divided out
constexpr double kSnapPerNoise = 2.5;     // standard deviations of the paper
constexpr double kLeastStroke = 0.12;     // of the paper's light: what a stroke across takes at least
// Of what the whole line takes of the light, and of the light: a stretch takes no more.
constexpr double kMostOfWhole = 1.35, kMostBesides = 0.02;
// Copied and worn lines change their darkness along them. How much they do at most places tells how dark they may be at
// any: a stroke along the line makes one place darker.
constexpr double kDarkRank = 0.08;                      // of the light along 160 px
constexpr double kDarkMargin = 1.2, kMostOfDark = 2.2;  // of what is usual, of what the line takes of the light
constexpr double kSteepestStroke = 2.0;                 // [px along / px across]
constexpr int kStrokeSteps = 8;                         // to either side

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
  RulingEraser(GreyImage& image, const RulingFamily& family, const RulingLine& line)
      : image_(image), family_(family), course_(image, family, line) {
    const double limit = std::min<double>(kMostReachPx, 0.5 * family.spacingPx - 0.5);
    reach_ = std::max(2, static_cast<int>(limit));
    rim_ =
        std::min(static_cast<double>(reach_) - 1.0, std::max(0.5 * family.widthPx + 1.5, kRimShare * family.spacingPx));
  }

  void erase() {
    course_.straighten();
    measurePaper();
    measureWhole();
    if (depth_ < kLeastDepthSeen || !findSupport()) return;
    measureRims();
    isSolid_ = 1.0 - depth_ < kSolidLight || family_.isBroken;
    if (isSolid_) findOtherInk();
    std::vector<LinePart> parts;  // all before the first pixel changes
    std::vector<double> darker;
    for (int b = 0; b < course_.blocks(); ++b) {
      LineLight light = lightOf(std::max(0, b - kProfileBlocks), std::min(course_.blocks(), b + kProfileBlocks + 1));
      parts.push_back({profileOf(light, kPaperRank), profileOf(light, kDarkRank)});
      const double usual = depthOf(parts.back().usual);
      if (usual >= kLeastDepthSeen) darker.push_back(depthOf(parts.back().dark) / usual);
    }
    const double varies = darker.empty() ? 1.0 : kDarkMargin * upperMedian(darker);
    for (LinePart& part : parts) {
      part.usual = ofLineAlone(std::move(part.usual), kMostOfWhole);
      part.dark = ofLineAlone(std::move(part.dark), std::clamp(varies, kMostOfWhole, kMostOfDark));
    }
    for (int b = 0; b < course_.blocks(); ++b) eraseBlock(b, parts[b]);
  }

 private:
  /// What the line takes of the light as a rule. Of a dark one only ink that stands between paper tells: where copying
  /// has broken it it is no paler, and where a shape lies over it no wider. Of a pale one, not what is drawn along it:
  /// blocks that are much darker than both the lines of its family and most others of its own.
  void measureWhole() {
    const bool isBroken = family_.isBroken;
    const auto measure = [&](const std::vector<char>& isTaken) {
      LineLight all = lightOf(0, course_.blocks(), isTaken);
      whole_ = profileOf(all, kPaperRank);
      depth_ = depthOf(whole_);
    };
    std::vector<char> isTaken(image_.width, 1);
    for (int x = course_.from(); isBroken && x < course_.to(); ++x) isTaken[x] = standsAlone(x) ? 1 : 0;
    measure(isTaken);
    if (isBroken || depth_ <= kMostOfFamily * family_.depth) return;
    std::vector<double> depths;
    for (int b = 0; b < course_.blocks(); ++b) {
      LineLight light = lightOf(b, b + 1, isTaken);
      depths.push_back(depthOf(profileOf(light, kPaperRank)));
    }
    const double own = lowerQuantile(std::vector<double>(depths), kOwnRank);
    const double most = kMostOfFamily * std::max(own, family_.depth);
    for (int b = 0; b < course_.blocks(); ++b)
      if (depths[b] > most) std::fill(isTaken.begin() + course_.begin(b), isTaken.begin() + course_.end(b), 0);
    measure(isTaken);
  }

  double depthOf(const std::vector<double>& profile) const {
    const auto [nearFrom, nearTo] = middleOf(profile);
    return 1.0 - *std::min_element(nearFrom, nearTo);
  }

  /// Light that comes through the line about one block, per half pixel across: as a rule, and where it is darkest.
  struct LinePart {
    std::vector<double> usual, dark;
  };

  int bins() const { return 2 * kBinsPerPx * reach_ + 1; }

  /// Calls f(x, y, offset of the pixel's centre from the line) for the pixels of a strip.
  template <class F>
  void forStrip(int fromX, int toX, double low, double high, F&& f) const {
    for (int x = fromX; x < toX; ++x) {
      const int y0 = std::max(0, static_cast<int>(std::ceil(course_.at(x) + low - 0.5)));
      const int y1 = std::min(image_.height - 1, static_cast<int>(std::floor(course_.at(x) + high - 0.5)));
      for (int y = y0; y <= y1; ++y) f(x, y, y + 0.5 - course_.at(x));
    }
  }

  void measurePaper() {
    std::vector<float> levels;
    for (int b = 0; b < course_.blocks(); ++b) {
      levels.clear();
      forStrip(course_.begin(b), course_.end(b), -reach_, reach_, [&](int x, int y, double offset) {
        if (std::fabs(offset) >= rim_) levels.push_back(static_cast<float>(image_.row(y)[x]));
      });
      const double level = levels.empty() ? 0.0 : static_cast<double>(lowerQuantile(levels, kPaperRank));
      paper_.push_back(level > 1.0 ? level : paper_.empty() ? 65535.0 : paper_.back());
    }
    if (family_.isBroken) {
      // Where ink fills all about the line no paper is seen.
      const double bright = lowerQuantile(std::vector<double>(paper_), kPaperAlong);
      for (double& level : paper_) level = level < kLeastPaperAlong * bright ? bright : level;
    }
    for (int b = 0; b < course_.blocks(); b += kSampledBlocks) {
      forStrip(course_.begin(b), course_.end(b), -reach_, reach_, [&](int x, int y, double offset) {
        const double light = lightAt(x, y);
        const bool isInk = family_.isBroken && light < 1.0 - 0.5 * family_.depth;
        if (std::fabs(offset) >= rim_ && !isInk) noise_.push_back(light - 1.0);
      });
    }
    noiseLevel_ = robustSigma(noise_);
  }

  double lightAt(int x, int y) const { return image_.row(y)[x] / course_.atBlocks(paper_, x); }

  /// The light of the pixels about some blocks.
  struct LineLight {
    std::vector<std::vector<float>> values;  ///< Per half pixel across.
    int columns = 0;                         ///< In which the line is on the page.
  };
  /// @param isTaken per column of the picture, 0 for those that are left out; empty: none is.
  LineLight lightOf(int fromBlock, int toBlock, const std::vector<char>& isTaken = {}) const {
    const int from = course_.begin(fromBlock), to = course_.end(toBlock - 1);
    LineLight light{std::vector<std::vector<float>>(bins()), 0};
    const auto isLeftOut = [&](int x) { return !isTaken.empty() && isTaken[x] == 0; };
    for (int x = from; x < to; ++x)
      light.columns += !isLeftOut(x) && course_.at(x) >= 0.0 && course_.at(x) < image_.height ? 1 : 0;
    forStrip(from, to, -reach_, reach_, [&](int x, int y, double offset) {
      if (isLeftOut(x)) return;
      const auto bin = std::lround((offset + reach_) * kBinsPerPx);
      light.values[std::clamp<long>(bin, 0, bins() - 1)].push_back(static_cast<float>(lightAt(x, y)));
    });
    return light;
  }

  /// Light that comes through the line, per half pixel across, of a rank: of a high one strokes across do not count.
  /// The values change their order.
  std::vector<double> profileOf(LineLight& light, double rank) const {
    std::vector<std::optional<double>> known;
    // A line without slope meets every second place only, but for a few pixels, which say nothing of the whole.
    const auto least = static_cast<int>(kLeastOfColumns * light.columns);
    for (auto& values : light.values)
      known.push_back(std::ssize(values) <= least
                          ? std::nullopt
                          : std::optional(std::min(1.0, static_cast<double>(lowerQuantile(values, rank)))));
    std::vector<double> profile = withoutGaps(known);
    // Beside the line there is paper, whatever the noise and the slope of its grey.
    std::vector<double> beside;
    for (int i = 0; i < bins(); ++i) {
      if (std::fabs(static_cast<double>(i) / kBinsPerPx - reach_) >= rim_) beside.push_back(profile[i]);
    }
    // Ink only darkens: the brighter pixels show the line alone.
    const double paper = beside.empty() ? 1.0 : std::max(0.5, upperMedian(beside));
    for (double& value : profile) value = std::min(1.0, value / paper);
    return profile;
  }

  /// Places of the profile that are not known lie between their neighbours.
  static std::vector<double> withoutGaps(const std::vector<std::optional<double>>& known) {
    std::vector<double> profile;
    for (int i = 0; i < std::ssize(known); ++i) {
      if (!known[i]) continue;
      // The places since the last known one.
      const int from = static_cast<int>(profile.size());
      const double before = from > 0 ? profile.back() : *known[i];
      for (int k = from; k < i; ++k) {
        const double share = static_cast<double>(k - from + 1) / static_cast<double>(i - from + 1);
        profile.push_back(before + share * (*known[i] - before));
      }
      profile.push_back(*known[i]);
    }
    profile.resize(known.size(), profile.empty() ? 1.0 : profile.back());
    return profile;
  }

  double at(const std::vector<double>& profile, double offset) const {
    const double place = std::clamp((offset + reach_) * kBinsPerPx, 0.0, bins() - 1.0);
    const int i = static_cast<int>(place), j = std::min(i + 1, static_cast<int>(profile.size()) - 1);
    return profile[i] + (place - i) * (profile[j] - profile[i]);
  }

  using Place = std::vector<double>::const_iterator;
  /// The part of a profile in which the line lies.
  std::pair<Place, Place> middleOf(const std::vector<double>& profile) const {
    const auto half = static_cast<std::ptrdiff_t>(rim_ * kBinsPerPx), middle = static_cast<std::ptrdiff_t>(bins() / 2);
    return {profile.begin() + std::max<std::ptrdiff_t>(0, middle - half),
            profile.begin() + std::min<std::ptrdiff_t>(bins(), middle + half + 1)};
  }

  /// How far the line reaches to either side of its middle; false if that is no line.
  bool findSupport() {
    const auto [nearFrom, nearTo] = middleOf(whole_);
    const auto darkest = std::min_element(nearFrom, nearTo) - whole_.begin();
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
      const auto level = course_.greyAt(x, offset);
      return level ? std::clamp(1.0 - static_cast<double>(*level) / course_.atBlocks(paper_, x), 0.0, 1.0) : 0.0;
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

  /// A stroke that runs along the line is no part of it: the line takes at most so many times what the whole takes.
  std::vector<double> ofLineAlone(std::vector<double> profile, double most) const {
    for (std::size_t i = 0; i < profile.size(); ++i)
      profile[i] = std::max({profile[i], 1.0 - most * (1.0 - whole_[i]) - kMostBesides, 0.0});
    return profile;
  }

  /// Whether the middle of the line is at least half as dark as a line of that depth.
  bool isInked(int x, double depth, double offset = 0.0) const {
    const auto level = course_.greyAt(x, offset);
    return level && static_cast<double>(*level) < (1.0 - 0.5 * depth) * course_.atBlocks(paper_, x);
  }
  /// [px] of black that take as much light as the ink across the line at a column.
  double inkAcross(int x) const {
    double sum = 0.0;
    forStrip(x, x + 1, -rim_, rim_, [&](int, int y, double) { sum += std::max(0.0, 1.0 - lightAt(x, y)); });
    return sum;
  }
  bool standsAlone(int x) const {
    const double depth = family_.depth;
    return isInked(x, depth) && !isInked(x, depth, -rim_) && !isInked(x, depth, rim_);
  }

  /// Which columns of a solid line's course hold ink that is not its own.
  void findOtherInk() {
    std::vector<char> inked;
    for (int x = course_.from(); x < course_.to(); ++x) inked.push_back(isInked(x, depth_) ? 1 : 0);
    std::vector<char> other = otherInkOnLine(inked, family_.spacingPx);
    // What is no wider than the line is a piece of it, where a copy has broken it.
    const double ofLine =
        std::accumulate(whole_.begin(), whole_.end(), 0.0, [](double sum, double light) { return sum + 1.0 - light; }) /
        kBinsPerPx;
    for (std::ptrdiff_t i = 0, end = 0; family_.isBroken && i < std::ssize(other); i = end) {
      std::vector<double> widths;
      for (end = i; end < std::ssize(other) && other[end] == other[i]; ++end)
        if (other[i] != 0) widths.push_back(inkAcross(course_.from() + static_cast<int>(end)));
      if (!widths.empty() && upperMedian(widths) < kWiderThanLine * ofLine)
        std::fill(other.begin() + i, other.begin() + end, 0);
    }
    isOther_.assign(image_.width, 0);
    std::copy(other.begin(), other.end(), isOther_.begin() + course_.from());
  }

  double leastStroke() const { return std::max(kLeastStroke, 3.0 * noiseLevel_); }

  bool isGap(const std::vector<double>& profile) const { return !isSolid_ && depthOf(profile) < kPresence * depth_; }

  void eraseBlock(int block, const LinePart& line) {
    if (isGap(line.usual)) return;
    const double snap = std::max(kSnapPerNoise * noiseLevel_, kSnapShare * depth_);
    forStrip(course_.begin(block), course_.end(block), low_, high_, [&](int x, int y, double offset) {
      if (isSolid_ && isOther_[x] != 0) return;
      const double paper = course_.atBlocks(paper_, x), light = image_.row(y)[x] / paper;
      const double stroke = strokeAt(x, offset);
      double left = 1.0;
      if (isSolid_) {
        if (stroke > leastStroke()) left = std::max(light, 1.0 - stroke);
      } else {
        left = std::min(1.0, light / std::max(kSolidLight, at(line.usual, offset)));
        // Ink at either rim may end on the line or run into it at a small angle.
        const bool isFree = above_[x] <= leastStroke() && below_[x] <= leastStroke();
        const bool isLine = 1.0 - left <= snap || (isFree && light >= at(line.dark, offset));
        if (isLine && stroke <= leastStroke()) left = 1.0;
      }
      if (left > light) image_.row(y)[x] = static_cast<std::uint16_t>(std::clamp(left * paper, 0.0, 65535.0));
    });
  }

  GreyImage& image_;
  const RulingFamily& family_;
  RulingCourse course_;
  int reach_ = 2;
  double rim_ = 1.0;
  std::vector<double> paper_;  ///< [0..65535] per block.
  std::vector<double> noise_, whole_, above_, below_;
  double noiseLevel_ = 0.0, depth_ = 0.0;
  double low_ = 0.0, high_ = 0.0;  ///< [px] What the line covers, from its middle.
  bool isSolid_ = false;
  std::vector<char> isOther_;  ///< Of a solid line, per column: not its ink.
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
