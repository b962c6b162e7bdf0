// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image/grey_image.h"
#include "tests/bench/accuracy_measure.h"

namespace batten::test {

/// Another tracer that may be installed.
struct Peer {
  std::string name;
  std::string missing;  ///< Why it cannot run here; empty: it can.
  /// Traces an 8-bit PGM; `folder` is for its files. Empty when it fails.
  std::function<std::optional<TraceResult>(const std::filesystem::path& pgm, const std::filesystem::path& folder)> run;
};

/// potrace; mkbitmap, then potrace; Inkscape's own trace. All with their own default settings.
std::vector<Peer> peers();
/// potrace with this tolerance for joining its curves.
Peer potraceWith(double optimumTolerance);

/// The page as these programs read it.
bool writePgm(const GreyImage& grey, const std::filesystem::path& file);

}  // namespace batten::test
