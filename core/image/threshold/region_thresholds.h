// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/base/conventions.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/paper_background.h"

namespace batten {

/// Whether the slow changes of the paper's grey (shading, gradation, shadow) are taken out before the thresholds.
struct PaperParams {
  bool flatten = true;  ///< Thresholds are measured against the local paper instead of against black.
  bool folds = true;    ///< With `flatten`: so are folds and edges of shadows that run straight across the page.
  bool operator==(const PaperParams&) const = default;
};

enum class ThresholdMode {
  Automatic,  ///< Every region the user has not set finds its own threshold.
  Manual,     ///< Every region the user has not set takes `manualLevel`.
};

/// The 64 region thresholds (000 II.B). Region r = row * 8 + column, row 0 at the top.
struct ThresholdParams {
  ThresholdMode mode = ThresholdMode::Automatic;
  double manualLevel = 128.0;  ///< [grey 0..255] Threshold of every region in Manual mode.
  double strength = 1.0;  ///< [-] 0.2..3. Scales the automatic minimum contrast of ink: larger keeps only darker lines.
  bool interpolate = true;  ///< Bilinear between region centres (no seams); off: blocks, as in the paper.
  bool smooth = true;  ///< A Gaussian as wide as the paper's noise asks for comes before the thresholds; off: none,
                       ///< as in the papers.
  double reach = 0.0;  ///< [-] 0..1. Share of the minimum contrast of ink that thin, long faint lines need; smaller
                       ///< keeps fainter ones, 1 = ink as it is, 0 = chosen by the program.
  int speckArea = 20;  ///< [px] >= 0. Smaller pieces of ink are specks and are dropped, but for those of
                       ///< a quarter of it that lie in rows; 0 keeps all.
  int holeArea = 10;   ///< [px] >= 0. Smaller holes inside ink are filled; 0 keeps all.
  /// [grey 0..255] The user's own thresholds on the scan's scale, at the region's centre; absent = automatic.
  std::array<std::optional<double>, kRegions> grid{};
  bool operator==(const ThresholdParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const ThresholdParams&);

/// Levels after a lesser smoothing.
struct FinerLevels {
  double smoothingPx = 0.0;                            ///< [px]
  std::array<double, kRegions> contrast{}, certain{};  ///< [grey] As in RegionThresholds.
};

/// What the automatic start found, and what acts.
struct RegionThresholds {
  PaperBackground paper;                     ///< Empty without flattening.
  std::array<double, kRegions> automatic{};  ///< [grey 0..255] at the region's centre, scan's scale.
  std::array<double, kRegions> level{};      ///< [grey 0..255] what acts: the user's where set, else automatic.
  std::array<bool, kRegions> measured{};     ///< The region holds edges of its own; else filled from its neighbours.
  double paperNoise = 0.0;                   ///< [grey] robust standard deviation of the paper.
  double smoothingPx = 0.0;                  ///< [px] Gaussian applied before thresholding.
  std::array<double, kRegions> contrast{};   ///< [grey] level minus the paper at the region's centre: what acts, at
                                             ///< every pixel added to its paper.
  std::array<double, kRegions> certain{};  ///< [grey] as contrast, deeper: a piece that nowhere gets there is a speck.
  double faintLimit = -1.5;                ///< [grey] contrast that faint parts joined to ink must have at least.
  /// Of the half level at the edges, 0..1: less where the grain of a pencil tears the ink.
  double halfLevelShare = 1.0;
  std::optional<FinerLevels> finer;  ///< For ink that the grain does not tear, where it tears that of the page.
  bool holesArePaper = false;        ///< The lines are so close that small holes are the paper between them.
  bool foundLine = true;             ///< False: no edge stands out of the paper anywhere.
  std::string note;                  ///< One line for the user when something is unusual; else empty.
};

/// Chooses the 64 thresholds. Automatic regions follow the half level at their own edges, or three quarters of it where
/// the grain of a pencil tears the ink, which is smoothed more, too (ink_grain.h); regions without edges of
/// their own are filled from those that have some, so that empty paper is not split into its own noise.
Result<RegionThresholds> findThresholds(const GreyImage&, const PaperParams&, const ThresholdParams&,
                                        const RunContext&);

}  // namespace batten
