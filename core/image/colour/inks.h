// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// What an ink is known by: its hue against the paper, or none for black, grey and pencil. A hue is the same at the
/// edge of a stroke and in its middle, in thin ink and in thick.
struct InkColour {
  std::optional<double> hueDeg{};  ///< 0..360: 0 red, 60 yellow, 120 green, 180 cyan, 240 blue, 300 magenta.
  bool operator==(const InkColour&) const = default;
};

/// Which inks are traced.
struct InkChoice {
  std::vector<InkColour> keep;  ///< Only these; none: all.
  std::vector<InkColour> drop;  ///< But not these.
  double rangeDeg = 30.0;       ///< 5..90: how far a hue may lie from the chosen one.
  bool isAll() const { return keep.empty() && drop.empty(); }
  bool operator==(const InkChoice&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const InkChoice&);

/// Whether two inks lie within a range of hues of one another.
bool isSameInk(const InkColour& a, const InkColour& b, double rangeDeg);

/// [degrees, 0..180] Between two hues; 0 if either ink has none.
double hueApartDeg(const InkColour& a, const InkColour& b);
/// Whether a choice traces an ink.
bool isTraced(const InkColour& ink, const InkChoice& choice);

/// An ink of the page, as a colour to show it by.
struct FoundInk {
  InkColour colour;
  Rgb8 shown;
  double share = 0.0;  ///< 0..1 of the ink of the page.
  bool operator==(const FoundInk&) const = default;
};

/// The inks of a colour scan, black (if there is any) first, then by hue. Those that make less than a fiftieth of the
/// ink are left out. Empty for a scan without colours.
std::vector<FoundInk> findInks(const GreyImage&, const ColourImage&, const RunContext&);

struct DroppedInk {
  GreyImage grey;
  std::int64_t pixels = 0;  ///< Painted over.
};
/// `page` with the inks that are not wanted painted over with the paper around. Where a dropped stroke is crossed by a
/// kept one, the kept one stays whole.
/// @param scan its own grey, which the colours were measured with.
/// @return absent: there is nothing to drop, or the run was cancelled.
std::optional<DroppedInk> dropInks(const GreyImage& page, const GreyImage& scan, const ColourImage&, const InkChoice&,
                                   const RunContext&);

}  // namespace batten
