// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/neighbourhood_filter.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/image/bits/padded_bits.h"
#include "core/image/bits/run_differences.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

/// When more than this share of the ink is gone, the strokes were too thin for the filter.
constexpr double kLostShare = 0.1;

enum class Step { Erosion, Dilation };

/// Pixels of a word with more than Coefficient ones among their 8 neighbours, from the four bits of the count.
template <int Coefficient>
inline std::uint64_t moreThan(std::uint64_t s, std::uint64_t t, std::uint64_t f, std::uint64_t e) {
  if constexpr (Coefficient < 0) return ~std::uint64_t{0};
  if constexpr (Coefficient == 0) return s | t | f | e;
  if constexpr (Coefficient == 1) return t | f | e;
  if constexpr (Coefficient == 2) return (t & s) | f | e;
  if constexpr (Coefficient == 3) return f | e;
  if constexpr (Coefficient == 4) return (f & (t | s)) | e;
  if constexpr (Coefficient == 5) return (f & t) | e;
  if constexpr (Coefficient == 6) return (f & t & s) | e;
  if constexpr (Coefficient == 7) return e;
  return 0;
}

/// A row with its neighbours, before a step and after.
struct RowOfStep {
  const std::uint64_t *above, *here, *below;
  std::uint64_t* out;
  int words;           ///< Of a row.
  std::uint64_t flip;  ///< All ones for erosion, which is dilation of the paper: ink is taken away.
};

/// One row of one step: 64 pixels at once, the 8 neighbours added by carry-save adders.
template <int Coefficient>
inline void stepRowBody(const RowOfStep& row) {
  const auto [above, here, below, out, words, flip] = row;
  for (int i = 0; i < words; ++i) {
    const std::uint64_t a = above[i] ^ flip, c = here[i] ^ flip, b = below[i] ^ flip;
    const std::uint64_t aL = (a << 1) | ((above[i - 1] ^ flip) >> 63), aR = (a >> 1) | ((above[i + 1] ^ flip) << 63);
    const std::uint64_t cL = (c << 1) | ((here[i - 1] ^ flip) >> 63), cR = (c >> 1) | ((here[i + 1] ^ flip) << 63);
    const std::uint64_t bL = (b << 1) | ((below[i - 1] ^ flip) >> 63), bR = (b >> 1) | ((below[i + 1] ^ flip) << 63);
    const std::uint64_t s1 = aL ^ a ^ aR, c1 = (aL & a) | (aR & (aL ^ a));
    const std::uint64_t s2 = bL ^ b ^ bR, c2 = (bL & b) | (bR & (bL ^ b));
    const std::uint64_t s3 = cL ^ cR, c3 = cL & cR;
    const std::uint64_t ones = s1 ^ s2 ^ s3, c4 = (s1 & s2) | (s3 & (s1 ^ s2));
    const std::uint64_t t = c1 ^ c2 ^ c3, u1 = (c1 & c2) | (c3 & (c1 ^ c2));
    const std::uint64_t twos = t ^ c4, u2 = t & c4;
    out[i] = (c | moreThan<Coefficient>(ones, twos, u1 ^ u2, u1 & u2)) ^ flip;
  }
}

BATTEN_HOT_LOOP void stepRow(const RowOfStep& row, int coefficient) {
  switch (coefficient) {
    case 0:
      return stepRowBody<0>(row);
    case 1:
      return stepRowBody<1>(row);
    case 2:
      return stepRowBody<2>(row);
    case 3:
      return stepRowBody<3>(row);
    case 4:
      return stepRowBody<4>(row);
    case 5:
      return stepRowBody<5>(row);
    case 6:
      return stepRowBody<6>(row);
    case 7:
      return stepRowBody<7>(row);
    default:
      break;
  }
  if (coefficient < 0) return stepRowBody<-1>(row);
  std::copy_n(row.here, row.words, row.out);
}

using RowFlags = std::vector<std::uint8_t>;  // one byte a row: neighbouring rows are written by different threads

/// What a row was before it changed.
struct FormerRow {
  int y;
  std::vector<std::uint64_t> words;
};
using FormerRows = std::vector<FormerRow>;  // from the top

/// An image, and which of its rows differ from an iteration before.
struct FlaggedBits {
  PaddedBits bits;
  RowFlags changed;
};

/// Runs one step from `in` into `out`, which holds the result of the same step one iteration ago: a row whose three
/// rows of origin have not changed since then is already right. @return what the changed rows of `out` were.
FormerRows runStep(const FlaggedBits& in, FlaggedBits& out, Step step, const FilterParams& params,
                   const RunContext& context) {
  const bool replicate = params.border == FilterBorder::Replicate;
  const std::uint64_t flip = step == Step::Erosion ? ~std::uint64_t{0} : 0;
  const int height = in.bits.height();
  const int words = in.bits.wordsPerRow();
  constexpr int kRows = 2 * kRowsPerBlock;  // one part of the work of the threads
  std::vector<FormerRows> parts((height + kRows - 1) / kRows);
  parallelFor(context, height, kRows, [&](int begin, int end) {
    std::vector<std::uint64_t> before(words);
    for (int y = begin; y < end; ++y) {
      const auto flag = [&](int row) { return in.changed[std::clamp(row, 0, height - 1)]; };
      std::uint8_t& mark = out.changed[y];
      mark = 0;
      if ((flag(y - 1) | flag(y) | flag(y + 1)) == 0) continue;
      std::uint64_t* row = out.bits.row(y);
      std::copy_n(row, words, before.data());
      stepRow({in.bits.row(y - 1), in.bits.row(y), in.bits.row(y + 1), row, words, flip}, params.coefficient);
      out.bits.finishRow(y, replicate);
      if (std::equal(before.begin(), before.end(), row)) continue;
      mark = 1;
      parts[begin / kRows].push_back({y, before});
    }
  });
  out.bits.finishBorderRows(replicate);
  FormerRows former;
  for (FormerRows& part : parts)
    former.insert(former.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
  return former;
}

/// Whether an iteration has undone the one before it. @param first, second what the rows were that each has changed.
bool isUndone(const PaddedBits& now, const FormerRows& first, const FormerRows& second) {
  return std::equal(first.begin(), first.end(), second.begin(), second.end(),
                    [&](const FormerRow& a, const FormerRow& b) {
                      return a.y == b.y && std::equal(a.words.begin(), a.words.end(), now.row(a.y));
                    });
}

/// The pairs of one erosion and one dilation, until nothing changes.
PaddedBits runPairs(const BitImage& image, const FilterParams& params, FilterReport& report,
                    const RunContext& context) {
  const bool replicate = params.border == FilterBorder::Replicate;
  const std::size_t rows = image.height;
  const Step first = params.order == FilterOrder::ErosionFirst ? Step::Erosion : Step::Dilation;
  const Step second = params.order == FilterOrder::ErosionFirst ? Step::Dilation : Step::Erosion;
  FlaggedBits state{PaddedBits(image, replicate), RowFlags(rows, 1)};
  FlaggedBits middle{PaddedBits(image.width, image.height), RowFlags(rows, 1)};
  FormerRows changedBefore;
  report.why = Termination::IterationLimit;
  int limit = params.iterations;
  while (report.iterations < limit && !context.isCancelled()) {
    runStep(state, middle, first, params, context);
    if (report.iterations == 0) std::fill(middle.changed.begin(), middle.changed.end(), std::uint8_t{1});
    FormerRows changed = runStep(middle, state, second, params, context);
    ++report.iterations;
    context.report(static_cast<double>(report.iterations) / limit);
    if (changed.empty()) {
      report.why = Termination::FixedPoint;
      break;
    }
    if (!report.alternates && report.iterations >= 2 && isUndone(state.bits, changedBefore, changed)) {
      // Two states take turns for ever: what the asked number of pairs gives is decided by its being odd or even.
      report.alternates = true;
      report.why = Termination::NoProgress;
      limit = report.iterations + (params.iterations - report.iterations) % 2;
    }
    changedBefore = std::move(changed);
  }
  return std::move(state.bits);
}

/// Undoes the larger ones of the changes from `from` to `to`, which are set in `from` alone. @return their pixels, and
/// how many of them were undone.
struct Changes {
  std::int64_t all = 0, undone = 0;
};
template <class Undo>
Changes limitChanges(const BitImage& from, const BitImage& to, int maxChangePx, const Undo& undo,
                     const RunContext& context) {
  Changes changes;
  const RunPieces pieces = findPiecesOfDifference(from, to, Connectivity::Eight, context);
  if (context.isCancelled()) return changes;
  const std::vector<std::int64_t> area = areasOfPieces(pieces);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const InkRun& run = pieces.runs[i];
    changes.all += run.x1 - run.x0;
    if (maxChangePx <= 0 || area[pieces.piece[i]] <= maxChangePx) continue;
    changes.undone += run.x1 - run.x0;
    undo(run);
  }
  return changes;
}

/// Undoes the larger ones of the changes, and counts.
void limitAllChanges(const BitImage& before, const FilterParams& params, FilteredImage& result,
                     const RunContext& context) {
  FilterReport& report = result.report;
  // What is put back first is set in both, and so no change of the second kind.
  const Changes lost = limitChanges(
      before, result.ink, params.maxChangePx, [&](const InkRun& run) { setBits(result.ink, run); }, context);
  const Changes gained = limitChanges(
      result.ink, before, params.maxChangePx, [&](const InkRun& run) { clearBits(result.ink, run); }, context);
  report.undone = lost.undone + gained.undone;
  report.inkLost = lost.all - lost.undone;
  report.inkGained = gained.all - gained.undone;
  report.inkAfter = report.inkBefore - report.inkLost + report.inkGained;
  report.thinStrokesLost = static_cast<double>(report.inkLost) > kLostShare * static_cast<double>(report.inkBefore);
}

BitImage singleStep(const BitImage& image, Step step, int coefficient, FilterBorder border, const RunContext& context) {
  const bool replicate = border == FilterBorder::Replicate;
  const RowFlags all(image.height, 1);
  const FlaggedBits in{PaddedBits(image, replicate), all};
  FlaggedBits out{PaddedBits(image.width, image.height), all};
  FilterParams params;
  params.coefficient = coefficient;
  params.border = border;
  runStep(in, out, step, params, context);
  return out.bits.toImage();
}

}  // namespace

std::optional<Error> validate(const FilterParams& params) {
  if (params.coefficient < 0 || params.coefficient > 4) {
    return Error{ErrorCode::BadParameter, "The filter coefficient must lie between 0 and 4.", {}};
  }
  if (params.iterations < 0 || params.iterations > 100) {
    return Error{ErrorCode::BadParameter, "The filter iterations must lie between 0 and 100.", {}};
  }
  if (params.maxChangePx < 0 || params.maxChangePx > kMostChangePx) {
    return Error{ErrorCode::BadParameter, "The filter's largest change must lie between 0 and 100000 px.", {}};
  }
  return std::nullopt;
}

Result<FilteredImage> neighbourhoodFilter(const BitImage& image, const FilterParams& params,
                                          const RunContext& context) {
  if (const auto error = validate(params)) return fail(*error);
  try {
    FilteredImage result;
    result.report.inkBefore = image.count();
    if (params.iterations == 0) {
      result.ink = image;
    } else {
      result.ink = runPairs(image, params, result.report, context).toImage();
    }
    if (!context.isCancelled()) limitAllChanges(image, params, result, context);
    if (context.isCancelled()) return cancelled();
    return result;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the filter; scan at a lower resolution or crop.");
  }
}

BitImage erode(const BitImage& image, int coefficient, FilterBorder border, const RunContext& context) {
  return singleStep(image, Step::Erosion, coefficient, border, context);
}

BitImage dilate(const BitImage& image, int coefficient, FilterBorder border, const RunContext& context) {
  return singleStep(image, Step::Dilation, coefficient, border, context);
}

}  // namespace batten
