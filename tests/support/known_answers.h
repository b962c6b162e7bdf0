// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// A reference case of tests/data, from an independent implementation. `directory` is BATTEN_TEST_DATA.
inline nlohmann::json knownAnswer(const std::string& directory, const std::string& file) {
  std::ifstream in(directory + "/" + file);
  if (!in) throw std::runtime_error("missing test data: " + file);
  return nlohmann::json::parse(in);
}

inline Vec2 toVec2(const nlohmann::json& pair) { return {pair.at(0).get<double>(), pair.at(1).get<double>()}; }

inline std::vector<Vec2> toPoints(const nlohmann::json& list) {
  std::vector<Vec2> points;
  points.reserve(list.size());
  for (const auto& pair : list) points.push_back(toVec2(pair));
  return points;
}

}  // namespace batten::test
