// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_pieces.h"

#include <cstddef>
#include <utility>

#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr double kStepPx = 0.5;  // of the samples of the dense curve

void lighten(ConstructedPiece& piece, bool closed, const LightOptions& options, double pixelMm,
             const RunContext& context) {
  auto light = makeLight(piece.curve, closed, options, context);
  if (!light) return;  // cancelled, or nothing that a light curve could stand for
  piece.report.light = lightNote(light->report, pixelMm);
  if (light->report.kind == LightKind::Dense) return;
  piece.dense = std::exchange(piece.curve, std::move(light->curve));
  piece.report.isLine = piece.report.isLine || light->report.kind == LightKind::Line;
  piece.report.isCircle = piece.report.isCircle || (closed && light->report.kind == LightKind::Arc);
}

}  // namespace

LightOptions lightOptions(const ConstructParams& params, double pixelMm) {
  LightOptions options;
  options.tolerance = params.lightTolerancePx * pixelMm;
  options.step = kStepPx * pixelMm;
  return options;
}

LightNote lightNote(const LightReport& report, double pixelMm) {
  LightNote note;
  note.found = report.kind != LightKind::Dense;
  note.exact = report.kind == LightKind::Line || report.kind == LightKind::Arc;
  note.points = report.points;
  note.pointsBefore = report.pointsBefore;
  note.movedPx = report.worst / pixelMm;
  return note;
}

Result<void> makePiecesLight(std::vector<ConstructedPiece>& made, const ConstructContour& contour,
                             const ConstructParams& params, const RunContext& context) {
  const LightOptions options = lightOptions(params, contour.pixelMm);
  parallelFor(context, static_cast<int>(made.size()), 1, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (!context.isCancelled()) lighten(made[i], contour.pieces[i].closed, options, contour.pixelMm, context);
    }
  });
  if (context.isCancelled()) return cancelled();
  return {};
}

}  // namespace batten
