// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curves/pen_fairness.h"

#include <span>
#include <utility>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/segment/regression_segments.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/session/background/guarded.h"

namespace batten {
namespace {

/// What the stroke becomes, and on what page.
struct PenCourse {
  Recipe recipe;  ///< The settings of segments and curves alone.
  PenStroke stroke;
  PageExtent page;
  PageFrame frame;
};

/// The stroke by itself, from the points on: nothing of the page is read.
Result<CurveFairness> fairnessOf(const PenCourse& course, const RunContext& context) {
  const auto lines = withPenStrokes({}, std::span(&course.stroke, 1), course.page);
  if (!lines) return fail(lines.error());
  const auto pieces = splitAtCorners(*lines, {}, course.recipe.corners, context);
  if (!pieces) return fail(pieces.error());
  const auto segments = regressionSegments(*pieces, course.recipe.segments, context);
  if (!segments) return fail(segments.error());
  const auto made = constructAll(*lines, *pieces, *segments, course.recipe, course.frame, context);
  if (!made) return fail(made.error());
  const TracedCurve& curve = made->curves.front();
  const auto fairness = curveFairness(curve.sketched, curve.closed);
  if (!fairness) return fail(ErrorCode::NoCurve, "No curve yet.");
  return *fairness;
}

}  // namespace

PenFairness::PenFairness(const EditorSession& session, QObject* parent) : QObject(parent), session_(session) {}

void PenFairness::follow(PenStroke stroke) {
  if (!session_.hasScan() || validate(stroke)) return;
  PenCourse course{{}, std::move(stroke), {}, frameFor(*session_.scan(), session_.recipe())};
  course.recipe.segments = session_.recipe().segments;
  course.recipe.construct = session_.recipe().construct;
  course.page = {static_cast<double>(session_.scan()->grey.width), static_cast<double>(session_.scan()->grey.height)};
  worker_.start(
      [this, course = std::move(course), line = line_](const CancelToken& token) {
        RunContext context;
        context.cancel = token;
        const auto fairness = guarded<CurveFairness>([&] { return fairnessOf(course, context); });
        if (!fairness || token.isCancelled()) return;
        inbox_.post([this, line, found = *fairness] {
          if (line_ != line) return;
          latest_ = found;
          emit changed();
        });
      },
      BackgroundWorker::Running::Finish);
}

void PenFairness::stop() {
  ++line_;
  latest_.reset();
  worker_.cancelAll();
}

}  // namespace batten
