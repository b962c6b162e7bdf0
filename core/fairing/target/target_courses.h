// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/target_steps.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// The steps over one knot vector.
struct TargetCourse {
  std::shared_ptr<const FairingSetup> setup;
  std::unique_ptr<TargetSteps> followed;
};

/// The courses from a sketch to a target, over its own knots and over fewer ones. None depends on the tolerance: no
/// step is made twice, however many modifications ask for it. For one thread.
class TargetCourses {
 public:
  /// @param context must outlive it.
  TargetCourses(std::shared_ptr<const FairingSetup> setup, const TargetProfile& profile, const RunContext& context)
      : context_(context), objective_(targetObjective(*setup, profile)) {
    own_.setup = std::move(setup);
  }
  TargetCourses(const TargetCourses&) = delete;
  TargetCourses& operator=(const TargetCourses&) = delete;

  const RunContext& context() const { return context_; }
  const FairingSetup& sketch() const { return *own_.setup; }
  int sketchedExtrema();  ///< Curvature extrema of the sketch, of the usual prominence.
  const Result<FairingObjective>& objective() const { return objective_; }
  /// Over the sketch's own knots, up to where the curve has left the sketch by more than `mostMm`. @pre an objective.
  const TargetCourse& own(double mostMm);
  /// Over the knots of calmSetups().
  const std::vector<TargetCourse>& calm(double mostMm);

 private:
  void follow(TargetCourse& course, double mostMm) const;

  const RunContext& context_;
  Result<FairingObjective> objective_;
  TargetCourse own_;
  std::vector<TargetCourse> calm_;
  bool hasCalm_ = false;
  std::optional<int> sketchedExtrema_;
};

}  // namespace batten
