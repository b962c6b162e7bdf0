// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/scan.h"

#include "core/base/conventions.h"

namespace batten {

PageFrame pageFrame(const Scan& scan, std::optional<double> dpi) {
  return {scan.grey.width, scan.grey.height, kMillimetresPerInch / dpi.value_or(kAssumedDpi)};
}

}  // namespace batten
