// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/exchange/cad/step_data.h"

namespace batten {

struct StepUnits {
  std::optional<double> mmPerUnit;  ///< Absent: the file states no unit of length that can be read.
  double radiansPerUnit = 1.0;      ///< Of plane angle.
};

/// The units of a file, by the first of its contexts that states them.
StepUnits readStepUnits(const StepData&);

}  // namespace batten
