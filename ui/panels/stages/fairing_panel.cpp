// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/fairing_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/pipeline/recipe/parameter_table.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/stages/ends_table.h"
#include "ui/panels/stages/fairing_figures.h"
#include "ui/panels/stages/fairing_links.h"
#include "ui/panels/stages/profile_shelf.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/runs/tolerance_offer.h"

namespace batten {
namespace {

/// Of room for what is said of the curve: with nothing below it, and above the link that helps.
constexpr int kLinesAlone = 4, kLinesAbove = 3;
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
      note_(new LinesNote(kLinesAlone, this)),
      raise_(linkButton(tr("Raise the tolerance"), QStringLiteral("fairing.raise"), this)),
      offer_(new ToleranceOffer(this)),
      links_(new FairingLinks(session, this)),
      figures_(new FigureTable(this)),
      ends_(new EndsTable([this] { return shown(session_.recipe()); },
                          [this](int end, EndHold hold) { setHold(end, hold); }, this)) {
  auto* column = panelColumn(this, tr("Fairing"));
  buildScopeAndMode();
  buildTolerance();
  buildSettingsOfModes();
  buildNote();
  // What decides comes first. The tables have the same rows for every curve: a click in the list leaves it in its
  // place.
  buildFigures();
  column->addWidget(caption(tr("Curves"), this));
  auto* curves = new CurveList(session, Judged::Result, this);
  column->addWidget(curves);
  column->addSpacerItem(curves->roomBelow());
  buildLinks();
  column->addWidget(editor_);
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
  ofMode_ = new QWidget(this);
  auto* rows = new QVBoxLayout(ofMode_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(column()->spacing());
  for (ParameterRow* row : {policy_, keep_, wavelength_, moves_}) rows->addWidget(row);
  rows->addStretch();
  column()->addWidget(ofMode_);
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
  auto* said = new QWidget(this);
  auto* lines = new QVBoxLayout(said);
  lines->setContentsMargins(0, 0, 0, 0);
  lines->setSpacing(0);
  lines->addWidget(note_);
  lines->addWidget(raise_, 0, Qt::AlignLeft);
  lines->addStretch();
  said->setFixedHeight(
      std::max(note_->roomFor(kLinesAlone), note_->roomFor(kLinesAbove) + raise_->sizeHint().height()));
  column()->addWidget(said);
}

void FairingPanel::buildLinks() {
  column()->addWidget(links_);
  connect(links_, &FairingLinks::comparisonAsked, this, &FairingPanel::comparisonAsked);
  connect(links_, &FairingLinks::useForAllAsked, this, &FairingPanel::useForAll);
  connect(links_, &FairingLinks::followAllAsked, this, &FairingPanel::followAll);
  connect(links_, &FairingLinks::savedProfile, this, [this] {
    findChild<ProfileShelf*>()->refresh();
    refresh();
  });
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
  figures_->setObjectName(QStringLiteral("fairing.figures"));
  figures_->setHeader({}, {tr("sketched"), tr("faired")});
  column()->addWidget(figures_);
  ends_->setObjectName(QStringLiteral("fairing.ends"));
  ends_->setAccessibleName(tr("Ends"));
  column()->addWidget(ends_);
}

void FairingPanel::followSession() {
  connect(raise_, &QPushButton::clicked, this, &FairingPanel::raiseTolerance);
  connect(offer_, &ToleranceOffer::changed, this, &FairingPanel::refreshFigures);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished, &EditorSession::targetsChanged})
    connect(&session_, signal, this, &FairingPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Pieces || stage == StageId::Curves || stage == StageId::Faired) refresh();
  });
}

void FairingPanel::refreshModeSettings(const FairingParams& params) {
  keep_->setVisible(params.mode == FairingMode::Monotone);
  wavelength_->setVisible(params.mode == FairingMode::LowPass);
  policy_->setVisible(params.mode == FairingMode::Tolerance);
  // Only a Bézier path has edges whose lengths can be moved alone.
  const Recipe& recipe = session_.recipe();
  const PieceChoice* choice = choiceOf(session_, session_.selectedCurve());
  const ConstructMethod method = choice && choice->method ? *choice->method : recipe.construct.method;
  const bool followsProfile = params.mode == FairingMode::Target || params.mode == FairingMode::LowPass;
  moves_->setVisible(followsProfile && method == ConstructMethod::Bezier);
  for (ParameterRow* row : {keep_, wavelength_, policy_, moves_}) row->sync();
  // One room for all modes: curves with settings of their own differ in mode from row to row of the list.
  const bool hasPath =
      recipe.construct.method == ConstructMethod::Bezier ||
      std::ranges::any_of(recipe.choices, [](const PieceChoice& one) { return one.method == ConstructMethod::Bezier; });
  int room = 0;
  for (const ParameterRow* row : {keep_, wavelength_, policy_}) room = std::max(room, row->sizeHint().height());
  if (hasPath) room += ofMode_->layout()->spacing() + moves_->sizeHint().height();
  ofMode_->setFixedHeight(room);
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
  refreshModeSettings(params);
  links_->refresh(params, own);
  auto* shelf = findChild<ProfileShelf*>();
  shelf->setVisible(shelf->count() > 0 && session_.hasScan());
  findChild<QLabel*>(QStringLiteral("fairing.savedProfiles"))->setVisible(shelf->count() > 0 && session_.hasScan());
  refreshFigures();
}

void FairingPanel::refreshFigures() {
  const TracedCurve* curve = session_.selected();
  const FairingNote said = curve ? fairingNote(*curve) : FairingNote{};
  // Whatever the settings above apply to, the figures are those of one curve.
  figures_->setTitle(curve ? curveName(session_, *session_.selectedCurve()) : tr("Before and after"));
  figures_->setRows(curve ? fairingRows(session_, *curve) : noFairingRows(session_));
  const FairingMode mode = shown(session_.recipe()).mode;
  note_->setText(mode == FairingMode::None && said.text.isEmpty()
                     ? tr("Fairing is off: the curves stay as they are in Curves.")
                     : said.text);
  offer_->ask(curve, said.neededMm);
  const auto enough = offer_->enough();
  if (enough) raise_->setText(tr("Needs %1: raise the tolerance").arg(millimetres(*enough)));
  raise_->setVisible(enough.has_value());
  note_->setLines(enough ? kLinesAbove : kLinesAlone);
}

}  // namespace batten
