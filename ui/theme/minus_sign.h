// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace batten {

/// A number as it is set in print: with a minus sign, which is as wide as a digit, for the hyphen.
inline QString withMinusSign(QString number) { return number.replace(QLatin1Char('-'), QChar(0x2212)); }

}  // namespace batten
