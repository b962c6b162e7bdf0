// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes where an SVG of ours is read back: refused, or the very curves that were written.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/exchange/svg/svg_check.h"

namespace {

/// The drawing of fuzz_seeds' curve: a straight line of one cubic B-spline.
batten::ExportDocument drawing() {
  batten::ExportDocument document;
  document.frame = {100, 80, 0.1};
  document.dpi = 254.0;
  document.title = "seed.png";
  auto curve = batten::NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{1, 1}, {3, 2}, {5, 2}, {7, 1}}, {});
  document.curves.push_back({"curve-1", false, {{*curve}}, {}});
  return document;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const batten::ExportDocument kDrawing = drawing();
  const auto check = batten::checkSvg({reinterpret_cast<const char*>(data), size}, kDrawing);
  if (check && check->curves != 1) std::abort();
  if (!check && check.error().message.empty()) std::abort();
  return 0;
}
