// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/explanation_source.h"

#include <utility>

#include "ui/session/background/guarded.h"
#include "ui/session/editor_session.h"

namespace batten {

ExplanationSource::ExplanationSource(EditorSession& session) : QObject(&session), session_(session) {
  connect(&session_, &EditorSession::runFinished, this, &ExplanationSource::follow);
  connect(&session_, &EditorSession::recipeChanged, this, &ExplanationSource::follow);
  connect(&session_, &EditorSession::stopped, this, [this] {
    if (isComputing_) forget();
  });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::pageChanged})
    connect(&session_, signal, this, &ExplanationSource::forget);
}

void ExplanationSource::setWanted(bool wanted) {
  if (std::exchange(isWanted_, wanted) == wanted) return;
  if (wanted)
    follow();
  else
    forget();
}

std::shared_ptr<const Explanation> ExplanationSource::found() const {
  return session_.output().faired == of_ ? found_ : nullptr;
}

void ExplanationSource::follow() {
  const PipelineOutput& output = session_.output();
  // While a run goes on its curves come first.
  if (!isWanted_ || session_.isBusy() || session_.isStale(StageId::Faired) || !output.faired) {
    if (isComputing_) forget();
    return;
  }
  if (output.faired == of_) return;
  of_ = output.faired;
  found_.reset();
  isComputing_ = true;
  session_.setSideWork(this, true);
  worker_.start([this, scan = session_.scan(), recipe = session_.recipe(), output](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto result = guarded<Explanation>([&] { return explainPage(*scan, recipe, output, context); });
    if (token.isCancelled()) return;
    std::shared_ptr<const Explanation> found;
    if (result) found = std::make_shared<const Explanation>(std::move(*result));
    inbox_.post([this, of = output.faired, found] {
      if (of != of_) return;
      found_ = found;
      stop();
      emit changed();
    });
  });
  emit changed();
}

void ExplanationSource::stop() {
  worker_.cancelAll();
  if (std::exchange(isComputing_, false)) session_.setSideWork(this, false);
}

void ExplanationSource::forget() {
  stop();
  of_.reset();
  found_.reset();
  emit changed();
}

}  // namespace batten
