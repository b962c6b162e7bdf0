// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// What the header says of the samples and the decoder does not heed.
struct SampleMeaning {
  bool isTiff = false;
  bool minIsWhite = false;                     ///< TIFF: 0 is white.
  bool alphaAssociated = false;                ///< TIFF: the colours are multiplied by their alpha already.
  std::optional<std::uint16_t> transparent{};  ///< PNG, grey: the level as stored that stands for no ink at all.
  int bits = 8;                                ///< Of a stored sample.
};

/// A decoded picture: its grey and, if any pixel has colour, its colours.
struct DecodedPicture {
  GreyImage grey;
  ColourImage colour;
};

/// Decodes a file held in memory to grey: colour by the luma of Rec. 601 (.299 red, .587 green, .114 blue), which is
/// also JPEG's own grey; alpha laid over white. The orientation is left as stored. Empty if the file cannot be decoded.
std::optional<DecodedPicture> decodePicture(std::span<std::byte> file, const SampleMeaning&, const RunContext& context);

/// The picture rotated upright. @param orientation EXIF 1..8.
GreyImage rotateUpright(GreyImage image, int orientation, const RunContext& context);
ColourImage rotateUpright(ColourImage image, int orientation, const RunContext& context);

/// Drops the colours of a picture that has none: every pixel grey.
void dropGreyColours(ColourImage& colour, const RunContext& context);

}  // namespace batten
