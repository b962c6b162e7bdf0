// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "core/base/run_context.h"
#include "core/base/termination.h"

namespace batten {

/// A sum of squares to be made small, with the state that it is taken at and a trial state beside it.
class LevenbergProblem {
 public:
  LevenbergProblem() = default;
  LevenbergProblem(const LevenbergProblem&) = delete;
  LevenbergProblem& operator=(const LevenbergProblem&) = delete;
  virtual ~LevenbergProblem() = default;

  /// Makes the Gauss-Newton model at the state. @return the cost there; not finite where the state is impossible.
  virtual double linearise() = 0;
  /// Makes the state to which the step with this damping leads the trial. @return its cost; not finite where there is
  /// no such step.
  virtual double tryStep(double damping) = 0;
  /// About the most that the last step could lower the cost by, as the model has it.
  virtual double promised() const { return std::numeric_limits<double>::infinity(); }
  /// The trial becomes the state.
  virtual void accept() = 0;
  /// Whether the state is good enough. Asked after each accepted step.
  virtual bool isReached() const { return false; }
  /// Whether further steps are not worth their time. Asked after each accepted step that did not reach.
  virtual bool isHopeless() const { return false; }
};

struct LevenbergOptions {
  int iterations = 40;                             ///< At most.
  int attempts = std::numeric_limits<int>::max();  ///< Dampings tried in one iteration.
  double damping = 1e-3;                           ///< To begin with; relative to what the problem damps by.
  double success = 5.0, failure = 4.0;             ///< The damping is divided by the one, or multiplied by the other.
  double leastDamping = 1e-12;                     ///< It is not lowered further.
  double mostDamping = std::numeric_limits<double>::infinity();  ///< No attempt is made at this one or above.
  double leastPromise = 0.0;    ///< Relative: after a failed step that promised less, no higher damping is tried.
  double smallDecrease = 1e-4;  ///< Relative: a step that lowers the cost by less is a small one.
  int smallSteps = 2;           ///< That many in a row end it …
  int smallStepsDamped = 2;     ///< … or that many while the damping is above `freeDamping`: a heavily damped step is
                                ///< short by itself and proves little.
  double freeDamping = 1e-2;
  double negligible = 0.0;  ///< A cost as small as this, or smaller, needs no further step.
};

struct LevenbergRun {
  /// Converged: by small steps, a negligible cost, or no step that decreases after a small one. FixedPoint:
  /// isReached(). NoProgress (isHopeless() too), IterationLimit (also when cancelled); Degenerate: the first state is
  /// impossible.
  Termination why = Termination::IterationLimit;
  int iterations = 0;    ///< Models made, the one without a successful step included.
  double cost = 0.0;     ///< Of the state that the problem has kept.
  double damping = 0.0;  ///< For a later run from here.
};

/// Levenberg-Marquardt: damped Gauss-Newton steps, the damping lowered by each that decreases the cost and raised by
/// each that does not. Marquardt, SIAM J. Appl. Math. 11 (1963). The problem keeps the best state.
LevenbergRun levenbergMarquardt(LevenbergProblem& problem, const LevenbergOptions& options, const RunContext& context);

}  // namespace batten
