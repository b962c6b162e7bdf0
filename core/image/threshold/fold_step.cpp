// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/fold_step.h"

#include <cmath>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kLeastPart = 0.6;      // of the course must show the step
constexpr double kLeastAtEnds = 0.3;    // of the first and the last tenth
constexpr double kAlike = 0.35;         // relative: steps that belong to one fold
constexpr double kLooselyAlike = 0.8;   // the same on noisy pages: no step is never a step
constexpr double kUneven = 6.0;         // median unevennesses of the paper: what stands out of it
constexpr double kLeastAtEdge = 0.3;    // of the step in the middle: a fold may fade out, but not away
constexpr double kStepLeft = 0.03;      // of the step: as good as none
constexpr double kLeastLeft = 0.5;      // [grey] what medians do not tell from none
constexpr double kFarthestStep = 0.75;  // of the reach: beyond it too little of the strip is left to be its paper
constexpr int kRowsPerShown = 3;        // a third of the rows show the step, or their medians are not those of the fold
constexpr int kFewestSlopeRows = 5;     // either way, in a median of the slope: single rows are noisy, or hold lines
constexpr int kSlopeReaches = 20;       // of the course: shading changes slowly along it
/// Standard deviation over the median size of the difference of two normal variables: 1 / (sqrt(2) quantile(3/4)).
constexpr double kSigmaPerJump = 1.05;

float foldGreyAt(const GreyImage& image, const Vec2& p) {
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

double noiseOf(const std::vector<double>& steps) {
  std::vector<double> jumps;
  for (std::size_t i = 1; i < steps.size(); ++i) jumps.push_back(std::fabs(steps[i] - steps[i - 1]));
  return jumps.empty() ? 0.0 : kSigmaPerJump * lowerQuantile(jumps, 0.5);
}

/// The grey at each d from -reach to reach less the brighter paper: its median over the rows that show the step.
/// Absent: too few do.
std::optional<std::vector<float>> medianProfile(const FoldStrip& strip, const FoldStepFit& fit, int reach) {
  std::vector<int> rows;
  for (int i = 0; i < strip.rows; ++i)
    if (fit.shows[i] != 0) rows.push_back(i);
  if (static_cast<int>(rows.size()) * kRowsPerShown < strip.rows || rows.empty()) return std::nullopt;
  const int outer = std::min(strip.half, reach + kFoldPaperPx);
  std::vector<float> bright, column, profile;
  for (const int i : rows) bright.push_back(static_cast<float>(strip.mean(i, reach, outer)));
  for (int d = -reach; d <= reach; ++d) {
    column.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) column.push_back(strip.row(rows[k])[d + strip.half] - bright[k]);
    profile.push_back(lowerQuantile(column, 0.5));
  }
  return profile;
}

}  // namespace

FoldStrip foldStripAlong(const GreyImage& image, const FoldCourse& course, int half, double stepPx) {
  FoldStrip strip;
  strip.half = half;
  strip.stepPx = stepPx;
  strip.rows = std::max(0, static_cast<int>((course.to - course.from) / stepPx));
  strip.grey.resize(std::ptrdiff_t{strip.rows} * (2 * half + 1));
  auto out = strip.grey.begin();
  for (int i = 0; i < strip.rows; ++i) {
    const double t = course.from + (i + 0.5) * stepPx;
    for (int d = -half; d <= half; ++d) *out++ = foldGreyAt(image, course.at(t, d));
  }
  return strip;
}

// Medians over the rows around each.
std::vector<double> foldSlopesAcross(const FoldStrip& strip) {
  const int outer = strip.half, inner = strip.half / 2, width = kFoldPaperPx;
  const double apart = outer - inner;
  std::vector<double> each, slopes;
  for (int i = 0; i < strip.rows; ++i) {
    const double bright = strip.mean(i, outer - width, outer) - strip.mean(i, inner - width, inner);
    const double dark = strip.mean(i, -inner, width - inner) - strip.mean(i, -outer, width - outer);
    each.push_back(0.5 * (bright + dark) / apart);
  }
  const int reach = std::max(kFewestSlopeRows, strip.rows / kSlopeReaches);
  for (int i = 0; i < strip.rows; ++i) {
    std::vector<double> window(each.begin() + std::max(0, i - reach),
                               each.begin() + std::min(strip.rows, i + reach + 1));
    slopes.push_back(lowerQuantile(window, 0.5));
  }
  return slopes;
}

std::vector<double> foldStepsOf(const FoldStrip& strip, int reach, const std::vector<double>& slopes) {
  std::vector<double> steps(strip.rows);
  const int outer = std::min(strip.half, reach + kFoldPaperPx);
  for (int i = 0; i < strip.rows; ++i) {
    const std::int64_t at = i * std::ssize(slopes) / strip.rows;
    steps[i] = strip.mean(i, reach, outer) - strip.mean(i, -outer, -reach) - slopes[at] * (reach + outer);
  }
  return steps;
}

// From the medians of ten parts taken in pairs.
std::optional<FoldStepFit> fitFoldStep(const std::vector<double>& steps) {
  constexpr int kParts = 10;  // of the course, each with a median of its own
  const int rows = static_cast<int>(steps.size());
  if (rows < 5 * kParts) return std::nullopt;
  const double noise = noiseOf(steps);
  std::vector<double> medians;
  for (int part = 0; part < kParts; ++part) {
    std::vector<double> piece(steps.begin() + part * rows / kParts, steps.begin() + (part + 1) * rows / kParts);
    medians.push_back(lowerQuantile(piece, 0.5));
  }
  const auto isNear = [&](const FoldStepFit& fit, int i) {
    const double level = fit.at(i, rows);
    return level > 0.0 && std::fabs(steps[i] - level) < std::clamp(3.0 * noise, kAlike * level, kLooselyAlike * level);
  };
  FoldStepFit best;
  int most = 0;
  for (int a = 0; a < kParts; ++a) {
    for (int b = a + 3; b < kParts; ++b) {
      FoldStepFit fit;
      const double width = static_cast<double>(rows) / kParts;
      fit.slope = (medians[b] - medians[a]) / ((b - a) * width);
      fit.middle = medians[a] + fit.slope * (0.5 * rows - (a + 0.5) * width);
      if (std::min(fit.at(0, rows), fit.at(rows, rows)) < kLeastAtEdge * fit.middle) continue;
      int count = 0;
      for (int i = 0; i < rows; ++i) count += isNear(fit, i) ? 1 : 0;
      if (count > most) {
        most = count;
        best = fit;
      }
    }
  }
  if (most < kLeastPart * rows || best.middle < std::max(kLeastFoldStep, noise)) return std::nullopt;
  const int part = rows / kParts;
  int ends[2] = {0, 0};
  for (int i = 0; i < rows; ++i) {
    best.shows.push_back(isNear(best, i) ? 1 : 0);
    if (i < part) ends[0] += best.shows.back();
    if (i >= rows - part) ends[1] += best.shows.back();
  }
  if (std::min(ends[0], ends[1]) < kLeastAtEnds * part) return std::nullopt;
  return best;
}

// To where as good as nothing of the step is left, a crease included.
std::optional<int> foldReachOf(const FoldStrip& strip, const FoldStepFit& fit) {
  const int reach = strip.half - kFoldPaperPx;
  const std::optional<std::vector<float>> profile = medianProfile(strip, fit, reach);
  if (!profile) return std::nullopt;
  // The paper's own slope across: equal on both sides of the step.
  const auto at = [&](int d) { return static_cast<double>((*profile)[d + reach]); };
  const int half = reach / 2;
  const double slope = 0.5 * ((at(reach) - at(half)) + (at(-half) - at(-reach))) / (reach - half);
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
  const double uneven = kUneven * lowerQuantile(outside, 0.5);
  if (uneven > step) return std::nullopt;  // hatching along the course: as much of a step everywhere
  const double tolerance = std::max({kStepLeft * step, kLeastLeft, uneven});
  constexpr int kNearestPx = 3, kBeyondPx = 3;  // the blur of a scan on either side; room beyond the last rest
  int last = kNearestPx;
  for (int d = 2; d < reach; ++d) {
    if (left(d) > tolerance || left(-d) > tolerance) last = std::max(last, d);
  }
  if (last > kFarthestStep * reach) return std::nullopt;  // no step, but a slope
  return last + kBeyondPx;
}

}  // namespace batten
