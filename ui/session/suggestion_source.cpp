// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/suggestion_source.h"

#include <utility>

#include "core/base/angle.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/pipeline/run/corner_places.h"
#include "ui/session/background/guarded.h"
#include "ui/session/editor_session.h"

namespace batten {
SuggestionSource::SuggestionSource(EditorSession& session) : QObject(&session), session_(session) {}

void SuggestionSource::look(double angleDeg, double scalePx) {
  const auto contours = session_.output().contours;
  const double snapPx = session_.recipe().corners.snapDistancePx;
  if (contours == of_ && angleDeg == angleDeg_ && scalePx == scalePx_ && snapPx == snapPx_) return;
  of_ = contours;
  angleDeg_ = angleDeg;
  scalePx_ = scalePx;
  snapPx_ = snapPx;
  if (!contours) {
    worker_.cancelAll();
    found_.clear();
    emit changed();
    return;
  }
  worker_.start([this, contours, angleDeg, scalePx, snapPx](const CancelToken& token) {
    auto found = guarded<std::vector<CornerSuggestion>>([&] {
      const double angle = angleDeg * kRadPerDeg;
      RunContext context;
      context.cancel = token;
      return oncePerCorner(*contours, suggestCornersAndCuts(*contours, angle, scalePx, context), snapPx, context);
    });
    if (token.isCancelled() || !found) return;
    inbox_.post([this, contours, angleDeg, scalePx, snapPx, found = std::move(*found)] {
      if (contours != of_ || angleDeg != angleDeg_ || scalePx != scalePx_ || snapPx != snapPx_) return;
      found_ = found;
      emit changed();
    });
  });
}

}  // namespace batten
