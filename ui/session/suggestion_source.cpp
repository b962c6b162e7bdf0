// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/suggestion_source.h"

#include <QPointer>
#include <numbers>
#include <utility>

#include "ui/session/editor_session.h"
#include "ui/session/guarded.h"

namespace batten {
namespace {

/// [px] Over which length a turn counts as a corner.
constexpr double kScalePx = 14.0;

}  // namespace

SuggestionSource::SuggestionSource(EditorSession& session) : QObject(&session), session_(session) {}

void SuggestionSource::look(double angleDeg) {
  const auto contours = session_.output().contours;
  if (contours == of_ && angleDeg == angleDeg_) return;
  of_ = contours;
  angleDeg_ = angleDeg;
  if (!contours) {
    worker_.cancelAll();
    found_.clear();
    emit changed();
    return;
  }
  worker_.start([contours, angleDeg, source = QPointer<SuggestionSource>(this)](const CancelToken& token) {
    auto found = guarded<std::vector<CornerSuggestion>>(
        [&] { return suggestCorners(*contours, angleDeg * std::numbers::pi / 180.0, kScalePx); });
    if (token.isCancelled() || !found || !source) return;
    QMetaObject::invokeMethod(
        source.data(),
        [source, contours, angleDeg, found = std::move(*found)] {
          if (!source || contours != source->of_ || angleDeg != source->angleDeg_) return;
          source->found_ = found;
          emit source->changed();
        },
        Qt::QueuedConnection);
  });
}

}  // namespace batten
