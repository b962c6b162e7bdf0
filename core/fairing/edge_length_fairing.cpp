// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/edge_length_fairing.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/base/interpolation.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/fairing/edge_lengths.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/target/low_pass.h"
#include "core/fairing/target/shape_modification.h"
#include "core/fairing/target_splits.h"

namespace batten {
namespace {

constexpr int kPathDegree = 5;  // of a path whose edge lengths can be moved
/// Samples of the path's own curvature, and of the misfit.
constexpr int kSamples = 801;
/// Bisections of the share of the way to the profile, and the part of the tolerance that ends them.
constexpr int kBisections = 12;
constexpr double kUsedByLengthsShare = 0.97;  // of the tolerance
// measured at few for a guess, then at many
constexpr int kFewPlaces = 100, kManyPlaces = 2000, kPlacesPerPiece = 64;

/// The pieces of a path; empty for any other curve.
std::vector<Quintic> quinticsOf(const NurbsCurve& curve) {
  std::vector<Quintic> path;
  const auto pieces = curve.degree() == kPathDegree && !curve.isRational()
                          ? bezierPieces(curve)
                          : Result<std::vector<BezierPiece>>(fail(ErrorCode::Numerical, ""));
  if (!pieces) return path;
  const int joints = static_cast<int>(pieces->size()) - 1;
  // Every joint brings as many control points as its knot is multiple.
  if (curve.controlPointCount() - (kPathDegree + 1) < 3 * joints) return path;
  for (const BezierPiece& piece : *pieces) {
    Quintic& q = path.emplace_back();
    std::copy(piece.controlPoints.begin(), piece.controlPoints.end(), q.begin());
  }
  return path;
}

Result<TargetProfile> profileFor(const NurbsCurve& path, bool closed, const FairingParams& params, CancelCheck check) {
  if (params.mode == FairingMode::LowPass) return lowPassedProfile(path, closed, params, check);
  if (params.target == FairingTarget::Drawn) return drawnProfile(params.profile, closed);
  if (params.target == FairingTarget::LogAesthetic) return logAestheticOf(path, closed, params, check).profile;
  const TargetSet targets = fitTargets(path, params.targets, closed);
  return targets.profiles[degreeOf(params.target).value_or(targets.recommendedDegree.value_or(1)) - 1];
}

/// Turns and scales a path about its start so that it ends where it has to.
void settle(std::vector<Quintic>& path, const Vec2& end) {
  const Vec2 start = path.front()[0], was = path.back()[5] - start, wanted = end - start;
  if (!(was.norm() > 0.0)) return;
  const std::complex<double> turn = std::complex(wanted.x(), wanted.y()) / std::complex(was.x(), was.y());
  for (Quintic& q : path) {
    for (Vec2& p : q) {
      const auto moved = std::complex(p.x() - start.x(), p.y() - start.y()) * turn;
      p = start + Vec2(moved.real(), moved.imag());
    }
  }
  path.back()[5] = end;
}

class EdgeLengthFairing {
 public:
  EdgeLengthFairing(const NurbsCurve& curve, bool closed, const std::vector<Quintic>& path,
                    const TargetProfile& profile, const FairingParams& params, const RunContext& context)
      : curve_(curve), closed_(closed), path_(path), profile_(profile), params_(params), context_(context) {
    for (const CurveSample& sample : sampleByArcLength(curve, kSamples, context)) own_.push_back(sample.kappa);
    length_ = ArcLength(curve).total();
  }

  Result<FairedCurve> run() {
    FairedCurve best{curve_, {}};
    best.report.objectiveBefore = misfit(curve_);
    best.report.objectiveAfter = best.report.objectiveBefore;
    best.report.why = Termination::NoProgress;
    best.report.note = "No change of edge lengths brings the path closer to the profile.";
    const bool free = !closed_ && !params_.startHold.tangent && !params_.endHold.tangent;
    for (const bool pin : {false, true}) {
      if (!pin && !free) continue;
      const auto found = followed(pin);
      if (context_.isCancelled()) return cancelled();
      if (found && found->report.objectiveAfter < best.report.objectiveAfter) best = *found;
    }
    const double scale = kExtremumProminence / std::max(extent(curve_), 1e-300);
    best.report.extremaBefore = static_cast<int>(curvatureExtrema(curve_, scale, closed_, context_).size());
    best.report.extremaAfter = static_cast<int>(curvatureExtrema(best.curve, scale, closed_, context_).size());
    best.report.iterations = iterations_;
    if (context_.isCancelled()) return cancelled();
    return best;
  }

 private:
  double ownAt(double share) const { return linearBetween(own_, std::clamp(share, 0.0, 1.0) * (kSamples - 1)); }

  /// Rms difference from the profile over its rms, both rescaled to one length.
  double misfit(const NurbsCurve& curve) const {
    const double scale = ArcLength(curve).total() / length_;
    double sum = 0.0, size = 0.0;
    const auto samples = sampleByArcLength(curve, kSamples, context_);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double wanted = profile_.curvatureAt(static_cast<double>(i) / (kSamples - 1));
      sum += std::pow(scale * samples[i].kappa - wanted, 2);
      size += wanted * wanted;
    }
    return std::sqrt(sum / std::max(size, 1e-12 * kSamples / (length_ * length_)));
  }

  /// The path that goes this share of the way to the profile.
  std::optional<NurbsCurve> attempt(double share, bool pin) {
    EdgeLengthOptions options;
    options.pinEnds = pin;
    const auto wanted = [&](double f) { return ownAt(f) + share * (profile_.curvatureAt(f) - ownAt(f)); };
    EdgeLengthResult result = followCurvature(path_, wanted, options, context_);
    iterations_ += result.iterations;
    if (closed_) equaliseJoint(result.path.back(), result.path.front());
    if (!closed_ && !pin) settle(result.path, path_.back()[5]);
    if (params_.startHold.curvature) setStartCurvature(result.path.front(), own_.front());
    if (params_.endHold.curvature) setEndCurvature(result.path.back(), own_.back());
    auto curve = joinedQuintics(result.path, 1.0);
    return curve ? std::optional(std::move(*curve)) : std::nullopt;
  }

  /// Both ways, at so many places of each piece that what lies between them fits in the room. The search looks at few
  /// of them first: what is too far away there is too far away.
  double moved(const NurbsCurve& curve) const {
    const double seen = movedAt(curve, kFewPlaces);
    if (!(seen <= kToleranceRoom * params_.toleranceMm)) return seen;
    return movedAt(curve, std::max(kManyPlaces, kPlacesPerPiece * static_cast<int>(path_.size())));
  }

  double movedAt(const NurbsCurve& curve, int places) const {
    const auto farthest = [places, this](const NurbsCurve& from, const NurbsCurve& to) {
      std::vector<Vec2> points;
      for (int i = 0; i <= places; ++i)
        points.push_back(from.point(from.start() + (from.end() - from.start()) * i / places));
      return deviation(to, points, true, context_).max;
    };
    return std::max(farthest(curve, curve_), farthest(curve_, curve));
  }

  std::optional<FairedCurve> followed(bool pin) {
    double inside = 0.0, outside = 1.0;
    std::optional<FairedCurve> best;
    std::optional<double> needed;
    for (int i = 0; i <= kBisections && !context_.isCancelled(); ++i) {
      const double share = i == 0 ? 1.0 : 0.5 * (inside + outside);
      auto curve = attempt(share, pin);
      const std::optional<double> away = curve ? std::optional(moved(*curve)) : std::nullopt;
      if (i == 0 && away) needed = toleranceFor(*away);
      if (!away || !(*away <= kToleranceRoom * params_.toleranceMm)) {
        outside = share;
        continue;
      }
      inside = share;
      best = FairedCurve{std::move(*curve), {}};
      best->report.maxDeviationMm = *away;
      if (i == 0 || *away > kUsedByLengthsShare * params_.toleranceMm) break;
    }
    if (!best) return std::nullopt;
    best->report.neededMm = needed;
    best->report.withinTolerance = inside == 1.0;
    best->report.why = inside == 1.0 ? Termination::Converged : Termination::ToleranceLimited;
    if (inside < 1.0) best->report.note = "The profile was followed as far as the tolerance allows.";
    best->report.objectiveBefore = misfit(curve_);
    best->report.objectiveAfter = misfit(best->curve);
    return best;
  }

  const NurbsCurve& curve_;
  bool closed_;
  const std::vector<Quintic>& path_;
  const TargetProfile& profile_;
  const FairingParams& params_;
  const RunContext& context_;
  std::vector<double> own_;
  double length_ = 0.0;
  int iterations_ = 0;
};

/// What came of a curve that has no edge lengths to move.
Result<FairedCurve> noted(Result<FairedCurve> other) {
  if (other) noteNoPath(other->report);
  return other;
}

}  // namespace

bool isBezierPath(const NurbsCurve& curve) { return !quinticsOf(curve).empty(); }

void noteNoPath(FairingReport& report) {
  if (report.note.empty()) report.note = "Not a Bézier path: its control points were moved instead of edge lengths.";
}

bool movesEdgeLengths(const FairingParams& params) {
  return params.means == FairingMeans::EdgeLengths &&
         (params.mode == FairingMode::Target || params.mode == FairingMode::LowPass);
}

Result<FairedCurve> fairByEdgeLengths(const NurbsCurve& path, bool closed, const FairingParams& params,
                                      const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  if (path.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to fair.");
  const std::vector<Quintic> pieces = quinticsOf(path);
  if (pieces.empty()) return noted(fair(path, closed, params, context));
  const auto profile = profileFor(path, closed, params, context);
  if (context.isCancelled()) return cancelled();
  if (!profile || !profile->valid) return fair(path, closed, params, context);
  return EdgeLengthFairing(path, closed, pieces, *profile, params, context).run();
}

Result<FairedCurve> fairByEdgeLengths(const NurbsCurve& path, bool closed, const TargetProfile& profile,
                                      const FairingParams& params, const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  if (path.isEmpty()) return fail(ErrorCode::BadParameter, "There is no curve to fair.");
  const std::vector<Quintic> pieces = quinticsOf(path);
  if (pieces.empty()) return noted(modifyShape(path, closed, profile, params, context));
  if (!profile.valid) return modifyShape(path, closed, profile, params, context);
  return EdgeLengthFairing(path, closed, pieces, profile, params, context).run();
}

}  // namespace batten
