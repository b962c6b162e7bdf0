// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace batten {

/// Why a numerical routine stopped. Only Converged, Exact and FixedPoint mean that it reached what it was asked for.
enum class Termination {
  NotRun,            ///< The routine was not needed (mode off).
  Exact,             ///< A direct solution; no iteration involved.
  Converged,         ///< The stated tolerance was reached.
  FixedPoint,        ///< Another iteration would change nothing.
  IterationLimit,    ///< The safety limit stopped it; the best state so far is returned.
  NoProgress,        ///< No step decreased the objective any more.
  ToleranceLimited,  ///< The tolerance, not the objective, stopped it.
  Degenerate,        ///< The input has too little shape (too few points, no length); a fallback was used.
};

/// In words, as reports hold it: "not run".
constexpr std::string_view name(Termination t) {
  switch (t) {
    case Termination::NotRun:
      return "not run";
    case Termination::Exact:
      return "exact";
    case Termination::Converged:
      return "converged";
    case Termination::FixedPoint:
      return "fixed point";
    case Termination::IterationLimit:
      return "iteration limit";
    case Termination::NoProgress:
      return "no progress";
    case Termination::ToleranceLimited:
      return "tolerance limited";
    case Termination::Degenerate:
      return "degenerate";
  }
  return "unknown";
}

}  // namespace batten
