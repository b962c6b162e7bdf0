// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// Whether this build can write and read IGES and STEP: Open CASCADE is loaded when it is first needed. In a build
/// without it all of this room fails and says so.
bool hasOpenCascade();

}  // namespace batten
