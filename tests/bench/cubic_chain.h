// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/truth_shapes.h"

namespace batten::test {

/// Control points of the chain of G1 cubics that follows a known line within a tolerance [px], each cubic as long as it
/// can be: what path simplification can reach at best. Tangents are those of the line, the lengths of the handles free.
int cubicChainPoints(const TruthPiece&, bool closed, double tolerance);

}  // namespace batten::test
