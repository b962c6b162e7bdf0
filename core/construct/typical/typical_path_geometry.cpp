// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path_geometry.h"

namespace batten {

std::vector<PathGeometry> geometryOf(const TypicalPath& path) {
  std::vector<PathGeometry> all;
  all.reserve(path.elements.size());
  for (std::size_t e = 0; e < path.elements.size(); ++e) all.emplace_back(path, e);
  return all;
}

}  // namespace batten
