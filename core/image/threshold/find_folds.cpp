// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/find_folds.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/threshold/fold_lines.h"
#include "core/image/threshold/fold_step.h"

namespace batten {
namespace {

constexpr int kWidest = 40;              // [px] half the softest edge that is looked at
constexpr double kDarkestShade = 0.4;    // of the paper beside it: what is darker is no shaded paper
constexpr double kLeastSeen = 0.5;       // of the step: what the grey itself steps, the slope of the paper left in
constexpr double kBarShare = 0.2;        // of the page's smaller side: two opposite steps that are nearer make a bar
constexpr double kWindowPx = 96.0;       // along the course: a line that crosses takes up a small part of it
constexpr double kSpacingPx = 16.0;      // between stations along the course
constexpr float kShownShare = 0.3f;      // of the median step: a place where the step shows
constexpr double kCoarseRows = 400.0;    // of the first look along a course: hardly more for a longer one, …
constexpr double kLeastRowPx = 4.0;      // … and no closer than this
constexpr double kOppositeCos = -0.9;    // of the normals: opposite but for 26 degrees
constexpr double kUsualSidePx = 1000.0;  // of the shrunk page; softness goes with the size of the scan, …
constexpr double kLeastScale = 0.5, kMostScale = 3.0;  // … within limits
constexpr double kAboveWhite = 0.5;  // of the step: paper that would be so much brighter than white is in no shade, …
constexpr double kMostLit = 0.25;    // … and of the darker side so much at most

float sample(const Plane& u, const Vec2& p) {
  const int x = std::clamp(static_cast<int>(p.x()), 0, u.width - 1);
  const int y = std::clamp(static_cast<int>(p.y()), 0, u.height - 1);
  return u.row(y)[x];
}

/// Whether the smoothed page has other levels on the two sides at most places along the course: tells the many straight
/// lines of a drawing from the few steps before these are looked at closely.
bool mayStep(const Plane& u, const FoldCourse& c) {
  constexpr int kPlaces = 160;  // along the course, for a first look
  // [px] from the course: the levels, and with the farther ones the slope of the paper
  constexpr double kNear = 14.0, kFar = 28.0;
  std::vector<float> steps;
  for (int i = 0; i < kPlaces; ++i) {
    const double t = c.from + (i + 0.5) * (c.to - c.from) / kPlaces;
    const auto at = [&](double d) { return sample(u, c.at(t, d)); };
    const float bright = at(kNear), dark = at(-kNear);
    const float slope = static_cast<float>(0.5 / (kFar - kNear)) * (at(kFar) - bright + dark - at(-kFar));
    steps.push_back(bright - dark - static_cast<float>(2.0 * kNear) * slope);
  }
  std::vector<float> sorted = steps;
  const float middle = lowerQuantile(sorted, 0.5);
  const auto shown = std::count_if(steps.begin(), steps.end(), [&](float step) { return step > kShownShare * middle; });
  return static_cast<double>(middle) > 0.5 * kLeastFoldStep && 2 * shown > kPlaces;
}

class FoldMaker {
 public:
  FoldMaker(const GreyImage& image, const FoldCourse& course, double scale)
      : image_(image), course_(course), scale_(scale) {}

  std::optional<PaperFold> make() {
    const int widest = static_cast<int>(kWidest * scale_);
    const FoldStrip coarse =
        foldStripAlong(image_, course_, widest, std::max(kLeastRowPx, (course_.to - course_.from) / kCoarseRows));
    const std::vector<double> slopes = foldSlopesAcross(coarse);
    const auto rough = fitFoldStep(foldStepsOf(coarse, widest - kFoldPaperPx, slopes));
    if (!rough) return std::nullopt;
    const auto reach = foldReachOf(coarse, *rough);
    if (!reach) return std::nullopt;
    strip_ = foldStripAlong(image_, course_, *reach + kFoldPaperPx, 2.0);
    const auto fine = fitFoldStep(foldStepsOf(strip_, *reach, slopes));
    if (!fine || !isSeen(*fine, *reach) || !isShade(*fine, *reach)) return std::nullopt;
    return profiled(*fine, *reach);
  }

 private:
  /// Whether the grey itself steps, not its slope alone: a line along one side of the course would pass for a slope.
  bool isSeen(const FoldStepFit& fit, int reach) const {
    const std::vector<double> level(strip_.rows, 0.0);
    return lowerQuantile(foldStepsOf(strip_, reach, level), 0.5) > kLeastSeen * fit.middle;
  }

  bool isShade(const FoldStepFit& fit, int reach) const {
    std::vector<double> ratios;
    for (int i = 0; i < strip_.rows; ++i) {
      if (fit.shows[i] == 0) continue;
      const double bright = strip_.mean(i, reach, reach + kFoldPaperPx);
      ratios.push_back((bright - fit.at(i, strip_.rows)) / std::max(1.0, bright));
    }
    return !ratios.empty() && lowerQuantile(ratios, 0.5) > kDarkestShade;
  }

  PaperFold profiled(const FoldStepFit& fit, int reach) const {
    PaperFold fold;
    fold.course = course_;
    fold.reach = reach;
    fold.spacing = kSpacingPx;
    fold.stations = std::max(2, static_cast<int>((course_.to - course_.from) / kSpacingPx) + 1);
    const std::vector<std::vector<StripPixel>> pixels = stripPixels(fold, fit);
    std::vector<std::vector<float>> profiles;
    profiles.reserve(fold.stations);
    for (int k = 0; k < fold.stations; ++k) profiles.push_back(edgeProfile(pixels, k, fold));
    const int taps = fold.taps();
    fillGaps(profiles);
    std::vector<float> raw;
    for (std::vector<float>& profile : profiles) {
      profile.resize(taps, 0.0f);
      const float bright = endMean(profile, false);
      for (float& value : profile) value -= bright;
      raw.push_back(std::max(0.0f, -endMean(profile, true)));
    }
    for (int k = 0; k < fold.stations; ++k) {
      fold.depth.push_back(smoothedDepth(raw, k));
      appendProfile(profiles[k], fold.depth.back(), fold.profile);
    }
    return fold;
  }

  struct StripPixel {
    float d, value;
  };

  /// The pixels near the course that show the step, each less the brighter paper beside it, by their nearest station.
  /// Pixels themselves, not samples between them: a sharp fold would be drawn out by interpolation.
  std::vector<std::vector<StripPixel>> stripPixels(const PaperFold& fold, const FoldStepFit& fit) const {
    std::vector<float> bright;
    bright.reserve(strip_.rows);
    for (int i = 0; i < strip_.rows; ++i)
      bright.push_back(static_cast<float>(strip_.mean(i, fold.reach, fold.reach + kFoldPaperPx)));
    std::vector<std::vector<StripPixel>> pixels(fold.stations);
    for (int y = 0; y < image_.height; ++y) {
      const auto [x0, x1] = fold.stripOfRow(y, image_.width);
      for (int x = x0; x < x1; ++x) {
        const Vec2 p = Vec2(x + 0.5, y + 0.5) - course_.origin;
        const double t = p.dot(course_.along), d = p.dot(course_.normal) - course_.bendAt(t);
        const auto row = static_cast<int>((t - course_.from) / strip_.stepPx);
        if (t < course_.from || row >= strip_.rows || std::fabs(d) > fold.reach + 0.5) continue;
        if (fit.shows[row] == 0) continue;
        const long station = std::min<long>(fold.stations - 1, std::lround((t - course_.from) / fold.spacing));
        pixels[station].push_back({static_cast<float>(d), static_cast<float>(image_.level(x, y)) - bright[row]});
      }
    }
    return pixels;
  }

  /// Medians over the pixels of a window along the course, by their distance from it. Empty with too few.
  static std::vector<float> edgeProfile(const std::vector<std::vector<StripPixel>>& pixels, int station,
                                        const PaperFold& fold) {
    constexpr std::size_t kFewest = 6;  // pixels that a median is taken of
    const int taps = fold.taps(), around = static_cast<int>(0.5 * kWindowPx / fold.spacing);
    std::vector<std::vector<float>> values(taps);
    std::vector<double> places(taps, 0.0);
    for (int k = std::max(0, station - around); k <= std::min(fold.stations - 1, station + around); ++k) {
      for (const StripPixel& pixel : pixels[k]) {
        const double v = (static_cast<double>(pixel.d) + fold.reach) * PaperFold::kTapsPerPx;
        const long bin = std::clamp<long>(std::lround(v), 0, taps - 1);
        values[bin].push_back(pixel.value);
        places[bin] += v;
      }
    }
    std::vector<std::pair<double, float>> knots;
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
      if (values[bin].size() < kFewest) continue;
      knots.emplace_back(places[bin] / static_cast<double>(values[bin].size()), lowerQuantile(values[bin], 0.5));
    }
    if (static_cast<int>(knots.size()) * 3 < taps) return {};
    std::vector<float> profile;
    std::size_t at = 0;
    for (int bin = 0; bin < taps; ++bin) {
      while (at + 2 < knots.size() && knots[at + 1].first < bin) ++at;
      const auto& [v0, y0] = knots[at];
      const auto& [v1, y1] = knots[at + 1];
      const double share = std::clamp((bin - v0) / std::max(1e-6, v1 - v0), 0.0, 1.0);
      profile.push_back(y0 + static_cast<float>(share) * (y1 - y0));
    }
    return profile;
  }

  static float endMean(const std::vector<float>& profile, bool front) {
    const std::size_t n = profile.size(), at = front ? 0 : n - 3;
    return (profile[at] + profile[at + 1] + profile[at + 2]) / 3.0f;
  }

  /// The step on the darker side reaches far over the page: its noise along the course would show as streaks.
  static float smoothedDepth(const std::vector<float>& raw, int k) {
    constexpr int kHalf = 6;  // stations to either side
    float sum = 0.0f, weight = 0.0f;
    for (int i = -kHalf; i <= kHalf; ++i) {
      const int at = k + i;
      if (at < 0 || at >= static_cast<int>(raw.size())) continue;
      const auto w = static_cast<float>(kHalf + 1 - std::abs(i));
      sum += w * raw[at];
      weight += w;
    }
    return sum / weight;
  }

  /// The measured profile, brought to 0 and to -depth at its ends.
  static void appendProfile(const std::vector<float>& profile, float depth, std::vector<float>& out) {
    const std::size_t n = profile.size();
    const float first = profile.front() + depth, last = profile.back();
    for (std::size_t i = 0; i < n; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(n - 1);
      out.push_back(profile[i] - first * (1.0f - share) - last * share);
    }
  }

  static void fillGaps(std::vector<std::vector<float>>& profiles) {
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      for (std::size_t far = 1; profiles[k].empty() && far < profiles.size(); ++far) {
        if (far <= k && !profiles[k - far].empty())
          profiles[k] = profiles[k - far];
        else if (k + far < profiles.size() && !profiles[k + far].empty())
          profiles[k] = profiles[k + far];
      }
    }
  }

  const GreyImage& image_;
  FoldCourse course_;
  double scale_;
  FoldStrip strip_;
};

/// Whether the darker side is in shade as far as the page goes. Beside a gutter the paper brightens again within some
/// widths of it: what the step is there would wash out all lines farther on.
bool staysDark(const PaperFold& fold, const Plane& smoothed, int shrink) {
  constexpr int kStep = 4;  // [px] of the plane
  constexpr double kWhite = 255.0;
  int dark = 0, lit = 0;
  for (int y = 0; y < smoothed.height; y += kStep) {
    for (int x = 0; x < smoothed.width; x += kStep) {
      const double px = (x + 0.5) * shrink, py = (y + 0.5) * shrink;
      const Vec2 p = Vec2(px, py) - fold.course.origin;
      if (p.dot(fold.course.normal) - fold.course.bendAt(p.dot(fold.course.along)) > -fold.reach) continue;
      const double depth = -fold.at(px, py);
      ++dark;
      if (static_cast<double>(smoothed.row(y)[x]) + (1.0 - kAboveWhite) * depth > kWhite) ++lit;
    }
  }
  return lit <= kMostLit * dark;
}

/// The course on the picture that the plane was shrunk from.
FoldCourse enlarged(FoldCourse c, int shrink) {
  c.origin *= shrink;
  c.from *= shrink;
  c.to *= shrink;
  for (double& b : c.bend) b *= shrink;
  return c;
}

/// Two steps of opposite direction close together: a bar that was drawn.
bool isBar(const FoldCourse& a, const FoldCourse& b, double nearPx) {
  if (a.normal.dot(b.normal) > kOppositeCos) return false;
  const double first = (b.at(b.from, 0.0) - a.origin).dot(a.normal), last = (b.at(b.to, 0.0) - a.origin).dot(a.normal);
  return std::min(std::fabs(first), std::fabs(last)) < nearPx;
}

}  // namespace

std::vector<PaperFold> findFolds(const GreyImage& image, const Plane& smoothed, const InkEdges& edges, int shrink,
                                 const RunContext& context) {
  std::vector<PaperFold> found;
  for (const FoldCourse& line : findFoldLines(smoothed, edges, context)) {
    if (context.isCancelled()) return {};
    if (!mayStep(smoothed, line)) continue;
    const double side = std::sqrt(static_cast<double>(image.width) * image.height);
    const double scale = std::clamp(side / kUsualSidePx, kLeastScale, kMostScale);
    if (auto fold = FoldMaker(image, enlarged(line, shrink), scale).make(); fold && staysDark(*fold, smoothed, shrink))
      found.push_back(std::move(*fold));
  }
  const double nearPx = kBarShare * std::min(image.width, image.height);
  std::vector<PaperFold> folds;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool bar = std::any_of(found.begin(), found.end(),
                                 [&](const PaperFold& other) { return isBar(found[i].course, other.course, nearPx); });
    if (!bar) folds.push_back(found[i]);
  }
  return folds;
}

}  // namespace batten
