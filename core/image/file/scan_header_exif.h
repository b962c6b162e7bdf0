// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/file/scan_header.h"

namespace batten {

/// Headers of JPEG and TIFF, which share the tags of EXIF; each expects that the first bytes are those of its format.
ScanHeader readJpegHeader(const ByteReader& file);
/// @param page from 1; a header without a size if the file has no such page, `pages` says how many it has.
ScanHeader readTiffHeader(const ByteReader& file, int page);

/// Resolution and orientation as a directory of a TIFF states them; absent: not stated, or not plausible.
struct TiffTags {
  struct Orientation {
    int value = 1;         ///< 1..8
    std::uint64_t at = 0;  ///< Where it is written.
  };
  std::optional<double> dpi;
  std::optional<Orientation> orientation;
  std::optional<double> focal35Mm;  ///< [mm] Focal length, of film of 35 mm.
  /// The header with what is stated here.
  ScanHeader in(ScanHeader header) const;
};
/// Of a TIFF structure (also that inside EXIF): of its first directory, or of another one.
TiffTags readTiffTags(const ByteReader& tiff);
TiffTags readTiffTags(const ByteReader& tiff, std::uint64_t directory);

}  // namespace batten
