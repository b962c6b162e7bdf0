// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/drawing_figures.h"

namespace batten {

/// The file that writes and reads IGES and STEP: the libraries of Open CASCADE take longer to load than all others. It
/// calls no code of core but what headers hold, as the rest lies in the program: so it takes and gives plain data.
inline constexpr const char* kCadModule = "batten-cad";
// Its functions, of the types below.
inline constexpr const char* kWriteIges = "battenWriteIges";
inline constexpr const char* kReadIges = "battenReadIges";
inline constexpr const char* kWriteStep = "battenWriteStep";
inline constexpr const char* kReadStep = "battenReadStep";

/// What NurbsCurve::make() takes: as it was read, it need not be a valid curve.
struct PlainSpline {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec2> points;
  std::vector<double> weights;  ///< Empty: non-rational.
};
using PlainShape = std::variant<CadLine, CadArc, CadPolyline, PlainSpline>;

/// CadEntity and CadDrawing with such splines.
struct PlainEntity {
  std::string name, layer;  // UTF-8
  PlainShape shape;
};
struct PlainDrawing {
  std::vector<PlainEntity> entities;
  std::optional<double> mmPerUnit;
  int left = 0;
};

/// What the functions of the room do, but for what core does for them: titles on one line, files that have a name.
/// `largest` is the largest coordinate of the drawing. The outcome is put in the last argument; no exception leaves.
using WriteIges = void (*)(const PlainDrawing&, const std::string& title, double largest, Result<std::string>&);
using ReadIges = void (*)(const std::string& path, Result<PlainDrawing>&);
using WriteStep = void (*)(const PlainDrawing&, const DrawingFigures&, const std::string& title, Result<std::string>&);
using ReadStep = void (*)(std::string_view bytes, Result<PlainDrawing>&);

}  // namespace batten
