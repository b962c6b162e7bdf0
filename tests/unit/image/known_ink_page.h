// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/image/threshold/binarize.h"

namespace batten::test {

/// A page whose ink is known.
struct KnownInkPage {
  GreyImage grey;
  BitImage truth;
  BitImage nearEdge;  ///< Pixels within 1.5 px of the ideal border: either answer is right there.
};

inline std::int64_t wrongPixels(const KnownInkPage& page, const BitImage& ink) {
  std::int64_t wrong = 0;
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      wrong += !page.nearEdge.at(x, y) && ink.at(x, y) != page.truth.at(x, y) ? 1 : 0;
    }
  }
  return wrong;
}

inline BitImage thresholded(const GreyImage& grey, const PaperParams& paper, const ThresholdParams& params,
                            int threads = 0) {
  RunContext context;
  context.threads = threads;
  return *binarize(grey, *findThresholds(grey, paper, params, context), params, context);
}

}  // namespace batten::test
