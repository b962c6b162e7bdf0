// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/fairing/fairing_report.h"

namespace batten {

/// The six targets of one curve made fair, by degree minus one; absent where one failed.
using FairedByDegree = std::array<std::optional<FairedCurve>, 6>;
/// The degree of the highest S of the modified curve (003 section 6), of equal ones the lowest; none where no curve has
/// one.
std::optional<int> mostSimilar(const FairedByDegree&);

/// Adds a sentence that is not there yet.
void addSentence(std::string& notes, const std::string& note);

/// What the fairing of one more part of the curve adds to the report of the whole: the worst of both. The extrema,
/// which do not add up, are the caller's business.
void addPart(FairingReport& sum, const FairingReport& part);

}  // namespace batten
