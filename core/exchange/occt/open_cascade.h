// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Whether this build can write and read IGES and STEP. Without Open CASCADE all of this room fails and says so.
bool hasOpenCascade();

/// Open CASCADE keeps its settings in one place for the whole program: who holds this has it alone, and silent, since
/// it would write its messages to stdout.
class OcctSession {
 public:
  OcctSession();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Knots without repetition, and how often each is repeated.
struct KnotRuns {
  std::vector<double> knots;
  std::vector<int> multiplicities;
};
KnotRuns knotRuns(const NurbsCurve&);

/// What it says when Open CASCADE fails at a file of ours.
tl::unexpected<Error> occtFailed(const std::string& what, std::string detail = {});

}  // namespace batten
