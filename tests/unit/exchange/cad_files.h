// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// What a parser of the tests found in a file: lengths in the unit of the file.
struct FoundCurve {
  enum class Kind { Spline, Line, Arc } kind = Kind::Spline;
  std::string name;
  int degree = 0;
  bool closedFlag = false, periodicFlag = false;
  std::vector<double> knots, weights;
  std::vector<Vec2> points;  ///< Poles; both ends of a line; centre, start and end of an arc.
};
struct FoundFile {
  std::string unit;
  std::vector<FoundCurve> curves;
};

/// IGES by its standard: 80 columns, the parameter data in columns 1 to 64 of the lines marked P, reals and integers
/// between commas; entity 126, 110 and 100 in the order of the file, names from property 406 form 15.
FoundFile parseIges(const std::string& text);
/// STEP by ISO 10303-21: instances by their number; the elements of every geometric curve set in order.
FoundFile parseStep(const std::string& text);

}  // namespace batten::test
