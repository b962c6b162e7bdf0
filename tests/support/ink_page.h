// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"
#include "tests/support/render_page.h"

/// Pages that dark pens have inked on light paper.
namespace batten::test {

/// Draws over what there is: where inks lie one over the other, the fuller one shows.
void inkOver(std::vector<float>& coverage, const std::vector<float>& ink);

/// Paper 240, ink 30, blur .8.
PageStyle penPage(double noise, std::uint32_t seed = 1);
/// Where such a page is darker than halfway from the paper to the ink.
BitImage penInk(const GreyImage&);

struct InkPage {
  BitImage ink;
  GreyImage grey;
};
/// What several pens have inked one over the other, scanned as a penPage(). @param inks the coverage of each.
InkPage scannedInks(const std::vector<std::vector<float>>& inks, int width, int height, double noise,
                    std::uint32_t seed = 1);

}  // namespace batten::test
