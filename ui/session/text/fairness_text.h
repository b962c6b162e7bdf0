// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "core/fairing/curve_fairness.h"

namespace batten {

/// S alone, three places: never 1.000 for what is not.
QString fairnessBadge(const CurveFairness&);
/// All its figures, as a sentence.
QString fairnessSentence(const CurveFairness&);
/// The same in a few words, for a line that changes while the pen draws.
QString fairnessLine(const CurveFairness&);

}  // namespace batten
