// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/laplacian_edges.h"

#include <new>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/image/bits/padded_bits.h"

namespace batten {
namespace {

/// Ink with paper among the 8 neighbours: not all nine of the block are ink.
BATTEN_HOT_LOOP void edgeRow(const std::uint64_t* above, const std::uint64_t* here, const std::uint64_t* below,
                             std::uint64_t* out, int words) {
  for (int i = 0; i < words; ++i) {
    const std::uint64_t middle = above[i] & here[i] & below[i];
    const std::uint64_t before = above[i - 1] & here[i - 1] & below[i - 1];
    const std::uint64_t after = above[i + 1] & here[i + 1] & below[i + 1];
    const std::uint64_t inner = middle & ((middle << 1) | (before >> 63)) & ((middle >> 1) | (after << 63));
    out[i] = here[i] & ~inner;
  }
}

}  // namespace

Result<BitImage> laplacianEdges(const BitImage& ink, const RunContext& context) {
  try {
    const PaddedBits padded(ink, false);
    BitImage edges(ink.width, ink.height);
    parallelFor(context, ink.height, 4 * kRowsPerBlock, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) {
        edgeRow(padded.row(y - 1), padded.row(y), padded.row(y + 1), edges.row(y), ink.wordsPerRow);
      }
    });
    if (context.isCancelled()) return cancelled();
    return edges;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the edges; scan at a lower resolution or crop.");
  }
}

}  // namespace batten
