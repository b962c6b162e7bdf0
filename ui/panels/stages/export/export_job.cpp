// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_job.h"

#include <algorithm>
#include <new>

namespace batten {

ExportDocument documentOf(const ExportRequest& request, const ExportSettings& settings, CancelCheck check) {
  const auto widths = holdsWidths(settings) ? ExportedWidths::Measured : ExportedWidths::None;
  const ExportDocument whole =
      exportDocument(request.output, request.recipe, *request.scan, request.which, widths, check);
  return request.numbers ? onlyCurves(whole, *request.numbers) : whole;
}

Result<ExportReport> runExport(const ExportRequest& request, const RunContext& context) {
  try {
    const ExportDocument document = documentOf(request, request.settings, context);
    if (context.isCancelled()) return cancelled();
    if (document.curves.empty())
      return fail(ErrorCode::NoCurve, "There is no curve to export. Include at least one curve (the eye in the list).");
    return exportToFile(document, request.settings, request.path, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to export. Close other programs or exclude some curves.");
  }
}

ExportSize exportSize(const PipelineOutput& output, ExportedCurves which, const std::optional<std::set<int>>& numbers) {
  ExportSize size;
  if (!output.faired) return size;
  Vec2 low(0, 0), high(0, 0);
  bool first = true;
  const auto add = [&](const NurbsCurve& shape) {
    const int samples = std::max(64, 8 * shape.controlPointCount());
    for (int i = 0; i <= samples; ++i) {
      const Vec2 p = shape.point(shape.start() + (shape.end() - shape.start()) * i / samples);
      low = first ? p : Vec2(low.cwiseMin(p));
      high = first ? p : Vec2(high.cwiseMax(p));
      first = false;
    }
    ++size.curves;
  };
  for (const TracedCurve& curve : output.faired->curves) {
    if (!curve.included || (numbers && !numbers->contains(curveNumber(output, curve)))) continue;
    if (which != ExportedCurves::Sketched && !curve.faired.isEmpty()) add(curve.faired);
    if (which != ExportedCurves::Faired && !curve.sketched.isEmpty()) add(curve.sketched);
  }
  size.widthMm = high.x() - low.x();
  size.heightMm = high.y() - low.y();
  return size;
}

}  // namespace batten
