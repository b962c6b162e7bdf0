// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/file/scan_header.h"

namespace batten {

/// Whether the bytes begin as JPEG 2000: a file of boxes (JP2) or a bare codestream.
bool isJpeg2000(const ByteReader& file);

/// Size, depth and resolution (ITU-T T.800, annexes A and I), and whether every part of every tile lies inside the
/// file. Not supported: signed samples, more than 16 bit, components of other sizes, more than four of them.
/// @pre isJpeg2000(file)
ScanHeader readJpeg2000Header(const ByteReader& file);

}  // namespace batten
