// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/step_reader.h"

#include "core/exchange/occt/cad_module_call.h"

namespace batten {

Result<CadDrawing> readStep(std::string_view bytes) {
  return callCadModule<PlainDrawing, ReadStep>(kReadStep, bytes).map(drawingOf);
}

}  // namespace batten
