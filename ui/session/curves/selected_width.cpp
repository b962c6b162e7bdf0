// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curves/selected_width.h"

#include <algorithm>
#include <utility>

#include "core/pipeline/run/stroke_widths.h"
#include "ui/session/background/guarded.h"

namespace batten {

SelectedWidth::SelectedWidth(const EditorSession& session, QObject* parent) : QObject(parent), session_(session) {}

bool SelectedWidth::Asked::isOf(const Asked& other) const {
  return scan == other.scan && output.page == other.output.page && output.contours == other.output.contours &&
         output.pieces == other.output.pieces && curve.piece == other.curve.piece &&
         curve.sketched == other.curve.sketched;
}

/// As quick to tell as the measuring is slow: outlines, pen strokes and imported lines have no widths at their points.
bool SelectedWidth::Asked::isStroke() const {
  if (!output.pieces || !output.contours || curve.piece < 0 || curve.piece >= std::ssize(output.pieces->pieces))
    return false;
  const int contour = output.pieces->pieces[curve.piece].contour;
  if (contour < 0 || contour >= std::ssize(output.contours->contours)) return false;
  return hasStrokeWidths(output.contours->contours[contour].points);
}

void SelectedWidth::follow() {
  const TracedCurve* curve = session_.selected();
  if (!curve || !session_.scan()) return stop();
  PipelineOutput read;  // and none of the rest, which may be large
  const PipelineOutput& all = session_.output();
  read.page = all.page, read.contours = all.contours, read.pieces = all.pieces, read.frame = all.frame;
  auto asked = std::make_shared<const Asked>(Asked{session_.scan(), std::move(read), *curve});
  if (asked_ && asked_->isOf(*asked)) return;
  asked_ = asked;
  figures_.reset();
  isKnown_ = !asked->isStroke();
  if (isKnown_) return worker_.cancelAll();
  worker_.start([this, asked](const CancelToken& token) {
    const auto found = guarded<std::optional<WidthFigures>>([&]() -> Result<std::optional<WidthFigures>> {
      RunContext context;
      context.cancel = token;
      const auto widths = strokeWidthsAlong(asked->output, *asked->scan, asked->curve, asked->curve.sketched, context);
      return widths ? std::optional(figuresOf(*widths)) : std::nullopt;
    });
    if (token.isCancelled()) return;
    // What could not be measured has no row.
    const std::optional<WidthFigures> figures = found ? *found : std::nullopt;
    inbox_.post([this, asked, figures] { take(asked, figures); });
  });
}

void SelectedWidth::stop() {
  worker_.cancelAll();
  asked_.reset();
  figures_.reset();
}

void SelectedWidth::take(const std::shared_ptr<const Asked>& of, const std::optional<WidthFigures>& found) {
  if (of != asked_) return;
  isKnown_ = true;
  figures_ = found;
  emit changed();
}

}  // namespace batten
