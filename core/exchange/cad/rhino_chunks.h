// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace batten::rhino {

/// Codes of the chunks of a 3DM that hold what Batten writes (OpenNURBS, opennurbs_3dm.h). A chunk is its code, 4
/// bytes, and its length or, where the highest bit is set, its value, 4 bytes.
enum Code : std::uint32_t {
  kComment = 0x00000001,
  kEndOfFile = 0x00007fff,
  kMaterialTable = 0x10000010,
  kLayerTable = 0x10000011,
  kLightTable = 0x10000012,
  kObjectTable = 0x10000013,
  kProperties = 0x10000014,
  kSettings = 0x10000015,
  kLibraryVersion = 0xa0000026,
  kUnits = 0x20008031,
  kLayer = 0x20008050,
  kObject = 0x20008070,
  kObjectKind = 0x82000071,
  kObjectAttributes = 0x02008072,
  kObjectEnd = 0x8200007f,
  kClass = 0x00027ffa,
  kClassId = 0x0002fffb,
  kClassData = 0x0002fffc,
  kClassEnd = 0x80027fff,
  kEndOfTable = 0xffffffff,
};
inline constexpr std::uint32_t kShort = 0x80000000;   ///< Bit of codes whose second number is a value.
inline constexpr std::uint32_t kHasCrc = 0x00008000;  ///< Bit of codes whose content ends with a CRC-32.

inline constexpr std::string_view kHead = "3D Geometry File Format        3";  // of the file
/// Classes by their 16 bytes, as they stand in the file.
inline constexpr std::string_view kNurbsCurveId{"\xdd\xd4\xd7\x4e\x47\xe9\xd3\x11\xbf\xe5\x00\x10\x83\x01\x22\xf0", 16};
// a class
inline constexpr std::string_view kLayerId{"\x13\x98\x80\x95\x85\xe9\xd3\x11\xbf\xe5\x00\x10\x83\x01\x22\xf0", 16};
inline constexpr std::uint32_t kCurveKind = 4;                 // of objects: 4 is a curve
inline constexpr std::uint32_t kMillimetres = 2, kInches = 8;  ///< Of the unit chunk.

/// CRC-32 as in zlib, of IEEE 802.3.
std::uint32_t crc32(std::string_view bytes);

}  // namespace batten::rhino
