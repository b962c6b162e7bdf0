// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/image/bits/bit_image.h"

namespace batten {

enum class FilterOrder { ErosionFirst, DilationFirst };
enum class FilterBorder {
  Paper,      ///< Outside the page is paper (default).
  Replicate,  ///< The border row and column are repeated outside: for drawings that are cropped.
};

inline constexpr int kMostChangePx = 100000;  ///< That FilterParams::maxChangePx may be.

struct FilterParams {
  int coefficient = 2;  ///< [-] 0..4. Neighbours that must disagree before a pixel changes: more than this many of 8. 0
                        ///< = ordinary erosion and dilation.
  int iterations = 15;  ///< 0..100. Pairs of one erosion and one dilation; stops earlier at the fixed point.
  FilterOrder order = FilterOrder::ErosionFirst;
  FilterBorder border = FilterBorder::Paper;
  /// [px] 0..100000. Connected changes of a larger area are undone: thin strokes, tips and narrow gaps, which no rule
  /// about eight neighbours can tell from dirt, stay as they are. 0 = no limit, as in the paper.
  int maxChangePx = 8;
  bool operator==(const FilterParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const FilterParams&);

struct FilterReport {
  Termination why = Termination::NotRun;
  int iterations = 0;            ///< Pairs really run.
  std::int64_t inkBefore = 0;    ///< [px]
  std::int64_t inkAfter = 0;     ///< [px]
  std::int64_t inkLost = 0;      ///< [px] of ink that is paper now.
  std::int64_t inkGained = 0;    ///< [px] of paper that is ink now.
  std::int64_t undone = 0;       ///< [px] of changes that were too large (FilterParams::maxChangePx).
  bool thinStrokesLost = false;  ///< A good part of the ink vanished: thin strokes did not survive.
  bool alternates =
      false;  ///< Two states take turns (why = NoProgress); the result is that of the asked number of pairs.
};
struct FilteredImage {
  BitImage ink;
  FilterReport report;
};

/// "Feature based" erosion and dilation (000 II.C; the printed rule counts the wrong colour, this is the cited
/// source's): all pixels at once; erosion: an ink pixel with more than `coefficient` paper pixels among its 8
/// neighbours becomes paper; dilation: a paper pixel with more than `coefficient` ink neighbours becomes ink; equality
/// changes nothing. Large changes are undone in the end (`maxChangePx`, our own).
Result<FilteredImage> neighbourhoodFilter(const BitImage&, const FilterParams&, const RunContext&);

/// One step of each, for tests and for stepping through.
BitImage erode(const BitImage&, int coefficient, FilterBorder, const RunContext&);
BitImage dilate(const BitImage&, int coefficient, FilterBorder, const RunContext&);

}  // namespace batten
