// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/growing_player.h"

#include <algorithm>

#include "ui/session/background/guarded.h"
#include "ui/session/editor_session.h"

namespace batten {
namespace {

constexpr int kStepMs = 350;  // each step is seen

}  // namespace

GrowingPlayer::GrowingPlayer(EditorSession& session) : QObject(&session), session_(session) {
  timer_.setInterval(kStepMs);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (isMore()) stepBy(1);
    if (!isMore()) setPlaying(false);
  });
  connect(&session_, &EditorSession::selectionChanged, this, &GrowingPlayer::compute);
  connect(&session_, &EditorSession::runFinished, this, &GrowingPlayer::compute);
  connect(&session_, &EditorSession::scanOpened, this, &GrowingPlayer::close);
  connect(&session_, &EditorSession::stopped, this, [this] {
    if (isComputing()) close();
  });
}

void GrowingPlayer::open() {
  if (isOpen_) return;
  isOpen_ = true;
  compute();
}

void GrowingPlayer::close() {
  if (!isOpen_) return;
  isOpen_ = false;
  timer_.stop();
  worker_.cancelAll();
  ++newest_;
  source_.reset();
  steps_.reset();
  problem_.clear();
  step_.reset();
  emit changed();
}

void GrowingPlayer::compute() {
  if (!isOpen_) return;
  // A run that leaves the line as it is leaves the player where it stands.
  const TracedCurve* selected = session_.selected();
  const Source source{session_.output().pieces, session_.output().segments, session_.recipe().construct,
                      session_.recipe().segmentPoints, selected ? std::optional(selected->piece) : std::nullopt};
  if (source_ && *source_ == source) return;
  source_ = source;
  const std::uint64_t request = ++newest_;
  timer_.stop();
  steps_.reset();
  step_.reset();
  const auto pieces = session_.output().pieces;
  const auto segments = session_.output().segments;
  problem_ = selected && pieces && segments ? QString() : tr("Select a curve to see how its chain grows.");
  emit changed();
  if (!problem_.isEmpty()) return;
  worker_.start([this, pieces, segments, request, recipe = session_.recipe(), frame = session_.output().frame,
                 piece = selected->piece](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    auto result = guarded<std::vector<GrowingStep>>(
        [&] { return growingStepsOf(*pieces, *segments, recipe, frame, piece, context); });
    if (token.isCancelled()) return;
    auto steps = result ? std::make_shared<const std::vector<GrowingStep>>(std::move(*result)) : nullptr;
    const QString problem = result ? QString() : QString::fromStdString(result.error().message);
    inbox_.post([this, request, steps, problem] { take(request, steps, problem); });
  });
}

void GrowingPlayer::take(std::uint64_t request, std::shared_ptr<const std::vector<GrowingStep>> steps,
                         const QString& problem) {
  if (request != newest_ || !isOpen_) return;
  steps_ = std::move(steps);
  problem_ = problem;
  if (steps_ && steps_->empty()) problem_ = tr("This line is nowhere curved enough for typical curves.");
  step_ = stepCount() > 0 ? std::optional(0) : std::nullopt;
  emit changed();
}

void GrowingPlayer::setStep(int step) {
  if (stepCount() == 0) return;
  const int bounded = std::clamp(step, 0, stepCount() - 1);
  if (bounded == step_) return;
  step_ = bounded;
  emit changed();
}

void GrowingPlayer::setPlaying(bool playing) {
  if (playing == timer_.isActive()) return;
  if (playing && stepCount() > 0) {
    if (!isMore()) step_ = 0;
    timer_.start();
  } else {
    timer_.stop();
  }
  emit changed();
}

}  // namespace batten
