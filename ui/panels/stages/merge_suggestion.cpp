// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/merge_suggestion.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/background/guarded.h"

namespace batten {
namespace {

// Holds the masks and lines of a page between the two traces; the session has its own cache beside this one.
constexpr std::size_t kCacheBytes = std::size_t{64} << 20;

}  // namespace

MergeSuggestion::MergeSuggestion(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      note_(note({}, this)),
      ask_(linkButton(tr("Suggest"), QStringLiteral("edges.suggestMerge"), this)),
      offer_(linkButton(tr("Curves that were meant"), QStringLiteral("edges.offerIntent"), this)) {
  note_->setObjectName(QStringLiteral("edges.suggestMerge.note"));
  ask_->setAccessibleName(tr("Suggest merge distance"));
  ask_->setToolTip(tr("Checks for overdrawn strokes and sets the merge distance if there are any."));
  offer_->setToolTip(tr("Replaces lines that were drawn over more than once by the curves that were meant."));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  column->addLayout(row);
  column->addWidget(offer_, 0, Qt::AlignRight);
  row->addWidget(note_, 1);
  row->addWidget(ask_, 0, Qt::AlignTop | Qt::AlignRight);
  say({});
  connect(ask_, &QPushButton::clicked, this, &MergeSuggestion::look);
  connect(offer_, &QPushButton::clicked, this, [this] {
    Recipe after = session_.recipe();
    after.edges.intent = true;
    session_.change(tr("Curves that were meant"), std::move(after));
  });
  connect(&session_, &EditorSession::recipeChanged, this, &MergeSuggestion::showOffer);
  connect(&session_, &EditorSession::stopped, this, &MergeSuggestion::stop);
  connect(&session_, &EditorSession::recipeChanged, this, &MergeSuggestion::follow);
  connect(&session_, &EditorSession::scanOpened, this, [this] {
    stop();
    said_.reset();
    say({});
  });
}

void MergeSuggestion::look() {
  const auto scan = session_.scan();
  if (!scan) return;
  const Recipe recipe = session_.recipe();
  const ContentHash key = mergeAdviceKey(*scan, recipe);
  asked_ = key;
  said_.reset();
  say(tr("Analysing strokes…"));
  session_.setSideWork(this, true, false);
  worker_.start([this, scan, recipe, key](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    const auto advice = guarded<MergeAdvice>([&] {
      StageCache cache(kCacheBytes);
      return adviseMerge(*scan, recipe, cache, context);
    });
    if (token.isCancelled()) return;
    inbox_.post([this, scan, key, advice] {
      if (session_.scan() == scan && asked_ == key) take(advice);
    });
  });
}

void MergeSuggestion::take(const Result<MergeAdvice>& advice) {
  said_ = {*asked_, session_.recipe().edges.mergeWidths};
  asked_.reset();
  session_.setSideWork(this, false);
  if (!advice) {
    say(QString::fromStdString(advice.error().message));
    return;
  }
  said_->isMeant = advice->meant.has_value();
  if (advice->widths) {
    said_->strength = *advice->widths;
    Recipe after = session_.recipe();
    after.edges.mergeWidths = *advice->widths;
    if (!(after == session_.recipe())) session_.change(tr("Merge strokes as suggested"), std::move(after));
  }
  say(QString::fromStdString(describe(*advice)));
}

void MergeSuggestion::stop() {
  if (!asked_) return;
  asked_.reset();
  worker_.cancelAll();
  session_.setSideWork(this, false);
  say({});
}

void MergeSuggestion::follow() {
  const auto scan = session_.scan();
  if (!scan || !(asked_ || said_)) return;
  const ContentHash key = mergeAdviceKey(*scan, session_.recipe());
  if (asked_) {
    if (*asked_ != key) look();
    return;
  }
  if (said_->key == key && said_->strength == session_.recipe().edges.mergeWidths) return;
  said_.reset();
  say({});
}

void MergeSuggestion::say(const QString& text) {
  note_->setText(text.isEmpty() ? tr("Overdrawn strokes?") : text);
  showOffer();
}

void MergeSuggestion::showOffer() { offer_->setVisible(said_ && said_->isMeant && !session_.recipe().edges.intent); }

}  // namespace batten
