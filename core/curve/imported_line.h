// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// One curve of a line that another program made.
struct ImportedCurve {
  NurbsCurve curve;       ///< Clamped. Model frame, mm.
  std::string name = {};  ///< UTF-8; may be empty.
  bool operator==(const ImportedCurve&) const = default;
};

/// A line that another program made. Model frame, mm. It is either curves, which stay what they are, or points, which a
/// construction makes a curve of.
struct ImportedLine {
  std::string name;                   ///< UTF-8; may be empty.
  std::string layer = {};             ///< UTF-8; may be empty.
  std::vector<ImportedCurve> curves;  ///< Each begins where the one before it ends. Where they meet is a corner.
  std::vector<Vec2> points;           ///< In order of travel; used where there are no curves.
  std::vector<int> corners;           ///< Indices of points at which the line turns sharply, ascending.
  bool closed = false;                ///< The end is followed by the begin; of points the first is not repeated.
  bool operator==(const ImportedLine&) const = default;
};

/// What was taken over from one file.
struct ImportedFile {
  std::string source;  ///< Name of the file, without its folder; UTF-8.
  std::string unit;    ///< What its numbers were in: "mm", "in" …; with "?" behind it where the file did not say.
  std::vector<ImportedLine> lines;
  bool operator==(const ImportedFile&) const = default;
};

/// A line needs curves that follow each other or two points at different places (closed: three), all finite and within
/// 100 m of the origin; a file at most 20 000 lines, 500 000 points and control points.
std::optional<Error> validate(const ImportedFile&);

}  // namespace batten
