// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"

namespace batten {

/// A page as tones are searched on it.
struct ToneCopy {
  const GreyImage* page = nullptr;        ///< Never null, and must outlive this.
  int pixelsPerPx = 1;                    ///< Pixels of the page along one of the copy.
  std::optional<GreyImage> smaller = {};  ///< Absent: the page is small enough itself.
  const GreyImage& searched() const { return smaller ? *smaller : *page; }
};
/// Absent: the page is uniform or too narrow to be shaded.
std::optional<ToneCopy> toneCopyOf(const GreyImage& page, const RunContext&);

/// Where a page is shaded, and how bright it is there without its lines.
struct ToneAreas {
  int pixelsPerPx = 1;        ///< Pixels of the page along one of `ground`.
  int columns = 0, rows = 0;  ///< Of `ground`.
  /// [0..255 of the paper's brightness] What lines are drawn on, row by row: 255 where nothing is shaded.
  std::vector<std::uint8_t> ground;
  static constexpr double kGainUnit = 16.0;
  static constexpr double kGrainGain = 0.15;  ///< Of a pencil's grain: what is left is fainter than that of paper.
  /// [1 / kGainUnit] The depth below the ground is multiplied by what the ground is darker than the paper, but at most
  /// by this, row by row: more, and the grain of the tone is as deep as lines.
  struct MostGain {
    std::vector<std::uint8_t> units;
  };
  /// [1 / kGainUnit] It is multiplied by this, row by row.
  struct KnownGain {
    std::vector<std::uint8_t> units;
  };
  std::variant<MostGain, KnownGain> gain;
  std::vector<std::uint8_t> paper;  ///< [grey 0..255] What the ground is a share of, row by row.
  /// Not 0 along sharp borders that no line is drawn along, row by row. Absent: there are none.
  std::optional<std::vector<std::uint8_t>> bare;
  /// 255 where an area was filled with hatching and becomes as dark as lines all over, row by row. Absent: none was.
  std::optional<std::vector<std::uint8_t>> filled;
  double lineWidthPx = 0.0;   ///< [px of the page] Of the lines.
  double lineDarkness = 0.0;  ///< [of 255] Of the lines.
  double share = 0.0;         ///< 0..1 of the page is clearly shaded.
  bool leavesFull = false;    ///< An area stays ink only because lines cover much of it.
};

/// Finds areas of even tone that lines are drawn on and around, as the shading of marker or airbrush: wider than any
/// line, lighter than the lines on them, smooth inside, and bounded by lines, or by a gradual fade where it has
/// none. An area that ends in a sharp edge without a line nearly all along, or has no lines, is a shape and stays ink;
/// so do black, and areas of hatching and of grain.
/// @return Absent: there are none, or the search was cancelled.
std::optional<ToneAreas> findToneAreas(const ToneCopy&, const RunContext&);
/// The same with areas that lines cover more than a third of: lines drawn close together, but hatching and grain, too.
std::optional<ToneAreas> findToneAreasFullOfLines(const ToneCopy&, const RunContext&);

}  // namespace batten
