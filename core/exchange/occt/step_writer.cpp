// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/step_writer.h"

#include "core/exchange/occt/cad_module_call.h"

namespace batten {

Result<std::string> writeStep(const CadDrawing& drawing, const DrawingFigures& figures, const std::string& title) {
  return callCadModule<std::string, WriteStep>(kWriteStep, plainDrawing(drawing), figures, title);
}

}  // namespace batten
