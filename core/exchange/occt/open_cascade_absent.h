// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"

namespace batten {

/// What the functions of this room say in a build without Open CASCADE, which compiles this source file in place of the
/// others.
Error openCascadeAbsent();

}  // namespace batten
