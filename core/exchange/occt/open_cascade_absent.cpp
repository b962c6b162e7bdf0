// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/open_cascade_absent.h"

#include "core/exchange/occt/iges.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/occt/step_reader.h"
#include "core/exchange/occt/step_writer.h"

namespace batten {

Error openCascadeAbsent() {
  return {ErrorCode::BadParameter,
          "This build of Batten is without Open CASCADE and cannot write IGES or STEP. Use "
          "DXF or 3DM, or install libocct-data-exchange-dev and build again.",
          {}};
}

bool hasOpenCascade() { return false; }
Result<std::string> writeIges(const CadDrawing&, const std::string&) { return fail(openCascadeAbsent()); }
Result<CadDrawing> readIges(std::string_view) { return fail(openCascadeAbsent()); }
Result<std::string> writeStep(const CadDrawing&, const DrawingFigures&, const std::string&) {
  return fail(openCascadeAbsent());
}
Result<CadDrawing> readStep(std::string_view) { return fail(openCascadeAbsent()); }

}  // namespace batten
