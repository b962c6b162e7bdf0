// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/log_transform.h"

#include <algorithm>
#include <cmath>

namespace batten {

std::optional<Error> validate(const LogParams& params) {
  if (!(params.factor >= 10.0 && params.factor <= 150.0)) {
    return Error{ErrorCode::BadParameter, "The log factor must lie between 10 and 150.", {}};
  }
  return std::nullopt;
}

double logTone(double grey, const LogParams& params) {
  const double level = std::clamp(grey, 0.0, 255.0);
  if (!params.enabled) return level;
  return std::clamp(params.factor * std::log1p(level), 0.0, 255.0);
}

double greyOfTone(double tone, const LogParams& params) {
  if (!params.enabled) return std::clamp(tone, 0.0, 255.0);
  return std::clamp(std::expm1(std::clamp(tone, 0.0, 255.0) / params.factor), 0.0, 255.0);
}

std::array<std::uint8_t, 256> toneTable(const LogParams& params) {
  std::array<std::uint8_t, 256> table{};
  for (int grey = 0; grey < 256; ++grey) {
    table[grey] = static_cast<std::uint8_t>(std::lround(logTone(grey, params)));
  }
  return table;
}

}  // namespace batten
