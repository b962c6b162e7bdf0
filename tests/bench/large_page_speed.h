// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten::test {

/// Prints, for a page of 35 megapixels with 72 strokes, what each part of the way from grey to curves takes: least and
/// median processor time of `rounds` rounds on two threads, and both as a multiple of a copy of the page made in the
/// same round. In every round each row runs once, so that the rows can be compared whatever else the machine does.
void printLargePageSpeed(int rounds);

}  // namespace batten::test
