// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/module/occt_step_reader.h"

#include <IFSelect_ReturnStatus.hxx>
#include <Interface_InterfaceModel.hxx>
#include <QString>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_NamedUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Circle.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_HArray1OfCartesianPoint.hxx>
#include <StepGeom_HArray1OfTrimmingSelect.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_Polyline.hxx>
#include <StepGeom_TrimmedCurve.hxx>
#include <StepGeom_TrimmingSelect.hxx>
#include <StepGeom_Vector.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <StepShape_GeometricSet.hxx>
#include <StepShape_GeometricSetSelect.hxx>
#include <TCollection_HAsciiString.hxx>
#include <cmath>
#include <sstream>

#include "core/base/conventions.h"
#include "core/exchange/occt/module/occt_session.h"

namespace batten {
namespace {

/// A string of ISO 10303-21 as UTF-8: what stands between \\X2\\ and \\X0\\ is UTF-16 in hexadecimal.
std::string plain(const Handle(TCollection_HAsciiString) & text) {
  if (text.IsNull()) return "";
  const QString raw = QString::fromUtf8(text->ToCString());
  QString result;
  for (qsizetype at = 0; at < raw.size();) {
    const qsizetype begin = raw.indexOf(QLatin1String("\\X2\\"), at);
    const qsizetype end = begin < 0 ? -1 : raw.indexOf(QLatin1String("\\X0\\"), begin);
    if (end < 0) return (result + raw.mid(at)).toStdString();
    result += raw.mid(at, begin - at);
    for (qsizetype i = begin + 4; i + 4 <= end; i += 4) result += QChar(raw.mid(i, 4).toUShort(nullptr, 16));
    at = end + 4;
  }
  return result.toStdString();
}

Vec2 place(const Handle(StepGeom_CartesianPoint) & p) { return {p->CoordinatesValue(1), p->CoordinatesValue(2)}; }

template <class Spline>
std::vector<double> knotsOf(const Spline& spline, int count) {
  std::vector<double> knots;
  for (int i = 1; i <= count; ++i) {
    const int times = spline->KnotMultiplicitiesValue(i);
    if (times < 1 || times > 8) return {};
    knots.insert(knots.end(), times, spline->KnotsValue(i));
  }
  return knots;
}

PlainShape splineOf(const Handle(StepGeom_BSplineCurve) & curve) {
  std::vector<Vec2> points;
  for (int i = 1; i <= curve->NbControlPointsList(); ++i) points.push_back(place(curve->ControlPointsListValue(i)));
  std::vector<double> knots, weights;
  if (const auto rational = Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve)::DownCast(curve);
      !rational.IsNull()) {
    knots = knotsOf(rational, rational->NbKnots());
    for (int i = 1; i <= rational->NbWeightsData(); ++i) weights.push_back(rational->WeightsDataValue(i));
  } else if (const auto simple = Handle(StepGeom_BSplineCurveWithKnots)::DownCast(curve); !simple.IsNull()) {
    knots = knotsOf(simple, simple->NbKnots());
  }
  return PlainSpline{curve->Degree(), std::move(knots), std::move(points), std::move(weights)};
}

std::optional<CadArc> circleOf(const Handle(StepGeom_Circle) & circle) {
  const Handle(StepGeom_Axis2Placement3d) axes = circle->Position().Axis2Placement3d();
  if (axes.IsNull() || !(circle->Radius() > 0.0)) return std::nullopt;
  if (axes->HasAxis() && !(axes->Axis()->DirectionRatiosValue(3) > 0.5)) return std::nullopt;  // seen from behind
  double start = 0.0;
  if (axes->HasRefDirection())
    start = std::atan2(axes->RefDirection()->DirectionRatiosValue(2), axes->RefDirection()->DirectionRatiosValue(1));
  return CadArc{place(axes->Location()), circle->Radius(), start, kFullTurnRad};
}

/// The parameter or the place at which a curve is trimmed.
struct Trim {
  std::optional<double> parameter;
  std::optional<Vec2> point;
};
Trim trimOf(const Handle(StepGeom_HArray1OfTrimmingSelect) & list) {
  Trim trim;
  for (int i = 1; !list.IsNull() && i <= list->Length(); ++i) {
    const StepGeom_TrimmingSelect select = list->Value(i);
    if (select.CaseMember() > 0) trim.parameter = select.ParameterValue();
    if (const auto p = select.CartesianPoint(); !p.IsNull()) trim.point = place(p);
  }
  return trim;
}

std::optional<PlainShape> trimmedOf(const Handle(StepGeom_TrimmedCurve) & curve) {
  const Trim first = trimOf(curve->Trim1()), second = trimOf(curve->Trim2());
  const bool forwards = curve->SenseAgreement();
  if (const auto line = Handle(StepGeom_Line)::DownCast(curve->BasisCurve()); !line.IsNull()) {
    const Vec2 from = place(line->Pnt());
    const Handle(StepGeom_Direction) d = line->Dir()->Orientation();
    const Vec2 step = line->Dir()->Magnitude() * Vec2(d->DirectionRatiosValue(1), d->DirectionRatiosValue(2));
    const auto at = [&](const Trim& trim) { return trim.parameter ? Vec2(from + *trim.parameter * step) : trim.point; };
    const std::optional<Vec2> a = at(first), b = at(second);
    if (!a || !b || *a == *b) return std::nullopt;
    return CadLine{*a, *b};
  }
  if (const auto circle = Handle(StepGeom_Circle)::DownCast(curve->BasisCurve()); !circle.IsNull()) {
    const auto whole = circleOf(circle);
    if (!whole) return std::nullopt;
    const auto angle = [&](const Trim& trim) -> std::optional<double> {
      if (trim.parameter) return whole->startRad + *trim.parameter;
      if (!trim.point) return std::nullopt;
      const Vec2 out = *trim.point - whole->centre;
      return std::atan2(out.y(), out.x());
    };
    const auto a = angle(forwards ? first : second), b = angle(forwards ? second : first);
    if (!a || !b) return std::nullopt;
    const double sweep = std::fmod(*b - *a, kFullTurnRad);
    return CadArc{whole->centre, whole->radius, *a, sweep > 0.0 ? sweep : sweep + kFullTurnRad};
  }
  return std::nullopt;
}

std::optional<PlainShape> shapeOf(const Handle(Standard_Transient) & entity) {
  if (const auto curve = Handle(StepGeom_BSplineCurve)::DownCast(entity); !curve.IsNull()) return splineOf(curve);
  if (const auto curve = Handle(StepGeom_TrimmedCurve)::DownCast(entity); !curve.IsNull()) return trimmedOf(curve);
  if (const auto circle = Handle(StepGeom_Circle)::DownCast(entity); !circle.IsNull()) {
    const auto arc = circleOf(circle);
    return arc ? std::optional<PlainShape>(*arc) : std::nullopt;
  }
  if (const auto line = Handle(StepGeom_Polyline)::DownCast(entity); !line.IsNull() && line->NbPoints() > 1) {
    CadPolyline polyline;
    for (int i = 1; i <= line->NbPoints(); ++i) polyline.vertices.push_back({place(line->PointsValue(i))});
    return polyline;
  }
  return std::nullopt;
}

std::optional<double> millimetresOf(const Handle(Standard_Transient) & unit) {
  if (const auto si = Handle(StepBasic_SiUnitAndLengthUnit)::DownCast(unit); !si.IsNull()) {
    if (!si->HasPrefix()) return 1000.0;
    switch (si->Prefix()) {
      case StepBasic_spMilli:
        return 1.0;
      case StepBasic_spCenti:
        return 10.0;
      case StepBasic_spDeci:
        return 100.0;
      case StepBasic_spMicro:
        return 0.001;
      default:
        return std::nullopt;
    }
  }
  if (const auto other = Handle(StepBasic_ConversionBasedUnitAndLengthUnit)::DownCast(unit); !other.IsNull()) {
    std::string name = plain(other->Name());
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (name == "INCH") return kMillimetresPerInch;
    if (name == "FOOT") return 12.0 * kMillimetresPerInch;
  }
  return std::nullopt;
}

PlainDrawing drawingIn(const Handle(Interface_InterfaceModel) & model) {
  PlainDrawing drawing;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model->Value(i);
    if (const auto unit = millimetresOf(entity); unit && (!drawing.mmPerUnit || *unit != 1.0)) drawing.mmPerUnit = unit;
    const auto set = Handle(StepShape_GeometricSet)::DownCast(entity);
    if (set.IsNull() || set->Elements().IsNull()) continue;
    for (int k = 1; k <= set->Elements()->Length(); ++k) {
      const Handle(Standard_Transient) element = set->ElementsValue(k).Value();
      if (const auto p = Handle(StepGeom_Point)::DownCast(element); !p.IsNull()) continue;
      auto shape = shapeOf(element);
      const auto item = Handle(StepRepr_RepresentationItem)::DownCast(element);
      if (shape && !item.IsNull())
        drawing.entities.push_back({plain(item->Name()), plain(set->Name()), std::move(*shape)});
      else
        ++drawing.left;
    }
  }
  return drawing;
}

}  // namespace

Result<PlainDrawing> drawingOfStep(std::string_view bytes) {
  const auto damaged = [](std::string detail) {
    return fail(ErrorCode::BadParameter, "The STEP cannot be read: it is damaged or not a STEP file.",
                std::move(detail));
  };
  const OcctSession session;
  try {
    STEPControl_Reader reader;
    std::istringstream in{std::string(bytes)};
    if (reader.ReadStream("drawing", in) != IFSelect_RetDone) return damaged("not read");
    const Handle(Interface_InterfaceModel) model = reader.Model();
    if (model.IsNull() || model->NbEntities() == 0) return damaged("no entity");
    return drawingIn(model);
  } catch (const Standard_Failure& failure) {
    return damaged(failure.GetMessageString());
  }
}

}  // namespace batten
