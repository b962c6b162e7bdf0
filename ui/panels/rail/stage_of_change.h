// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/pipeline/recipe/recipe.h"
#include "ui/panels/rail/panel_stage.h"

namespace batten {

/// The first stage whose settings or edits differ between two recipes; none when they are equal.
std::optional<PanelStage> stageOfChange(const Recipe& before, const Recipe& after);

}  // namespace batten
