// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as curve JSON: refused with a reason, or curves that are written as JSON and SVG without a fault.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/exchange/svg/svg_check.h"
#include "core/exchange/svg/svg_writer.h"
#include "core/exchange/text/curve_json.h"

namespace {
constexpr double kMostMm = 1e5;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto document = batten::readCurveJson({reinterpret_cast<const char*>(data), size});
  if (!document) {
    if (document.error().message.empty()) std::abort();
    return 0;
  }
  const auto json = batten::writeCurveJson(*document);
  if (json && !batten::readCurveJson(*json)) std::abort();
  // Whoever writes curves of a file has refused those beyond 100 m: their cubics within .002 mm have no end.
  for (const batten::ExportCurve& curve : document->curves)
    for (const auto& piece : curve.pieces)
      for (const batten::Vec2& p : piece.curve.controlPoints())
        if (!(p.cwiseAbs().maxCoeff() < kMostMm)) return 0;
  // Curves may be too wild for cubics; they must not be written wrong.
  const auto svg = batten::writeSvg(*document, {});
  if (svg) (void)batten::checkSvg(svg->text, *document);
  return 0;
}
