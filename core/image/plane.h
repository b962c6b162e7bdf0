// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "core/base/platform_memory.h"
#include "core/base/run_context.h"
#include "core/image/grey_image.h"

namespace batten {

/// Real numbers over a grid, row by row. The memory is uninitialised.
struct Plane {
  int width = 0;
  int height = 0;
  struct Free {
    void operator()(float* buffer) const { freeBuffer(buffer); }
  };
  std::unique_ptr<float[], Free> data;

  Plane() = default;
  Plane(int w, int h)
      : width(w), height(h), data(static_cast<float*>(allocateBuffer(std::size_t{sizeof(float)} * w * h))) {
    if (!data) throw std::bad_alloc();
  }
  float* row(int y) { return data.get() + std::ptrdiff_t{y} * width; }
  const float* row(int y) const { return data.get() + std::ptrdiff_t{y} * width; }
};

/// Half of a symmetric kernel: tap 0 is the middle. The whole sums to 1.
std::vector<float> gaussianKernel(double variance);

/// Smooths along a row: `in` holds `radius` values before and after the `count` that are asked for.
void smoothAlong(const float* in, float* out, int count, const std::vector<float>& kernel);
/// Smooths across rows: `rows` are 2 radius + 1 pointers, the middle one is the output row.
void smoothAcross(const float* const* rows, float* out, int count, const std::vector<float>& kernel);

/// Separable smoothing; the border is repeated outside.
Plane smooth(const Plane& in, const std::vector<float>& kernel, const RunContext& context);

/// Means over shrink x shrink pixels as grey levels 0..255; the last row and column may cover fewer.
Plane shrinkGrey(const GreyImage& image, int shrink, const RunContext& context);

}  // namespace batten
