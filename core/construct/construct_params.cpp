// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/construct_params.h"

#include <string>

#include "core/base/number_text.h"

namespace batten {
namespace {

std::optional<Error> outside(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return std::nullopt;
  return Error{ErrorCode::BadParameter,
               std::string(field) + " is " + numberToText(value) + "; it must lie between " + numberToText(low) +
                   " and " + numberToText(high) + ".",
               {}};
}

}  // namespace

std::optional<Error> validate(const ConstructParams& params) {
  if (auto error = outside("construct.derivative_magnitude", params.derivativeMagnitude, 0.1, 3.0)) return error;
  if (auto error = outside("construct.degree", params.degree, 2, 5)) return error;
  if (auto error = outside("construct.removal_step", params.removalStepPx, 0.0, 200.0)) return error;
  if (auto error = outside("construct.removal_tolerance", params.removalTolerancePx, 0.0, 50.0)) return error;
  if (auto error = outside("construct.closeness", params.maxDeviationPx, 0.0, 50.0)) return error;
  if (auto error = outside("construct.lowpass", params.lowPass, 0.0, 8.0)) return error;
  if (auto error = outside("construct.growing_stop", params.growingStopDeg, 0.2, 20.0)) return error;
  if (auto error = outside("construct.light_tolerance", params.lightTolerancePx, 0.005, 50.0)) return error;
  if (auto error = outside("construct.detail", params.detail, 0.0, 1.0)) return error;
  if (auto error = outside("construct.reduce", params.knotRemovalTolerance, 0.0, 1.0)) return error;
  return outside("construct.keep_extrema", params.extremumSignificance, 1.0, 1000.0);
}

}  // namespace batten
