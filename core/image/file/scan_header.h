// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/conventions.h"
#include "core/image/file/byte_reader.h"
#include "core/image/file/scan_grey.h"
#include "core/image/scan.h"

namespace batten {

inline constexpr double kMetresPerInch = kMillimetresPerInch / 1000.0;  // PNG and JPEG 2000 state pixels per metre

struct ScanHeader {
  ScanInfo info;
  bool complete = true;      ///< False: the file ends before its picture does.
  bool progressive = false;  ///< Its decoder keeps the whole page's coefficients.
  bool supported = true;     ///< False: a kind of picture that cannot be read (floating point, 32 bit).
  std::optional<std::uint64_t> orientationAt;  ///< TIFF: where the orientation is written.
  bool bigEndian = true;
  std::uint64_t tilePixels = 0;  ///< [px] TIFF: of one tile, which may be larger than the picture; 0 without tiles.
  SampleMeaning meaning;
  int pages = 1;                             ///< TIFF: pictures in the file, thumbnails not counted.
  std::optional<std::uint64_t> directoryAt;  ///< TIFF: where the directory of the page lies.
  std::uint64_t workBytes = 0;               ///< [bytes] JPEG 2000: what its decoder takes beside the picture.
};

/// Reads the header of whichever format the bytes are; empty when they are none of those that can be read.
/// @param page of a TIFF, from 1; beyond the last one the header has no size.
std::optional<ScanHeader> readScanHeader(const ByteReader& file, int page = 1);

/// The parts of readScanHeader; each expects that the first bytes are those of its format.
ScanHeader readPngHeader(const ByteReader& file);
ScanHeader readBmpHeader(const ByteReader& file);
ScanHeader readWebpHeader(const ByteReader& file);
ScanHeader readPnmHeader(const ByteReader& file);

/// Dots per inch if both axes agree and the number is one that scanners and cameras write.
std::optional<double> plausibleDpi(double xDpi, double yDpi);
/// The same of dots per metre, which files have as whole numbers or fractions: 300 dpi is written as 11811 and comes
/// back as 299.9994.
std::optional<double> plausibleDpiOfMetres(double xPerMetre, double yPerMetre);

}  // namespace batten
