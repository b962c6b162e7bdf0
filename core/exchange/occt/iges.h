// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// A drawing as IGES 5.3: entities 126 (form 0), 110 and 100 in the plane z = 0, never flagged periodic, unit flag 2
/// (mm) or 1 (inch), 17 digits; a level per layer, names as property 406 form 15 and, shortened, as labels.
/// @return BadParameter without Open CASCADE; CannotWrite if it does not take the drawing, or if the module that holds
/// it is missing. @pre no polylines.
Result<std::string> writeIges(const CadDrawing&, const std::string& title);

/// What writeIges() wrote, in the order of the file, z left out; other curves are counted in `left`. Not for files of
/// others: the library crashes on damaged ones.
Result<CadDrawing> readIges(std::string_view bytes);

}  // namespace batten
