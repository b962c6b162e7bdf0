// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// A document as a file is to hold it.
struct Arrangement {
  ExportDocument document;
  int lines = 0;    ///< Lines of the given document of which something is left.
  int doubles = 0;  ///< Curves left out because they lie on another one of their layer, forwards or backwards.
};

/// Begins closed lines where the user wants it, turns what is to run the other way, and takes curves out that lie
/// wholly on a longer or earlier one of the same layer (within a ten-millionth of their size). Exact.
/// @param joined the pieces of a line stay together, and a line runs the way of the latest of its pieces' marks; else
/// every piece is a line of its own. Joined imported lines become one wherever just two of their ends meet, whatever
/// their order and direction in the file; the first of them, or one whose direction the user chose, says which way.
/// Ids stay unique; names and layers are kept.
Result<Arrangement> arranged(const ExportDocument&, bool joined, const RunContext& = {});

}  // namespace batten
