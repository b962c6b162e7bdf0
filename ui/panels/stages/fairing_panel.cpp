// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/fairing_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/pipeline/recipe/parameter_table.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/stages/ends_table.h"
#include "ui/panels/stages/fairing_figures.h"
#include "ui/panels/stages/like_link.h"
#include "ui/panels/stages/profile_shelf.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/tolerance_offer.h"

namespace batten {
namespace {

/// Slider range of the tolerance: what a hand-drawn line can need. The field takes any allowed value.
constexpr double kLeastToleranceMm = 0.01, kMostToleranceMm = 5.0;

const Parameter& modeParameter() { return *findParameter("fairing.mode"); }

QStringList labelsOf(const Parameter& parameter) {
  QStringList labels;
  for (const std::string& label : parameter.choiceLabels) labels << FairingPanel::tr(label.c_str());
  return labels;
}

QStringList wordsOf(const Parameter& parameter) {
  QStringList words;
  for (const std::string& word : parameter.choices) words << QString::fromStdString(word);
  return words;
}

/// The mode that the segment stands for, by its word in the parameter table.
FairingMode modeAt(int segment) {
  Recipe recipe;
  modeParameter().set(recipe, modeParameter().choices.at(segment));
  return recipe.fairing.mode;
}

int segmentOf(FairingMode mode) {
  Recipe recipe;
  recipe.fairing.mode = mode;
  const auto& words = modeParameter().choices;
  return static_cast<int>(std::find(words.begin(), words.end(), modeParameter().get(recipe)) - words.begin());
}

}  // namespace

FairingPanel::FairingPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      scope_(new SegmentedControl({tr("All curves"), tr("Selected curve")}, this)),
      mode_(new SegmentedControl(labelsOf(modeParameter()), this)),
      tolerance_(new ParameterRow(session, *findParameter("fairing.tolerance"), this)),
      keep_(new ParameterRow(session, *findParameter("fairing.keep_extrema"), this)),
      wavelength_(new ParameterRow(session, *findParameter("fairing.lowpass"), this)),
      policy_(new ParameterRow(session, *findParameter("fairing.spend"), this)),
      moves_(new ParameterRow(session, *findParameter("fairing.moves"), this)),
      editor_(new ParameterEditor(session,
                                  {"fairing.spans", "fairing.choose", "fairing.alpha", "fairing.samples",
                                   "fairing.quantity", "fairing.monotone"},
                                  this)),
      note_(note({}, this)),
      raise_(linkButton(tr("Raise the tolerance"), QStringLiteral("fairing.raise"), this)),
      offer_(new ToleranceOffer(this)),
      useForAll_(linkButton(tr("Use this for all curves"), QStringLiteral("fairing.useForAll"), this)),
      followAll_(linkButton(tr("Use the common setting"), QStringLiteral("fairing.followAll"), this)),
      whole_(linkButton({}, QStringLiteral("fairing.whole"), this)),
      split_(linkButton({}, QStringLiteral("fairing.split"), this)),
      unsplit_(linkButton({}, QStringLiteral("fairing.unsplit"), this)),
      draw_(linkButton(tr("Draw the target in the plot"), QStringLiteral("fairing.draw"), this)),
      forget_(linkButton(tr("Back to the six targets"), QStringLiteral("fairing.forget"), this)),
      like_(likeLink(session, this,
                     [this] {
                       findChild<ProfileShelf*>()->refresh();
                       refresh();
                     })),
      logAesthetic_(linkButton(tr("Log-aesthetic target"), QStringLiteral("fairing.logAesthetic"), this)),
      figures_(new FigureTable(this)),
      ends_(new EndsTable([this] { return shown(session_.recipe()); },
                          [this](int end, EndHold hold) { setHold(end, hold); }, this)) {
  auto* column = panelColumn(this, tr("Fairing"));
  buildScopeAndMode();
  buildTolerance();
  buildSettingsOfModes();
  buildNote();
  buildLinks();
  buildScopeLinks();
  buildFigures();
  column->addWidget(caption(tr("Curves"), this));
  column->addWidget(new CurveList(session, Judged::Result, this), 1);
  // Last: the list grows with what is saved.
  buildProfiles();
  column->addStretch();
  followSession();
  refresh();
}

QVBoxLayout* FairingPanel::column() const { return static_cast<QVBoxLayout*>(layout()); }

void FairingPanel::buildScopeAndMode() {
  scope_->setNames(QStringLiteral("fairing.scope"), {QStringLiteral("all"), QStringLiteral("one")});
  scope_->setToolTip(tr(
      "Whether mode, tolerance, the settings of the mode and ends apply to the whole drawing or only to the selected "
      "curve."));
  column()->addWidget(scope_);
  mode_->setNames(QStringLiteral("fairing.mode"), wordsOf(modeParameter()));
  mode_->setToolTip(
      tr("None: as sketched. Target: follows a curvature profile. Smooth: least variation of "
         "curvature within the tolerance. Monotone: no or few curvature extrema. Low-pass: "
         "removes short waves of the curvature."));
  setSettingName(mode_, tr("Fairing mode"));
  column()->addWidget(mode_);
  connect(scope_, &SegmentedControl::chosen, this, [this](int index) {
    oneCurve_ = index == 1;
    tolerance_->sync();
    refresh();
  });
  connect(mode_, &SegmentedControl::chosen, this, [this](int index) { setMode(modeAt(index)); });
}

void FairingPanel::buildTolerance() {
  tolerance_->setLabel(tr("Tolerance"));
  tolerance_->setSliderRange(kLeastToleranceMm, kMostToleranceMm);
  bindToScope(tolerance_,
              [](PieceChoice& choice, const FairingParams& params) { choice.toleranceMm = params.toleranceMm; });
  column()->addWidget(tolerance_);
}

void FairingPanel::buildSettingsOfModes() {
  for (ParameterRow* row : {keep_, wavelength_, policy_, moves_}) column()->addWidget(row);
  bindToScope(keep_, [](PieceChoice& choice, const FairingParams& params) { choice.keepExtrema = params.keepExtrema; });
  bindToScope(wavelength_,
              [](PieceChoice& choice, const FairingParams& params) { choice.lowPassMm = params.lowPassMm; });
  bindToScope(policy_, [](PieceChoice& choice, const FairingParams& params) {
    choice.tolerancePolicy = params.tolerancePolicy;
  });
  bindToScope(moves_, [](PieceChoice& choice, const FairingParams& params) { choice.means = params.means; });
  wavelength_->setSliderRange(1.0, 300.0);
  keep_->setSliderRange(-1.0, 12.0);
}

void FairingPanel::bindToScope(ParameterRow* row,
                               const std::function<void(PieceChoice&, const FairingParams&)>& store) {
  const Parameter* parameter = &row->parameter();
  row->setBinding({[this, parameter](const Recipe& recipe) {
                     Recipe probe;
                     probe.fairing = shown(recipe);
                     return parameter->get(probe);
                   },
                   [this, parameter, store](Recipe& recipe, std::string_view text) -> Result<void> {
                     if (!actsOnOne()) return parameter->set(recipe, text);
                     Recipe probe;
                     auto done = parameter->set(probe, text);
                     if (!done) return done;
                     recipe = withChoice(session_, session_.selectedCurve(),
                                         [&](PieceChoice& choice) { store(choice, probe.fairing); });
                     return {};
                   }});
}

// What is said of the curve, and how to help it, in a room that stays: so nothing moves away under a click that selects
// another curve.
void FairingPanel::buildNote() {
  said_ = new QWidget(this);
  auto* lines = new QVBoxLayout(said_);
  lines->setContentsMargins(0, 0, 0, 0);
  lines->setSpacing(2);
  note_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  lines->addWidget(note_);
  lines->addWidget(raise_, 0, Qt::AlignLeft);
  lines->addStretch();
  column()->addWidget(said_);
}

void FairingPanel::buildLinks() {
  // Close together: what stands below them is to fit into a low window.
  links_ = new QVBoxLayout;
  links_->setSpacing(0);
  column()->addLayout(links_);
  for (QPushButton* link : {split_, whole_, unsplit_, draw_, forget_, like_, logAesthetic_})
    links_->addWidget(link, 0, Qt::AlignLeft);
  split_->setText(tr("Natural spans"));
  unsplit_->setText(tr("One polynomial for the whole curve"));
  whole_->setText(tr("Targets for the whole curve"));
  whole_->setToolTip(tr("The targets apply to the span you clicked. Click here to return to the whole curve."));
  draw_->setToolTip(tr("Converts the target to points that can be dragged in the plot of curvature or radius."));
  connect(logAesthetic_, &QPushButton::clicked, this, [this] {
    session_.pointAtSpan({});
    chooseTarget(session_, FairingTarget::LogAesthetic);
  });
  auto* compare = linkButton(tr("Compare shapes…"), QStringLiteral("fairing.compare"), this);
  compare->setToolTip(tr("Similarity of two curves and fairness of this one, as a table."));
  links_->addWidget(compare, 0, Qt::AlignLeft);
  connect(compare, &QPushButton::clicked, this, &FairingPanel::comparisonAsked);
  connect(split_, &QPushButton::clicked, this, [this] { splitNaturally(session_); });
  connect(unsplit_, &QPushButton::clicked, this, [this] { joinAllSpans(session_); });
  connect(whole_, &QPushButton::clicked, this, [this] { session_.pointAtSpan({}); });
  connect(draw_, &QPushButton::clicked, this, [this] { drawTarget(session_, profileToBeginWith(session_)); });
  connect(forget_, &QPushButton::clicked, this, [this] { forgetDrawnTarget(session_); });
}

void FairingPanel::buildScopeLinks() {
  for (QPushButton* link : {useForAll_, followAll_}) links_->addWidget(link, 0, Qt::AlignLeft);
  connect(raise_, &QPushButton::clicked, this, &FairingPanel::raiseTolerance);
  connect(offer_, &ToleranceOffer::changed, this, &FairingPanel::refreshFigures);
  connect(useForAll_, &QPushButton::clicked, this, &FairingPanel::useForAll);
  connect(followAll_, &QPushButton::clicked, this, &FairingPanel::followAll);
}

void FairingPanel::buildProfiles() {
  QLabel* saved = caption(tr("Saved profiles"), this);
  saved->setObjectName(QStringLiteral("fairing.savedProfiles"));
  column()->addWidget(saved);
  auto* shelf = new ProfileShelf(session_, this);
  column()->addWidget(shelf);
  connect(shelf, &ProfileShelf::emptied, this, &FairingPanel::refresh);
}

void FairingPanel::buildFigures() {
  column()->addWidget(caption(tr("Before and after"), this));
  figures_->setHeader({}, {tr("sketched"), tr("faired")});
  column()->addWidget(figures_);
  column()->addWidget(caption(tr("Ends"), this));
  column()->addWidget(ends_);
  column()->addWidget(editor_);
}

void FairingPanel::followSession() {
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished, &EditorSession::targetsChanged})
    connect(&session_, signal, this, &FairingPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Pieces || stage == StageId::Curves || stage == StageId::Faired) refresh();
  });
}

void FairingPanel::refreshLinks(const FairingParams& params) {
  keep_->setVisible(params.mode == FairingMode::Monotone);
  wavelength_->setVisible(params.mode == FairingMode::LowPass);
  policy_->setVisible(params.mode == FairingMode::Tolerance);
  // Only a Bézier path has edges whose lengths can be moved alone.
  const PieceChoice* choice = choiceOf(session_, session_.selectedCurve());
  const ConstructMethod method = choice && choice->method ? *choice->method : session_.recipe().construct.method;
  const bool followsProfile = params.mode == FairingMode::Target || params.mode == FairingMode::LowPass;
  moves_->setVisible(followsProfile && method == ConstructMethod::Bezier);
  for (ParameterRow* row : {keep_, wavelength_, policy_, moves_}) row->sync();
  const bool isTarget = params.mode == FairingMode::Target && session_.selected();
  const bool isDrawn = isTargetDrawn(session_);
  draw_->setVisible(isTarget && !isDrawn);
  forget_->setVisible(isDrawn);
  // Links of a mode that have nothing to do stay where they are, greyed: those below keep their places.
  logAesthetic_->setVisible(isTarget);
  logAesthetic_->setEnabled(params.target != FairingTarget::LogAesthetic);
  like_->setVisible(session_.selected() != nullptr && params.mode != FairingMode::None);
  auto* shelf = findChild<ProfileShelf*>();
  shelf->setVisible(shelf->count() > 0 && session_.hasScan());
  findChild<QLabel*>(QStringLiteral("fairing.savedProfiles"))->setVisible(shelf->count() > 0 && session_.hasScan());
  const bool canSplit = isTarget && !isDrawn && params.targets.quantity == TargetQuantity::Curvature;
  const auto spans = canSplit ? static_cast<qint64>(splitsOf(session_).size()) : 0;
  const bool isPointed = canSplit && session_.pointedSpan().has_value();
  whole_->setVisible(isPointed);
  unsplit_->setVisible(isTarget && !isPointed);
  unsplit_->setEnabled(canSplit && spans > 0);
  split_->setVisible(isTarget);
  split_->setEnabled(canSplit && !hasNaturalSpans(session_));
  explainLinks(isDrawn, canSplit);
}

// What is greyed says why.
void FairingPanel::explainLinks(bool isDrawn, bool canSplit) {
  const QString why = isDrawn     ? tr("The drawn target has no spans; go back to the six targets first.")
                      : !canSplit ? tr("Radius profiles and edge lengths have one polynomial for the whole curve.")
                                  : QString();
  split_->setToolTip(split_->isEnabled() ? tr("A polynomial from each extremum of the curvature to the next. Extrema "
                                              "whose removal would move the curve by less than a tenth of the "
                                              "tolerance do not count.")
                     : why.isEmpty()     ? tr("The curve has its natural spans already.")
                                         : why);
  unsplit_->setToolTip(unsplit_->isEnabled() ? tr("Joins all spans, as in the papers.")
                       : why.isEmpty()       ? tr("The curve has one polynomial already.")
                                             : why);
  logAesthetic_->setToolTip(logAesthetic_->isEnabled()
                                ? tr("In each span, radius to the power alpha is linear in arc length: clothoids, "
                                     "spirals, involutes. Alpha is under More.")
                                : tr("The log-aesthetic target is in use. Alpha is under More."));
}

FairingParams FairingPanel::shown(const Recipe& recipe) const {
  const auto choice = actsOnOne() ? choiceAlong(session_, session_.selectedCurve()) : std::nullopt;
  return choice ? choice->fairing(recipe.fairing) : recipe.fairing;
}

void FairingPanel::setMode(FairingMode mode) {
  Recipe after = session_.recipe();
  if (actsOnOne())
    after = withChoice(session_, session_.selectedCurve(), [mode](PieceChoice& choice) { choice.mode = mode; });
  else
    after.fairing.mode = mode;
  session_.change(tr("Fairing"), std::move(after));
}

void FairingPanel::setHold(int end, EndHold hold) {
  Recipe after = session_.recipe();
  if (actsOnOne())
    after = withChoice(session_, session_.selectedCurve(),
                       [end, hold](PieceChoice& choice) { (end == 0 ? choice.startHold : choice.endHold) = hold; });
  else
    (end == 0 ? after.fairing.startHold : after.fairing.endHold) = hold;
  session_.change(end == 0 ? tr("Hold at start") : tr("Hold at end"), std::move(after));
}

void FairingPanel::raiseTolerance() {
  const TracedCurve* curve = session_.selected();
  const auto offered = offer_->enough();
  if (!curve || !offered) return;
  Recipe after = session_.recipe();
  const double needed = *offered;
  if (hasOwnFairing(session_, session_.selectedCurve()))
    after =
        withChoice(session_, session_.selectedCurve(), [needed](PieceChoice& choice) { choice.toleranceMm = needed; });
  else
    after.fairing.toleranceMm = needed;
  session_.change(tr("Tolerance"), std::move(after));
}

void FairingPanel::useForAll() {
  Recipe after = session_.recipe();
  after.fairing = shown(after);
  for (PieceChoice& choice : after.choices) choice.clearFairing();
  std::erase_if(after.choices, [](const PieceChoice& choice) { return choice.isEmpty(); });
  oneCurve_ = false;
  session_.change(tr("Fairing of all curves"), std::move(after));
}

void FairingPanel::followAll() {
  Recipe after = withChoice(session_, session_.selectedCurve(), [](PieceChoice& choice) { choice.clearFairing(); });
  std::erase_if(after.choices, [](const PieceChoice& choice) { return choice.isEmpty(); });
  oneCurve_ = false;
  session_.change(tr("Use the common fairing"), std::move(after));
}

void FairingPanel::refresh() {
  const auto selected = session_.selectedCurve();
  const bool own = hasOwnFairing(session_, selected);
  const bool several = session_.curves().size() > 1;
  // A curve that has its own choice shows it; otherwise the choice of scope stays as the user left it.
  if (own)
    oneCurve_ = true;
  else if (selected != lastSelected_ || !selected)
    oneCurve_ = false;
  lastSelected_ = selected;
  scope_->setVisible(several);
  scope_->setSegmentEnabled(1, selected.has_value());
  scope_->setCurrent(oneCurve_ ? 1 : 0);
  const FairingParams params = shown(session_.recipe());
  mode_->setCurrent(segmentOf(params.mode));
  tolerance_->sync();
  tolerance_->setEnabled(params.mode != FairingMode::None);
  ends_->refresh();
  refreshLinks(params);
  for (QPushButton* link : {useForAll_, followAll_}) {
    link->setVisible(several);
    link->setEnabled(own);
  }
  const QString none = tr("The selected curve has no fairing settings of its own.");
  useForAll_->setToolTip(own ? tr("Applies the settings of the selected curve to the whole drawing.") : none);
  followAll_->setToolTip(own ? tr("The selected curve gives up its own settings for those of the drawing.") : none);
  refreshFigures();
}

void FairingPanel::refreshFigures() {
  const TracedCurve* curve = session_.selected();
  const FairingNote said = curve ? fairingNote(*curve) : FairingNote{};
  figures_->setRows(curve ? fairingRows(session_, *curve) : noFairingRows());
  constexpr int kUsualLines = 2, kLinesOfTargets = 3;  // of room for the note
  const FairingMode mode = shown(session_.recipe()).mode;
  const int lines = mode == FairingMode::Target ? kLinesOfTargets : kUsualLines;
  const bool canNeedMore = mode == FairingMode::Target || mode == FairingMode::Monotone;
  said_->setMinimumHeight(lines * note_->fontMetrics().lineSpacing() +
                          (canNeedMore ? said_->layout()->spacing() + raise_->sizeHint().height() : 0));
  note_->setText(mode == FairingMode::None && said.text.isEmpty()
                     ? tr("Fairing is off: the curves stay as they are in Curves.")
                     : said.text);
  note_->setVisible(!note_->text().isEmpty());
  offer_->ask(curve, said.neededMm);
  const auto enough = offer_->enough();
  if (enough) raise_->setText(tr("Needs %1: raise the tolerance").arg(millimetres(*enough)));
  raise_->setVisible(enough.has_value());
}

}  // namespace batten
