// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "core/base/loaded_module.h"
#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/occt/module/cad_module.h"

namespace batten {

/// What writing and reading say where the file of the module is missing or cannot be loaded.
Error cadModuleMissing();

/// A drawing as the module takes it.
PlainDrawing plainDrawing(const CadDrawing&);
/// A drawing that the module read; splines that are no valid curves are counted in `left`.
CadDrawing drawingOf(PlainDrawing);

/// What a function of the module makes of these arguments: a T.
template <class T, class Function, class... Arguments>
Result<T> callCadModule(const char* name, const Arguments&... arguments) {
  const auto function = reinterpret_cast<Function>(functionOfModule(kCadModule, name));
  if (function == nullptr) return fail(cadModuleMissing());
  Result<T> outcome;
  function(arguments..., outcome);
  return outcome;
}

}  // namespace batten
