// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/module/occt_step_writer.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <QString>
#include <STEPConstruct_ContextTool.hxx>
#include <STEPConstruct_Part.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_ApplicationProtocolDefinition.hxx>
#include <StepBasic_MeasureValueMember.hxx>
#include <StepBasic_NamedUnit.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_Unit.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepGeom_Axis2Placement.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_HArray1OfCartesianPoint.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_Vector.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepRepr_MeasureRepresentationItem.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_PropertyDefinitionRepresentation.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <StepShape_GeometricCurveSet.hxx>
#include <StepShape_GeometricSetSelect.hxx>
#include <StepShape_GeometricallyBoundedWireframeShapeRepresentation.hxx>
#include <StepShape_HArray1OfGeometricSetSelect.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <sstream>

#include "core/base/conventions.h"
#include "core/exchange/occt/module/occt_session.h"

namespace batten {
namespace {

constexpr double kUncertainty = 1e-6;  ///< [unit of the file] Stated in the file.
constexpr int kAp214 = 4;              ///< The international standard, as Open CASCADE counts the schemas.

using Text = Handle(TCollection_HAsciiString);
using Items = std::vector<Handle(StepRepr_RepresentationItem)>;

/// A string as ISO 10303-21 spells it: \X2\ before and \X0\ behind UTF-16 in hexadecimal, for what is not ASCII, and
/// for backslashes, so that every one in the file is part of such a mark. The library doubles apostrophes, and the
/// backslashes, too: mended() takes one of each pair away.
Text text(const std::string& utf8) {
  std::string result;
  bool wide = false;
  for (const QChar unit : QString::fromStdString(utf8)) {
    const char16_t c = unit.unicode();
    const bool isWide = c > 0x7e || c < 0x20 || c == u'\\';
    if (isWide != wide) result += isWide ? "\\X2\\" : "\\X0\\";
    wide = isWide;
    result += isWide ? QString::number(uint(c), 16).rightJustified(4, QLatin1Char('0')).toUpper().toStdString()
                     : std::string(1, static_cast<char>(c));
  }
  if (wide) result += "\\X0\\";
  return new TCollection_HAsciiString(result.c_str());
}

Handle(StepGeom_CartesianPoint) point(const Vec2& p, const Text& name = text("")) {
  Handle(StepGeom_CartesianPoint) made = new StepGeom_CartesianPoint;
  made->Init3D(name, p.x(), p.y(), 0.0);
  return made;
}

Handle(StepGeom_Direction) direction(double x, double y, double z) {
  Handle(TColStd_HArray1OfReal) ratios = new TColStd_HArray1OfReal(1, 3);
  ratios->SetValue(1, x);
  ratios->SetValue(2, y);
  ratios->SetValue(3, z);
  Handle(StepGeom_Direction) made = new StepGeom_Direction;
  made->Init(text(""), ratios);
  return made;
}

Handle(StepGeom_Axis2Placement3d) axes(const Vec2& origin) {
  Handle(StepGeom_Axis2Placement3d) made = new StepGeom_Axis2Placement3d;
  made->Init(text(""), point(origin), true, direction(0, 0, 1), true, direction(1, 0, 0));
  return made;
}

Handle(StepGeom_Curve) trimmed(const Handle(StepGeom_Curve) & basis, const Text& name, double from, double to) {
  const auto end = [](double parameter) {
    StepGeom_TrimmingSelect select;
    select.SetParameterValue(parameter);
    Handle(StepGeom_HArray1OfTrimmingSelect) list = new StepGeom_HArray1OfTrimmingSelect(1, 1);
    list->SetValue(1, select);
    return list;
  };
  Handle(StepGeom_TrimmedCurve) made = new StepGeom_TrimmedCurve;
  made->Init(name, basis, end(from), end(to), true, StepGeom_tpParameter);
  return made;
}

Handle(StepGeom_Curve) lineCurve(const CadLine& line, const Text& name) {
  const Vec2 along = line.to - line.from;
  const double length = along.norm();
  Handle(StepGeom_Vector) vector = new StepGeom_Vector;
  vector->Init(text(""), direction(along.x() / length, along.y() / length, 0.0), 1.0);
  Handle(StepGeom_Line) made = new StepGeom_Line;
  made->Init(text(""), point(line.from), vector);
  return trimmed(made, name, 0.0, length);
}

Handle(StepGeom_Curve) arcCurve(const CadArc& arc, const Text& name) {
  StepGeom_Axis2Placement placement;
  placement.SetValue(axes(arc.centre));
  Handle(StepGeom_Circle) made = new StepGeom_Circle;
  made->Init(isCircle(arc) ? name : text(""), placement, arc.radius);
  if (isCircle(arc)) return made;
  return trimmed(made, name, arc.startRad, arc.startRad + arc.sweepRad);
}

/// Knots without repetition, and how often each is repeated.
struct KnotRuns {
  std::vector<double> knots;
  std::vector<int> multiplicities;
};
KnotRuns knotRuns(const PlainSpline& curve) {
  KnotRuns runs;
  for (const double knot : curve.knots) {
    if (runs.knots.empty() || runs.knots.back() != knot) {
      runs.knots.push_back(knot);
      runs.multiplicities.push_back(0);
    }
    ++runs.multiplicities.back();
  }
  return runs;
}

Handle(StepGeom_Curve) splineCurve(const PlainSpline& curve, const Text& name) {
  const int count = static_cast<int>(curve.points.size());
  Handle(StepGeom_HArray1OfCartesianPoint) poles = new StepGeom_HArray1OfCartesianPoint(1, count);
  for (int i = 0; i < count; ++i) poles->SetValue(i + 1, point(curve.points[i]));
  const KnotRuns runs = knotRuns(curve);
  const int distinct = static_cast<int>(runs.knots.size());
  Handle(TColStd_HArray1OfReal) knots = new TColStd_HArray1OfReal(1, distinct);
  Handle(TColStd_HArray1OfInteger) times = new TColStd_HArray1OfInteger(1, distinct);
  for (int i = 0; i < distinct; ++i) {
    knots->SetValue(i + 1, runs.knots[i]);
    times->SetValue(i + 1, runs.multiplicities[i]);
  }
  // A loop is not said to be closed: Open CASCADE and others would make a periodic curve of it.
  if (curve.weights.empty()) {
    Handle(StepGeom_BSplineCurveWithKnots) made = new StepGeom_BSplineCurveWithKnots;
    made->Init(name, curve.degree, poles, StepGeom_bscfUnspecified, StepData_LFalse, StepData_LFalse, times, knots,
               StepGeom_ktUnspecified);
    return made;
  }
  Handle(TColStd_HArray1OfReal) weights = new TColStd_HArray1OfReal(1, count);
  for (int i = 0; i < count; ++i) weights->SetValue(i + 1, curve.weights[i]);
  Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve) made =
      new StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve;
  made->Init(name, curve.degree, poles, StepGeom_bscfUnspecified, StepData_LFalse, StepData_LFalse, times, knots,
             StepGeom_ktUnspecified, weights);
  return made;
}

Handle(StepGeom_Curve) curveEntity(const PlainEntity& entity) {
  const Text name = text(entity.name);
  if (const auto* line = std::get_if<CadLine>(&entity.shape)) return lineCurve(*line, name);
  if (const auto* arc = std::get_if<CadArc>(&entity.shape)) return arcCurve(*arc, name);
  if (const auto* curve = std::get_if<PlainSpline>(&entity.shape)) return splineCurve(*curve, name);
  return {};
}

Handle(StepRepr_HArray1OfRepresentationItem) listOf(const Items& items) {
  Handle(StepRepr_HArray1OfRepresentationItem) list =
      new StepRepr_HArray1OfRepresentationItem(1, static_cast<int>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) list->SetValue(static_cast<int>(i) + 1, items[i]);
  return list;
}

/// One layer: a set of curves.
Handle(StepShape_GeometricCurveSet) curveSet(const std::vector<const PlainEntity*>& entities) {
  Handle(StepShape_HArray1OfGeometricSetSelect) elements =
      new StepShape_HArray1OfGeometricSetSelect(1, static_cast<int>(entities.size()));
  for (std::size_t i = 0; i < entities.size(); ++i) {
    const Handle(StepGeom_Curve) curve = curveEntity(*entities[i]);
    if (curve.IsNull()) return {};
    StepShape_GeometricSetSelect element;
    element.SetValue(curve);
    elements->SetValue(static_cast<int>(i) + 1, element);
  }
  Handle(StepShape_GeometricCurveSet) set = new StepShape_GeometricCurveSet;
  set->Init(text(entities.front()->layer), elements);
  return set;
}

std::string mended(const std::string& file) {
  std::string result;
  for (std::size_t i = 0; i < file.size(); ++i) {
    result += file[i];
    if (file[i] == '\\' && i + 1 < file.size() && file[i + 1] == '\\') ++i;
  }
  return result;
}

using Context = Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx);

class Properties {
 public:
  Properties(const Handle(StepData_StepModel) & model, const Handle(StepBasic_ProductDefinition) & product,
             const Context& context)
      : model_(model), product_(product), context_(context) {}

  void add(const DrawingFigures& figures) {
    Handle(StepBasic_MeasureValueMember) length = new StepBasic_MeasureValueMember;
    length->SetName("LENGTH_MEASURE");
    length->SetReal(figures.length);
    StepBasic_Unit unit;
    unit.SetValue(context_->UnitsValue(1));
    Handle(StepRepr_MeasureRepresentationItem) item = new StepRepr_MeasureRepresentationItem;
    item->Init(text("curve length measure"), length, unit);
    addOne("independent curve length", {item});
    addOne("independent curve centroid", {point(figures.centroid, text("curve centre point"))});
    Items places;
    for (const Vec2& p : figures.places) places.push_back(point(p, text("sampling point")));
    if (!places.empty()) addOne("smooth sampling points", places);
  }

 private:
  void addOne(const char* name, const Items& items) {
    StepRepr_CharacterizedDefinition owner;
    owner.SetValue(product_);
    Handle(StepRepr_PropertyDefinition) property = new StepRepr_PropertyDefinition;
    property->Init(text("geometric_validation_property"), true, text(name), owner);
    Handle(StepRepr_Representation) values = new StepRepr_Representation;
    values->Init(text(name), listOf(items), context_);
    StepRepr_RepresentedDefinition definition;
    definition.SetValue(property);
    Handle(StepRepr_PropertyDefinitionRepresentation) link = new StepRepr_PropertyDefinitionRepresentation;
    link->Init(definition, values);
    model_->AddWithRefs(link);
  }

  Handle(StepData_StepModel) model_;
  Handle(StepBasic_ProductDefinition) product_;
  Context context_;
};

void nameFile(const Handle(StepData_StepModel) & model, const std::string& title) {
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text(title));
  header.SetAuthorValue(1, text("Batten"));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text("Batten"));
  header.SetAuthorisation(text(""));
  header.Apply(model);
}

/// The curves of each layer, layers in the order in which they come.
std::vector<std::vector<const PlainEntity*>> byLayer(const PlainDrawing& drawing) {
  std::vector<std::vector<const PlainEntity*>> layers;
  for (const PlainEntity& entity : drawing.entities) {
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const auto& layer) { return layer.front()->layer == entity.layer; });
    (found == layers.end() ? layers.emplace_back() : *found).push_back(&entity);
  }
  return layers;
}

Result<std::string> written(const PlainDrawing& drawing, const DrawingFigures& figures, const std::string& title) {
  const bool isInch = drawing.mmPerUnit == std::optional(kMillimetresPerInch);
  Interface_Static::SetIVal("write.step.schema", kAp214);
  Interface_Static::SetCVal("write.step.unit", isInch ? "INCH" : "MM");
  STEPControl_Writer session;
  const Handle(StepData_StepModel) model = session.Model(true);
  STEPConstruct_UnitContext units;
  units.Init(kUncertainty);
  STEPConstruct_ContextTool contexts(model);
  contexts.AddAPD();
  Items items = {axes(Vec2::Zero())};
  for (const auto& layer : byLayer(drawing)) {
    const Handle(StepShape_GeometricCurveSet) set = curveSet(layer);
    if (set.IsNull()) return occtFailed("write the STEP");
    items.push_back(set);
  }
  Handle(StepShape_GeometricallyBoundedWireframeShapeRepresentation) shape =
      new StepShape_GeometricallyBoundedWireframeShapeRepresentation;
  shape->Init(text(title), listOf(items), units.Value());
  STEPConstruct_Part part;
  part.MakeSDR(shape, text(title), contexts.GetAPD()->Application());
  model->AddWithRefs(part.SDRValue());
  Properties(model, part.PD(), units.Value()).add(figures);
  nameFile(model, title);

  StepData_StepWriter writer(model);
  writer.FloatWriter().SetFormat("%.15E");
  writer.FloatWriter().SetFormatForRange("%.16f", 0.1, 10.0);
  writer.SendModel(Handle(StepData_Protocol)::DownCast(session.WS()->Protocol()));
  std::ostringstream out;
  out.imbue(std::locale::classic());
  if (!writer.Print(out)) return occtFailed("write the STEP");
  return mended(out.str());
}

}  // namespace

Result<std::string> stepOf(const PlainDrawing& drawing, const DrawingFigures& figures, const std::string& title) {
  const OcctSession session;
  try {
    return written(drawing, figures, title);
  } catch (const Standard_Failure& failure) {
    return occtFailed("write the STEP", failure.GetMessageString());
  }
}

}  // namespace batten
