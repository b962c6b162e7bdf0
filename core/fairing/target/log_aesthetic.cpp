// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/log_aesthetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/interpolation.h"
#include "core/curve/curvature.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/profile_data.h"
#include "core/fairing/profile/split_profile.h"
#include "core/solve/golden_section.h"
#include "core/solve/levenberg_marquardt.h"

namespace batten {
namespace {

constexpr double kClothoid = -1.0;       // alpha of the curve whose curvature changes evenly
constexpr double kNielsen = 1e-9;        // a smaller alpha is 0
constexpr double kStraightShare = 1e-3;  // of the largest curvature: less is straight
constexpr double kAlphaStep = 0.5;       // of a first look at the range of alpha
constexpr int kAlphaSteps = 20;          // of golden section: alpha to 1e-4
// what differs from the usual steps
constexpr LevenbergOptions kEndFit{.iterations = 40,
                                   .failure = 5.0,
                                   .mostDamping = 1e8,
                                   .smallDecrease = 1e-12,
                                   .smallSteps = 1,
                                   .smallStepsDamped = 1};
// of the logarithm of a curvature, beyond which the fit ends, and of one step of it
constexpr double kMostLog = 24.0, kMostLogStep = 1.0;
constexpr int kNodesPerStretch = 32;  // of the profile

/// A log-aesthetic curvature made ready for many places: the power alpha of the radius is linear in x.
class LogAestheticCourse {
 public:
  explicit LogAestheticCourse(const LogAesthetic& one)
      : one_(one), isNielsen_(std::abs(one.alpha) < kNielsen), isClothoid_(one.alpha == kClothoid) {
    if (isClothoid_) return;
    const double ratio = one.startKappa / one.endKappa;  // of the radii, end over start
    rise_ = isNielsen_ ? std::log(ratio) : std::pow(ratio, one.alpha) - 1.0;
    power_ = -1.0 / one.alpha;
  }

  double kappa(double x) const {
    if (isClothoid_) return one_.startKappa + (one_.endKappa - one_.startKappa) * x;
    return one_.startKappa * (isNielsen_ ? std::exp(-rise_ * x) : std::pow(1.0 + rise_ * x, power_));
  }
  double slope(double x) const {
    if (isClothoid_) return one_.endKappa - one_.startKappa;
    return (isNielsen_ ? -rise_ : rise_ * power_ / (1.0 + rise_ * x)) * kappa(x);
  }
  /// Derivatives of kappa at x, which is known, by the logarithms of kappa at the start and at the end.
  std::array<double, 2> byEnds(double x, double kappa) const {
    if (isClothoid_) return {one_.startKappa * (1.0 - x), one_.endKappa * x};
    if (isNielsen_) return {kappa * (1.0 - x), kappa * x};
    const double share = kappa / (1.0 + rise_ * x);
    return {share * (1.0 - x), share * (1.0 + rise_) * x};
  }

 private:
  LogAesthetic one_;
  bool isNielsen_, isClothoid_;
  double rise_ = 0.0, power_ = 0.0;
};

/// Squares of the misfit of one stretch.
double misfitOf(const LogAesthetic& one, std::span<const double> x, std::span<const double> kappa) {
  const LogAestheticCourse course(one);
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = course.kappa(x[i]) - kappa[i];
    sum += off * off;
  }
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::max();
}

/// Straight line through the samples, through what is held.
LogAesthetic linearFit(std::span<const double> x, std::span<const double> kappa, std::optional<double> start,
                       std::optional<double> end) {
  // kappa = a (1 - x) + b x
  double aa = 0.0, ab = 0.0, bb = 0.0, ak = 0.0, bk = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = 1.0 - x[i], v = x[i];
    aa += u * u, ab += u * v, bb += v * v, ak += u * kappa[i], bk += v * kappa[i];
  }
  LogAesthetic fit{start.value_or(0.0), end.value_or(0.0), kClothoid};
  const double determinant = aa * bb - ab * ab;
  if (!start && !end && determinant > 0.0) {
    fit.startKappa = (bb * ak - ab * bk) / determinant;
    fit.endKappa = (aa * bk - ab * ak) / determinant;
  } else if (!start && aa > 0.0) {
    fit.startKappa = (ak - ab * fit.endKappa) / aa;
  } else if (!end && bb > 0.0) {
    fit.endKappa = (bk - ab * fit.startKappa) / bb;
  }
  return fit;
}

/// The logarithms of the curvatures at the free ends, for one alpha.
class EndsProblem final : public LevenbergProblem {
 public:
  EndsProblem(const LogAesthetic& fit, std::span<const double> x, std::span<const double> kappa,
              const std::array<bool, 2>& isFree)
      : alpha_(fit.alpha),
        sign_(fit.startKappa > 0.0 ? 1.0 : -1.0),
        x_(x),
        kappa_(kappa),
        isFree_(isFree),
        log_{std::log(std::abs(fit.startKappa)), std::log(std::abs(fit.endKappa))},
        trial_(log_) {}

  LogAesthetic result() const { return made(log_); }

  double linearise() override {
    gradient_ = {};
    h00_ = h01_ = h11_ = 0.0;
    const LogAestheticCourse course(made(log_));
    double squares = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double value = course.kappa(x_[i]), off = value - kappa_[i];
      std::array<double, 2> slope = course.byEnds(x_[i], value);
      for (std::size_t k = 0; k < 2; ++k) slope[k] = isFree_[k] ? slope[k] : 0.0;
      gradient_[0] += slope[0] * off, gradient_[1] += slope[1] * off;
      h00_ += slope[0] * slope[0], h01_ += slope[0] * slope[1], h11_ += slope[1] * slope[1];
      squares += off * off;
    }
    return std::isfinite(squares) ? squares : std::numeric_limits<double>::max();
  }
  double tryStep(double damping) override {
    const double a = isFree_[0] ? h00_ * (1.0 + damping) : 1.0, b = isFree_[1] ? h11_ * (1.0 + damping) : 1.0;
    const double determinant = a * b - h01_ * h01_;
    if (!(determinant > 0.0)) return std::numeric_limits<double>::infinity();
    const std::array<double, 2> step = {(b * gradient_[0] - h01_ * gradient_[1]) / determinant,
                                        (a * gradient_[1] - h01_ * gradient_[0]) / determinant};
    for (std::size_t k = 0; k < 2; ++k)
      trial_[k] = isFree_[k] ? log_[k] - std::clamp(step[k], -kMostLogStep, kMostLogStep) : log_[k];
    return misfitOf(made(trial_), x_, kappa_);
  }
  void accept() override { log_ = trial_; }
  /// An end runs off to a straight line, or to a point.
  bool isReached() const override { return std::abs(log_[0]) > kMostLog || std::abs(log_[1]) > kMostLog; }

 private:
  LogAesthetic made(const std::array<double, 2>& at) const {
    return {sign_ * std::exp(at[0]), sign_ * std::exp(at[1]), alpha_};
  }

  double alpha_, sign_;
  std::span<const double> x_, kappa_;
  std::array<bool, 2> isFree_;
  std::array<double, 2> log_, trial_, gradient_{};
  double h00_ = 0.0, h01_ = 0.0, h11_ = 0.0;
};

/// The best ends for the alpha of a fit.
LogAesthetic withEnds(const LogAesthetic& fit, std::span<const double> x, std::span<const double> kappa, bool freeStart,
                      bool freeEnd) {
  EndsProblem problem(fit, x, kappa, {freeStart, freeEnd});
  LevenbergOptions options = kEndFit;
  if (!freeStart && !freeEnd) options.iterations = 0;
  levenbergMarquardt(problem, options, RunContext{});
  return problem.result();
}

/// From split to split, as samples over 0..1 of the stretch.
struct Stretch {
  double from = 0.0, to = 1.0;
  std::vector<double> x, kappa;
};

std::vector<Stretch> stretchesOf(const CurvatureSamples& samples, const std::vector<double>& splits, bool closed) {
  std::vector<double> borders;
  if (!closed || splits.empty()) borders.push_back(0.0);
  borders.insert(borders.end(), splits.begin(), splits.end());
  borders.push_back(closed && !splits.empty() ? splits.front() + 1.0 : 1.0);
  const double last = samples.count() - 1.0;
  const auto kappaAt = [&](double f) { return linearBetween(samples.kappa, (f > 1.0 ? f - 1.0 : f) * last); };
  std::vector<Stretch> stretches;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    Stretch one{borders[k], borders[k + 1], {}, {}};
    const int count = std::max(24, static_cast<int>(std::lround((one.to - one.from) * last)));
    for (int i = 0; i <= count; ++i) {
      one.x.push_back(static_cast<double>(i) / count);
      one.kappa.push_back(kappaAt(one.from + one.x.back() * (one.to - one.from)));
    }
    stretches.push_back(std::move(one));
  }
  return stretches;
}

LogAestheticSpan reported(const Stretch& stretch, const LogAesthetic& fit, double lengthMm, double straight) {
  LogAestheticSpan span{stretch.from, stretch.to, fit.alpha};
  if (std::abs(fit.startKappa) > straight) span.startRadiusMm = 1.0 / fit.startKappa;
  if (std::abs(fit.endKappa) > straight) span.endRadiusMm = 1.0 / fit.endKappa;
  const double ratio = fit.startKappa / fit.endKappa, length = (stretch.to - stretch.from) * lengthMm;
  if (!span.startRadiusMm || !span.endRadiusMm || !(ratio > 0.0)) return span;
  const double unit = std::abs(*span.startRadiusMm) / length;
  span.lambda =
      std::abs(fit.alpha) < kNielsen ? std::log(ratio) * unit : (std::pow(ratio, fit.alpha) - 1.0) / fit.alpha * unit;
  return span;
}

}  // namespace

double LogAesthetic::kappa(double x) const { return LogAestheticCourse(*this).kappa(x); }

double LogAesthetic::slope(double x) const { return LogAestheticCourse(*this).slope(x); }

LogAesthetic fitLogAesthetic(std::span<const double> x, std::span<const double> kappa, std::optional<double> alpha,
                             std::optional<double> start, std::optional<double> end) {
  LogAesthetic linear = linearFit(x, kappa, start, end);
  double largest = 0.0;
  for (const double k : kappa) largest = std::max(largest, std::abs(k));
  const double straight = kStraightShare * largest;
  const auto isUsable = [&](double k) { return std::abs(k) > straight && k * linear.startKappa > 0.0; };
  const bool oneSign =
      std::all_of(kappa.begin(), kappa.end(), isUsable) && isUsable(linear.startKappa) && isUsable(linear.endKappa);
  if (!oneSign || largest == 0.0) return linear;
  const auto with = [&](double a) {
    LogAesthetic one = linear;
    one.alpha = a;
    return withEnds(one, x, kappa, !start, !end);
  };
  if (alpha) return with(*alpha);
  double best = kClothoid, least = misfitOf(linear, x, kappa);
  for (double a = kLeastAlpha; a <= kMostAlpha + 1e-9; a += kAlphaStep) {
    const double misfit = misfitOf(with(a), x, kappa);
    if (misfit < least) least = misfit, best = a;
  }
  const auto misfit = [&](double a) { return misfitOf(with(a), x, kappa); };
  const ValueAt finest = goldenSection(misfit, std::max(kLeastAlpha, best - kAlphaStep),
                                       std::min(kMostAlpha, best + kAlphaStep), kAlphaSteps);
  if (finest.value <= least) return with(finest.at);
  return best == kClothoid ? linear : with(best);
}

LogAestheticTarget logAestheticTarget(const NurbsCurve& curve, bool closed, const std::vector<double>& splits,
                                      std::optional<double> alpha, int samples) {
  LogAestheticTarget target;
  const CurvatureSamples sampled = curve.isEmpty() ? CurvatureSamples{} : sampledCurvature(curve, samples);
  if (!(sampled.lengthMm > 0.0) || sampled.kappa.size() < 2) {
    target.profile.problem = "The curve has no length.";
    return target;
  }
  const std::vector<Stretch> stretches = stretchesOf(sampled, splits, closed);
  const std::size_t count = stretches.size();
  // Where two meet: the mean of what both want there.
  std::vector<LogAesthetic> fits;
  fits.reserve(count);
  for (const Stretch& one : stretches) fits.push_back(fitLogAesthetic(one.x, one.kappa, alpha, {}, {}));
  std::vector<double> joint(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) joint[k] = 0.5 * (fits[k].kappa(1.0) + fits[(k + 1) % count].kappa(0.0));
  double largest = 0.0;
  for (const double k : sampled.kappa) largest = std::max(largest, std::abs(k));
  std::vector<ProfileNode>& nodes = target.profile.nodes;
  for (std::size_t k = 0; k < count; ++k) {
    const Stretch& one = stretches[k];
    const auto start = k > 0 || closed ? std::optional(joint[(k + count - 1) % count]) : std::nullopt;
    const auto end = k + 1 < count || closed ? std::optional(joint[k]) : std::nullopt;
    const LogAesthetic fit = fitLogAesthetic(one.x, one.kappa, alpha, start, end);
    const double width = one.to - one.from;
    for (int i = 0; i <= kNodesPerStretch; ++i) {
      const double x = static_cast<double>(i) / kNodesPerStretch;
      nodes.push_back({one.from + x * width, fit.kappa(x), fit.slope(x) / width});
    }
    target.spans.push_back(reported(one, fit, sampled.lengthMm, kStraightShare * largest));
    if (one.to > 1.0) {
      const double seam = (1.0 - one.from) / width;
      nodes = cutAtSeam(nodes, fit.kappa(seam), fit.slope(seam) / width);
    }
  }
  target.profile.valid = true;
  target.profile.isMonotone = true;  // each stretch is, between the splits
  const ProfileData data = profileData(sampled.perimeters(), sampled.kappa, extent(curve), TargetQuantity::Curvature);
  std::vector<double> fitted;
  for (const double f : data.perimeter) fitted.push_back(target.profile.value(f));
  judgeProfile(target.profile, data, fitted, 3 * static_cast<int>(count), curve.controlPointCount());
  return target;
}

}  // namespace batten
