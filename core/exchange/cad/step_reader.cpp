// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/step_reader.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/angle.h"
#include "core/curve/closest_point.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/cad/step_data.h"
#include "core/exchange/cad/step_records.h"
#include "core/exchange/cad/step_units.h"

namespace batten {
namespace {

constexpr int kDeepestCurve = 16;             // curves within curves
constexpr int kMostStepKnots = 1 << 20;       // of one curve
constexpr std::size_t kMostShapes = 200'000;  // composites may name one part again and again

/// Where a trimmed curve or an edge begins and ends: by place or by parameter.
struct StepEnd {
  std::optional<Vec2> place;
  std::optional<double> parameter;
};
struct StepTrim {
  StepEnd from, to;
  bool forwards = true;
};

CadShape reversed(CadShape shape) {
  if (auto* line = std::get_if<CadLine>(&shape)) std::swap(line->from, line->to);
  if (auto* line = std::get_if<CadPolyline>(&shape)) std::reverse(line->vertices.begin(), line->vertices.end());
  if (auto* curve = std::get_if<NurbsCurve>(&shape)) *curve = reversed(*curve);
  return shape;  // an arc has no direction of its own
}

class StepReader {
 public:
  StepReader(const StepRecords& records, const RunContext& context)
      : data_(records), records_(records), context_(context) {}

  Result<CadDrawing> read() {
    const StepUnits units = readStepUnits(data_);
    drawing_.mmPerUnit = units.mmPerUnit;
    radiansPerUnit_ = units.radiansPerUnit;
    const std::vector<std::uint64_t> roots = findRoots();
    for (std::size_t i = 0; i < roots.size(); ++i) {
      constexpr std::size_t kEvery = 256;  // between two looks at whether the run was cancelled
      if (i % kEvery == 0 && context_.isCancelled()) return cancelled();
      const std::size_t before = drawing_.entities.size();
      if (!take(roots[i], {}, 0)) {
        drawing_.entities.resize(before);
        ++drawing_.left;
      }
      if (const auto layer = layerOf_.find(roots[i]); layer != layerOf_.end()) {
        for (std::size_t k = before; k < drawing_.entities.size(); ++k) drawing_.entities[k].layer = layer->second;
      }
      if (visitsLeft_ == 0)
        return fail(ErrorCode::BadParameter,
                    "The curves of the STEP file refer to each other too often. Export it again.");
      if (drawing_.entities.size() > kMostShapes)
        return fail(ErrorCode::BadParameter, "The STEP file holds more than 200000 curves. Export fewer of them.");
    }
    if (context_.isCancelled()) return cancelled();
    return std::move(drawing_);
  }

 private:
  static bool isCurve(std::string_view type) {
    static const std::set<std::string_view> kCurves = {"B_SPLINE_CURVE_WITH_KNOTS",
                                                       "BOUNDED_CURVE",
                                                       "BEZIER_CURVE",
                                                       "QUASI_UNIFORM_CURVE",
                                                       "UNIFORM_CURVE",
                                                       "RATIONAL_B_SPLINE_CURVE",
                                                       "B_SPLINE_CURVE",
                                                       "LINE",
                                                       "CIRCLE",
                                                       "ELLIPSE",
                                                       "PARABOLA",
                                                       "HYPERBOLA",
                                                       "POLYLINE",
                                                       "TRIMMED_CURVE",
                                                       "COMPOSITE_CURVE"};
    return kCurves.contains(type);
  }

  /// Which curves the file is about.
  std::vector<std::uint64_t> findRoots() {
    std::vector<std::uint64_t> ofSets, edges, alone;
    std::set<std::uint64_t> used;
    for (const std::uint64_t id : records_.order) {
      const std::string_view type = data_.typeOf(id);
      if (type == "PRESENTATION_LAYER_ASSIGNMENT") readLayer(id);
      if (type == "EDGE_CURVE") edges.push_back(id);
      for (const char* set : {"GEOMETRIC_CURVE_SET", "GEOMETRIC_SET"}) {
        const auto values = data_.record(id, set);
        if (!values || values->size() < 2) continue;
        for (const StepValue& one : data_.valuesOf((*values)[1])) {
          const auto element = StepData::idOf(one);
          if (!element || !isCurve(data_.typeOf(*element))) continue;
          ofSets.push_back(*element);
          // The sets of our own files are their layers; a layer that was assigned is told apart by its own record.
          if (const std::string name = nameOf(*values); !name.empty()) layerOf_.try_emplace(*element, name);
        }
      }
      if (!isCurve(type) && type != "COMPOSITE_CURVE_SEGMENT" && type != "PCURVE") continue;
      const auto values = data_.record(id, type);
      for (std::size_t i = 0; values && i < values->size(); ++i) {
        const StepValue& value = (*values)[i];
        if (const auto part = StepData::idOf(value)) used.insert(*part);
      }
    }
    if (!ofSets.empty()) return ofSets;
    if (!edges.empty()) return edges;
    for (const std::uint64_t id : records_.order) {
      if (isCurve(data_.typeOf(id)) && !used.contains(id)) alone.push_back(id);
    }
    return alone;
  }

  /// What lies on a layer: name, description, items.
  void readLayer(std::uint64_t id) {
    const auto values = data_.record(id, "PRESENTATION_LAYER_ASSIGNMENT");
    if (!values || values->size() < 3) return;
    const std::string name = nameOf(*values);
    for (const StepValue& one : data_.valuesOf((*values)[2])) {
      if (const auto item = StepData::idOf(one); item && !name.empty()) layerOf_[*item] = name;
    }
  }

  bool push(const std::string& name, std::optional<CadShape> shape) {
    if (!shape || drawing_.entities.size() > kMostShapes) return false;
    drawing_.entities.push_back({name, {}, std::move(*shape)});
    return true;
  }

  std::string nameOf(StepValues values) const {
    return !values.empty() && values[0].kind == StepValue::Kind::Text ? stepText(values[0].text) : std::string();
  }

  /// Adds the shapes of a curve; false if it cannot be read.
  bool take(std::uint64_t id, const std::optional<StepTrim>& trim, int depth) {
    if (depth > kDeepestCurve || visitsLeft_ == 0 || context_.isCancelled()) return false;
    --visitsLeft_;
    if (const auto edge = data_.record(id, "EDGE_CURVE")) return takeEdge(*edge, depth);
    if (const auto curve = data_.record(id, "TRIMMED_CURVE")) return takeTrimmed(*curve, depth);
    if (const auto curve = data_.record(id, "COMPOSITE_CURVE")) return takeComposite(*curve, depth);
    for (const char* type : {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"}) {
      const auto curve = data_.record(id, type);
      const auto base = curve && curve->size() > 1 ? StepData::idOf((*curve)[1]) : std::nullopt;
      if (base) return take(*base, trim, depth + 1);
    }
    if (const auto line = data_.record(id, "LINE")) return push(nameOf(*line), lineOf(*line, trim));
    if (const auto circle = data_.record(id, "CIRCLE")) {
      if (circle->size() < 3) return false;
      const auto radius = StepData::number((*circle)[2]);
      return radius && push(nameOf(*circle), conicOf((*circle)[1], Vec2::Constant(*radius), trim));
    }
    if (const auto ellipse = data_.record(id, "ELLIPSE")) {
      if (ellipse->size() < 4) return false;
      const auto a = StepData::number((*ellipse)[2]), b = StepData::number((*ellipse)[3]);
      return a && b && push(nameOf(*ellipse), conicOf((*ellipse)[1], Vec2(*a, *b), trim));
    }
    if (const auto line = data_.record(id, "POLYLINE")) return push(nameOf(*line), polylineOf(*line));
    return takeSpline(id, trim);
  }

  bool takeEdge(StepValues edge, int depth) {
    if (edge.size() < 5) return false;
    const auto vertex = [&](const StepValue& one) -> std::optional<Vec2> {
      const auto values = data_.record(one, "VERTEX_POINT");
      return values && values->size() > 1 ? data_.point((*values)[1]) : std::nullopt;
    };
    const auto from = vertex(edge[1]), to = vertex(edge[2]);
    const auto curve = StepData::idOf(edge[3]);
    if (!from || !to || !curve) return false;
    return take(*curve, StepTrim{{from, {}}, {to, {}}, edge[4].text != "F"}, depth + 1);
  }

  bool takeTrimmed(StepValues curve, int depth) {
    if (curve.size() < 5) return false;
    const auto basis = StepData::idOf(curve[1]);
    const auto endOf = [&](const StepValue& list) {
      StepEnd end;
      for (const StepValue& one : data_.valuesOf(list)) {
        if (!end.place) end.place = data_.point(one);
        if (!end.parameter) end.parameter = data_.measure(one);
      }
      return end;
    };
    if (!basis) return false;
    const std::size_t first = drawing_.entities.size();
    if (!take(*basis, StepTrim{endOf(curve[2]), endOf(curve[3]), curve[4].text != "F"}, depth + 1)) return false;
    if (const std::string name = nameOf(curve); !name.empty() && drawing_.entities.size() == first + 1)
      drawing_.entities.back().name = name;
    return true;
  }

  bool takeComposite(StepValues curve, int depth) {
    if (curve.size() < 2) return false;
    for (const StepValue& one : data_.valuesOf(curve[1])) {
      const auto segment = data_.record(one, "COMPOSITE_CURVE_SEGMENT");
      const auto part = segment && segment->size() > 2 ? StepData::idOf((*segment)[2]) : std::nullopt;
      const std::size_t first = drawing_.entities.size();
      if (!part || !take(*part, {}, depth + 1)) return false;
      if ((*segment)[1].text != "F") continue;
      const auto begin = drawing_.entities.begin() + static_cast<std::ptrdiff_t>(first);
      std::reverse(begin, drawing_.entities.end());
      std::for_each(begin, drawing_.entities.end(), [](CadEntity& e) { e.shape = reversed(std::move(e.shape)); });
    }
    return true;
  }

  std::optional<CadShape> lineOf(StepValues line, const std::optional<StepTrim>& trim) const {
    if (line.size() < 3 || !trim) return std::nullopt;  // without an end it is endless
    const auto origin = data_.point(line[1]);
    const auto vector = data_.record(line[2], "VECTOR");
    const auto direction = vector && vector->size() > 2 ? data_.triple((*vector)[1], "DIRECTION") : std::nullopt;
    const auto length = direction ? StepData::number((*vector)[2]) : std::nullopt;
    if (!origin || !length) return std::nullopt;
    const auto placeOf = [&](const StepEnd& end) -> std::optional<Vec2> {
      if (end.place) return end.place;
      if (!end.parameter) return std::nullopt;
      const double size = std::hypot((*direction)[0], (*direction)[1], (*direction)[2]);
      return *origin + Vec2((*direction)[0], (*direction)[1]) * (*length * *end.parameter / (size > 0.0 ? size : 1.0));
    };
    const auto from = placeOf(trim->from), to = placeOf(trim->to);
    if (!from || !to || *from == *to) return std::nullopt;
    return CadLine{*from, *to};
  }

  std::optional<CadShape> conicOf(const StepValue& axes, const Vec2& half, const std::optional<StepTrim>& trim) const {
    const auto placed = placementOf(data_, axes);
    if (!placed) return std::nullopt;
    if (!trim) return conicShape(*placed, half, 0.0, kFullTurnRad);
    const Eigen::Matrix2d linear = placed->axes * half.asDiagonal();
    if (!(std::abs(linear.determinant()) > 0.0)) return std::nullopt;
    const auto angleOf = [&](const StepEnd& end) -> std::optional<double> {
      if (end.place) {
        const Vec2 own = linear.inverse() * (*end.place - placed->origin);
        return std::atan2(own.y(), own.x());
      }
      return end.parameter ? std::optional(*end.parameter * radiansPerUnit_) : std::nullopt;
    };
    auto from = angleOf(trim->from), to = angleOf(trim->to);
    if (!from || !to) return std::nullopt;
    if (!trim->forwards) std::swap(from, to);
    constexpr double kSame = 1e-9;  // [rad] a smaller sweep is a whole turn
    double sweep = std::fmod(*to - *from, kFullTurnRad);
    if (sweep <= kSame) sweep += kFullTurnRad;
    return conicShape(*placed, half, *from, sweep);
  }

  std::optional<CadShape> polylineOf(StepValues line) {
    if (line.size() < 2 || !mayRead(data_.valuesOf(line[1]).size())) return std::nullopt;
    const auto points = line.size() > 1 ? data_.points(line[1]) : std::nullopt;
    if (!points || points->size() < 2) return std::nullopt;
    CadPolyline shape;
    for (const Vec2& p : *points) shape.vertices.push_back({p});
    shape.closed = points->size() > 3 && points->front() == points->back();
    if (shape.closed) shape.vertices.pop_back();
    return shape;
  }

  bool takeSpline(std::uint64_t id, const std::optional<StepTrim>& trim) {
    auto spline = splineOf(id);
    if (!spline) return false;
    auto& [name, curve] = *spline;
    if (trim) {
      auto part = cutTo(curve, *trim);
      if (!part) return false;
      curve = *part;
    }
    return push(name, CadShape(curve));
  }

  struct NamedCurve {
    std::string name;
    NurbsCurve curve;
  };
  std::optional<NamedCurve> splineOf(std::uint64_t id) {
    // A plain entry has its name first; of one of several types each record has its own values alone.
    const auto plain = data_.record(id, "B_SPLINE_CURVE_WITH_KNOTS");
    const auto base = data_.record(id, "B_SPLINE_CURVE");
    std::string name;
    StepValues shape;
    for (const char* type : {"B_SPLINE_CURVE_WITH_KNOTS", "BEZIER_CURVE", "QUASI_UNIFORM_CURVE"}) {
      const auto values = data_.record(id, type);
      if (values && !base && values->size() >= 6) {
        name = nameOf(*values);
        shape = values->subspan(1);
      }
    }
    if (base) {
      shape = *base;
      if (const auto item = data_.record(id, "REPRESENTATION_ITEM")) name = nameOf(*item);
    }
    if (shape.size() < 2 || !mayRead(data_.valuesOf(shape[1]).size())) return std::nullopt;
    const auto degree = StepData::number(shape[0]);
    auto points = data_.points(shape[1]);
    if (!degree || *degree != std::floor(*degree) || !(*degree >= 1.0 && *degree <= 7.0) || !points)
      return std::nullopt;
    const int d = static_cast<int>(*degree);
    const auto knots = plain ? knotsOf(base ? *plain : plain->subspan(std::min<std::size_t>(6, plain->size())))
                             : evenKnots(data_.record(id, "BEZIER_CURVE").has_value(), d, points->size());
    std::vector<double> weights;
    if (const auto rational = data_.record(id, "RATIONAL_B_SPLINE_CURVE"); rational && !rational->empty()) {
      const auto numbers = data_.numbers((*rational)[0]);
      if (!numbers) return std::nullopt;
      weights = *numbers;
    }
    if (!knots) return std::nullopt;
    auto made = NurbsCurve::make(d, *knots, std::move(*points), std::move(weights));
    if (!made) return std::nullopt;
    return NamedCurve{std::move(name), std::move(*made)};
  }

  /// Many edges may name one curve: what is read of them all together has a limit.
  bool mayRead(std::size_t points) {
    if (points > pointsLeft_) return false;
    pointsLeft_ -= points;
    return true;
  }

  /// Multiplicities, then distinct knots.
  std::optional<std::vector<double>> knotsOf(StepValues values) const {
    if (values.size() < 2) return std::nullopt;
    const auto counts = data_.numbers(values[0]), distinct = data_.numbers(values[1]);
    if (!counts || !distinct || counts->size() != distinct->size()) return std::nullopt;
    std::vector<double> knots;
    for (std::size_t i = 0; i < counts->size(); ++i) {
      if (!((*counts)[i] >= 1.0 && (*counts)[i] <= 8.0) || std::ssize(knots) > kMostStepKnots) return std::nullopt;
      knots.insert(knots.end(), (*counts)[i], (*distinct)[i]);
    }
    return knots;
  }
  /// Of a Bézier chain, or evenly spaced between repeated ends.
  static std::optional<std::vector<double>> evenKnots(bool isBezier, int degree, std::size_t points) {
    const std::size_t d = degree;
    if (points < d + 1 || (isBezier && (points - 1) % d != 0)) return std::nullopt;
    std::vector<double> knots(d + 1, 0.0);
    const std::size_t spans = isBezier ? (points - 1) / d : points - d;
    for (std::size_t i = 1; i < spans; ++i) knots.insert(knots.end(), isBezier ? d : 1, static_cast<double>(i));
    knots.insert(knots.end(), d + 1, static_cast<double>(spans));
    return knots;
  }

  static std::optional<NurbsCurve> cutTo(const NurbsCurve& whole, const StepTrim& trim) {
    const auto held = clamped(whole);
    if (!held) return std::nullopt;
    const NurbsCurve& curve = *held;
    const auto parameterOf = [&](const StepEnd& end) -> std::optional<double> {
      if (end.parameter) return std::clamp(*end.parameter, curve.start(), curve.end());
      return end.place ? std::optional(closestPoint(curve, *end.place).u) : std::nullopt;
    };
    auto from = parameterOf(trim.from), to = parameterOf(trim.to);
    if (!from || !to) return std::nullopt;
    if (!trim.forwards) std::swap(from, to);
    constexpr double kSame = 1e-7;  // of the parameters
    const auto part = partBetween(curve, *from, *to, kSame);
    if (!part) return std::nullopt;
    return trim.forwards ? *part : reversed(*part);
  }

  StepData data_;
  const StepRecords& records_;
  const RunContext& context_;
  double radiansPerUnit_ = 1.0;
  std::size_t pointsLeft_ = 20'000'000;  ///< Control points that may still be read.
  std::size_t visitsLeft_ = 2'000'000;   ///< Curves that may still be looked at: composites of composites multiply.
  std::map<std::uint64_t, std::string> layerOf_;
  CadDrawing drawing_;
};

}  // namespace

Result<CadDrawing> parseStep(std::string_view text, const RunContext& context) {
  const auto records = readStepRecords(text, context);
  if (!records) return fail(records.error());
  return StepReader(*records, context).read();
}

}  // namespace batten
