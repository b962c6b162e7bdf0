// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/runs/merge_outputs.h"

namespace batten {

void mergeOutputs(PipelineOutput& shown, const PipelineOutput& run, StageId last) {
  const auto take = [last](StageId stage, auto& to, const auto& from) {
    if (stage <= last) to = from;
  };
  take(StageId::Thresholds, shown.page, run.page);
  take(StageId::Thresholds, shown.thresholds, run.thresholds);
  take(StageId::Binary, shown.binary, run.binary);
  take(StageId::Filtered, shown.filtered, run.filtered);
  take(StageId::Edges, shown.edges, run.edges);
  take(StageId::Contours, shown.contours, run.contours);
  take(StageId::Pieces, shown.pieces, run.pieces);
  take(StageId::Segments, shown.segments, run.segments);
  take(StageId::Curves, shown.constructed, run.constructed);
  take(StageId::Faired, shown.faired, run.faired);
  if (shown.frame != run.frame) {
    // Curves in millimetres of another frame would be drawn at the wrong place.
    if (last < StageId::Curves) shown.constructed.reset();
    if (last < StageId::Faired) shown.faired.reset();
    shown.frame = run.frame;
  }
  // The numbers belong to the curves shown: curves of the run before keep theirs until the new ones are there.
  if (last == StageId::Faired || (run.numbers && !shown.faired)) shown.numbers = run.numbers;
  shown.timing = run.timing;
  shown.error = run.error;
  shown.failedStage = run.failedStage;
}

}  // namespace batten
