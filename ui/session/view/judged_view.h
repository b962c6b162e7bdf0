// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/session/view/judged_curve.h"
#include "ui/session/view/view_settings.h"

namespace batten {

/// The curve that is looked at: as fairing leaves it where that is shown, else as constructed.
Judged judgedIn(const ViewSettings& view);

/// Back to the start with what belongs to one drawing: its region, how its corners are looked for.
void forgetDrawing(ViewSettings& view);

}  // namespace batten
