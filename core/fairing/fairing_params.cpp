// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fairing_params.h"

#include <string>

#include "core/base/number_text.h"
#include "core/fairing/profile/target_degrees.h"

namespace batten {
namespace {

constexpr int kFewestExtremaNumber = -1;  // as few as the tolerance allows

}  // namespace

static_assert(static_cast<int>(FairingTarget::Degree1) == 1 &&
              static_cast<int>(FairingTarget::Degree6) == kMostTargetDegree);

std::optional<int> degreeOf(FairingTarget target) {
  const bool isDegree = target >= FairingTarget::Degree1 && target <= FairingTarget::Degree6;
  return isDegree ? std::optional(static_cast<int>(target)) : std::nullopt;
}

FairingTarget targetOfDegree(int degree) { return static_cast<FairingTarget>(degree); }

std::optional<FairingTarget> targetOfNumber(int number) {
  const bool isKnown = number >= 0 && number <= static_cast<int>(FairingTarget::LogAesthetic);
  return isKnown ? std::optional(static_cast<FairingTarget>(number)) : std::nullopt;
}

int numberOf(const KeptExtrema& kept) { return kept.count.value_or(kFewestExtremaNumber); }

KeptExtrema keptExtremaOf(int number) { return number == kFewestExtremaNumber ? KeptExtrema{} : KeptExtrema{number}; }

std::optional<Error> validate(const FairingParams& params) {
  if (!(params.toleranceMm >= 0.001 && params.toleranceMm <= kLargestToleranceMm)) {
    return Error{ErrorCode::BadParameter,
                 "The fairing tolerance must be between 0.001 and 20 mm, not " + numberToText(params.toleranceMm) + ".",
                 {}};
  }
  if (params.alpha && !(*params.alpha >= kLeastAlpha && *params.alpha <= kMostAlpha)) {
    return Error{
        ErrorCode::BadParameter,
        "The alpha of a log-aesthetic target must be between -3 and 6, not " + numberToText(*params.alpha) + ".",
        {}};
  }
  if (!(params.lowPassMm >= 0.1 && params.lowPassMm <= 10000.0)) {
    return Error{
        ErrorCode::BadParameter,
        "The low-pass wavelength must be between 0.1 and 10000 mm, not " + numberToText(params.lowPassMm) + ".",
        {}};
  }
  if (const std::optional<int> count = params.keepExtrema.count; count && (*count < 0 || *count > 99)) {
    return Error{ErrorCode::BadParameter,
                 "The number of extrema to keep must be 0 to 99, or -1 for as few as possible, not " +
                     std::to_string(*count) + ".",
                 {}};
  }
  for (const double at : params.keptAt) {
    if (!(at >= 0.0 && at <= 1.0))
      return Error{ErrorCode::BadParameter, "An extremum to keep is not on the curve.", {}};
  }
  for (const SpanTarget& one : params.spanTargets) {
    if (!(one.at >= 0.0 && one.at <= 1.0))
      return Error{ErrorCode::BadParameter, "A span with its own target is not on the curve.", {}};
    if (!isTargetDegree(one.degree)) {
      return Error{ErrorCode::BadParameter,
                   "The target of a span must be 1 to " + std::to_string(kMostTargetDegree) + ", not " +
                       std::to_string(one.degree) + ".",
                   {}};
    }
  }
  if (auto wrong = validateProfile(params.profile)) return wrong;
  return validate(params.targets);
}

}  // namespace batten
