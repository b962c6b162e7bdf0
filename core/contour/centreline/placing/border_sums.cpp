// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/placing/border_sums.h"

#include "core/base/avx2.h"

namespace batten {
namespace {

BorderSums sumsPlain(const StrokePixels& pixels, const StrokeBorders& m, const BorderResiduals& out) {
  BorderSums sums;
  for (int i = 0; i < pixels.count; ++i) {
    const double distance = pixels.distance[i], w = pixels.weight[i];
    const ResponseRow::Value in = m.response.at(distance - m.low), past = m.response.at(distance - m.high);
    const double e = pixels.grey[i] - (m.paper + m.slope * distance - m.contrast * (in.part - past.part));
    const double byLow = m.contrast * in.slope, byHigh = -m.contrast * past.slope;
    sums.ll += w * byLow * byLow;
    sums.lh += w * byLow * byHigh;
    sums.hh += w * byHigh * byHigh;
    sums.l += w * byLow * e;
    sums.h += w * byHigh * e;
    out.left[i] = e;
    out.byLow[i] = byLow;
    out.byHigh[i] = byHigh;
  }
  return sums;
}

SquareSums squaresPlain(const StrokePixels& pixels, const BorderResiduals& of) {
  SquareSums sums;
  for (int i = 0; i < pixels.count; ++i) {
    const double w = pixels.weight[i], w2 = w * w, e = of.left[i], byLow = of.byLow[i], byHigh = of.byHigh[i];
    sums.ll += w2 * byLow * byLow;
    sums.lh += w2 * byLow * byHigh;
    sums.hh += w2 * byHigh * byHigh;
    sums.squares += w * e * e;
    sums.weights += w;
  }
  return sums;
}

constexpr BorderKernels kPlainBorders{sumsPlain, squaresPlain};  // for any processor

#ifdef BATTEN_HAS_AVX2

struct FourResponses {
  __m256d part, slope;
};

/// Two neighbouring pairs of a table.
BATTEN_AVX2 inline __m128 pairsAt(const ResponseRow& row, int index) { return _mm_loadu_ps(row.values + 2 * index); }

BATTEN_AVX2 inline __m256d valueBetween(__m128 here, __m128 step, __m256d f) {
  return _mm256_add_pd(_mm256_cvtps_pd(here), _mm256_mul_pd(f, _mm256_cvtps_pd(step)));
}

/// ResponseRow::at() for four distances.
BATTEN_AVX2 inline FourResponses responsesAt(const ResponseRow& row, __m256d distance) {
  const __m256d zero = _mm256_setzero_pd(), most = _mm256_set1_pd(row.columns - 2.0);
  const __m256d place =
      _mm256_mul_pd(_mm256_add_pd(distance, _mm256_set1_pd(row.range)), _mm256_set1_pd(double{ResponseRow::kPerPx}));
  const __m256d within = _mm256_min_pd(_mm256_max_pd(place, zero), most);
  const __m128i k = _mm256_cvttpd_epi32(within);
  const __m256d f = _mm256_sub_pd(within, _mm256_cvtepi32_pd(k));
  const __m128 a = pairsAt(row, _mm_extract_epi32(k, 0)), b = pairsAt(row, _mm_extract_epi32(k, 1)),
               c = pairsAt(row, _mm_extract_epi32(k, 2)), d = pairsAt(row, _mm_extract_epi32(k, 3));
  const __m128 abHere = _mm_unpacklo_ps(a, b), cdHere = _mm_unpacklo_ps(c, d);
  const __m128 abNext = _mm_unpackhi_ps(a, b), cdNext = _mm_unpackhi_ps(c, d);
  const __m128 part = _mm_movelh_ps(abHere, cdHere), slope = _mm_movehl_ps(cdHere, abHere);
  const __m128 partStep = _mm_sub_ps(_mm_movelh_ps(abNext, cdNext), part),
               slopeStep = _mm_sub_ps(_mm_movehl_ps(cdNext, abNext), slope);
  const __m256d after = _mm256_cmp_pd(place, most, _CMP_GE_OQ), inside = _mm256_cmp_pd(place, zero, _CMP_GT_OQ);
  return {_mm256_and_pd(inside, _mm256_blendv_pd(valueBetween(part, partStep, f), _mm256_set1_pd(1.0), after)),
          _mm256_and_pd(inside, _mm256_andnot_pd(after, valueBetween(slope, slopeStep, f)))};
}

/// Four numbers of four pixels each: `sum` += those of the first pixel, then of the second ...
BATTEN_AVX2 inline void addByPixel(__m256d& sum, __m256d a, __m256d b, __m256d c, __m256d d) {
  const __m256d ab02 = _mm256_unpacklo_pd(a, b), ab13 = _mm256_unpackhi_pd(a, b);
  const __m256d cd02 = _mm256_unpacklo_pd(c, d), cd13 = _mm256_unpackhi_pd(c, d);
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab02, cd02, 0x20));
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab13, cd13, 0x20));
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab02, cd02, 0x31));
  sum = _mm256_add_pd(sum, _mm256_permute2f128_pd(ab13, cd13, 0x31));
}

BATTEN_AVX2 inline void addByPixel(__m128d& sum, __m256d a) {
  const __m128d low = _mm256_castpd256_pd128(a), high = _mm256_extractf128_pd(a, 1);
  sum = _mm_add_sd(sum, low);
  sum = _mm_add_sd(sum, _mm_unpackhi_pd(low, low));
  sum = _mm_add_sd(sum, high);
  sum = _mm_add_sd(sum, _mm_unpackhi_pd(high, high));
}

BATTEN_AVX2 BorderSums sumsAvx2(const StrokePixels& pixels, const StrokeBorders& m, const BorderResiduals& out) {
  __m256d sum = _mm256_setzero_pd();  // ll, lh, hh, l
  __m128d sumH = _mm_setzero_pd();
  const __m256d low = _mm256_set1_pd(m.low), high = _mm256_set1_pd(m.high), paper = _mm256_set1_pd(m.paper),
                slope = _mm256_set1_pd(m.slope), contrast = _mm256_set1_pd(m.contrast),
                minus = _mm256_set1_pd(-m.contrast);
  for (int i = 0; i < pixels.count; i += 4) {
    const __m256d distance = _mm256_loadu_pd(pixels.distance + i), w = _mm256_loadu_pd(pixels.weight + i);
    const FourResponses in = responsesAt(m.response, _mm256_sub_pd(distance, low)),
                        past = responsesAt(m.response, _mm256_sub_pd(distance, high));
    const __m256d beside = _mm256_add_pd(paper, _mm256_mul_pd(slope, distance));
    const __m256d model = _mm256_sub_pd(beside, _mm256_mul_pd(contrast, _mm256_sub_pd(in.part, past.part)));
    const __m256d e = _mm256_sub_pd(_mm256_loadu_pd(pixels.grey + i), model);
    const __m256d byLow = _mm256_mul_pd(contrast, in.slope), byHigh = _mm256_mul_pd(minus, past.slope);
    const __m256d wLow = _mm256_mul_pd(w, byLow), wHigh = _mm256_mul_pd(w, byHigh);
    addByPixel(sum, _mm256_mul_pd(wLow, byLow), _mm256_mul_pd(wLow, byHigh), _mm256_mul_pd(wHigh, byHigh),
               _mm256_mul_pd(wLow, e));
    addByPixel(sumH, _mm256_mul_pd(wHigh, e));
    _mm256_storeu_pd(out.left + i, e);
    _mm256_storeu_pd(out.byLow + i, byLow);
    _mm256_storeu_pd(out.byHigh + i, byHigh);
  }
  double sums[4];
  _mm256_storeu_pd(sums, sum);
  return {sums[0], sums[1], sums[2], sums[3], _mm_cvtsd_f64(sumH)};
}

BATTEN_AVX2 SquareSums squaresAvx2(const StrokePixels& pixels, const BorderResiduals& of) {
  __m256d sum = _mm256_setzero_pd();  // ll, lh, hh, squares
  __m128d sumW = _mm_setzero_pd();
  for (int i = 0; i < pixels.count; i += 4) {
    const __m256d w = _mm256_loadu_pd(pixels.weight + i), e = _mm256_loadu_pd(of.left + i);
    const __m256d byLow = _mm256_loadu_pd(of.byLow + i), byHigh = _mm256_loadu_pd(of.byHigh + i);
    const __m256d w2 = _mm256_mul_pd(w, w), w2Low = _mm256_mul_pd(w2, byLow), w2High = _mm256_mul_pd(w2, byHigh);
    addByPixel(sum, _mm256_mul_pd(w2Low, byLow), _mm256_mul_pd(w2Low, byHigh), _mm256_mul_pd(w2High, byHigh),
               _mm256_mul_pd(_mm256_mul_pd(w, e), e));
    addByPixel(sumW, w);
  }
  double sums[4];
  _mm256_storeu_pd(sums, sum);
  return {sums[0], sums[1], sums[2], sums[3], _mm_cvtsd_f64(sumW)};
}

constexpr BorderKernels kAvx2Borders{sumsAvx2, squaresAvx2};  // four values at once

#endif

}  // namespace

const BorderKernels& plainBorderKernels() { return kPlainBorders; }

const BorderKernels& borderKernels() {
#ifdef BATTEN_HAS_AVX2
  if (hasAvx2()) return kAvx2Borders;
#endif
  return kPlainBorders;
}

}  // namespace batten
