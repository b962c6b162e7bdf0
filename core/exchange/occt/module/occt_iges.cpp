// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/module/occt_iges.h"

#include <IGESAppli_LevelFunction.hxx>
#include <IGESBasic_Name.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_LevelListEntity.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <IGESGeom_CircularArc.hxx>
#include <IGESGeom_Line.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_FloatWriter.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfXYZ.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/conventions.h"
#include "core/exchange/occt/module/occt_session.h"

namespace batten {
namespace {

constexpr double kResolution = 1e-6;     ///< [unit of the file] Stated in the global section.
constexpr int kIges53 = 11;              // number of version 5.3 in the format
constexpr std::size_t kLabelLength = 8;  // characters

Handle(TCollection_HAsciiString) text(const std::string& s) { return new TCollection_HAsciiString(s.c_str()); }

gp_XYZ place(const Vec2& p) { return {p.x(), p.y(), 0.0}; }

Handle(IGESData_IGESEntity) splineEntity(const PlainSpline& curve) {
  const int degree = curve.degree, upper = static_cast<int>(curve.points.size()) - 1;
  Handle(TColStd_HArray1OfReal) knots = new TColStd_HArray1OfReal(-degree, upper + 1);
  for (int i = 0; i < static_cast<int>(curve.knots.size()); ++i) knots->SetValue(i - degree, curve.knots[i]);
  const bool isRational = !curve.weights.empty();
  Handle(TColStd_HArray1OfReal) weights = new TColStd_HArray1OfReal(0, upper, 1.0);
  Handle(TColgp_HArray1OfXYZ) poles = new TColgp_HArray1OfXYZ(0, upper);
  for (int i = 0; i <= upper; ++i) {
    poles->SetValue(i, place(curve.points[i]));
    if (isRational) weights->SetValue(i, curve.weights[i]);
  }
  const bool isClosed = curve.points.front() == curve.points.back();
  const double start = curve.knots[degree], end = curve.knots[upper + 1];  // of the domain
  Handle(IGESGeom_BSplineCurve) entity = new IGESGeom_BSplineCurve;
  entity->Init(upper, degree, true, isClosed, !isRational, false, knots, weights, poles, start, end,
               gp_XYZ(0.0, 0.0, 1.0));
  return entity;
}

Handle(IGESData_IGESEntity) entityOf(const PlainShape& shape) {
  if (const auto* line = std::get_if<CadLine>(&shape)) {
    Handle(IGESGeom_Line) entity = new IGESGeom_Line;
    entity->Init(place(line->from), place(line->to));
    return entity;
  }
  if (const auto* arc = std::get_if<CadArc>(&shape)) {
    const Vec2 from = pointAt(*arc, 0.0), to = isCircle(*arc) ? from : pointAt(*arc, 1.0);
    Handle(IGESGeom_CircularArc) entity = new IGESGeom_CircularArc;
    entity->Init(0.0, gp_XY(arc->centre.x(), arc->centre.y()), gp_XY(from.x(), from.y()), gp_XY(to.x(), to.y()));
    return entity;
  }
  if (const auto* curve = std::get_if<PlainSpline>(&shape)) return splineEntity(*curve);
  return {};
}

/// ASCII letters and digits of a name, as many as a label holds.
std::string labelOf(const std::string& name) {
  std::string label;
  for (const char c : name) {
    if (label.size() == kLabelLength) break;
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (plain) label += c;
  }
  return label.empty() ? "CURVE" : label;
}

void describe(const Handle(IGESData_IGESModel) & model, const std::string& title, double largest) {
  IGESData_GlobalSection global = model->GlobalSection();
  global.SetSendName(text(title));
  global.SetFileName(text(title + ".igs"));
  global.SetReceiveName(text(title));
  global.SetSystemId(text("Batten"));
  global.SetInterfaceVersion(text("Batten"));
  global.SetAuthorName(text("Batten"));
  global.SetCompanyName(text("Batten"));
  global.SetScale(1.0);
  global.SetResolution(kResolution);
  global.SetMaxCoord(largest);
  global.SetIGESVersion(kIges53);
  global.SetDraftingStandard(0);
  model->SetGlobalSection(global);
}

std::optional<PlainShape> splineOf(const Handle(IGESGeom_BSplineCurve) & entity) {
  const int degree = entity->Degree(), count = entity->NbPoles();
  if (degree < 1 || degree > 7 || count < degree + 1) return std::nullopt;
  std::vector<double> knots, weights;
  std::vector<Vec2> points;
  for (int i = -degree; i <= count; ++i) knots.push_back(entity->Knot(i));
  for (int i = 0; i < count; ++i) {
    const gp_Pnt pole = entity->TransformedPole(i);
    points.emplace_back(pole.X(), pole.Y());
    weights.push_back(entity->Weight(i));
  }
  if (std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights.front(); })) weights.clear();
  return PlainSpline{degree, std::move(knots), std::move(points), std::move(weights)};
}

std::optional<PlainShape> arcOf(const Handle(IGESGeom_CircularArc) & entity) {
  const gp_Pnt centre = entity->TransformedCenter(), from = entity->TransformedStartPoint(),
               to = entity->TransformedEndPoint();
  if (!(entity->TransformedAxis().Z() > 0.5)) return std::nullopt;  // seen from behind
  const Vec2 c(centre.X(), centre.Y()), a = Vec2(from.X(), from.Y()) - c, b = Vec2(to.X(), to.Y()) - c;
  if (!(a.norm() > 0.0)) return std::nullopt;
  const double turn = std::atan2(cross(a, b), a.dot(b));
  const bool whole = a == b;
  return CadArc{c, a.norm(), std::atan2(a.y(), a.x()), whole ? kFullTurnRad : turn > 0.0 ? turn : turn + kFullTurnRad};
}

std::optional<PlainShape> shapeOf(const Handle(IGESData_IGESEntity) & entity) {
  if (const auto spline = Handle(IGESGeom_BSplineCurve)::DownCast(entity); !spline.IsNull()) return splineOf(spline);
  if (const auto arc = Handle(IGESGeom_CircularArc)::DownCast(entity); !arc.IsNull()) return arcOf(arc);
  if (const auto line = Handle(IGESGeom_Line)::DownCast(entity); !line.IsNull()) {
    const gp_Pnt from = line->TransformedStartPoint(), to = line->TransformedEndPoint();
    const CadLine shape{Vec2(from.X(), from.Y()), Vec2(to.X(), to.Y())};
    return shape.from == shape.to ? std::nullopt : std::optional<PlainShape>(shape);
  }
  return std::nullopt;
}

bool isCurve(int type) {
  return type >= 100 && type <= 130 && type != 106 && type != 108 && type != 116 && type != 124;
}

PlainDrawing drawingIn(const Handle(IGESData_IGESModel) & model) {
  PlainDrawing drawing;
  drawing.mmPerUnit = model->GlobalSection().UnitValue();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(IGESData_IGESEntity) entity = model->Entity(i);
    if (entity.IsNull() || !isCurve(entity->TypeNumber())) continue;
    auto shape = shapeOf(entity);
    if (!shape) {
      ++drawing.left;
      continue;
    }
    std::string name;
    for (Interface_EntityIterator it = entity->Properties(); it.More(); it.Next())
      if (const auto given = Handle(IGESBasic_Name)::DownCast(it.Value()); !given.IsNull() && !given->Value().IsNull())
        name = given->Value()->ToCString();
    drawing.entities.push_back({name, "Level " + std::to_string(entity->Level()), std::move(*shape)});
  }
  return drawing;
}

}  // namespace

Result<std::string> igesOf(const PlainDrawing& drawing, const std::string& title, double largest) {
  const OcctSession session;
  try {
    const bool isInch = drawing.mmPerUnit == std::optional(kMillimetresPerInch);
    IGESControl_Writer writer(isInch ? "INCH" : "MM", 0);
    const Handle(IGESData_IGESModel) model = writer.Model();
    std::vector<std::string> layers;
    std::vector<Handle(IGESAppli_LevelFunction)> names;  // of the layers: IGES has numbered levels
    for (const PlainEntity& entity : drawing.entities) {
      const Handle(IGESData_IGESEntity) made = entityOf(entity.shape);
      if (made.IsNull()) return occtFailed("write " + entity.name);
      auto level = std::find(layers.begin(), layers.end(), entity.layer);
      if (level == layers.end()) {
        level = layers.insert(layers.end(), entity.layer);
        names.push_back(new IGESAppli_LevelFunction);
        constexpr int kValues = 2, kOwnCode = 0;  // of the property: its own code is not used
        names.back()->Init(kValues, kOwnCode, text(entity.layer));
        names.back()->InitLevel(Handle(IGESData_LevelListEntity)(), static_cast<int>(std::ssize(layers)));
      }
      made->InitLevel(Handle(IGESData_LevelListEntity)(), static_cast<int>(level - layers.begin()) + 1);
      made->SetLabel(text(labelOf(entity.name)));
      Handle(IGESBasic_Name) name = new IGESBasic_Name;
      name->Init(1, text(entity.name));
      made->AddProperty(name);
      made->AddProperty(names[level - layers.begin()]);
      if (!writer.AddEntity(made)) return occtFailed("write " + entity.name);
    }
    writer.ComputeModel();
    describe(model, title, largest);
    IGESData_IGESWriter sections(model);
    sections.FloatWriter().SetFormat("%.15E");
    sections.FloatWriter().SetFormatForRange("%.16f", 0.1, 10.0);
    sections.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
    std::ostringstream out;
    out.imbue(std::locale::classic());
    if (!sections.Print(out)) return occtFailed("write the IGES");
    return out.str();
  } catch (const Standard_Failure& failure) {
    return occtFailed("write the IGES", failure.GetMessageString());
  }
}

Result<PlainDrawing> drawingOfIges(const std::string& path) {
  const auto damaged = [](std::string detail) {
    return fail(ErrorCode::BadParameter, "The IGES cannot be read: it is damaged or not an IGES file.",
                std::move(detail));
  };
  const OcctSession session;
  try {
    IGESControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return damaged("not read");
    const Handle(IGESData_IGESModel) model = reader.IGESModel();
    if (model.IsNull() || model->NbEntities() == 0) return damaged("no entity");
    return drawingIn(model);
  } catch (const Standard_Failure& failure) {
    return damaged(failure.GetMessageString());
  }
}

}  // namespace batten
