// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/find_folds.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/image/fold_lines.h"

namespace batten {
namespace {

constexpr int kWidest = 40;            // [px] half the softest edge that is looked at
constexpr int kBand = 8;               // [px] of paper on either side that says its level
constexpr double kLeastPart = 0.6;     // of the course must show the step
constexpr double kLeastAtEnds = 0.3;   // of the first and the last tenth
constexpr double kAlike = 0.35;        // relative: steps that belong to one fold
constexpr double kLooselyAlike = 0.8;  // the same on noisy pages: no step is never a step
constexpr double kLeastStep = 4.0;     // [grey]
constexpr double kDarkestShade = 0.4;  // of the paper beside it: what is darker is no shaded paper
constexpr double kBarShare = 0.2;      // of the page's smaller side: two opposite steps that are nearer make a bar
constexpr double kWindowPx = 96.0;     // along the course: a line that crosses takes up a small part of it
constexpr double kSpacingPx = 16.0;

/// Grey along normals of the course: rows of 2 * half + 1 values, one row every `stepPx`.
struct Strip {
  int half = 0, rows = 0;
  double stepPx = 2.0;
  std::vector<float> grey;
  const float* row(int i) const {
    return grey.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(2 * half + 1);
  }
  /// Mean over d in [from, to] of row i.
  double mean(int i, int from, int to) const {
    double sum = 0.0;
    for (int d = from; d <= to; ++d) sum += static_cast<double>(row(i)[d + half]);
    return sum / (to - from + 1);
  }
};

float sample(const GreyImage& image, const Vec2& p) {
  const double x = std::clamp(p.x() - 0.5, 0.0, image.width - 1.0),
               y = std::clamp(p.y() - 0.5, 0.0, image.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(0, image.width - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, image.height - 2));
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const double u = x - x0, v = y - y0;
  const double above = image.row(y0)[x0] + u * (image.row(y0)[x1] - image.row(y0)[x0]);
  const double below = image.row(y1)[x0] + u * (image.row(y1)[x1] - image.row(y1)[x0]);
  return static_cast<float>((above + v * (below - above)) / GreyImage::kGreyUnit);
}

/// Where a row of the strip leaves the page its values repeat the border: such rows are left out by isInside.
Strip stripAlong(const GreyImage& image, const FoldCourse& course, int half, double stepPx) {
  Strip strip;
  strip.half = half;
  strip.stepPx = stepPx;
  strip.rows = std::max(0, static_cast<int>((course.to - course.from) / stepPx));
  strip.grey.resize(static_cast<std::size_t>(strip.rows) * static_cast<std::size_t>(2 * half + 1));
  auto out = strip.grey.begin();
  for (int i = 0; i < strip.rows; ++i) {
    const double t = course.from + (i + 0.5) * stepPx;
    for (int d = -half; d <= half; ++d) *out++ = sample(image, course.at(t, d));
  }
  return strip;
}

template <class Value>
Value quantile(std::vector<Value>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// A step that changes linearly along the course, and which rows of the strip show it.
struct StepFit {
  double middle = 0.0, slope = 0.0;  // [grey], [grey per row]
  std::vector<std::uint8_t> shows;
  double at(int i, int rows) const { return middle + slope * (i - 0.5 * rows); }
};

/// Slope of the paper across the course [grey/px], the same on both sides of a step, per row of the strip: medians over
/// a twentieth of the course either way.
std::vector<double> slopesAcross(const Strip& strip) {
  const int outer = strip.half, inner = strip.half / 2, width = kBand;
  const double apart = outer - inner;
  std::vector<double> each, slopes;
  for (int i = 0; i < strip.rows; ++i) {
    const double bright = strip.mean(i, outer - width, outer) - strip.mean(i, inner - width, inner);
    const double dark = strip.mean(i, -inner, width - inner) - strip.mean(i, -outer, width - outer);
    each.push_back(0.5 * (bright + dark) / apart);
  }
  const int reach = std::max(5, strip.rows / 20);
  for (int i = 0; i < strip.rows; ++i) {
    std::vector<double> window(each.begin() + std::max(0, i - reach),
                               each.begin() + std::min(strip.rows, i + reach + 1));
    slopes.push_back(quantile(window, 0.5));
  }
  return slopes;
}

/// How far the brighter side of every row stands above the darker one, the paper's slope across taken out.
std::vector<double> stepsOf(const Strip& strip, int reach, const std::vector<double>& slopes) {
  std::vector<double> steps(static_cast<std::size_t>(strip.rows));
  const int outer = std::min(strip.half, reach + kBand);
  for (int i = 0; i < strip.rows; ++i) {
    const auto at = static_cast<std::size_t>((static_cast<std::int64_t>(i) * static_cast<std::int64_t>(slopes.size())) /
                                             strip.rows);
    steps[static_cast<std::size_t>(i)] =
        strip.mean(i, reach, outer) - strip.mean(i, -outer, -reach) - slopes[at] * (reach + outer);
  }
  return steps;
}

double noiseOf(const std::vector<double>& steps) {
  std::vector<double> jumps;
  for (std::size_t i = 1; i < steps.size(); ++i) jumps.push_back(std::fabs(steps[i] - steps[i - 1]));
  return jumps.empty() ? 0.0 : 1.05 * quantile(jumps, 0.5);
}

/// The line through the steps that most of them are near, from the medians of ten parts taken in pairs.
std::optional<StepFit> fitStep(const std::vector<double>& steps) {
  constexpr int kParts = 10;
  const int rows = static_cast<int>(steps.size());
  if (rows < 5 * kParts) return std::nullopt;
  const double noise = noiseOf(steps);
  std::vector<double> medians;
  for (int part = 0; part < kParts; ++part) {
    std::vector<double> piece(steps.begin() + part * rows / kParts, steps.begin() + (part + 1) * rows / kParts);
    medians.push_back(quantile(piece, 0.5));
  }
  const auto isNear = [&](const StepFit& fit, int i) {
    const double level = fit.at(i, rows);
    return level > 0.0 && std::fabs(steps[static_cast<std::size_t>(i)] - level) <
                              std::clamp(3.0 * noise, kAlike * level, kLooselyAlike * level);
  };
  StepFit best;
  int most = 0;
  for (int a = 0; a < kParts; ++a) {
    for (int b = a + 3; b < kParts; ++b) {
      StepFit fit;
      const double width = static_cast<double>(rows) / kParts;
      fit.slope = (medians[static_cast<std::size_t>(b)] - medians[static_cast<std::size_t>(a)]) / ((b - a) * width);
      fit.middle = medians[static_cast<std::size_t>(a)] + fit.slope * (0.5 * rows - (a + 0.5) * width);
      if (std::min(fit.at(0, rows), fit.at(rows, rows)) < 0.3 * fit.middle) continue;
      int count = 0;
      for (int i = 0; i < rows; ++i) count += isNear(fit, i) ? 1 : 0;
      if (count > most) {
        most = count;
        best = fit;
      }
    }
  }
  if (most < kLeastPart * rows || best.middle < std::max(kLeastStep, noise)) return std::nullopt;
  int ends[2] = {0, 0};
  for (int i = 0; i < rows; ++i) {
    best.shows.push_back(isNear(best, i) ? 1 : 0);
    if (i < rows / kParts) ends[0] += best.shows.back();
    if (i >= rows - rows / kParts) ends[1] += best.shows.back();
  }
  if (std::min(ends[0], ends[1]) < kLeastAtEnds * (rows / kParts)) return std::nullopt;
  return best;
}

/// Median over rows [begin, end) that show the step of the grey at d less the brighter paper, in `out` (2 reach + 1).
bool medianProfile(const Strip& strip, const StepFit& fit, int begin, int end, int reach, std::vector<float>& out) {
  std::vector<int> rows;
  for (int i = std::max(0, begin); i < std::min(end, strip.rows); ++i)
    if (fit.shows[static_cast<std::size_t>(i)] != 0) rows.push_back(i);
  if (static_cast<int>(rows.size()) * 3 < end - begin || rows.empty()) return false;
  const int outer = std::min(strip.half, reach + kBand);
  std::vector<float> bright, column;
  for (const int i : rows) bright.push_back(static_cast<float>(strip.mean(i, reach, outer)));
  out.clear();
  for (int d = -reach; d <= reach; ++d) {
    column.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) column.push_back(strip.row(rows[k])[d + strip.half] - bright[k]);
    out.push_back(quantile(column, 0.5));
  }
  return true;
}

/// From the middle of the step to where less than a fiftieth of it is left on either side, a crease included.
std::optional<int> reachOf(const Strip& strip, const StepFit& fit) {
  std::vector<float> profile;
  const int reach = strip.half - kBand;
  if (!medianProfile(strip, fit, 0, strip.rows, reach, profile)) return std::nullopt;
  // The paper's own slope across: equal on both sides of the step.
  const auto at = [&](int d) { return static_cast<double>(profile[static_cast<std::size_t>(d + reach)]); };
  const double slope = 0.5 * ((at(reach) - at(reach / 2)) + (at(-reach / 2) - at(-reach))) / (reach - reach / 2);
  const double dark = at(-reach) + slope * reach, bright = at(reach) - slope * reach, step = bright - dark;
  if (step <= 0.0) return std::nullopt;
  // What is left of the step beyond the noise of the medians, a little smoothed.
  const auto left = [&](int d) {
    double sum = 0.0;
    for (int k = -1; k <= 1; ++k) sum += std::fabs(at(d + k) - slope * (d + k) - (d > 0 ? bright : dark)) / 3.0;
    return sum;
  };
  std::vector<double> outside;
  for (int d = reach / 2; d < reach; ++d) {
    outside.push_back(left(d));
    outside.push_back(left(-d));
  }
  const double tolerance = std::max({0.03 * step, 0.5, 6.0 * quantile(outside, 0.5)});
  int last = 3;
  for (int d = 2; d < reach; ++d) {
    if (left(d) > tolerance || left(-d) > tolerance) last = std::max(last, d);
  }
  if (4 * last > 3 * reach) return std::nullopt;  // no step, but a slope
  return last + 3;
}

float sample(const Plane& u, const Vec2& p) {
  const int x = std::clamp(static_cast<int>(p.x()), 0, u.width - 1);
  const int y = std::clamp(static_cast<int>(p.y()), 0, u.height - 1);
  return u.row(y)[x];
}

/// Whether the smoothed page has other levels on the two sides at most places along the course: tells the many straight
/// lines of a drawing from the few steps before these are looked at closely.
bool mayStep(const Plane& u, const FoldCourse& c) {
  constexpr int kPlaces = 160;
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
  const float middle = quantile(sorted, 0.5);
  const auto shown = std::count_if(steps.begin(), steps.end(), [&](float step) { return step > 0.3f * middle; });
  return static_cast<double>(middle) > 0.5 * kLeastStep && 2 * shown > kPlaces;
}

class FoldMaker {
 public:
  FoldMaker(const GreyImage& image, const FoldCourse& course, double scale)
      : image_(image), course_(course), scale_(scale) {}

  std::optional<PaperFold> make() {
    const int widest = static_cast<int>(kWidest * scale_);
    const Strip coarse = stripAlong(image_, course_, widest, std::max(4.0, (course_.to - course_.from) / 400.0));
    const std::vector<double> slopes = slopesAcross(coarse);
    const auto rough = fitStep(stepsOf(coarse, widest - kBand, slopes));
    if (!rough) return std::nullopt;
    const auto reach = reachOf(coarse, *rough);
    if (!reach) return std::nullopt;
    strip_ = stripAlong(image_, course_, *reach + kBand, 2.0);
    const auto fine = fitStep(stepsOf(strip_, *reach, slopes));
    if (!fine || !isShade(*fine, *reach)) return std::nullopt;
    return profiled(*fine, *reach);
  }

 private:
  bool isShade(const StepFit& fit, int reach) const {
    std::vector<double> ratios;
    for (int i = 0; i < strip_.rows; ++i) {
      if (fit.shows[static_cast<std::size_t>(i)] == 0) continue;
      const double bright = strip_.mean(i, reach, reach + kBand);
      ratios.push_back((bright - fit.at(i, strip_.rows)) / std::max(1.0, bright));
    }
    return !ratios.empty() && quantile(ratios, 0.5) > kDarkestShade;
  }

  PaperFold profiled(const StepFit& fit, int reach) const {
    PaperFold fold;
    fold.course = course_;
    fold.reach = reach;
    fold.spacing = kSpacingPx;
    fold.stations = std::max(2, static_cast<int>((course_.to - course_.from) / kSpacingPx) + 1);
    const std::vector<std::vector<BandPixel>> pixels = bandPixels(fold, fit);
    std::vector<std::vector<float>> profiles;
    for (int k = 0; k < fold.stations; ++k) profiles.push_back(edgeProfile(pixels, k, fold));
    const auto taps = static_cast<std::size_t>(fold.taps());
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
      appendProfile(profiles[static_cast<std::size_t>(k)], fold.depth.back(), fold.profile);
    }
    return fold;
  }

  struct BandPixel {
    float d, value;
  };

  /// The pixels near the course that show the step, each less the brighter paper beside it, by their nearest station.
  /// Pixels themselves, not samples between them: a sharp fold would be drawn out by interpolation.
  std::vector<std::vector<BandPixel>> bandPixels(const PaperFold& fold, const StepFit& fit) const {
    std::vector<float> bright;
    for (int i = 0; i < strip_.rows; ++i)
      bright.push_back(static_cast<float>(strip_.mean(i, fold.reach, fold.reach + kBand)));
    std::vector<std::vector<BandPixel>> pixels(static_cast<std::size_t>(fold.stations));
    for (int y = 0; y < image_.height; ++y) {
      const auto [x0, x1] = fold.bandOfRow(y, image_.width);
      for (int x = x0; x < x1; ++x) {
        const Vec2 p = Vec2(x + 0.5, y + 0.5) - course_.origin;
        const double t = p.dot(course_.along), d = p.dot(course_.normal) - course_.bendAt(t);
        const auto row = static_cast<int>((t - course_.from) / strip_.stepPx);
        if (t < course_.from || row >= strip_.rows || std::fabs(d) > fold.reach + 0.5) continue;
        if (fit.shows[static_cast<std::size_t>(row)] == 0) continue;
        const auto station = static_cast<std::size_t>(
            std::min<double>(fold.stations - 1, std::lround((t - course_.from) / fold.spacing)));
        pixels[station].push_back(
            {static_cast<float>(d), static_cast<float>(image_.level(x, y)) - bright[static_cast<std::size_t>(row)]});
      }
    }
    return pixels;
  }

  /// Medians over the pixels of a window along the course, by their distance from it. Empty with too few.
  static std::vector<float> edgeProfile(const std::vector<std::vector<BandPixel>>& pixels, int station,
                                        const PaperFold& fold) {
    constexpr std::size_t kFewest = 6;
    const int taps = fold.taps(), around = static_cast<int>(0.5 * kWindowPx / fold.spacing);
    std::vector<std::vector<float>> values(static_cast<std::size_t>(taps));
    std::vector<double> places(static_cast<std::size_t>(taps), 0.0);
    for (int k = std::max(0, station - around); k <= std::min(fold.stations - 1, station + around); ++k) {
      for (const BandPixel& pixel : pixels[static_cast<std::size_t>(k)]) {
        const double v = (static_cast<double>(pixel.d) + fold.reach) * PaperFold::kTapsPerPx;
        const auto bin = static_cast<std::size_t>(std::clamp<long>(std::lround(v), 0, taps - 1));
        values[bin].push_back(pixel.value);
        places[bin] += v;
      }
    }
    std::vector<std::pair<double, float>> knots;
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
      if (values[bin].size() < kFewest) continue;
      knots.emplace_back(places[bin] / static_cast<double>(values[bin].size()), quantile(values[bin], 0.5));
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
    constexpr int kHalf = 6;
    float sum = 0.0f, weight = 0.0f;
    for (int i = -kHalf; i <= kHalf; ++i) {
      const int at = k + i;
      if (at < 0 || at >= static_cast<int>(raw.size())) continue;
      const auto w = static_cast<float>(kHalf + 1 - std::abs(i));
      sum += w * raw[static_cast<std::size_t>(at)];
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
  Strip strip_;
};

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
  if (a.normal.dot(b.normal) > -0.9) return false;
  const double first = (b.at(b.from, 0.0) - a.origin).dot(a.normal), last = (b.at(b.to, 0.0) - a.origin).dot(a.normal);
  return std::min(std::fabs(first), std::fabs(last)) < nearPx;
}

}  // namespace

std::vector<PaperFold> findFolds(const GreyImage& image, const Plane& smoothed, const PageEdges& edges, int shrink,
                                 const RunContext& context) {
  std::vector<PaperFold> found;
  for (const FoldCourse& line : findFoldLines(smoothed, edges, context)) {
    if (context.isCancelled()) return {};
    if (!mayStep(smoothed, line)) continue;
    const double scale = std::clamp(std::sqrt(static_cast<double>(image.width) * image.height) / 1000.0, 0.5, 3.0);
    if (auto fold = FoldMaker(image, enlarged(line, shrink), scale).make()) found.push_back(std::move(*fold));
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
