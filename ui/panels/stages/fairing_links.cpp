// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/fairing_links.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <initializer_list>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/like_link.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {
namespace {

constexpr int kBelowCaption = 4;  // px

}  // namespace

FairingLinks::FairingLinks(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      split_(linkButton(tr("Natural spans"), QStringLiteral("fairing.split"), this)),
      whole_(linkButton(tr("Targets for the whole curve"), QStringLiteral("fairing.whole"), this)),
      unsplit_(linkButton(tr("One polynomial for the whole curve"), QStringLiteral("fairing.unsplit"), this)),
      draw_(linkButton(tr("Draw the target in the plot"), QStringLiteral("fairing.draw"), this)),
      forget_(linkButton(tr("Back to the six targets"), QStringLiteral("fairing.forget"), this)),
      like_(likeLink(session, this, [this] { emit savedProfile(); })),
      logAesthetic_(linkButton(tr("Log-aesthetic target"), QStringLiteral("fairing.logAesthetic"), this)),
      useForAll_(linkButton(tr("Use this for all curves"), QStringLiteral("fairing.useForAll"), this)),
      followAll_(linkButton(tr("Use the common setting"), QStringLiteral("fairing.followAll"), this)) {
  auto* compare = linkButton(tr("Compare shapes…"), QStringLiteral("fairing.compare"), this);
  // Close together: there are many.
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  const auto add = [&](const QString& title, std::initializer_list<QPushButton*> links) {
    column->addWidget(caption(title, this));
    column->addSpacing(kBelowCaption);
    for (QPushButton* link : links) {
      column->addWidget(link, 0, Qt::AlignLeft);
      // A click that disables the link would hand the keyboard on to the next, and the panel would scroll there.
      link->setFocusPolicy(Qt::TabFocus);
    }
  };
  add(tr("Target profile"), {split_, whole_, unsplit_, draw_, forget_, like_, logAesthetic_});
  column->addSpacing(2 * kBelowCaption);
  add(tr("Selected curve"), {compare, useForAll_, followAll_});
  whole_->setToolTip(tr("The targets apply to the span you clicked. Click here to return to the whole curve."));
  forget_->setToolTip(tr("Follows a polynomial again."));
  compare->setToolTip(tr("Similarity of two curves and fairness of this one, as a table."));
  connect(logAesthetic_, &QPushButton::clicked, this, [this] {
    session_.pointAtSpan({});
    chooseTarget(session_, FairingTarget::LogAesthetic);
  });
  connect(compare, &QPushButton::clicked, this, &FairingLinks::comparisonAsked);
  connect(split_, &QPushButton::clicked, this, [this] { splitNaturally(session_); });
  connect(unsplit_, &QPushButton::clicked, this, [this] { joinAllSpans(session_); });
  connect(whole_, &QPushButton::clicked, this, [this] { session_.pointAtSpan({}); });
  connect(draw_, &QPushButton::clicked, this, [this] { drawTarget(session_, profileToBeginWith(session_)); });
  connect(forget_, &QPushButton::clicked, this, [this] { forgetDrawnTarget(session_); });
  connect(useForAll_, &QPushButton::clicked, this, &FairingLinks::useForAllAsked);
  connect(followAll_, &QPushButton::clicked, this, &FairingLinks::followAllAsked);
}

void FairingLinks::refresh(const FairingParams& params, bool isOwn) {
  const bool isTarget = params.mode == FairingMode::Target && session_.selected();
  const bool isDrawn = isTargetDrawn(session_);
  // Two links in one place where only one of them can have something to do.
  draw_->setVisible(!isDrawn);
  draw_->setEnabled(isTarget);
  forget_->setVisible(isDrawn);
  logAesthetic_->setEnabled(isTarget && params.target != FairingTarget::LogAesthetic);
  like_->setEnabled(session_.selected() != nullptr);
  const bool canSplit = isTarget && !isDrawn && params.targets.quantity == TargetQuantity::Curvature;
  const auto spans = canSplit ? static_cast<qint64>(splitsOf(session_).size()) : 0;
  const bool isPointed = canSplit && session_.pointedSpan().has_value();
  whole_->setVisible(isPointed);
  unsplit_->setVisible(!isPointed);
  unsplit_->setEnabled(canSplit && spans > 0);
  split_->setEnabled(canSplit && !hasNaturalSpans(session_));
  for (QPushButton* link : {useForAll_, followAll_}) {
    link->setVisible(session_.curves().size() > 1);
    link->setEnabled(isOwn);
  }
  explain(params, isDrawn, canSplit, isOwn);
}

// What is greyed says why.
void FairingLinks::explain(const FairingParams& params, bool isDrawn, bool canSplit, bool isOwn) {
  const bool isTarget = params.mode == FairingMode::Target;
  const QString elsewhere = !session_.selected() ? tr("Select a curve first.")
                            : !isTarget          ? tr("Only in mode Target.")
                                                 : QString();
  const auto tell = [&elsewhere](QPushButton* link, const QString& does, const QString& why) {
    link->setToolTip(link->isEnabled() ? does : elsewhere.isEmpty() ? why : elsewhere);
  };
  const QString noSpans = isDrawn ? tr("The drawn target has no spans; go back to the six targets first.")
                                  : tr("Radius profiles and edge lengths have one polynomial for the whole curve.");
  tell(split_,
       tr("A polynomial from each extremum of the curvature to the next. Extrema whose removal would move the curve by "
          "less than a tenth of the tolerance do not count."),
       canSplit ? tr("The curve has its natural spans already.") : noSpans);
  tell(unsplit_, tr("Joins all spans, as in the papers."),
       canSplit ? tr("The curve has one polynomial already.") : noSpans);
  tell(draw_, tr("Converts the target to points that can be dragged in the plot of curvature or radius."), {});
  tell(logAesthetic_,
       tr("In each span, radius to the power alpha is linear in arc length: clothoids, spirals, involutes. Alpha is "
          "under More."),
       tr("The log-aesthetic target is in use. Alpha is under More."));
  const QString none = tr("The selected curve has no fairing settings of its own.");
  useForAll_->setToolTip(isOwn ? tr("Applies the settings of the selected curve to the whole drawing.") : none);
  followAll_->setToolTip(isOwn ? tr("The selected curve gives up its own settings for those of the drawing.") : none);
}

}  // namespace batten
