// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fairing/model/fairing_line.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/fairing_state.h"

namespace batten {

/// The points of a line as seen from its curve: means over blocks of neighbours, so that what neighbours have in common
/// does not count twice.
struct LineBlocks {
  struct Block {
    double sample = 0.0;    ///< Where it lies along the sketched curve, in samples of its setup.
    double distance = 0.0;  ///< [mm] Signed, positive to the left.
  };
  std::vector<Block> blocks;  ///< In order.
  double widthMm = 0.0;       ///< Length of a block.

  bool areEnough() const { return blocks.size() >= 12; }
  /// One value per sample of the setup, between the blocks by straight lines.
  std::vector<double> offsets(const FairingSetup& setup) const;
  /// Sum of the squared distances of the blocks from a curve, given its signed distances from the sketched one.
  double misfit(const FairingSetup& setup, const FairingState& state) const;
};
LineBlocks lineBlocks(const FairingSetup& setup, const FairingLine& line);

}  // namespace batten
