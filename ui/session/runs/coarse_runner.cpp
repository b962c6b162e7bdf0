// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/runs/coarse_runner.h"

#include <algorithm>
#include <thread>

#include "core/pipeline/run/coarse_run.h"
#include "ui/session/background/guarded.h"

namespace batten {

void CoarseRunner::start(Request request) {
  if (coarseFactor(*request.scan, request.recipe) <= 1) return;
  worker_.start([this, request = std::move(request)](const CancelToken& token) { run(request, token); },
                BackgroundWorker::Running::Finish);
}

void CoarseRunner::run(const Request& request, const CancelToken& token) {
  RunContext context;
  context.cancel = token;
  // The exact run beside it takes all threads and would wait for these. On two processors, at 10 megapixels, the coarse
  // ink takes 50 ms with half of the threads and with all of them, and the exact run is done after 275 instead of 295
  // ms. Coarse curves are asked for where nothing is seen yet: they have all.
  if (!request.withCurves) context.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2);
  // What fails here fails in the full run, which says so.
  (void)guarded<bool>([&]() -> Result<bool> {
    const int factor = coarseFactor(*request.scan, request.recipe);
    if (!page_ || pageOf_.lock() != request.scan) {
      auto page = std::make_shared<const Scan>(coarsePage(*request.scan, factor, context));
      if (token.isCancelled()) return cancelled();
      (void)cache_.release();
      page_ = std::move(page);
      pageOf_ = request.scan;
    }
    PipelineRequest wanted;
    wanted.needEdges = false;
    wanted.isPreview = true;
    wanted.upTo = request.withCurves ? StageId::Faired : StageId::Filtered;
    wanted.stageReady = [&](StageId stage, const PipelineOutput& output) {
      if (!token.isCancelled() && (stage == StageId::Filtered || stage == StageId::Faired)) post(request, output);
    };
    (void)runPipeline(*page_, coarseRecipe(request.recipe, *request.scan, factor), cache_, wanted, context);
    return true;
  });
}

void CoarseRunner::post(const Request& request, const PipelineOutput& output) {
  auto result = std::make_shared<CoarseResult>();
  result->factor = coarseFactor(*request.scan, request.recipe);
  result->binary = output.binary;
  result->filtered = output.filtered;
  result->faired = output.faired;
  result->frame = coarseFrame(output.frame, result->factor);
  result->generation = request.generation;
  inbox_.post([this, scan = request.scan, result] { show_(scan, result); });
}

}  // namespace batten
