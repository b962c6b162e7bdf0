// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/pen_fairness.h"

#include <QPointer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/conventions.h"
#include "core/pipeline/run/pipeline.h"
#include "ui/session/guarded.h"

namespace batten {
namespace {

constexpr double kPenMarginPx = 8.0;
constexpr int kSmallestPagePx = 16, kLargestPagePx = 8000;
constexpr std::size_t kPenCacheBytes = std::size_t{16} << 20;

/// The stroke alone on a page of its size, made as the drawing's lines are.
Result<CurveFairness> fairnessOf(PenStroke stroke, const ConstructParams& construct, double dpi,
                                 const RunContext& context) {
  Vec2 low = stroke.points.front(), high = low;
  for (const Vec2& p : stroke.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  for (Vec2& p : stroke.points) p += Vec2::Constant(kPenMarginPx) - low;
  const Vec2 size = high - low + Vec2::Constant(2.0 * kPenMarginPx);
  const auto pixels = [](double value) {
    return std::clamp(static_cast<int>(std::ceil(value)), kSmallestPagePx, kLargestPagePx);
  };
  const Scan page = blankScan(pixels(size.x()), pixels(size.y()), dpi);
  Recipe recipe;
  recipe.construct = construct;
  recipe.dpi = dpi;
  recipe.page = BlankPage{pixels(size.x()), pixels(size.y())};
  recipe.penStrokes.push_back(std::move(stroke));
  PipelineRequest request;
  request.upTo = StageId::Curves;
  StageCache cache(kPenCacheBytes);
  const PipelineOutput output = runPipeline(page, recipe, cache, request, context);
  if (output.error) return fail(*output.error);
  if (!output.constructed || output.constructed->curves.empty()) return fail(ErrorCode::NoCurve, "No curve yet.");
  const TracedCurve& curve = output.constructed->curves.front();
  const auto fairness = curveFairness(curve.sketched, curve.closed);
  if (!fairness) return fail(ErrorCode::NoCurve, "No curve yet.");
  return *fairness;
}

}  // namespace

PenFairness::PenFairness(const EditorSession& session, QObject* parent) : QObject(parent), session_(session) {}

void PenFairness::follow(PenStroke stroke) {
  if (!session_.hasScan() || validate(stroke)) return;
  const double dpi = kMillimetresPerInch / frameFor(*session_.scan(), session_.recipe()).mmPerPx;
  worker_.start(
      [stroke = std::move(stroke), construct = session_.recipe().construct, dpi, line = line_,
       pen = QPointer<PenFairness>(this)](const CancelToken& token) {
        RunContext context;
        context.cancel = token;
        const auto fairness = guarded<CurveFairness>([&] { return fairnessOf(stroke, construct, dpi, context); });
        if (!fairness || token.isCancelled() || !pen) return;
        QMetaObject::invokeMethod(
            pen.data(),
            [pen, line, found = *fairness] {
              if (!pen || pen->line_ != line) return;
              pen->latest_ = found;
              emit pen->changed();
            },
            Qt::QueuedConnection);
      },
      BackgroundWorker::Running::Finish);
}

void PenFairness::stop() {
  ++line_;
  latest_.reset();
  worker_.cancelAll();
}

}  // namespace batten
