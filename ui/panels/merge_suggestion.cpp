// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/merge_suggestion.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>

#include "ui/panels/panel_parts.h"
#include "ui/session/guarded.h"

namespace batten {
namespace {

// What the suggestion depends on: all but the strength itself.
Recipe withoutMerging(Recipe recipe) {
  recipe.edges.mergeWidths = 0.0;
  return recipe;
}

QString textOf(const MergeAdvice& advice) {
  if (advice.strokes == 0)
    return MergeSuggestion::tr("No ink is followed along its middle: there are no strokes to merge.");
  if (!(advice.widths > 0.0)) return MergeSuggestion::tr("No overdrawn strokes were found: merging is not needed.");
  const QString strokes =
      counted(advice.strokes, MergeSuggestion::tr("1 stroke becomes"), MergeSuggestion::tr("%1 strokes become"));
  const QString lines = counted(advice.lines, MergeSuggestion::tr("1 line"), MergeSuggestion::tr("%1 lines"));
  const QString widths = advice.widths == 1.0 ? MergeSuggestion::tr("%1 stroke width: %2 %3.")
                                              : MergeSuggestion::tr("%1 stroke widths: %2 %3.");
  return widths.arg(QString::number(advice.widths), strokes, lines);
}

}  // namespace

MergeSuggestion::MergeSuggestion(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      note_(note({}, this)),
      ask_(linkButton(tr("Suggest"), QStringLiteral("edges.suggestMerge"), this)) {
  note_->setObjectName(QStringLiteral("edges.suggestMerge.note"));
  ask_->setAccessibleName(tr("Suggest how far to merge strokes"));
  ask_->setToolTip(
      tr("Looks whether lines were drawn in several strokes over one another, and if so sets how far to merge them."));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  row->addWidget(note_, 1);
  row->addWidget(ask_, 0, Qt::AlignTop | Qt::AlignRight);
  say({});
  connect(ask_, &QPushButton::clicked, this, &MergeSuggestion::look);
  connect(&session_, &EditorSession::stopped, this, &MergeSuggestion::stop);
  connect(&session_, &EditorSession::recipeChanged, this, &MergeSuggestion::follow);
  connect(&session_, &EditorSession::scanOpened, this, [this] {
    stop();
    said_ = -1.0;
    say({});
  });
}

void MergeSuggestion::look() {
  const auto scan = session_.scan();
  if (!scan) return;
  const Recipe recipe = withoutMerging(session_.recipe());
  asked_ = recipe;
  said_ = -1.0;
  say(tr("Looking at the strokes …"));
  session_.setSideWork(this, true, false);
  worker_.start([scan, recipe, panel = QPointer<MergeSuggestion>(this)](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    const auto advice = guarded<MergeAdvice>([&] {
      StageCache cache;
      return adviseMerge(*scan, recipe, cache, context);
    });
    if (token.isCancelled() || !panel) return;
    QMetaObject::invokeMethod(
        panel.data(),
        [panel, scan, recipe, advice] {
          if (panel && panel->session_.scan() == scan && panel->asked_ == recipe) panel->take(advice);
        },
        Qt::QueuedConnection);
  });
}

void MergeSuggestion::take(const Result<MergeAdvice>& advice) {
  asked_.reset();
  session_.setSideWork(this, false);
  if (!advice) {
    say(QString::fromStdString(advice.error().message));
    return;
  }
  if (advice->widths > 0.0) {
    said_ = advice->widths;
    Recipe after = session_.recipe();
    after.edges.mergeWidths = advice->widths;
    if (!(after == session_.recipe())) session_.change(tr("Merge strokes as suggested"), std::move(after));
  }
  say(textOf(*advice));
}

void MergeSuggestion::stop() {
  if (!asked_) return;
  asked_.reset();
  worker_.cancelAll();
  session_.setSideWork(this, false);
  say({});
}

void MergeSuggestion::follow() {
  if (asked_) {
    if (!(*asked_ == withoutMerging(session_.recipe()))) look();
    return;
  }
  // What was said holds for that strength alone.
  if (session_.recipe().edges.mergeWidths != said_) say({});
}

void MergeSuggestion::say(const QString& text) {
  note_->setText(text.isEmpty() ? tr("Drawn in several strokes?") : text);
}

}  // namespace batten
