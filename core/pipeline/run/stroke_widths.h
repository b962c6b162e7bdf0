// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "core/base/cancel_check.h"
#include "core/curve/width_profile.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// The widths of the strokes of an output. What is of a whole line is measured once for all curves on it.
class StrokeWidths {
 public:
  /// All must outlive it.
  StrokeWidths(const PipelineOutput&, const Scan&, CancelCheck = {});
  ~StrokeWidths();
  StrokeWidths(const StrokeWidths&) = delete;
  StrokeWidths& operator=(const StrokeWidths&) = delete;

  /// As strokeWidthsAlong().
  std::optional<WidthProfile> along(const TracedCurve&, const NurbsCurve& shape);

 private:
  class OfLine;
  /// Null for a line that has no widths.
  const OfLine* ofLine(int contour);

  const PipelineOutput& output_;
  const Scan& scan_;
  CancelCheck check_;
  std::map<int, std::unique_ptr<OfLine>> lines_;  ///< By contour.
};

/// [mm] The stroke's width along one of the two shapes of a traced curve, from the widths that were measured at the
/// points of its line and, where the stroke is too thin for its edges to be told apart, from the darkness of its ink.
/// Absent for lines without widths: outlines, pen strokes, imported ones.
std::optional<WidthProfile> strokeWidthsAlong(const PipelineOutput&, const Scan&, const TracedCurve&,
                                              const NurbsCurve& shape, CancelCheck = {});

}  // namespace batten
