// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/dxf_writer.h"

#include <dxflib/dl_dxf.h>

#include <QString>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/exchange/model/scratch_file.h"

namespace batten {
namespace {

constexpr const char* kApplication = "BATTEN";     // under which names are stored
constexpr int kPlanarSpline = 8;                   // flag
constexpr int kColours[] = {7, 1, 5, 3, 6, 4, 2};  ///< AutoCAD's colour numbers, one a layer, in their order.

/// UTF-8 as DXF keeps it; what a layer must not hold becomes a dash.
std::string dxfText(const std::string& utf8, bool isLayer) {
  std::string text;
  for (const QChar unit : QString::fromStdString(utf8)) {
    const char16_t c = unit.unicode();
    if (c < 0x20 || (isLayer && QStringView(u"<>/\\\":;?*|,=`").contains(unit))) {
      text += isLayer ? '-' : ' ';
    } else if (c < 0x7f) {
      text += static_cast<char>(c);
    } else {
      text += QStringLiteral("\\U+%1").arg(uint(c), 4, 16, QLatin1Char('0')).toUpper().toStdString();
    }
  }
  return text.empty() ? "0" : text;
}

class Writer {
 public:
  Writer(const CadDrawing& drawing, DxfProfile profile)
      : drawing_(drawing),
        isOld_(profile == DxfProfile::Cnc),
        isInch_(drawing.mmPerUnit == std::optional(kMillimetresPerInch)) {
    for (const CadEntity& entity : drawing.entities) {
      std::string layer = dxfText(entity.layer, true);
      if (std::find(layers_.begin(), layers_.end(), layer) == layers_.end()) layers_.push_back(std::move(layer));
    }
  }

  bool write(const std::string& path) {
    out_.reset(dxf_.out(path.c_str(), isOld_ ? DL_Codes::AC1009 : DL_Codes::AC1015));
    if (!out_) return false;
    header();
    tables();
    if (!isOld_) blocks();
    out_->sectionEntities();
    for (const CadEntity& entity : drawing_.entities) put(entity);
    out_->sectionEnd();
    if (!isOld_) {
      dxf_.writeObjects(*out_, kApplication);
      dxf_.writeObjectsEnd(*out_);
    }
    out_->dxfEOF();
    out_->close();
    return true;
  }

 private:
  void header() {
    dxf_.writeHeader(*out_);
    if (!isOld_) {  // R12 knows no units; what it is drawn in stands in a comment
      out_->dxfString(9, "$INSUNITS");
      out_->dxfInt(70, isInch_ ? 1 : 4);
      out_->dxfString(9, "$MEASUREMENT");
      out_->dxfInt(70, isInch_ ? 0 : 1);
    }
    out_->sectionEnd();
    out_->comment(isInch_ ? "Batten, unit inch" : "Batten, unit mm");
  }

  void tables() {
    out_->sectionTables();
    dxf_.writeVPort(*out_);
    out_->tableLinetypes(isOld_ ? 1 : 3);
    if (!isOld_) {
      dxf_.writeLinetype(*out_, DL_LinetypeData("BYBLOCK", "", 0, 0, 0.0));
      dxf_.writeLinetype(*out_, DL_LinetypeData("BYLAYER", "", 0, 0, 0.0));
    }
    dxf_.writeLinetype(*out_, DL_LinetypeData("CONTINUOUS", "Solid line", 0, 0, 0.0));
    out_->tableEnd();
    out_->tableLayers(static_cast<int>(layers_.size()) + 1);
    dxf_.writeLayer(*out_, DL_LayerData("0", 0), DL_Attributes("", 7, 25, "CONTINUOUS", 1.0));
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      if (layers_[i] == "0") continue;
      dxf_.writeLayer(*out_, DL_LayerData(layers_[i], 0),
                      DL_Attributes("", kColours[i % std::size(kColours)], 25, "CONTINUOUS", 1.0));
    }
    out_->tableEnd();
    if (!isOld_) moreTables();
    out_->sectionEnd();
  }

  void moreTables() {
    out_->tableStyle(1);
    dxf_.writeStyle(*out_, DL_StyleData("Standard", 0, 0.0, 1.0, 0.0, 0, 2.5, "txt", ""));
    out_->tableEnd();
    dxf_.writeView(*out_);
    dxf_.writeUcs(*out_);
    out_->tableAppid(2);
    dxf_.writeAppid(*out_, "ACAD");
    dxf_.writeAppid(*out_, kApplication);
    out_->tableEnd();
    dxf_.writeDimStyle(*out_, 1.0, 1.0, 1.0, 1.0, 1.0);
    dxf_.writeBlockRecord(*out_);
    out_->tableEnd();
  }

  void blocks() {
    out_->sectionBlocks();
    for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
      dxf_.writeBlock(*out_, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
      dxf_.writeEndBlock(*out_, name);
    }
    out_->sectionEnd();
  }

  void put(const CadEntity& entity) {
    const DL_Attributes look(dxfText(entity.layer, true), 256, -1, "BYLAYER", 1.0);
    if (const auto* line = std::get_if<CadLine>(&entity.shape)) {
      dxf_.writeLine(*out_, DL_LineData(line->from.x(), line->from.y(), 0.0, line->to.x(), line->to.y(), 0.0), look);
    } else if (const auto* arc = std::get_if<CadArc>(&entity.shape)) {
      put(*arc, look);
    } else if (const auto* polyline = std::get_if<CadPolyline>(&entity.shape)) {
      put(*polyline, look);
    } else {
      put(std::get<NurbsCurve>(entity.shape), look);
    }
    if (isOld_) return;
    out_->dxfString(1001, kApplication);
    out_->dxfString(1000, dxfText(entity.name, false));
  }

  void put(const CadArc& arc, const DL_Attributes& look) {
    if (isCircle(arc)) {
      dxf_.writeCircle(*out_, DL_CircleData(arc.centre.x(), arc.centre.y(), 0.0, arc.radius), look);
      return;
    }
    const auto angle = [&](double radians) {
      const double degrees = std::fmod(radians * kDegPerRad, 360.0);
      return degrees < 0.0 ? degrees + 360.0 : degrees;
    };
    dxf_.writeArc(*out_,
                  DL_ArcData(arc.centre.x(), arc.centre.y(), 0.0, arc.radius, angle(arc.startRad),
                             angle(arc.startRad + arc.sweepRad)),
                  look);
  }

  void put(const CadPolyline& line, const DL_Attributes& look) {
    const int count = static_cast<int>(line.vertices.size());
    dxf_.writePolyline(*out_, DL_PolylineData(count, 0, 0, line.closed ? 1 : 0), look);
    for (const CadVertex& vertex : line.vertices)
      dxf_.writeVertex(*out_, DL_VertexData(vertex.point.x(), vertex.point.y(), 0.0, vertex.bulge));
    dxf_.writePolylineEnd(*out_);
  }

  void put(const NurbsCurve& curve, const DL_Attributes& look) {
    dxf_.writeSpline(*out_,
                     DL_SplineData(curve.degree(), static_cast<int>(curve.knots().size()), curve.controlPointCount(), 0,
                                   kPlanarSpline | (curve.isRational() ? 4 : 0)),
                     look);
    for (const double knot : curve.knots()) dxf_.writeKnot(*out_, DL_KnotData(knot));
    for (const double weight : curve.weights()) out_->dxfReal(41, weight);
    for (const Vec2& p : curve.controlPoints())
      dxf_.writeControlPoint(*out_, DL_ControlPointData(p.x(), p.y(), 0.0, 1.0));
  }

  const CadDrawing& drawing_;
  bool isOld_, isInch_;
  std::vector<std::string> layers_;
  DL_Dxf dxf_;
  std::unique_ptr<DL_WriterA> out_;
};

}  // namespace

Result<std::string> writeDxf(const CadDrawing& drawing, DxfProfile profile) {
  // The library writes to files only.
  const auto file = ScratchFile::create();
  if (!file) return fail(file.error());
  const bool isWritten = Writer(drawing, profile).write(file->path());
  std::string bytes = file->read();
  const auto last = bytes.find_last_not_of(" \r\n");
  if (!isWritten || last == std::string::npos || !std::string_view(bytes).substr(0, last + 1).ends_with("EOF"))
    return fail(ErrorCode::CannotWrite, "The folder for temporary files cannot be written to. Free some space there.");
  return bytes;
}

}  // namespace batten
