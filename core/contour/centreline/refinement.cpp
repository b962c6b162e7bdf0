// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/parallel.h"
#include "core/contour/centreline/pixel_placement.h"
#include "core/contour/centreline/stroke_course.h"
#include "core/contour/centreline/stroke_ends.h"
#include "core/contour/centreline/stroke_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kBlock = 512;     // points refined together
constexpr int kAlongHalf = 6;   // profiles averaged to either side
constexpr double kAlong = 2.0;  // [points] Gaussian over neighbouring profiles

struct Block {
  int course, begin, end;
};

std::array<float, kAlongHalf + 1> alongKernel() {
  std::array<float, kAlongHalf + 1> kernel{};
  for (int k = 0; k <= kAlongHalf; ++k) {
    kernel[k] = static_cast<float>(std::exp(-0.5 * k * k / (kAlong * kAlong)));
  }
  return kernel;
}

// Measures the shift of the points [begin, end) of a course. The profiles are averaged in the moving frame, which bends
// with the stroke: no bias on curved strokes.
void measureBlock(StrokeCourse& course, int begin, int end, const GreyImage& grey, CentreRule rule) {
  static const std::array<float, kAlongHalf + 1> kKernel = alongKernel();
  const int n = static_cast<int>(course.base.size());
  const int half = course.profileHalf, samples = 2 * half + 1;
  const auto width = static_cast<std::size_t>(samples);
  const int rows = end - begin + 2 * kAlongHalf;
  std::vector<float> band(static_cast<std::size_t>(rows) * width), mean(width), scratch(width);
  std::vector<char> there(rows, 0);
  for (int r = 0; r < rows; ++r) {
    int i = begin - kAlongHalf + r;
    if (course.closed) i = wrapIndex(i, n);
    if (i < 0 || i >= n) continue;
    there[r] = 1;
    const Vec2& at = course.base[i];
    const Vec2 normal = leftNormal(course.tangent[i]);
    float* out = band.data() + static_cast<std::size_t>(r) * width;
    for (int k = 0; k < samples; ++k) {
      const double u = (k - half) * kStrokeStepPx;
      out[k] = sampleGrey(grey, at.x() + u * normal.x(), at.y() + u * normal.y());
    }
  }
  for (int i = begin; i < end; ++i) {
    std::fill(mean.begin(), mean.end(), 0.0f);
    float weight = 0.0f;
    const int here = i - begin + kAlongHalf;
    // Near an open end the window shrinks evenly, so that it stays centred.
    int reach = kAlongHalf;
    while (reach > 0 && !(there[here - reach] && there[here + reach])) {
      --reach;
    }
    for (int d = -reach; d <= reach; ++d) {
      const float w = kKernel[std::abs(d)];
      const float* row = band.data() + static_cast<std::size_t>(here + d) * width;
      for (std::size_t k = 0; k < width; ++k) mean[k] += w * row[k];
      weight += w;
    }
    for (float& m : mean) m /= weight;
    const auto at = static_cast<std::size_t>(i);
    const StrokeCentre c = rule == CentreRule::Centroid ? centroidCentre(mean, course.radius[at] + 1.5)
                                                        : halfLevelCentre(mean, course.widthPx, scratch);
    course.shift[at] = static_cast<float>(c.centre);
    course.measuredWidth[at] = static_cast<float>(c.width);
    course.measured[at] = c.ok ? 1 : 0;
    course.tone[at] = {static_cast<float>(c.contrast), static_cast<float>(c.paper), static_cast<float>(c.slope),
                       static_cast<float>(c.reach)};
  }
}

void measureAll(std::vector<StrokeCourse>& courses, const GreyImage& grey, CentreRule rule, const RunContext& context) {
  std::vector<Block> blocks;
  for (int c = 0; c < static_cast<int>(courses.size()); ++c) {
    const int n = static_cast<int>(courses[c].base.size());
    for (int begin = 0; begin < n; begin += kBlock) blocks.push_back({c, begin, std::min(n, begin + kBlock)});
  }
  parallelFor(context, static_cast<int>(blocks.size()), 1, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      const Block& block = blocks[b];
      measureBlock(courses[block.course], block.begin, block.end, grey, rule);
    }
  });
}

template <class Body>
void forCourses(std::vector<StrokeCourse>& courses, const RunContext& context, const Body& body) {
  parallelFor(context, static_cast<int>(courses.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) body(static_cast<std::size_t>(i));
  });
}

}  // namespace

std::vector<Contour> refineStrokePaths(const std::vector<StrokePath>& paths, const GreyImage& grey,
                                       const RefineSettings& settings, const RunContext& context) {
  constexpr int kRounds = 2;
  std::vector<StrokeCourse> courses(paths.size());
  forCourses(courses, context, [&](std::size_t i) { courses[i] = resample(paths[i]); });
  if (settings.rule != CentreRule::None) {
    for (int round = 0; round < kRounds && !context.isCancelled(); ++round) {
      measureAll(courses, grey, settings.rule, context);
      forCourses(courses, context, [&](std::size_t i) {
        rejectImplausibleShifts(courses[i], settings.rule == CentreRule::HalfLevel);
        if (settings.smoothShiftPx > 0.0) {
          courses[i].shift = smoothValues(courses[i].shift, courses[i].closed, settings.smoothShiftPx);
        }
        moveCourse(courses[i], round + 1 < kRounds);
      });
    }
  }
  if (settings.rule == CentreRule::HalfLevel) placeOnPixels(courses, grey, context);
  std::vector<Contour> contours(paths.size());
  forCourses(courses, context, [&](std::size_t i) {
    layThroughJunctions(courses[i]);
    if (settings.rule != CentreRule::None) placeEnds(courses[i], grey);
    contours[i] = contourOf(courses[i]);
  });
  return contours;
}

}  // namespace batten
