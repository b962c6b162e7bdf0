// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/run_pieces.h"

#include <algorithm>
#include <bit>

#include "core/base/parallel.h"
#include "core/image/bits/run_differences.h"

namespace batten {
namespace {

constexpr int kRowsPerStrip = 256;  // one part of the work of the threads

/// The words of the rows of an image.
struct RowsOfImage {
  const BitImage& image;
  int width() const { return image.width; }
  int height() const { return image.height; }
  int wordsPerRow() const { return image.wordsPerRow; }
  const std::uint64_t* row(int y, std::vector<std::uint64_t>&) const { return image.row(y); }
};

/// The words of what is set in the first and not in the second.
struct RowsOfDifference {
  const BitImage &from, &without;
  int width() const { return from.width; }
  int height() const { return from.height; }
  int wordsPerRow() const { return from.wordsPerRow; }
  const std::uint64_t* row(int y, std::vector<std::uint64_t>& own) const {
    own.resize(from.wordsPerRow);
    const std::uint64_t *a = from.row(y), *b = without.row(y);
    for (int i = 0; i < from.wordsPerRow; ++i) own[i] = a[i] & ~b[i];
    return own.data();
  }
};

void appendRuns(const std::uint64_t* row, int width, int y, std::vector<InkRun>& runs) {
  const int words = (width + 63) / 64;
  std::uint64_t carry = 0;
  bool open = false;
  for (int i = 0; i < words; ++i) {
    std::uint64_t changes = row[i] ^ ((row[i] << 1) | carry);
    carry = row[i] >> 63;
    for (; changes != 0; changes &= changes - 1) {
      const int x = i * 64 + std::countr_zero(changes);
      if (open) {
        runs.back().x1 = x;
      } else {
        runs.push_back({y, x, width});
      }
      open = !open;
    }
  }
}

int findRoot(std::vector<int>& parent, int i) {
  const auto at = [&](int k) -> int& { return parent[k]; };
  while (at(i) != i) {
    at(i) = at(at(i));
    i = at(i);
  }
  return i;
}

/// The runs of a row, by index: from first to before last.
struct RowRuns {
  int first = 0, last = 0;
};

/// Joins the runs of two neighbouring rows where they touch. @param slack [px] 1: corners touch, too; else 0.
void joinRows(const std::vector<InkRun>& runs, RowRuns upper, RowRuns lower, int slack, std::vector<int>& parent) {
  int a = upper.first, b = lower.first;
  while (a < upper.last && b < lower.last) {
    const InkRun& above = runs[a];
    const InkRun& below = runs[b];
    if (above.x0 < below.x1 + slack && below.x0 < above.x1 + slack) {
      const int rootA = findRoot(parent, a), rootB = findRoot(parent, b);
      parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
    }
    if (above.x1 < below.x1) {
      ++a;
    } else {
      ++b;
    }
  }
}

/// Calls `work` with the index of every word that pixels [x0, x1) of a row lie in, and their bits of it.
template <class Work>
void forWords(int x0, int x1, const Work& work) {
  const int first = x0 >> 6, last = (x1 - 1) >> 6;
  for (int i = first; i <= last; ++i) {
    std::uint64_t bits = ~std::uint64_t{0};
    if (i == first) bits &= ~std::uint64_t{0} << (x0 & 63);
    if (i == last) bits &= ~std::uint64_t{0} >> (63 - ((x1 - 1) & 63));
    work(i, bits);
  }
}

bool anyBit(const std::uint64_t* row, int x0, int x1) {
  bool any = false;
  forWords(x0, x1, [&](int i, std::uint64_t bits) { any = any || (row[i] & bits) != 0; });
  return any;
}

void setBits(std::uint64_t* row, int x0, int x1) {
  forWords(x0, x1, [&](int i, std::uint64_t bits) { row[i] |= bits; });
}

struct Strips {
  std::vector<int> rowStart;  ///< Index of the first run of every row, and the total at the end.
  std::vector<InkRun> runs;
};

template <class Rows>
Strips gatherRuns(const Rows& image, const RunContext& context) {
  const int height = image.height(), strips = (height + kRowsPerStrip - 1) / kRowsPerStrip;
  std::vector<std::vector<InkRun>> parts(strips);
  Strips all;
  all.rowStart.assign(height + 1, 0);
  parallelFor(context, height, kRowsPerStrip, [&](int begin, int end) {
    std::vector<InkRun>& part = parts[begin / kRowsPerStrip];
    std::vector<std::uint64_t> own;
    for (int y = begin; y < end; ++y) {
      const std::size_t before = part.size();
      appendRuns(image.row(y, own), image.width(), y, part);
      all.rowStart[y + 1] = static_cast<int>(part.size() - before);
    }
  });
  for (int y = 0; y < height; ++y) all.rowStart[y + 1] += all.rowStart[y];
  all.runs.reserve(all.rowStart.back());
  for (const auto& part : parts) all.runs.insert(all.runs.end(), part.begin(), part.end());
  return all;
}

template <class Rows>
RunPieces piecesOf(const Rows& image, Connectivity connectivity, const RunContext& context) {
  RunPieces result;
  const int height = image.height();
  if (height <= 0 || image.width() <= 0) return result;
  Strips all = gatherRuns(image, context);
  if (context.isCancelled()) return result;
  const int slack = connectivity == Connectivity::Eight ? 1 : 0;
  std::vector<int> parent(all.runs.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto join = [&](int y) {
    const std::size_t row = y;
    joinRows(all.runs, {all.rowStart[row - 1], all.rowStart[row]}, {all.rowStart[row], all.rowStart[row + 1]}, slack,
             parent);
  };
  // Within a strip only its own runs are joined, so strips do not disturb each other; the seams come afterwards.
  parallelFor(context, height, kRowsPerStrip, [&](int begin, int end) {
    for (int y = begin + 1; y < end; ++y) join(y);
  });
  for (int y = kRowsPerStrip; y < height; y += kRowsPerStrip) join(y);
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = parent[parent[i]];
  result.runs = std::move(all.runs);
  result.piece = std::move(parent);
  return result;
}

}  // namespace

RunPieces findPieces(const BitImage& image, Connectivity connectivity, const RunContext& context) {
  return piecesOf(RowsOfImage{image}, connectivity, context);
}

RunPieces findPiecesOfDifference(const BitImage& from, const BitImage& without, Connectivity connectivity,
                                 const RunContext& context) {
  return piecesOf(RowsOfDifference{from, without}, connectivity, context);
}

std::vector<std::int64_t> areasOfPieces(const RunPieces& pieces) {
  std::vector<std::int64_t> area(pieces.runs.size(), 0);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) area[pieces.piece[i]] += pieces.runs[i].x1 - pieces.runs[i].x0;
  return area;
}

std::vector<PieceBox> boxesOfPieces(const RunPieces& pieces) {
  std::vector<PieceBox> boxes(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const InkRun& run = pieces.runs[i];
    PieceBox& box = boxes[pieces.piece[i]];
    box = {std::min(box.x0, run.x0), std::min(box.y0, run.y), std::max(box.x1, run.x1), std::max(box.y1, run.y + 1)};
  }
  return boxes;
}

void setBits(BitImage& image, const InkRun& run) { setBits(image.row(run.y), run.x0, run.x1); }

std::optional<int> pieceAt(const RunPieces& pieces, int x, int y) {
  const auto before = [](const InkRun& run, const std::pair<int, int>& yx) {
    return run.y != yx.first ? run.y < yx.first : run.x1 <= yx.second;
  };
  const auto run = std::lower_bound(pieces.runs.begin(), pieces.runs.end(), std::pair(y, x), before);
  if (run == pieces.runs.end() || run->y != y || run->x0 > x) return {};
  return pieces.piece[run - pieces.runs.begin()];
}

void clearBits(BitImage& image, const InkRun& run) {
  std::uint64_t* row = image.row(run.y);
  forWords(run.x0, run.x1, [&](int i, std::uint64_t bits) { row[i] &= ~bits; });
}

void copyBits(const BitImage& from, const InkRun& run, BitImage& to) {
  const std::uint64_t* source = from.row(run.y);
  std::uint64_t* row = to.row(run.y);
  forWords(run.x0, run.x1, [&](int i, std::uint64_t bits) { row[i] |= source[i] & bits; });
}

int countBits(const BitImage& image, const InkRun& run) {
  const std::uint64_t* row = image.row(run.y);
  int count = 0;
  forWords(run.x0, run.x1, [&](int i, std::uint64_t bits) { count += std::popcount(row[i] & bits); });
  return count;
}

BitImage keepPieces(const BitImage& image, const PieceRule& rule, const RunContext& context) {
  const RunPieces found = findPieces(image, Connectivity::Eight, context);
  const std::vector<std::int64_t> areas = areasOfPieces(found);
  const std::vector<PieceBox> boxes = boxesOfPieces(found);
  std::vector<bool> isSeeded(found.runs.size(), rule.seeds == nullptr);
  for (std::size_t i = 0; i < found.runs.size() && rule.seeds != nullptr; ++i) {
    const InkRun& run = found.runs[i];
    if (anyBit(rule.seeds->row(run.y), run.x0, run.x1)) isSeeded[found.piece[i]] = true;
  }
  BitImage kept(image.width, image.height);
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    const int piece = found.piece[i];
    if (!isSeeded[piece] || areas[piece] < rule.minArea || !(boxes[piece].diagonal() >= rule.minDiagonal)) continue;
    setBits(kept.row(found.runs[i].y), found.runs[i].x0, found.runs[i].x1);
  }
  return kept;
}

void fillHoles(BitImage& image, int area, const RunContext& context) {
  if (area <= 1 || image.width <= 0) return;
  // A hole of fewer than `area` pixels has only shorter gaps: everything else of the paper need not be looked at.
  BitImage gaps(image.width, image.height);
  parallelFor(context, image.height, kRowsPerStrip, [&](int begin, int end) {
    std::vector<InkRun> runs;
    for (int y = begin; y < end; ++y) {
      runs.clear();
      appendRuns(image.row(y), image.width, y, runs);
      for (std::size_t i = 1; i < runs.size(); ++i) {
        if (runs[i].x0 - runs[i - 1].x1 < area) setBits(gaps.row(y), runs[i - 1].x1, runs[i].x0);
      }
    }
  });
  const RunPieces found = findPieces(gaps, Connectivity::Four, context);
  if (context.isCancelled()) return;
  std::vector<std::int64_t> size(found.runs.size(), 0);
  const auto openTowards = [&](const InkRun& run, int y) {
    if (y < 0 || y >= image.height) return true;
    bool isOpen = false;
    forWords(run.x0, run.x1,
             [&](int i, std::uint64_t bits) { isOpen = isOpen || (~(image.row(y)[i] | gaps.row(y)[i]) & bits) != 0; });
    return isOpen;
  };
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    const InkRun& run = found.runs[i];
    const bool open = openTowards(run, run.y - 1) || openTowards(run, run.y + 1);
    size[found.piece[i]] += open ? area : run.x1 - run.x0;
  }
  for (std::size_t i = 0; i < found.runs.size(); ++i) {
    if (size[found.piece[i]] >= area) continue;
    setBits(image.row(found.runs[i].y), found.runs[i].x0, found.runs[i].x1);
  }
}

}  // namespace batten
