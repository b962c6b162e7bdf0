// SPDX-License-Identifier: GPL-3.0-or-later
// DXF as an independent reader sees it: ezdxf in Python.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/curve/closest_point.h"
#include "core/exchange/export_file.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

struct SeenEntity {
  std::string kind;
  int degree = 0;
  std::vector<Vec2> places;
};
struct SeenFile {
  int units = -1, errors = -1;
  std::vector<SeenEntity> entities;
};

SeenFile seenByEzdxf(const ExportDocument& document, const ExportSettings& settings) {
  const fs::path folder = fs::temp_directory_path() / ("batten-ezdxf-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const auto report = exportToFile(document, settings, folder / "a.dxf");
  EXPECT_TRUE(report) << (report ? "" : report.error().message);
  const std::string command = "/usr/bin/python3 '" BATTEN_TEST_DATA "/../judges/ezdxf_samples.py' '" +
                              (folder / "a.dxf").string() + "' >'" + (folder / "out").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "install python3-ezdxf";
  SeenFile file;
  std::ifstream in(folder / "out");
  std::string word;
  in >> word >> file.units >> word >> file.errors;
  std::size_t count = 0;
  for (SeenEntity entity; in >> entity.kind >> entity.degree >> count;) {
    entity.places.resize(count);
    for (Vec2& p : entity.places) in >> p.x() >> p.y();
    file.entities.push_back(entity);
  }
  fs::remove_all(folder);
  return file;
}

TEST(Ezdxf, SeesEveryCurveToABillionthOfAMillimetre) {
  for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
    const ExportDocument document = test::exportOfAllDegrees();
    ExportSettings settings;
    settings.format = ExportFormat::Dxf;
    settings.unit = unit;
    const SeenFile file = seenByEzdxf(document, settings);
    EXPECT_EQ(file.units, unit == LengthUnit::Inch ? 1 : 4);
    EXPECT_EQ(file.errors, 0);
    ASSERT_EQ(file.entities.size(), 17u);
    std::size_t next = 0;
    for (const ExportCurve& line : document.curves) {
      for (const ExportPiece& piece : line.pieces) {
        const SeenEntity& entity = file.entities[next++];
        ASSERT_EQ(entity.places.size(), 201u) << entity.kind;
        if (entity.kind == "SPLINE") {
          EXPECT_EQ(entity.degree, piece.curve.degree()) << line.id;
        }
        for (std::size_t i = 0; i <= 200; ++i) {
          const Vec2 mm = millimetresPer(unit) * entity.places[i];
          const double u =
              piece.curve.start() + (piece.curve.end() - piece.curve.start()) * static_cast<double>(i) / 200;
          const double off =
              entity.kind == "SPLINE" ? (mm - piece.curve.point(u)).norm() : closestPoint(piece.curve, mm).distance;
          EXPECT_LE(off, 1e-9) << line.id << " " << i;
        }
      }
    }
  }
}

TEST(Ezdxf, FindsNoErrorInAnyProfile) {
  const std::map<DxfProfile, std::string> kinds = {{DxfProfile::Laser, "SPLINE"}, {DxfProfile::Cnc, "POLYLINE"}};
  for (const auto& [profile, kind] : kinds) {
    ExportSettings settings;
    settings.format = ExportFormat::Dxf;
    settings.dxf = profile;
    settings.splinesOnly = true;
    const SeenFile file = seenByEzdxf(test::exportOfAllKinds(), settings);
    EXPECT_EQ(file.errors, 0);
    EXPECT_GE(file.entities.size(), 8u);
    for (const SeenEntity& entity : file.entities) {
      EXPECT_EQ(entity.kind, kind);
      EXPECT_LE(entity.degree, 3);
    }
  }
}

}  // namespace
}  // namespace batten
