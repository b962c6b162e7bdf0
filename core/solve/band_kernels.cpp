// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/band_kernels.h"

#include "core/base/avx2.h"

namespace batten {
namespace {

constexpr int kRowWidth = RowFours::kWidth;
constexpr int kRowLanes = RowFours::kLanes;

void timesPlain(const RowFours& rows, const double* x, double* out) {
  const double* lanes = rows.lanes;
  for (const RowFour* four = rows.fours; four != rows.fours + rows.count; ++four, lanes += RowFours::kLaneStride) {
    double sums[kRowLanes] = {};
    for (int k = 0; k < kRowWidth; ++k) {
      for (int i = 0; i < kRowLanes; ++i) sums[i] += lanes[kRowLanes * k + i] * x[four->first + k];
    }
    for (int i = 0; i < four->count; ++i) out[four->row + i] = sums[i];
  }
}

void addTransposedPlain(const RowFours& rows, const double* weight, double* x) {
  for (const RowFour* four = rows.fours; four != rows.fours + rows.count; ++four) {
    double* to = x + four->first;
    for (int i = four->row; i < four->row + four->count; ++i) {
      const double* row = rows.rows + i * RowFours::kRowStride;
      for (int k = 0; k < kRowWidth; ++k) to[k] += weight[i] * row[k];
    }
  }
}

void addOuterPlain(const RowFours& rows, const double* weight, double* m) {
  for (const RowFour* four = rows.fours; four != rows.fours + rows.count; ++four) {
    for (int i = four->row; i < four->row + four->count; ++i) {
      const double* row = rows.rows + i * RowFours::kRowStride;
      double* to = m + kRowWidth * four->first;
      for (int a = 0; a < kRowWidth; ++a, to += kRowWidth) {
        const double weighed = weight[i] * row[a];
        for (int b = a; b < kRowWidth; ++b) to[b - a] += weighed * row[b];
      }
    }
  }
}

constexpr BandKernels kPlain{timesPlain, addTransposedPlain, addOuterPlain};  // for every processor

#ifdef BATTEN_HAS_AVX2

BATTEN_AVX2 void timesAvx2(const RowFours& rows, const double* x, double* out) {
  const double* lanes = rows.lanes;
  for (const RowFour* four = rows.fours; four != rows.fours + rows.count; ++four, lanes += RowFours::kLaneStride) {
    const double* at = x + four->first;
    __m256d sum = _mm256_setzero_pd();
    for (int k = 0; k < kRowWidth; ++k)
      sum = _mm256_add_pd(sum, _mm256_mul_pd(_mm256_loadu_pd(lanes + kRowLanes * k), _mm256_broadcast_sd(at + k)));
    double* to = out + four->row;
    if (four->count == kRowLanes) {
      _mm256_storeu_pd(to, sum);
    } else {
      double sums[kRowLanes];
      _mm256_storeu_pd(sums, sum);
      for (int i = 0; i < four->count; ++i) to[i] = sums[i];
    }
  }
}

/// The six sums of neighbouring unknowns stay in registers and move on by one with the rows: what has just been stored
/// is not read again.
BATTEN_AVX2 void addTransposedAvx2(const RowFours& rows, const double* weight, double* x) {
  if (rows.count == 0) return;
  double* at = x + rows.fours->first;
  __m256d low = _mm256_loadu_pd(at);
  __m128d high = _mm_loadu_pd(at + 4);
  for (const RowFour* four = rows.fours; four != rows.fours + rows.count; ++four) {
    double* const wanted = x + four->first;
    if (wanted == at + 1) {
      _mm_store_sd(at, _mm256_castpd256_pd128(low));
      const __m256d after = _mm256_permute2f128_pd(low, _mm256_castpd128_pd256(high), 0x21);
      low = _mm256_shuffle_pd(low, after, 0x5);
      high = _mm_shuffle_pd(high, _mm_load_sd(at + kRowWidth), 0x1);
    } else if (wanted != at) {
      _mm256_storeu_pd(at, low);
      _mm_storeu_pd(at + 4, high);
      low = _mm256_loadu_pd(wanted);
      high = _mm_loadu_pd(wanted + 4);
    }
    at = wanted;
    const double* row = rows.rows + four->row * RowFours::kRowStride;
    const double* own = weight + four->row;
    for (int i = 0; i < four->count; ++i, row += RowFours::kRowStride) {
      const __m256d w = _mm256_broadcast_sd(own + i);
      low = _mm256_add_pd(low, _mm256_mul_pd(w, _mm256_loadu_pd(row)));
      high = _mm_add_pd(high, _mm_mul_pd(_mm256_castpd256_pd128(w), _mm_loadu_pd(row + 4)));
    }
  }
  _mm256_storeu_pd(at, low);
  _mm_storeu_pd(at + 4, high);
}

/// Six rows of a matrix from the diagonal on, those of neighbouring unknowns: the first four entries of each, and the
/// two after these where they lie within the six. No array: that would be kept in memory.
struct MatrixWindow {
  __m256d row0, row1, row2, row3, row4, row5;
  __m128d rest0, rest1;
};

BATTEN_AVX2 inline void loadWindow(const double* at, MatrixWindow& m) {
  m.row0 = _mm256_loadu_pd(at);
  m.rest0 = _mm_loadu_pd(at + 4);
  m.row1 = _mm256_loadu_pd(at + kRowWidth);
  m.rest1 = _mm_loadu_pd(at + kRowWidth + 4);
  m.row2 = _mm256_loadu_pd(at + 2 * kRowWidth);
  m.row3 = _mm256_loadu_pd(at + 3 * kRowWidth);
  m.row4 = _mm256_loadu_pd(at + 4 * kRowWidth);
  m.row5 = _mm256_loadu_pd(at + 5 * kRowWidth);
}

BATTEN_AVX2 inline void storeWindow(const MatrixWindow& m, double* at) {
  _mm256_storeu_pd(at, m.row0);
  _mm_storeu_pd(at + 4, m.rest0);
  _mm256_storeu_pd(at + kRowWidth, m.row1);
  _mm_storeu_pd(at + kRowWidth + 4, m.rest1);
  _mm256_storeu_pd(at + 2 * kRowWidth, m.row2);
  _mm256_storeu_pd(at + 3 * kRowWidth, m.row3);
  _mm256_storeu_pd(at + 4 * kRowWidth, m.row4);
  _mm256_storeu_pd(at + 5 * kRowWidth, m.row5);
}

/// Stores the first row, and takes in the one after the last; `at`: of the new first.
BATTEN_AVX2 inline void moveWindow(MatrixWindow& m, double* at) {
  _mm256_storeu_pd(at - kRowWidth, m.row0);
  _mm_storeu_pd(at - kRowWidth + 4, m.rest0);
  m.row0 = m.row1;
  m.rest0 = m.rest1;
  m.row1 = m.row2;
  m.rest1 = _mm_loadu_pd(at + kRowWidth + 4);
  m.row2 = m.row3;
  m.row3 = m.row4;
  m.row4 = m.row5;
  m.row5 = _mm256_loadu_pd(at + 5 * kRowWidth);
}

BATTEN_AVX2 inline void addProduct(__m256d& sum, __m256d weighed, const double* values) {
  sum = _mm256_add_pd(sum, _mm256_mul_pd(weighed, _mm256_loadu_pd(values)));
}

BATTEN_AVX2 inline void addRowToWindow(const double* row, const double* weight, MatrixWindow& m) {
  const __m256d w = _mm256_broadcast_sd(weight);
  const __m256d by0 = _mm256_mul_pd(w, _mm256_broadcast_sd(row)), by1 = _mm256_mul_pd(w, _mm256_broadcast_sd(row + 1));
  addProduct(m.row0, by0, row);
  addProduct(m.row1, by1, row + 1);
  m.rest0 = _mm_add_pd(m.rest0, _mm_mul_pd(_mm256_castpd256_pd128(by0), _mm_loadu_pd(row + 4)));
  m.rest1 = _mm_add_pd(m.rest1, _mm_mul_pd(_mm256_castpd256_pd128(by1), _mm_loadu_pd(row + 5)));
  addProduct(m.row2, _mm256_mul_pd(w, _mm256_broadcast_sd(row + 2)), row + 2);
  addProduct(m.row3, _mm256_mul_pd(w, _mm256_broadcast_sd(row + 3)), row + 3);
  addProduct(m.row4, _mm256_mul_pd(w, _mm256_broadcast_sd(row + 4)), row + 4);
  addProduct(m.row5, _mm256_mul_pd(w, _mm256_broadcast_sd(row + 5)), row + 5);
}

BATTEN_AVX2 void addOuterAvx2(const RowFours& rows, const double* weight, double* matrix) {
  if (rows.count == 0) return;
  double* at = matrix + kRowWidth * rows.fours->first;
  MatrixWindow m;
  loadWindow(at, m);
  for (const RowFour *four = rows.fours, *end = four + rows.count; four != end; ++four) {
    double* const wanted = matrix + kRowWidth * four->first;
    if (wanted == at + kRowWidth) {
      moveWindow(m, wanted);
    } else if (wanted != at) {
      storeWindow(m, at);
      loadWindow(wanted, m);
    }
    at = wanted;
    const double *row = rows.rows + four->row * RowFours::kRowStride, *own = weight + four->row;
    for (const double* last = own + four->count; own != last; ++own, row += RowFours::kRowStride)
      addRowToWindow(row, own, m);
  }
  storeWindow(m, at);
}

constexpr BandKernels kAvx2{timesAvx2, addTransposedAvx2, addOuterAvx2};

#endif

}  // namespace

const BandKernels& plainBandKernels() { return kPlain; }

const BandKernels& bandKernels() {
#ifdef BATTEN_HAS_AVX2
  if (hasAvx2()) return kAvx2;
#endif
  return kPlain;
}

}  // namespace batten
