// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/rhino_writer.h"

#include <QString>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <vector>

#include "core/base/conventions.h"
#include "core/exchange/cad/rhino_chunks.h"

namespace batten {

namespace rhino {
namespace {

/// Content of a chunk, little-endian.
class Bytes {
 public:
  Bytes& byte(std::uint8_t value) {
    text_.push_back(static_cast<char>(value));
    return *this;
  }
  Bytes& number(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) byte(static_cast<std::uint8_t>(value >> shift));
    return *this;
  }
  Bytes& real(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) byte(static_cast<std::uint8_t>(bits >> shift));
    return *this;
  }
  Bytes& raw(std::string_view bytes) {
    text_.append(bytes);
    return *this;
  }
  /// UTF-16 with its terminating zero, which counts; an empty text is a count of 0 alone.
  Bytes& words(const std::string& utf8) {
    const QString text = QString::fromStdString(utf8);
    if (text.isEmpty()) return number(0);
    number(static_cast<std::uint32_t>(text.size()) + 1);
    for (const QChar unit : text)
      byte(static_cast<std::uint8_t>(unit.cell())).byte(static_cast<std::uint8_t>(unit.row()));
    return byte(0).byte(0);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string shortChunk(std::uint32_t code, std::uint32_t value) { return Bytes().number(code).number(value).text(); }

/// @param isDirect the content is numbers alone, which a CRC is taken of; of chunks within chunks it is 0.
std::string chunk(std::uint32_t code, const std::string& content, bool isDirect = true) {
  const bool hasCrc = (code & kHasCrc) != 0 && (code & kShort) == 0;
  Bytes bytes;
  bytes.number(code).number(static_cast<std::uint32_t>(content.size()) + (hasCrc ? 4 : 0)).raw(content);
  if (hasCrc) bytes.number(isDirect ? crc32(content) : 0);
  return bytes.text();
}

std::string table(std::uint32_t code, const std::string& content) {
  return chunk(code, content + shortChunk(kEndOfTable, 0), false);
}

std::string instance(std::string_view id, const std::string& data) {
  return chunk(kClass, chunk(kClassId, std::string(id)) + chunk(kClassData, data) + shortChunk(kClassEnd, 0), false);
}

std::string units(double mmPerUnit) {
  // of the record; decimals of numbers on the screen
  constexpr std::uint32_t kRhinoVersion = 102, kRhinoDecimals = 3;
  // what Rhino has by itself: unit, rad, share
  constexpr double kAbsoluteTolerance = 0.001, kAngleTolerance = 0.0174532925199433, kRelativeTolerance = 0.01;
  constexpr double kMetresPerMm = 0.001;  // the record is in metres
  const std::uint32_t unit = mmPerUnit == kMillimetresPerInch ? kInches : kMillimetres;
  return Bytes()
      .number(kRhinoVersion)
      .number(unit)
      .real(kAbsoluteTolerance)
      .real(kAngleTolerance)
      .real(kRelativeTolerance)
      .number(0)
      .number(kRhinoDecimals)
      .real(kMetresPerMm * mmPerUnit)
      .number(0)
      .text();
}

std::string layer(const std::string& name, std::uint32_t index) {
  constexpr std::uint8_t kRhinoVersion = 0x11;                                      // 1.1 of the record
  constexpr std::uint32_t kNone = 0xffffffff;                                       // of a reference
  constexpr std::array<std::uint32_t, 2> kRhinoColours = {0x00000000, 0x002000b0};  // 0x00BBGGRR: black, then red
  return Bytes()
      .byte(kRhinoVersion)
      .number(0)
      .number(index)
      .number(kNone)
      .number(kNone)
      .number(0)
      .number(kRhinoColours[index % kRhinoColours.size()])
      .number(0)
      .real(0.0)
      .real(1.0)
      .words(name)
      .byte(1)
      .text();
}

std::string nurbs(const NurbsCurve& curve) {
  constexpr std::uint8_t kRhinoVersion = 0x10;  // 1.0 of the record
  constexpr std::uint32_t kDimension = 3;       // z is 0
  const auto points = curve.controlPoints();
  const auto knots = curve.knots();
  Bytes bytes;
  bytes.byte(kRhinoVersion).number(kDimension).number(curve.isRational() ? 1 : 0);
  bytes.number(static_cast<std::uint32_t>(curve.degree()) + 1).number(static_cast<std::uint32_t>(points.size()));
  bytes.number(0).number(0);
  // Invalid bounding box: the reader computes its own.
  for (const double side : {1.0, 0.0, 0.0, -1.0, 0.0, 0.0}) bytes.real(side);
  bytes.number(static_cast<std::uint32_t>(knots.size()) - 2);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) bytes.real(knots[i]);
  bytes.number(static_cast<std::uint32_t>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double weight = curve.isRational() ? curve.weights()[i] : 1.0;
    bytes.real(weight * points[i].x()).real(weight * points[i].y()).real(0.0);
    if (curve.isRational()) bytes.real(weight);
  }
  return bytes.text();
}

/// An id that no other object of the file has: its place in the file, within a name space of Batten's own.
std::string objectId(std::uint32_t index) {
  return Bytes().number(index + 1).number(0x4c0e42b7).number(0x6e745fa9).number(0x21d0c38e).text();
}

std::string attributes(const CadEntity& entity, std::uint32_t index, std::uint32_t layerIndex) {
  constexpr std::uint8_t kRhinoVersion = 0x12;  // 1.2 of the record
  constexpr std::uint32_t kNone = 0xffffffff;   // of a reference
  return Bytes()
      .byte(kRhinoVersion)
      .raw(objectId(index))
      .number(layerIndex)
      .number(kNone)
      .number(0)
      .number(0)
      .real(0.0)
      .real(1.0)
      .number(1)
      .number(0)
      .words(entity.name)
      .number(0)
      .number(0)
      .byte(1)
      .text();
}

}  // namespace
}  // namespace rhino

Result<CadDrawing> curvesOnly(const CadDrawing& drawing) {
  CadDrawing result = drawing;
  for (CadEntity& entity : result.entities) {
    auto curve = curveOf(entity.shape);
    if (!curve) return fail(curve.error());
    entity.shape = std::move(*curve);
  }
  return result;
}

Result<std::string> writeRhino(const CadDrawing& drawing) {
  using namespace rhino;
  constexpr std::uint32_t kAsVersion = 200409090;  // a library of the time of version 3
  std::map<std::string, std::uint32_t> layers;
  std::vector<std::string> names;
  std::string objects;
  for (std::size_t i = 0; i < drawing.entities.size(); ++i) {
    const CadEntity& entity = drawing.entities[i];
    const auto* curve = std::get_if<NurbsCurve>(&entity.shape);
    if (curve == nullptr) return fail(ErrorCode::CannotWrite, "A 3DM holds curves only.");
    const auto [known, isNew] = layers.emplace(entity.layer, static_cast<std::uint32_t>(layers.size()));
    if (isNew) names.push_back(entity.layer);
    const auto index = static_cast<std::uint32_t>(i);
    objects += chunk(kObject,
                     shortChunk(kObjectKind, kCurveKind) + instance(kNurbsCurveId, nurbs(*curve)) +
                         chunk(kObjectAttributes, attributes(entity, index, known->second)) + shortChunk(kObjectEnd, 0),
                     false);
  }
  std::string layerRecords;
  for (std::size_t i = 0; i < names.size(); ++i)
    layerRecords += chunk(kLayer, instance(kLayerId, layer(names[i], static_cast<std::uint32_t>(i))), false);
  std::string file(kHead);
  file += chunk(kComment, std::string(" Batten\n\x1a\0", 10));
  file += table(kProperties, shortChunk(kLibraryVersion, kAsVersion));
  file += table(kSettings, chunk(kUnits, units(drawing.mmPerUnit.value_or(1.0))));
  file += table(kMaterialTable, {}) + table(kLayerTable, layerRecords) + table(kLightTable, {});
  file += table(kObjectTable, objects);
  constexpr std::uint32_t kEndLength = 12;  // bytes of the last chunk, which states the length of the file
  return file + chunk(kEndOfFile, Bytes().number(static_cast<std::uint32_t>(file.size()) + kEndLength).text());
}

}  // namespace batten
