// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/occt/open_cascade.h"

namespace batten {

bool hasOpenCascade() { return true; }

}  // namespace batten
