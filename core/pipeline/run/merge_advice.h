// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/base/content_hash.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/run/stage_cache.h"

namespace batten {

/// A strength for edges.merge that the drawing itself suggests.
struct MergeAdvice {
  /// [stroke widths] For EdgeParams::mergeWidths; absent: none were found, or it would not help.
  std::optional<double> widths = {};
  int strokes = 0;     ///< Centre lines of the page without merging, all of them,
  int lines = 0;       ///< and with it.
  double share = 0.0;  ///< [-] See OverdrawnStrokes::share.
  /// Centre lines with edges.intent; absent: the page shows no lines drawn over more than once.
  std::optional<int> meant = {};
};

/// Traces the page without merging, looks for strokes drawn over one another (findOverdrawnStrokes()), and where there
/// are some, traces it with the strength found to count the lines. What the recipe says about merging does not matter.
/// @return Cancelled, or why the page gives no lines.
Result<MergeAdvice> adviseMerge(const Scan& scan, const Recipe& recipe, StageCache& cache, const RunContext& context);

/// Digest of all that the advice depends on: the lines of the page without merging.
ContentHash mergeAdviceKey(const Scan& scan, const Recipe& recipe);

/// "9 stroke widths: 13 strokes become 1 line.", or that there are none, or that merging would not help.
std::string describe(const MergeAdvice& advice);

}  // namespace batten
