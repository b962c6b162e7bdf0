// SPDX-License-Identifier: GPL-3.0-or-later
// 3DM: the bytes by the layout of OpenNURBS, and what is read back. OpenNURBS itself judges them in
// tests/heavy/exports.sh.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <set>

#include "core/curve/closest_point.h"
#include "core/exchange/cad/rhino_reader.h"
#include "core/exchange/export_file.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

ExportSettings rhino(LengthUnit unit = LengthUnit::Millimetre) {
  ExportSettings settings;
  settings.format = ExportFormat::Rhino;
  settings.unit = unit;
  return settings;
}

std::string rhinoFileOf(const ExportDocument& document, const ExportSettings& settings) {
  const auto file = exportedFile(document, settings);
  EXPECT_TRUE(file) << (file ? "" : file.error().message + file.error().detail);
  return file ? file->bytes : std::string();
}

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + i))) << (8 * i);
  return value;
}
double realAt(const std::string& bytes, std::size_t at) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(numberAt(bytes, at)) |
                               static_cast<std::uint64_t>(numberAt(bytes, at + 4)) << 32);
}

/// Bit by bit, as the polynomial says.
std::uint32_t checkSum(const std::string& bytes) {
  std::uint32_t value = 0xffffffff;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xedb88320U : 0U);
  }
  return ~value;
}

/// A NURBS curve where its class begins, by offsets.
struct StoredCurve {
  std::uint32_t order = 0, points = 0, knots = 0;
  std::vector<double> knotValues, pointValues;
  bool hasCheckSum = false;
};
std::vector<StoredCurve> storedCurves(const std::string& bytes) {
  const std::string id("\xdd\xd4\xd7\x4e\x47\xe9\xd3\x11\xbf\xe5\x00\x10\x83\x01\x22\xf0", 16);
  std::vector<StoredCurve> curves;
  for (auto at = bytes.find(id); at != std::string::npos; at = bytes.find(id, at + 1)) {
    const std::size_t chunk = at + 16 + 4;  // behind the id's check sum
    EXPECT_EQ(numberAt(bytes, chunk), 0x0002fffcU);
    const std::uint32_t length = numberAt(bytes, chunk + 4);
    const std::string content = bytes.substr(chunk + 8, length - 4);
    StoredCurve curve;
    curve.hasCheckSum = numberAt(bytes, chunk + 8 + length - 4) == checkSum(content);
    EXPECT_EQ(content[0], 0x10);
    EXPECT_EQ(numberAt(content, 1), 3u) << "dimension";
    const bool isRational = numberAt(content, 5) != 0;
    curve.order = numberAt(content, 9);
    curve.points = numberAt(content, 13);
    curve.knots = numberAt(content, 17 + 8 + 48);
    std::size_t next = 17 + 8 + 48 + 4;
    for (std::uint32_t i = 0; i < curve.knots; ++i, next += 8) curve.knotValues.push_back(realAt(content, next));
    EXPECT_EQ(numberAt(content, next), curve.points);
    next += 4;
    for (; next + 8 <= content.size(); next += 8) curve.pointValues.push_back(realAt(content, next));
    EXPECT_EQ(next, content.size());
    EXPECT_EQ(curve.pointValues.size(), curve.points * (isRational ? 4u : 3u));
    curves.push_back(std::move(curve));
  }
  return curves;
}

class Rhino : public testing::TestWithParam<LengthUnit> {};

TEST_P(Rhino, HoldsEveryDegreeExactly) {
  const ExportDocument document = test::exportOfAllDegrees();
  const auto drawing = readRhino(rhinoFileOf(document, rhino(GetParam())));
  ASSERT_TRUE(drawing) << drawing.error().message;
  const double mm = millimetresPer(GetParam());
  EXPECT_EQ(drawing->mmPerUnit, mm);
  ASSERT_EQ(drawing->entities.size(), 17u);
  std::size_t next = 0;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      const CadEntity& entity = drawing->entities[next++];
      ASSERT_TRUE(std::holds_alternative<NurbsCurve>(entity.shape));
      const auto& found = std::get<NurbsCurve>(entity.shape);
      const std::vector<double> knots(found.knots().begin(), found.knots().end());
      const std::vector<Vec2> points(found.controlPoints().begin(), found.controlPoints().end());
      const std::vector<double> weights(found.weights().begin(), found.weights().end());
      // Lines, arcs and circles are held by their simplest curve, whose parameter is another.
      const bool sameParameter = found.degree() == piece.curve.degree() && found.degree() > 2;
      for (int i = 0; i <= 200; ++i) {
        const Vec2 place = mm * test::splineByDefinition(found.degree(), knots, points, weights, i / 200.0);
        const double u = piece.curve.start() + (piece.curve.end() - piece.curve.start()) * i / 200.0;
        EXPECT_LE(sameParameter ? (place - piece.curve.point(u)).norm() : closestPoint(piece.curve, place).distance,
                  1e-9)
            << line.id;
      }
      if (line.pieces.size() == 1) {
        EXPECT_EQ(entity.name, line.id);
      }
      EXPECT_EQ(entity.layer, "Faired");
    }
  }
}

TEST_P(Rhino, BytesAreAsOpenNurbsLaysThemOut) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.resize(2);
  const std::string bytes = rhinoFileOf(document, rhino(GetParam()));
  EXPECT_TRUE(bytes.starts_with("3D Geometry File Format        3"));
  EXPECT_EQ(numberAt(bytes, bytes.size() - 12), 0x00007fffU);
  EXPECT_EQ(numberAt(bytes, bytes.size() - 4), bytes.size()) << "the end states the length";
  const auto units = bytes.find(std::string("\x31\x80\x00\x20", 4));
  ASSERT_NE(units, std::string::npos);
  EXPECT_EQ(numberAt(bytes, units + 12), GetParam() == LengthUnit::Inch ? 8u : 2u);
  const auto curves = storedCurves(bytes);
  ASSERT_EQ(curves.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const NurbsCurve& curve = document.curves[k].pieces[0].curve;
    const StoredCurve& stored = curves[k];
    EXPECT_TRUE(stored.hasCheckSum);
    EXPECT_EQ(stored.order, 6u);
    ASSERT_EQ(stored.points, curve.controlPoints().size());
    ASSERT_EQ(stored.knots, stored.points + 4) << "control points + degree - 1";
    EXPECT_EQ(std::count(stored.knotValues.begin(), stored.knotValues.end(), stored.knotValues[0]), 5);
    for (std::size_t i = 0; i < stored.points; ++i) {
      const Vec2 place = millimetresPer(GetParam()) * Vec2(stored.pointValues[3 * i], stored.pointValues[3 * i + 1]);
      EXPECT_LE((place - curve.controlPoints()[i]).norm(), 1e-12);
      EXPECT_EQ(stored.pointValues[3 * i + 2], 0.0);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Units, Rhino, testing::Values(LengthUnit::Millimetre, LengthUnit::Inch));

TEST(RhinoFile, NamesAndLayersSurviveWhateverTheirLetters) {
  ExportDocument document = test::exportOfAllKinds();
  document.curves.resize(3);
  document.curves[0].name = "It's süß, 漢字 😀";
  document.curves[1].layer = "Skizze (roh)";
  document.curves[2].layer = "漢字";
  const auto drawing = readRhino(rhinoFileOf(document, rhino()));
  ASSERT_TRUE(drawing);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(drawing->entities[i].layer, document.curves[i].layer);
  EXPECT_EQ(drawing->entities[0].name, document.curves[0].name);
}

TEST(RhinoFile, IsTheSameEachTimeAndRefusesNothing) {
  EXPECT_EQ(rhinoFileOf(test::exportOfAllDegrees(), rhino()), rhinoFileOf(test::exportOfAllDegrees(), rhino()));
  EXPECT_EQ(exportedFile({}, rhino()).error().code, ErrorCode::NoCurve);
}

TEST(RhinoFile, DamageIsNoticed) {
  const std::string whole = rhinoFileOf(test::exportOfAllKinds(), rhino());
  for (std::size_t length = 0; length < whole.size(); length += 7)
    EXPECT_FALSE(readRhino(whole.substr(0, length))) << length;
  // A bit that turns in a curve is told by its check sum.
  const std::string id("\xdd\xd4\xd7\x4e\x47\xe9\xd3\x11\xbf\xe5\x00\x10\x83\x01\x22\xf0", 16);
  for (auto at = whole.find(id); at != std::string::npos; at = whole.find(id, at + 1)) {
    const std::size_t data = at + 28, length = numberAt(whole, at + 24);
    for (std::size_t behind = 0; behind < length; behind += 5) {
      std::string other = whole;
      other[data + behind] = static_cast<char>(other[data + behind] ^ 4);
      EXPECT_FALSE(readRhino(other)) << at << " " << behind;
    }
  }
  // Anything else is read or refused, and never more than there is.
  std::mt19937 random(5);
  for (int n = 0; n < 3000; ++n) {
    std::string other = whole;
    for (int k = 0; k < 3; ++k) other[random() % other.size()] = static_cast<char>(random());
    const auto drawing = readRhino(other);
    if (!drawing) {
      EXPECT_FALSE(drawing.error().message.empty());
    }
  }
}

}  // namespace
}  // namespace batten
