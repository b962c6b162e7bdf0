// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace batten::test {

/// One figure of the main job beside its limit.
struct JobFigure {
  std::string scene;  ///< "ellipse, filled" …
  std::string what;   ///< With its unit.
  double value = 0.0;
  double limit = 0.0;  ///< The largest value that will do.

  bool isMet() const { return value <= limit; }
};

/// What the program is for, measured: a sketch of 1600 x 900 px (blur 1.2 px, noise 5, paper from 250 to 150) of an
/// ellipse, a clothoid closed by a straight line, and a car silhouette with four corners, each filled and as a line of
/// 5 px. Traced: rms distance from the truth at least 10 px from corners (limit 0.08 px), corners clicked 6 px off
/// (limit 0.5 px). Faired, within the tolerance and towards the recommended target: curvature extrema more or fewer
/// than the ellipse and the clothoid have (limit 0).
std::vector<JobFigure> mainJob(std::uint32_t seed);

}  // namespace batten::test
