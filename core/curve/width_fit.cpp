// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/width_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/statistics.h"

namespace batten {
namespace {

/// [px] Widths are averaged over so much of the curve: about what the measurement averages itself.
constexpr double kBinPx = 4.0;
/// Neighbouring averages share what was averaged by the measurement (Gaussian of 2 px: 0.45 of their noise), so that
/// means of many of them vary by 1 + 2 * 0.45 as much as those of independent ones.
constexpr double kSharedNoise = 1.9;
constexpr int kNoiseLag = 2;             ///< [bins] 8 px apart noise is independent.
constexpr double kLeastNoisePx = 0.03;   ///< Of 8-bit grey at usual contrasts: nothing smaller is measured.
constexpr double kUnknownNoisePx = 0.1;  ///< Where there are too few widths to tell.
constexpr double kBlobShare = 0.25;      ///< Of the width: what stands out by more, and is short, is another line's.
constexpr int kBlobReach = 3;            ///< [bins] to either side; a blob is shorter than that.
constexpr std::ptrdiff_t kWindow = 10;   ///< [knots] Farther a knot changes others by less than 0.27^10.
constexpr std::ptrdiff_t kSeen = kWindow + 1;  ///< [knots] The equations of the last one in the window know the next.
constexpr double kGapBins = 2.0;    ///< Widths that end farther from an end say nothing of it: held from there.
constexpr double kNothingPx = 0.5;  ///< An end thinner than this is a tip: thinner lines leave no ink to see.

/// The widths of a short stretch, averaged.
struct WidthBin {
  double s = 0.0, width = 0.0;
};

std::vector<WidthBin> binsOf(std::vector<WidthSample> measured, double from, double to, double step) {
  std::sort(measured.begin(), measured.end(), [](const WidthSample& a, const WidthSample& b) { return a.s < b.s; });
  const double count = std::max(1.0, std::round((to - from) / step));
  std::vector<WidthBin> bins;
  std::vector<double> widths;
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const auto binOf = [&](double s) { return std::floor(std::min((s - from) / (to - from) * count, count - 0.5)); };
    widths.push_back(measured[i].width);
    sum += measured[i].s;
    if (i + 1 < measured.size() && binOf(measured[i + 1].s) == binOf(measured[i].s)) continue;
    double mean = 0.0;
    for (const double width : widths) mean += width / static_cast<double>(widths.size());
    bins.push_back({sum / static_cast<double>(widths.size()), mean});
    widths.clear();
    sum = 0.0;
  }
  return bins;
}

/// Without the bins that stand out: blobs, and where another line crosses.
std::vector<WidthBin> withoutBlobs(const std::vector<WidthBin>& bins) {
  std::vector<WidthBin> kept;
  const auto n = std::ssize(bins);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const std::ptrdiff_t reach = std::min<std::ptrdiff_t>({kBlobReach, i, n - 1 - i});
    std::vector<double> around;
    for (std::ptrdiff_t k = i - reach; k <= i + reach; ++k) around.push_back(bins[k].width);
    const double usual = upperMedian(around);
    if (bins[i].width - usual <= kBlobShare * usual) kept.push_back(bins[i]);
  }
  return kept;
}

/// Standard deviation of a bin, by fourth differences: they see nothing of a width that changes slowly.
double noiseOf(const std::vector<WidthBin>& bins, double pixel) {
  constexpr std::array kFourth = {1.0, -4.0, 6.0, -4.0, 1.0};  // a fourth difference
  constexpr double kFourthVariance = 70.0;                     // sum of their squares
  std::vector<double> differences;
  for (std::ptrdiff_t i = 0; i + std::ptrdiff_t{4} * kNoiseLag < std::ssize(bins); ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t k = 0; k < std::ssize(kFourth); ++k) sum += kFourth[k] * bins[i + k * kNoiseLag].width;
    differences.push_back(sum / std::sqrt(kFourthVariance));
  }
  constexpr std::size_t kFewest = 5;  // differences: fewer say nothing of the noise
  if (differences.size() < kFewest) return kUnknownNoisePx * pixel;
  return std::max(kLeastNoisePx * pixel, robustSigma(differences));
}

struct WidthKnot {
  double s = 0.0, width = 0.0;
  bool isFixed = false;                              ///< Stays whatever it costs.
  double diagonal = 0.0, beside = 0.0, right = 0.0;  ///< Of the normal equations; `beside`: with the next knot.
  std::optional<double> spread = std::nullopt;       ///< Of its bend; absent where knots near it have gone since.
};

/// Knots and the widths there that are nearest to the bins.
class KnotFit {
 public:
  KnotFit(const std::vector<WidthBin>& bins, std::vector<WidthKnot> knots) : bins_(bins), knots_(std::move(knots)) {
    solve();
  }
  const std::vector<WidthKnot>& knots() const { return knots_; }

  /// Removes, as long as there are any, knots that cost less than `most` in squared misfit.
  void removeUpTo(double most, CancelCheck check) {
    while (knots_.size() > 2 && !check.isCancelled()) {
      std::vector<std::optional<double>> costs(knots_.size());
      for (std::ptrdiff_t k = 1; k + 1 < std::ssize(knots_) && !check.isCancelled(); ++k)
        if (!knots_[k].isFixed) costs[k] = removalCost(k);
      if (!removeCheapest(costs, most)) return;
      solve();
    }
  }

 private:
  /// Cheaper than its neighbours: these are judged again when it is gone.
  static bool isCheapest(const std::vector<std::optional<double>>& costs, std::ptrdiff_t k, double most) {
    if (!costs[k] || !(*costs[k] <= most)) return false;
    const auto isBelow = [&](std::ptrdiff_t other, bool orEqual) {
      if (other < 0 || other >= std::ssize(costs) || !costs[other]) return true;
      return *costs[k] < *costs[other] || (orEqual && *costs[k] == *costs[other]);
    };
    return isBelow(k - 1, false) && isBelow(k + 1, true);
  }

  /// Whether there were any. The spread of those that see a knot which goes is to be found anew.
  bool removeCheapest(const std::vector<std::optional<double>>& costs, double most) {
    std::vector<WidthKnot> kept;
    std::ptrdiff_t sinceGone = kSeen + 1;
    for (std::ptrdiff_t k = 0; k < std::ssize(knots_); ++k) {
      if (!isCheapest(costs, k, most)) {
        kept.push_back(knots_[k]);
        if (++sinceGone <= kSeen) kept.back().spread.reset();
        continue;
      }
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, std::ssize(kept) - kSeen); i < std::ssize(kept); ++i)
        kept[i].spread.reset();
      sinceGone = 0;
    }
    const bool hasGone = kept.size() < knots_.size();
    knots_ = std::move(kept);
    return hasGone;
  }

  void solve() {
    for (WidthKnot& knot : knots_) knot.diagonal = knot.beside = knot.right = 0.0;
    std::ptrdiff_t k = 0;
    for (const WidthBin& bin : bins_) {
      while (k + 2 < std::ssize(knots_) && knots_[k + 1].s <= bin.s) ++k;
      WidthKnot &a = knots_[k], &b = knots_[k + 1];
      const double t = (bin.s - a.s) / (b.s - a.s), r = 1.0 - t;
      a.diagonal += r * r;
      a.beside += r * t;
      b.diagonal += t * t;
      a.right += r * bin.width;
      b.right += t * bin.width;
    }
    std::vector<double> right;
    for (const WidthKnot& knot : knots_) right.push_back(knot.right);
    const std::vector<double> widths = solved(0, std::ssize(knots_), std::move(right));
    for (std::size_t i = 0; i < knots_.size(); ++i) knots_[i].width = widths[i];
  }

  /// The normal equations of the knots [first, end), by elimination.
  std::vector<double> solved(std::ptrdiff_t first, std::ptrdiff_t end, std::vector<double> right) const {
    constexpr double kLeastPivot = 1e-9;  // a knot between two without a bin of its own stays solvable
    std::vector<double> pivot;
    for (std::ptrdiff_t i = 0; i < end - first; ++i) {
      double own = knots_[first + i].diagonal + kLeastPivot;
      if (i > 0) {
        const double factor = knots_[first + i - 1].beside / pivot.back();
        own -= factor * knots_[first + i - 1].beside;
        right[i] -= factor * right[i - 1];
      }
      pivot.push_back(std::max(own, kLeastPivot));
    }
    for (std::ptrdiff_t i = end - first - 1; i >= 0; --i) {
      if (i + 1 < end - first) right[i] -= knots_[first + i].beside * right[i + 1];
      right[i] /= pivot[i];
    }
    return right;
  }

  /// Rise of the squared misfit when knot k lies on the line between its neighbours and all others find their best
  /// place again: (c w)^2 / (c A^-1 c) of least squares with the constraint c w = 0.
  double removalCost(std::ptrdiff_t k) {
    const std::array<double, 3> c = bendAt(k);
    double off = 0.0;
    for (std::ptrdiff_t i = 0; i < std::ssize(c); ++i) off += c[i] * knots_[k - 1 + i].width;
    if (!knots_[k].spread) knots_[k].spread = spreadAt(k);
    return *knots_[k].spread > 0.0 ? off * off / *knots_[k].spread : 0.0;
  }

  /// How far a knot lies off the line between its neighbours, as weights of the three widths.
  std::array<double, 3> bendAt(std::ptrdiff_t k) const {
    const WidthKnot &a = knots_[k - 1], &b = knots_[k + 1];
    const double t = (knots_[k].s - a.s) / (b.s - a.s);
    return {t - 1.0, 1.0, -t};
  }

  double spreadAt(std::ptrdiff_t k) const {
    const std::array<double, 3> c = bendAt(k);
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, k - kWindow),
                         end = std::min(std::ssize(knots_), k + kWindow + 1);
    std::vector<double> right(end - first, 0.0);
    for (std::ptrdiff_t i = 0; i < std::ssize(c); ++i) right[k - 1 + i - first] = c[i];
    const std::vector<double> x = solved(first, end, right);
    double spread = 0.0;
    for (std::ptrdiff_t i = 0; i < std::ssize(c); ++i) spread += c[i] * x[k - 1 + i - first];
    return spread;
  }

  const std::vector<WidthBin>& bins_;
  std::vector<WidthKnot> knots_;
};

/// A knot at either end and at every bin that does not stand beside one.
std::vector<WidthKnot> firstKnots(const std::vector<WidthBin>& bins, double from, double to, bool closed,
                                  double length) {
  std::vector<WidthKnot> knots{{from, 0.0, true}};
  for (std::size_t i = 2; i + 2 < bins.size(); ++i) {
    const double before = knots.back().s;
    // The seam of a loop is a sample whatever it costs.
    for (const double seam : {0.0, length})
      if (closed && before < seam && bins[i].s >= seam && seam > from && seam < to) knots.push_back({seam, 0.0, true});
    if (bins[i].s > knots.back().s) knots.push_back({bins[i].s, 0.0, false});
  }
  if (to > knots.back().s) knots.push_back({to, 0.0, true});
  return knots;
}

double rmsFrom(const WidthProfile& profile, const std::vector<WidthBin>& bins) {
  double sum = 0.0;
  for (const WidthBin& bin : bins) sum += std::pow(profile.at(bin.s) - bin.width, 2.0);
  return std::sqrt(sum / static_cast<double>(bins.size()));
}

/// A loop goes on at either side: so many measurements again as bear on its seam.
std::vector<WidthSample> continued(std::span<const WidthSample> measured, double length, double reach) {
  std::vector<WidthSample> all(measured.begin(), measured.end());
  for (const WidthSample& sample : measured) {
    if (sample.s < reach) all.push_back({sample.s + length, sample.width});
    if (sample.s > length - reach) all.push_back({sample.s - length, sample.width});
  }
  return all;
}

/// What the knots say of the curve itself, and of its ends.
WidthProfile profileOf(const std::vector<WidthKnot>& knots, double length, bool closed, double pixel) {
  WidthProfile all;
  for (const WidthKnot& knot : knots) all.samples.push_back({knot.s, std::max(0.0, knot.width)});
  WidthProfile own{{{0.0, all.at(0.0)}}, 0.0};
  const double near = 0.5 * kBinPx * pixel;
  for (const WidthSample& sample : all.samples)
    if (sample.s > near && sample.s < length - near) own.samples.push_back(sample);
  own.samples.push_back({length, all.at(length)});
  WidthSample &front = own.samples.front(), &back = own.samples.back();
  if (closed) front.width = back.width = 0.5 * (front.width + back.width);
  for (WidthSample* end : {&front, &back})
    if (!closed && end->width < kNothingPx * pixel) end->width = 0.0;
  return own;
}

}  // namespace

WidthProfile fittedWidths(std::span<const WidthSample> measured, double length, bool closed, double pixel,
                          CancelCheck check) {
  const double step = kBinPx * pixel, reach = closed ? std::min(length, kWindow * step) : 0.0;
  const std::vector<WidthSample> all = continued(measured, length, reach);
  const std::vector<WidthBin> found = binsOf(all, -reach, length + reach, step);
  const std::vector<WidthBin> bins = withoutBlobs(found);
  constexpr std::size_t kFewest = 5;  // for a straight line at either end and something between
  if (bins.size() < kFewest) {
    std::vector<double> widths;
    for (const WidthSample& sample : measured) widths.push_back(sample.width);
    const double usual = upperMedian(widths);
    WidthProfile even{{{0.0, usual}, {length, usual}}, 0.0};
    even.tolerance = rmsFrom(even, found);
    return even;
  }
  const double from = bins.front().s < kGapBins * step ? -reach : bins.front().s;
  const double to = length - bins.back().s < kGapBins * step ? length + reach : bins.back().s;
  KnotFit fit(bins, firstKnots(bins, from, to, closed, length));
  const double noise = noiseOf(bins, pixel);
  // Bayesian information: a knot brings a place and a width.
  const double price = 2.0 * std::log(static_cast<double>(bins.size()));
  fit.removeUpTo(price * kSharedNoise * noise * noise, check);
  WidthProfile profile = profileOf(fit.knots(), length, closed, pixel);
  std::vector<WidthBin> own;
  for (const WidthBin& bin : bins)
    if (bin.s >= 0.0 && bin.s <= length) own.push_back(bin);
  if (!own.empty()) profile.tolerance = rmsFrom(profile, own);
  return profile;
}

}  // namespace batten
