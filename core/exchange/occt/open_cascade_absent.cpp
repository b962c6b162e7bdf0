// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled in place of the others where Open CASCADE is not installed.
#include "core/exchange/occt/iges.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/occt/step_reader.h"
#include "core/exchange/occt/step_writer.h"

namespace batten {
namespace {

tl::unexpected<Error> absent() {
  return fail(ErrorCode::BadParameter,
              "This build of Batten goes without Open CASCADE and knows neither IGES nor STEP. Use DXF, or install "
              "libocct-data-exchange-dev and build again.");
}

}  // namespace

bool hasOpenCascade() { return false; }
Result<std::string> writeIges(const CadDrawing&, const std::string&) { return absent(); }
Result<CadDrawing> readIges(std::string_view) { return absent(); }
Result<std::string> writeStep(const CadDrawing&, const DrawingFigures&, const std::string&) { return absent(); }
Result<CadDrawing> readStep(std::string_view) { return absent(); }

}  // namespace batten
