// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/placing/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/parallel.h"
#include "core/contour/centreline/ends/stroke_ends.h"
#include "core/contour/centreline/placing/course_junctions.h"
#include "core/contour/centreline/placing/pixel_placement.h"
#include "core/contour/centreline/profile/grey_across.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kCoursePointsPerBlock = 512;  // refined together; the result does not depend on it
constexpr double kAlong = 2.0;              // [points] Gaussian over neighbouring profiles
constexpr double kBesideInkPx = 1.5;        // of which the mask may have lost a border

// Points of a course.
struct CourseBlock {
  int course, begin, end;
};

// A Gaussian of its own, because whole profiles are averaged: smoothValues() mirrors the ends of a line, while here the
// window shrinks evenly towards them.
std::array<float, kMeanHalf + 1> alongKernel() {
  std::array<float, kMeanHalf + 1> kernel{};
  for (int k = 0; k <= kMeanHalf; ++k) {
    kernel[k] = static_cast<float>(std::exp(-0.5 * k * k / (kAlong * kAlong)));
  }
  return kernel;
}

// Measures the shift of the points [begin, end) of a course. The profiles are averaged in the moving frame, which bends
// with the stroke: no bias on curved strokes.
void measureBlock(StrokeCourse& course, int begin, int end, const GreyImage& grey, CentreRule rule) {
  static const std::array<float, kMeanHalf + 1> kKernel = alongKernel();
  const int n = course.count();
  const int half = course.profileHalf, samples = 2 * half + 1;
  const int rows = end - begin + 2 * kMeanHalf;
  std::vector<float> profiles(static_cast<std::ptrdiff_t>(rows) * samples), mean(samples), scratch(samples);
  std::vector<char> there(rows, 0);
  const auto rowOf = [&](int r) { return profiles.data() + static_cast<std::ptrdiff_t>(r) * samples; };
  for (int r = 0; r < rows; ++r) {
    int i = begin - kMeanHalf + r;
    if (course.closed) i = wrapIndex(i, n);
    if (i < 0 || i >= n) continue;
    there[r] = 1;
    sampleAcross(grey, course.points[i].base, leftNormal(course.points[i].tangent), half, rowOf(r));
  }
  for (int i = begin; i < end; ++i) {
    const int here = i - begin + kMeanHalf;
    // Near an open end the window shrinks evenly, so that it stays centred.
    int reach = kMeanHalf;
    while (reach > 0 && !(there[here - reach] && there[here + reach])) {
      --reach;
    }
    float weight = 0.0f;
    for (int d = -reach; d <= reach; ++d) weight += kKernel[std::abs(d)];
    if (reach == kMeanHalf) {
      meanOfProfiles(rowOf(here - reach), samples, kKernel.data(), weight, mean.data());
    } else {
      std::fill(mean.begin(), mean.end(), 0.0f);
      for (int d = -reach; d <= reach; ++d) {
        const float* row = rowOf(here + d);
        for (int k = 0; k < samples; ++k) mean[k] += kKernel[std::abs(d)] * row[k];
      }
      for (float& m : mean) m /= weight;
    }
    CoursePoint& p = course.points[i];
    const std::optional<StrokeCentre> c = rule == CentreRule::Centroid ? centroidCentre(mean, p.radius + kBesideInkPx)
                                                                       : halfLevelCentre(mean, course.widthPx, scratch);
    p.measured = c.has_value();
    p.shift = c ? static_cast<float>(c->centre) : 0.0f;
    p.measuredWidth = c ? static_cast<float>(c->width) : 0.0f;
    p.tone.reset();
    if (!c) continue;
    p.tone = {static_cast<float>(c->contrast), static_cast<float>(c->paper), static_cast<float>(c->slope),
              static_cast<float>(c->reach)};
  }
}

void measureAll(std::vector<StrokeCourse>& courses, const GreyImage& grey, CentreRule rule, const RunContext& context) {
  std::vector<CourseBlock> blocks;
  for (int c = 0; c < static_cast<int>(courses.size()); ++c) {
    const int n = courses[c].count();
    for (int begin = 0; begin < n; begin += kCoursePointsPerBlock)
      blocks.push_back({c, begin, std::min(n, begin + kCoursePointsPerBlock)});
  }
  parallelFor(context, static_cast<int>(blocks.size()), 1, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      const CourseBlock& block = blocks[b];
      measureBlock(courses[block.course], block.begin, block.end, grey, rule);
    }
  });
}

template <class Body>
void forCourses(std::vector<StrokeCourse>& courses, const RunContext& context, const Body& body) {
  parallelFor(context, static_cast<int>(courses.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) body(i);
  });
}

}  // namespace

RefinedStrokes refineStrokePaths(const std::vector<StrokePath>& paths, const GreyImage& grey,
                                 const RefineSettings& settings, const RunContext& context) {
  constexpr int kRounds = 2;  // the second samples across the middle that the first found
  std::vector<StrokeCourse> courses(paths.size());
  forCourses(courses, context, [&](int i) {
    courses[i] = resample(paths[i]);
    if (settings.rule != CentreRule::Centroid) hideBlots(courses[i]);  // the width of a pencil's strokes varies
  });
  if (settings.rule != CentreRule::None) {
    for (int round = 0; round < kRounds && !context.isCancelled(); ++round) {
      measureAll(courses, grey, settings.rule, context);
      forCourses(courses, context, [&](int i) {
        rejectImplausibleShifts(courses[i], settings.rule == CentreRule::HalfLevel);
        if (settings.smoothShiftPx > 0.0) {
          setValues(courses[i], &CoursePoint::shift,
                    smoothValues(valuesOf(courses[i], &CoursePoint::shift), courses[i].closed, settings.smoothShiftPx));
        }
        moveCourse(courses[i], round + 1 < kRounds);
      });
    }
  }
  if (settings.rule == CentreRule::HalfLevel) placeOnPixels(courses, grey, context);
  RefinedStrokes refined;
  refined.contours.resize(paths.size());
  std::vector<FreeEnds> ends(paths.size());
  forCourses(courses, context, [&](int i) {
    layThroughJunctions(courses[i]);
    removeJogs(courses[i]);
    if (settings.rule != CentreRule::None) ends[i] = findEnds(courses[i], grey, settings.rule == CentreRule::Centroid);
  });
  const double cutOdds = cutOddsOf(ends);
  forCourses(courses, context, [&](int i) {
    placeEnds(courses[i], ends[i], cutOdds);
    refined.contours[i] = contourOf(courses[i]);
  });
  for (const StrokeCourse& c : courses) refined.faint.insert(refined.faint.end(), c.faint.begin(), c.faint.end());
  return refined;
}

}  // namespace batten
