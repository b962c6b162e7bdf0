// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// [mm] How far borders are from where the widths of a line put them: distance from its nearest place, less half the
/// width there. Infinite if the line has no width.
double distanceFromWidth(const std::vector<std::array<Vec2, 4>>& border, const ExportCurve&, CancelCheck check = {});

}  // namespace batten
