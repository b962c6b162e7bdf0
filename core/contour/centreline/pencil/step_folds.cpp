// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/step_folds.h"

#include "core/base/avx2.h"
#include "core/base/hot_loop.h"

namespace batten {
namespace {

struct Sum {
  static float of(float a, float b) { return a + b; }
#ifdef BATTEN_HAS_AVX2
  BATTEN_AVX2 static __m256 of(__m256 a, __m256 b) { return _mm256_add_ps(a, b); }
#endif
};

struct Least {
  static float of(float a, float b) { return a < b ? a : b; }
#ifdef BATTEN_HAS_AVX2
  BATTEN_AVX2 static __m256 of(__m256 a, __m256 b) { return _mm256_min_ps(a, b); }
#endif
};

struct Most {
  static float of(float a, float b) { return a > b ? a : b; }
#ifdef BATTEN_HAS_AVX2
  BATTEN_AVX2 static __m256 of(__m256 a, __m256 b) { return _mm256_max_ps(a, b); }
#endif
};

template <class Fold>
void foldPlain(const float* grey, const int* steps, int stepCount, int count, float* to) {
  for (int i = 0; i < count; ++i) to[i] = grey[steps[0] + i];
  for (int k = 1; k < stepCount; ++k) {
    const float* from = grey + steps[k];
    for (int i = 0; i < count; ++i) to[i] = Fold::of(to[i], from[i]);
  }
}

#ifdef BATTEN_HAS_AVX2

constexpr int kPixelLanes = 8;  // floats that a processor works on at once

// Eight times kVectors pixels at once, of which the folds stay in registers.
template <class Fold, int kVectors>
BATTEN_AVX2 inline void foldBlock(const float* grey, const int* steps, int stepCount, float* to) {
  __m256 folds[kVectors];
  BATTEN_UNROLL
  for (int v = 0; v < kVectors; ++v) folds[v] = _mm256_loadu_ps(grey + steps[0] + kPixelLanes * v);
  for (int k = 1; k < stepCount; ++k) {
    const float* from = grey + steps[k];
    BATTEN_UNROLL
    for (int v = 0; v < kVectors; ++v) folds[v] = Fold::of(folds[v], _mm256_loadu_ps(from + kPixelLanes * v));
  }
  BATTEN_UNROLL
  for (int v = 0; v < kVectors; ++v) _mm256_storeu_ps(to + kPixelLanes * v, folds[v]);
}

template <class Fold>
BATTEN_AVX2 void foldAvx2(const float* grey, const int* steps, int stepCount, int count, float* to) {
  int i = 0;
  for (; i + 8 * kPixelLanes <= count; i += 8 * kPixelLanes) foldBlock<Fold, 8>(grey + i, steps, stepCount, to + i);
  for (; i + 4 * kPixelLanes <= count; i += 4 * kPixelLanes) foldBlock<Fold, 4>(grey + i, steps, stepCount, to + i);
  for (; i + 2 * kPixelLanes <= count; i += 2 * kPixelLanes) foldBlock<Fold, 2>(grey + i, steps, stepCount, to + i);
  for (; i + kPixelLanes <= count; i += kPixelLanes) foldBlock<Fold, 1>(grey + i, steps, stepCount, to + i);
  if (i < count) foldPlain<Fold>(grey + i, steps, stepCount, count - i, to + i);
}

#endif

}  // namespace

StepFolds plainStepFolds() { return {foldPlain<Sum>, foldPlain<Least>, foldPlain<Most>}; }

StepFolds stepFolds() {
#ifdef BATTEN_HAS_AVX2
  if (hasAvx2()) return {foldAvx2<Sum>, foldAvx2<Least>, foldAvx2<Most>};
#endif
  return plainStepFolds();
}

}  // namespace batten
