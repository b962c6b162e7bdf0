// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/scan_header.h"

namespace batten {

/// Headers of JPEG and TIFF, which share the tags of EXIF; each expects that the first bytes are those of its format.
ScanHeader readJpegHeader(const ByteReader& file);
ScanHeader readTiffHeader(const ByteReader& file);

/// Resolution and orientation of a TIFF structure (also that inside EXIF).
void readTiffTags(const ByteReader& tiff, ScanHeader& header);

}  // namespace batten
