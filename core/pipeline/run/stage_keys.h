// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/base/page_frame.h"
#include "core/image/scan.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/recipe/stage_id.h"

namespace batten {

/// Key of every stage's output: digest of the stage, the key of its input and what of the recipe it reads. Two runs
/// with equal keys have equal outputs.
///
/// The log transform is in no key: thresholds are stored on the scan's own scale, so its slider changes what is shown
/// and how numbers are entered, never a result.
struct StageKeys {
  std::array<ContentHash, kStages.size()> keys;
  ContentHash page;    ///< The prepared page, an output of the first stage beside its thresholds.
  ContentHash fine;    ///< The fine page of the filtered ink (fine_page.h), or that there is none.
  ContentHash traced;  ///< The lines of the scan alone, before the pen strokes: drawing one does not trace again.
  const ContentHash& operator[](StageId stage) const { return keys[indexOf(stage)]; }
};
/// What is done to the scan first. Shading is left out only where the paper is flattened and thresholds are automatic:
/// else they mean the scan's own grey.
PreparationParams preparationOf(const Recipe&);

StageKeys stageKeys(const Scan&, const Recipe&, const PageFrame&);

}  // namespace batten
