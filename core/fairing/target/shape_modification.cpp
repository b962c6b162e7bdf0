// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/shape_modification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/curve/curvature.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/target_steps.h"
#include "core/fairing/profile/profile_data.h"
#include "core/fairing/structure/tolerance_fairing.h"

namespace batten {
namespace {

/// Steps between two of TargetSteps, to use as much of the tolerance as this.
constexpr int kSearchSteps = 4, kRoundSteps = 4, kRoughSteps = 2;
constexpr double kTargetUsedShare = 0.95;  // of the tolerance: enough of it
/// Ratios of weights: of equal curves, and by which a small one grows; share between two that no step comes nearer.
constexpr double kSameWeight = 1.02, kSearchWeightStep = 4.0, kNearestShare = 0.1;
constexpr double kHardlyNearer = 0.9;  // of the distance before
/// [mm] Tolerances that are used up whatever the tolerance is, if it is no smaller.
constexpr std::array kRoundTolerances = {20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
/// A search that leaves more of it unused got stuck in the noise of a rough start; the barrier then takes over.
constexpr double kStuckShare = 0.8;
/// Tolerances: a curve that has left the sketch by this, on its way to the target, will not come back.
constexpr double kBeyondReach = 2.0;

/// Part of the way from the sketch's misfit to that of the target: a curve that has gone so far meets the target.
constexpr double kMetShare = 0.9;

/// Why a profile was not followed, or not to the end, with what can be done about it.
struct ModificationNotes {
  const char *nothingNearer, *addsExtrema, *outOfReach, *inPart, *toTolerance;
};
// what the report says where a target is followed
constexpr ModificationNotes kNotesOfTarget{
    "Unchanged: no curve within the tolerance is closer to this target without added curvature extrema. Raise the "
    "tolerance, split the profile, or use Smooth.",
    "Unchanged: reaching this target adds curvature extrema. Choose another degree, split the profile, or use Smooth.",
    "The profile is far out of reach for this curve. Split it, or mark the corners.",
    "The profile was followed as far as possible without adding a curvature extremum.",
    "The profile was followed as far as the tolerance allows."};
// and where the curve is filtered
constexpr ModificationNotes kNotesOfFilter{
    "Unchanged: no curve within the tolerance is closer to the filtered curvature without added extrema. Raise the "
    "tolerance, choose another wavelength, or use Smooth.",
    "Unchanged: following the filtered curvature adds extrema. Choose another wavelength, or use Smooth.",
    "The filtered curvature is far out of reach for this curve. Choose another wavelength, or mark the corners.",
    "The filtered curvature was followed as far as possible without adding a curvature extremum.",
    "The filtered curvature was followed as far as the tolerance allows."};

/// Of all curves within the tolerance the one with the fewest extrema, of these the one nearest to the target.
class ShapeModification {
 public:
  ShapeModification(TargetCourses& target, double toleranceMm, ModificationEffort effort)
      : target_(target),
        sketch_(target.sketch()),
        objective_(*target.objective()),
        toleranceMm_(toleranceMm),
        context_(target.context()),
        onlyIfMet_(effort.onlyIfMet),
        onlyNeed_(effort.onlyNeed),
        isFiltered_(effort.isFiltered),
        notes_(effort.isFiltered ? kNotesOfFilter : kNotesOfTarget),
        sketchedExtrema_(target.sketchedExtrema()),
        asked_(extremaAsked(sketch_, objective_)) {
    if (effort.asked == ExtremaAsked::UpToSketch) asked_ = std::min(asked_, sketchedExtrema_);
    if (onlyIfMet_ || onlyNeed_) mostMm_ = kBeyondReach * toleranceMm;
    openAll();
    // One that comes to its target decides together with the others, which are then followed to the end.
    const auto endsEarly = [](const Course& course) { return course.followed->endsEarly(); };
    const bool allEndEarly = std::all_of(courses_.begin(), courses_.end(), endsEarly);
    if (allEndEarly || std::none_of(courses_.begin(), courses_.end(), endsEarly)) return;
    mostMm_ = std::numeric_limits<double>::infinity();
    courses_.clear();
    openAll();
  }
  Result<FairedCurve> run() {
    if (context_.isCancelled()) return cancelled();
    const auto before = evaluate(sketch_, objective_, {}, sketch_.points, sketch_.start.places);
    if (courses_.empty() || !before) {
      return unchanged(sketch_.original, sketch_.closed, Termination::Degenerate,
                       "The curve has a cusp and was not changed.");
    }
    best_.points = sketch_.points;
    best_.misfit = before->misfit;
    best_.measured(0.0, sketchedExtrema_);
    report_.objectiveBefore = std::sqrt(best_.misfit);
    const TargetStep& full = fullStep();
    report_.neededMm = toleranceFor(full.deviationMm());
    metMisfit_ = full.misfit;
    if (!isFiltered_) takeUpTo(toleranceMm_);
    report_.withinTolerance = !courses_.front().followed->endsEarly() && *report_.neededMm <= toleranceMm_;
    if (onlyIfMet_ && !report_.withinTolerance) return done();
    if (isFiltered_) {
      useEach();
    } else {
      useRoundTolerances();
    }
    for (const Course& course : courses_) {
      if (!course_ || (course_ == &course && best_.weight > course.followed->steps().front().weight))
        useTolerance(course);
    }
    if (context_.isCancelled()) return cancelled();
    return done();
  }
  /// The tolerance that meets the target; nothing where no course came to it.
  std::optional<double> neededMm() const {
    if (courses_.empty() || isBeyond()) return std::nullopt;
    return toleranceFor(fullStep().deviationMm());
  }

 private:
  /// The steps over one knot vector.
  struct Course {
    const FairingSetup* setup;
    const TargetSteps* followed;
    std::vector<const TargetStep*>
        toTolerance{};  ///< Steps that use up the tolerance, where a round one has found them.
  };

  void openAll() {
    open(target_.own(mostMm_));
    if (isCalm() || (onlyNeed_ && isBeyond())) return;
    for (const TargetCourse& calm : target_.calm(mostMm_)) open(calm);
  }
  /// A target that is so far from the sketch is not looked for over fewer knots.
  bool isBeyond() const { return !courses_.empty() && !courses_.front().followed->steps().front().isWithin(mostMm_); }
  /// Where the target is met without tremor, there is none to be passed over.
  bool isCalm() const {
    if (courses_.empty() || courses_.front().followed->endsEarly()) return false;
    const auto steps = courses_.front().followed->steps();
    return !steps.empty() && steps.front().extrema() <= asked_;
  }
  void open(const TargetCourse& course) {
    if (!course.followed->steps().empty()) courses_.push_back({course.setup.get(), course.followed.get()});
  }
  /// Of the courses' ends at the target the one that meets it best.
  const TargetStep& fullStep() const {
    const Course* best = &courses_.front();
    for (const Course& course : courses_)
      if (course.followed->steps().front().misfit < best->followed->steps().front().misfit) best = &course;
    return best->followed->steps().front();
  }
  bool isWithin(const TargetStep& step) const { return step.isWithin(kToleranceRoom * toleranceMm_); }
  /// Extrema that the target itself has are no fault.
  int rank(const TargetStep& step) const { return std::max(step.extrema(), asked_); }

  /// Steps within a tolerance, those that move least first.
  void takeUpTo(double toleranceMm) {
    std::vector<std::pair<const TargetStep*, const Course*>> within;
    for (const Course& course : courses_)
      for (const TargetStep& step : course.followed->steps())
        if (step.isWithin(kToleranceRoom * toleranceMm)) within.emplace_back(&step, &course);
    if (isFiltered_) {
      std::stable_sort(within.begin(), within.end(),
                       [](const auto& a, const auto& b) { return a.first->deviationMm() < b.first->deviationMm(); });
    }
    for (const auto& [step, course] : within) take(*step, course);
  }
  void useRoundTolerances() {
    for (const double tolerance : kRoundTolerances) {
      const double left = tolerance - sketch_.claimedMm();
      if (left > 0.0 && left <= toleranceMm_) useRound(left);
    }
  }
  /// What each tolerance gives, from the smallest up. Curves with no more extrema than the filter leaves are all the
  /// same to rank(); of these, too, a larger tolerance gives none with more.
  void useEach() {
    for (auto tolerance = kRoundTolerances.rbegin(); tolerance != kRoundTolerances.rend(); ++tolerance) {
      const double left = *tolerance - sketch_.claimedMm();
      if (left <= 0.0) continue;
      if (left > toleranceMm_) break;
      takeUpTo(left);
      useRound(left);
    }
    takeUpTo(toleranceMm_);
  }

  void take(const TargetStep& step, const Course* course) {
    if (isFiltered_ && step.extrema() > best_.extrema()) return;
    const bool better = rank(step) < rank(best_) || (rank(step) == rank(best_) && step.misfit < best_.misfit);
    // Few extrema are no merit of a curve that is farther from the filtered curvature than the sketch: it lost long
    // waves.
    const bool isAstray = isFiltered_ && std::sqrt(step.misfit) > report_.objectiveBefore;
    if (!better || isAstray) return;
    best_ = step;
    course_ = course;
  }

  /// What only this tolerance has found must not win extrema that a larger one would not find again.
  void takeOfSameRank(const TargetStep& step, const Course* course) {
    if (isFiltered_ ? step.extrema() == best_.extrema() : rank(step) == rank(best_)) take(step, course);
  }

  /// The steps on both sides of a tolerance: the last that leaves it, and the first that keeps it.
  struct Sides {
    const TargetStep *outside = nullptr, *inside = nullptr;
  };
  Sides sidesOf(const Course& course, double toleranceMm) const {
    Sides sides;
    for (const TargetStep& step : course.followed->steps()) {
      if (step.isWithin(kToleranceRoom * toleranceMm)) {
        sides.inside = &step;
        break;
      }
      sides.outside = &step;
    }
    return sides;
  }

  /// A curve that uses up a round tolerance: what it wins, larger tolerances find too.
  void useRound(double toleranceMm) {
    for (Course& course : courses_) {
      if (rank(best_) <= asked_ || context_.isCancelled()) return;
      const Sides sides = sidesOf(course, toleranceMm);
      if (!sides.outside) continue;
      std::vector<const TargetStep*> found = between(course, sides, toleranceMm, kRoundSteps);
      for (const TargetStep* step : found) take(*step, &course);
      if (!(toleranceMm < toleranceMm_)) course.toTolerance = std::move(found);
    }
  }

  /// Steps that use more and more of a tolerance.
  std::vector<const TargetStep*> between(const Course& course, const Sides& sides, double toleranceMm, int most) const {
    std::vector<const TargetStep*> found;
    const TargetStep *wide = sides.outside, *near = sides.inside;
    double left = std::numeric_limits<double>::infinity();  // deviation of the step before
    for (int i = 0; i < most && !context_.isCancelled(); ++i) {
      if (!near && isStuck(wide->deviationMm(), left, toleranceMm, most - i)) break;
      left = wide->deviationMm();
      if (near && (near->deviationMm() >= kTargetUsedShare * toleranceMm || near->weight < kSameWeight * wide->weight))
        break;
      const double weight = near ? weightBetween(*wide, *near, toleranceMm) : kSearchWeightStep * wide->weight;
      const TargetStep* step = course.followed->between(near ? *near : *wide, weight);
      if (!step) break;
      if (step->deviationMm() <= kToleranceRoom * toleranceMm) {  // asked for by the next weight
        found.push_back(step);
        near = step;
      } else {
        wide = step;
      }
    }
    return found;
  }

  /// A curve that a larger weight did not bring back to the sketch, or that is farther than the steps left can bring
  /// it: at best its distance falls with the square of the weight.
  static bool isStuck(double deviationMm, double beforeMm, double toleranceMm, int steps) {
    return deviationMm > kHardlyNearer * beforeMm ||
           deviationMm > toleranceMm * std::pow(kSearchWeightStep * kSearchWeightStep, steps);
  }

  void useTolerance(const Course& course) {
    const Sides sides = sidesOf(course, toleranceMm_);
    if (!sides.outside) return;
    if (course.toTolerance.empty()) {
      const int most = course.followed->isRough() ? kRoughSteps : kSearchSteps;
      for (const TargetStep* step : between(course, sides, toleranceMm_, most)) takeOfSameRank(*step, &course);
    }
    if (course_ != &course || context_.isCancelled()) return;
    const auto polished = course.followed->polished(best_);
    if (polished && isWithin(*polished)) takeOfSameRank(*polished, &course);
    if (course.setup == &sketch_ && !course.followed->isRough() && best_.deviationMm() < kStuckShare * toleranceMm_)
      useBarrier(course);
  }

  static double weightBetween(const TargetStep& wide, const TargetStep& near, double toleranceMm) {
    const double a = std::log(wide.weight), b = std::log(near.weight);
    const double da = std::log(wide.deviationMm() / toleranceMm);
    const double db =
        std::log(std::max(near.deviationMm() / toleranceMm, 1e-9)) - std::log(0.5 * (1.0 + kTargetUsedShare));
    return std::exp(a + std::clamp(da / std::max(da - db, 1e-12), kNearestShare, 1.0 - kNearestShare) * (b - a));
  }

  void useBarrier(const Course& course) {
    BoundedRun bounded = minimiseWithin(sketch_, objective_, toleranceMm_, best_.points, context_);
    if (context_.isCancelled()) return;
    report_.iterations += bounded.iterations;
    TargetStep step = best_;
    step.points = std::move(bounded.points);
    const double deviationMm = keepWithin(sketch_, toleranceMm_, step.points);
    const auto state = evaluate(sketch_, objective_, {}, step.points, sketch_.start.places);
    const auto curve = toCurve(sketch_, step.points);
    if (!state || !curve) return;
    step.misfit = state->misfit;
    step.measured(deviationMm, countedExtrema(*curve, sketch_.closed, sketch_.check));
    takeOfSameRank(step, &course);
  }

  bool isFollowed() const {
    const double possible = report_.objectiveBefore - std::sqrt(metMisfit_);
    return report_.objectiveBefore - report_.objectiveAfter >= kMetShare * possible;
  }

  void explain() {
    const auto adds = [this](const TargetStep& step) { return isWithin(step) && rank(step) > rank(best_); };
    const auto& own = *courses_.front().followed;
    report_.why = course_ ? best_.why : Termination::FixedPoint;
    if (!course_ && (!report_.withinTolerance || std::any_of(own.steps().begin(), own.steps().end(), adds))) {
      report_.why = Termination::ToleranceLimited;
      report_.note = report_.withinTolerance ? notes_.addsExtrema : notes_.nothingNearer;
      report_.withinTolerance = false;
    } else if (report_.withinTolerance && !isFollowed()) {
      // The tolerance would have allowed more.
      report_.why = Termination::ToleranceLimited;
      report_.note = notes_.inPart;
      report_.withinTolerance = false;
    } else if (!report_.withinTolerance) {
      report_.why = Termination::ToleranceLimited;
      report_.note = notes_.toTolerance;
      if (best_.deviationMm() >= kStuckShare * toleranceMm_) return;
      // The corridor had room left: it was not what stopped the curve.
      report_.note = own.isRough() ? notes_.outOfReach : notes_.inPart;
    }
  }

  Result<FairedCurve> done() {
    for (const Course& course : courses_) report_.iterations += course.followed->iterations();
    report_.objectiveAfter = std::sqrt(best_.misfit);
    explain();
    if (!course_ || course_->setup == &sketch_)
      return finished(sketch_, std::move(best_.points), toleranceMm_, std::move(report_));
    auto curve = toCurve(*course_->setup, best_.points);
    if (!curve) return fail(curve.error());
    report_.maxDeviationMm = best_.deviationMm();
    report_.extremaBefore = sketchedExtrema_;
    report_.extremaAfter = best_.extrema();
    return FairedCurve{std::move(*curve), std::move(report_)};
  }

  TargetCourses& target_;
  const FairingSetup& sketch_;
  const FairingObjective& objective_;
  double toleranceMm_, mostMm_ = std::numeric_limits<double>::infinity();
  const RunContext& context_;
  std::vector<Course> courses_;
  bool onlyIfMet_, onlyNeed_, isFiltered_;
  const ModificationNotes& notes_;
  int sketchedExtrema_, asked_;
  double metMisfit_ = 0.0;  ///< Of the curve that meets the target.
  TargetStep best_;
  const Course* course_ = nullptr;  ///< To which the best one belongs; null: the sketch is the best.
  FairingReport report_;
};

}  // namespace

Result<FairedCurve> modifyShape(TargetCourses& target, double toleranceMm, ModificationEffort effort) {
  if (!target.objective()) return fail(target.objective().error());
  auto faired = ShapeModification(target, toleranceMm, effort).run();
  if (faired) faired->report.similarityAfter = similarityToSketch(faired->curve, target.sketch().sketchedCurve());
  return faired;
}

Result<FairedCurve> modifyShape(const std::shared_ptr<const FairingSetup>& setup, const TargetProfile& profile,
                                double toleranceMm, const RunContext& context, ModificationEffort effort) {
  TargetCourses target(setup, profile, context);
  return modifyShape(target, toleranceMm, effort);
}

std::optional<double> neededWithin(TargetCourses& target, double mostMm) {
  if (!target.objective()) return std::nullopt;
  return ShapeModification(target, mostMm, {.onlyNeed = true}).neededMm();
}

void noteMetOverMoreSpans(FairingReport& report) {
  report.why = Termination::ToleranceLimited;
  report.withinTolerance = false;
  report.note = report.maxDeviationMm > 0.0
                    ? "The profile was followed in part. Over more spans it would be met, with more curvature extrema."
                    : kNotesOfTarget.addsExtrema;
}

Result<FairedCurve> modifyShape(const NurbsCurve& curve, bool closed, const TargetProfile& profile,
                                const FairingParams& params, const RunContext& context) {
  return withSetup(curve, closed, params, context,
                   [&](const std::shared_ptr<const FairingSetup>& setup, const FairingParams& within) {
                     return modifyShape(setup, profile, within.toleranceMm, context, {ExtremaAsked::OfProfile});
                   });
}

}  // namespace batten
