// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/curves_panel.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <string_view>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/parameter_row.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/curves/comb_controls.h"
#include "ui/panels/stages/curves/curve_list.h"
#include "ui/panels/stages/curves/explained_panel.h"
#include "ui/panels/stages/curves/growing_controls.h"
#include "ui/panels/stages/curves/knot_panel.h"
#include "ui/panels/stages/curves/method_table.h"
#include "ui/panels/stages/curves/paper_row.h"
#include "ui/panels/stages/curves/pin_panel.h"
#include "ui/session/curves/selected_width.h"
#include "ui/session/edits/pen_edits.h"
#include "ui/session/edits/piece_choice.h"

namespace batten {
namespace {

/// Parameters of the panel, from top to bottom.
constexpr std::array<std::string_view, 21> kSettings = {"construct.start",
                                                        "construct.derivative_magnitude",
                                                        "construct.keep_extrema",
                                                        "construct.light",
                                                        "construct.detail",
                                                        "construct.smooth_ragged",
                                                        "construct.light_tolerance",
                                                        "construct.reduce",
                                                        "construct.lowpass",
                                                        "construct.closeness",
                                                        "construct.typical",
                                                        "construct.growing_stop",
                                                        "segments.mode",
                                                        "segments.count",
                                                        "segments.spacing",
                                                        "segments.tolerance",
                                                        "construct.gradients",
                                                        "construct.ends",
                                                        "construct.equalise",
                                                        "construct.magnitude_as_in_paper",
                                                        "construct.growing_as_in_paper"};

}  // namespace

CurvesPanel::CurvesPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      editor_(new ParameterEditor(session, {kSettings.begin(), kSettings.end()}, this)),
      detailScope_(new SegmentedControl({tr("Detail of all curves"), tr("of the selected")}, this)),
      methods_(new MethodTable(session, this)),
      knots_(new KnotPanel(session, view, this)),
      figures_(new FigureTable(this)),
      width_(new SelectedWidth(session, this)),
      note_(note({}, this)),
      waiting_(note({}, this)),
      forget_(linkButton(tr("Forget"), QStringLiteral("curves.forgetWaiting"), this)),
      segmentsNote_(note({}, this)),
      growing_(new GrowingControls(session.growing(), this)) {
  auto* layout = panelColumn(this, tr("Curves"));
  layout->addWidget(methods_);
  auto* paper = new PaperRow(session, this);
  auto* pin = new PinPanel(session, this);
  layout->addWidget(paper);
  layout->addWidget(pin);
  layout->addWidget(caption(tr("Curves"), this));
  auto* curves = new CurveList(session, Judged::Sketched, this);
  layout->addWidget(curves);
  layout->addSpacerItem(curves->roomBelow());
  // What comes and goes with a click above stands below all of that.
  layout->addWidget(pin->figures());
  layout->addWidget(paper->cost());
  layout->addWidget(editor_);
  layout->addWidget(knots_);
  layout->addWidget(segmentsNote_);
  layout->addWidget(growing_);
  bindDetail();
  addWaitingRow();
  layout->addWidget(new ExplainedPanel(session, view, this));
  layout->addWidget(caption(tr("Selected curve"), this));
  layout->addWidget(figures_);
  layout->addWidget(note_);
  layout->addWidget(caption(tr("Comb"), this));
  layout->addWidget(new CombControls(view, this));
  layout->addStretch();
  connect(width_, &SelectedWidth::changed, this, &CurvesPanel::refreshFigures);
  connect(methods_, &MethodTable::helpAsked, this, &CurvesPanel::helpAsked);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished})
    connect(&session_, signal, this, &CurvesPanel::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Curves) refresh();
  });
  refresh();
}

void CurvesPanel::bindDetail() {
  detailScope_->setNames(QStringLiteral("construct.detail.scope"), {QStringLiteral("all"), QStringLiteral("one")});
  detailScope_->setToolTip(tr("Whether the detail applies to the whole drawing or only to the selected curve."));
  detailScope_->setCurrent(0);
  editor_->addBelow("construct.detail", detailScope_);
  ParameterRow* row = editor_->row("construct.detail");
  const Parameter* parameter = &row->parameter();
  row->setBinding({[this, parameter](const Recipe& recipe) {
                     Recipe shown;
                     shown.construct.detail = recipe.construct.detail;
                     const PieceChoice* own = detailsOne() ? choiceOf(session_, session_.selectedCurve()) : nullptr;
                     if (own != nullptr && own->detail) shown.construct.detail = *own->detail;
                     return parameter->get(shown);
                   },
                   [this, parameter](Recipe& recipe, std::string_view text) -> Result<void> {
                     if (!detailsOne()) return parameter->set(recipe, text);
                     Recipe asked;
                     auto done = parameter->set(asked, text);
                     if (!done) return done;
                     const double detail = asked.construct.detail;
                     const bool isCommon = detail == recipe.construct.detail;
                     recipe = withChoice(session_, session_.selectedCurve(), [&](PieceChoice& own) {
                       own.detail = isCommon ? std::nullopt : std::optional(detail);
                     });
                     std::erase_if(recipe.choices, [](const PieceChoice& choice) { return choice.isEmpty(); });
                     return {};
                   }});
  connect(detailScope_, &SegmentedControl::chosen, row, &ParameterRow::sync);
}

bool CurvesPanel::detailsOne() const {
  return detailScope_->current() == 1 && session_.selected() != nullptr && session_.curves().size() > 1;
}

void CurvesPanel::addWaitingRow() {
  auto* row = new QHBoxLayout;
  row->addWidget(waiting_, 1);
  row->addWidget(forget_);
  static_cast<QVBoxLayout*>(layout())->addLayout(row);
  waiting_->setObjectName(QStringLiteral("curves.waiting"));
  waiting_->setToolTip(tr("A choice refers to a line that is missing now, for instance after a change of threshold."));
  forget_->setToolTip(tr("Removes these choices from the recipe."));
  connect(forget_, &QPushButton::clicked, this, [this] { forgetWaitingChoices(session_); });
}

void CurvesPanel::addWidthRow(std::vector<FigureTable::Row>& rows) const {
  const auto& figures = width_->figures();
  if (!figures && !width_->isPending()) return;
  // The row stands there from the beginning, so that those below it stay where they are.
  const QString text = figures ? tr("%1 mm (%2 to %3)")
                                     .arg(figures->mean, 0, 'f', 2)
                                     .arg(figures->least, 0, 'f', 2)
                                     .arg(figures->largest, 0, 'f', 2)
                               : QStringLiteral("…");
  rows.push_back(
      {tr("Stroke width"),
       {{text}},
       tr("Mean over the length of the curve, least and largest. Export to JSON holds the width along it.")});
}

void CurvesPanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  width_->stop();
}

void CurvesPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refreshFigures();
}

void CurvesPanel::addFitRows(std::vector<FigureTable::Row>& rows, const TracedCurve& curve) const {
  const ConstructReport& fit = curve.construct;
  const double mmPerPx = session_.output().frame.mmPerPx;
  const auto length = [mmPerPx](double px) {
    return tr("%1 px · %2 µm").arg(px, 0, 'f', 3).arg(1000.0 * px * mmPerPx, 0, 'f', 1);
  };
  if (fit.isCircle || fit.isLine)
    rows.insert(rows.begin(), {tr("Recognised"),
                               {{fit.isCircle ? tr("exact circle") : tr("exact line")}},
                               tr("The scan does not differ from the exact shape by more than its noise.")});
  if (fit.noisePx > 0.0)
    rows.push_back({tr("Edge noise"),
                    {{length(*fit.noisePx)}},
                    tr("Standard deviation of the scan's edge points from the curve.")});
  if (fit.fullControlPoints.value_or(0) > curve.sketchedFigures.controlPoints) {
    rows.push_back({tr("Before knot removal"),
                    {{tr("%1 points").arg(*fit.fullControlPoints)}},
                    tr("Control points before knot removal.")});
    rows.push_back({tr("Moved by knot removal"),
                    {{length(fit.knotRemovalMovedPx)}},
                    tr("Maximum move of the curve by knot removal.")});
  }
  if (fit.light && fit.light->corners > 0)
    rows.push_back({tr("Sharp corners inside"),
                    {{QString::number(fit.light->corners)}},
                    tr("Found at the scale of the detail; the curve is smooth between them.")});
  if (fit.light) {
    rows.push_back({tr("Made light"),
                    {{fit.light->found ? tr("%1 of %2 points").arg(fit.light->points).arg(fit.light->pointsBefore)
                                       : tr("nothing lighter")}},
                    tr("Control points of the light curve and of the dense curve it approximates.")});
    if (fit.light->found)
      rows.push_back({tr("Deviation from dense curve"),
                      {{length(fit.light->movedPx)}},
                      tr("Maximum distance between the light and the dense curve.")});
    if (!fit.light->why.empty())
      rows.push_back(
          {tr("Stayed dense"),
           {{fit.light->found ? tr("%1 of %2 sections").arg(fit.light->sectionsDense).arg(fit.light->sections)
                              : tr("all of it")}},
           QString::fromStdString(fit.light->why)});
  }
  const auto dropped =
      std::count_if(fit.extrema.begin(), fit.extrema.end(), [](const ExtremumNote& e) { return !e.kept; });
  if (dropped > 0)
    rows.push_back({tr("Rejected as noise"),
                    {{tr("%1 extrema").arg(dropped)}},
                    tr("Hollow marks on the curve: click one to keep it.")});
  const auto& pieces = session_.output().pieces;
  if (!pieces || curve.piece < 0 || curve.piece >= std::ssize(pieces->pieces)) return;
  const auto& points = pieces->pieces[curve.piece].points;
  const auto fallback = std::ranges::count(points, false, &PiecePoint::refined);
  // A line drawn by hand is where the hand drew it.
  if (fallback > 0 && !strokeOf(session_, session_.selectedCurve()))
    rows.push_back({tr("Points not located"),
                    {{tr("%1 of %2").arg(fallback).arg(points.size())}},
                    tr("Points without a clear edge in the grey values. Those of an outline lie on the pixel "
                       "borders, those of a centre line on the skeleton of the ink, mostly where strokes meet.")});
}

void CurvesPanel::refresh() {
  refreshRows();
  const auto waiting = static_cast<qint64>(session_.choiceOwners().waiting.size());
  waiting_->setText(batten::counted(waiting, tr("1 choice has no line at present. It is kept until the line returns."),
                                    tr("%1 choices have no line at present. They are kept until the lines return.")));
  waiting_->setVisible(waiting > 0);
  forget_->setVisible(waiting > 0);
  refreshFigures();
}

void CurvesPanel::refreshRows() {
  const ConstructMethod method = methods_->current();
  const SegmentParams& segments = session_.recipe().segments;
  const bool nurbs = method == ConstructMethod::Nurbs;
  // The fit needs no start, and a chain of typical curves always begins at the fit.
  editor_->setRowVisible("construct.start", method != ConstructMethod::Fair && method != ConstructMethod::Typical);
  editor_->setRowVisible("construct.derivative_magnitude", nurbs);
  editor_->setRowVisible("construct.magnitude_as_in_paper", nurbs);
  editor_->setRowVisible("construct.gradients", nurbs);
  editor_->setRowVisible("construct.ends", nurbs || method == ConstructMethod::Bezier);
  editor_->setRowVisible("construct.equalise",
                         method == ConstructMethod::Bezier && session_.recipe().construct.lowPass == 0.0);
  const bool typical = method == ConstructMethod::Typical;
  const bool grows = typical && session_.recipe().construct.typical == TypicalMode::Growing;
  editor_->setRowVisible("construct.lowpass", method == ConstructMethod::Bezier);
  const bool paperNurbs = nurbs && (session_.recipe().construct.magnitudeAsInPaper ||
                                    session_.recipe().construct.gradients == GradientUse::Directions);
  editor_->setRowVisible("construct.closeness", (nurbs && !paperNurbs) || method == ConstructMethod::Bezier);
  editor_->setRowVisible("construct.typical", typical);
  editor_->setRowVisible("construct.growing_stop", grows);
  editor_->setRowVisible("construct.growing_as_in_paper", grows);
  editor_->setRowVisible("construct.keep_extrema", method == ConstructMethod::Fair);
  growing_->setVisible(grows);
  const auto set = session_.recipe().segmentPoints.size();
  segmentsNote_->setVisible(typical);
  segmentsNote_->setText(set == 0 ? tr("To set where segments meet, press G and click the line.")
                                  : counted(static_cast<qint64>(set),
                                            tr("1 segment point set. G, then click it to remove it."),
                                            tr("%1 segment points set. G, then click one to remove it.")));
  const bool light = session_.recipe().construct.light;
  editor_->setRowVisible("construct.light", method == ConstructMethod::Fair);
  editor_->setRowVisible("construct.light_tolerance", method == ConstructMethod::Fair && light);
  const bool detailed = method == ConstructMethod::Fair && light;
  editor_->setRowVisible("construct.detail", detailed);
  editor_->setRowVisible("construct.smooth_ragged", detailed);
  detailScope_->setVisible(detailed && session_.curves().size() > 1);
  detailScope_->setSegmentEnabled(1, session_.selected() != nullptr);
  editor_->row("construct.detail")->sync();
  editor_->setRowVisible("construct.reduce", method == ConstructMethod::Fair && !light);
  knots_->setVisible(method == ConstructMethod::ControlPolygon);
  const bool segmented = method != ConstructMethod::Fair && method != ConstructMethod::ControlPolygon;
  const bool counted = segments.mode == SegmentMode::Stations || segments.mode == SegmentMode::Count;
  editor_->setRowVisible("segments.mode", segmented);
  editor_->setRowVisible("segments.count", segmented && counted);
  editor_->setRowVisible("segments.spacing", segmented && counted && segments.count == 0);
  editor_->setRowVisible("segments.tolerance", segmented && segments.mode == SegmentMode::Adaptive);
}

void CurvesPanel::refreshFigures() {
  const TracedCurve* curve = session_.selected();
  if (isVisible()) width_->follow();
  note_->hide();
  if (!curve) {
    figures_->setRows({{tr("No curve selected"), {{QStringLiteral("–")}}, {}}});
    return;
  }
  const CurveFigures& f = curve->sketchedFigures;
  std::vector<FigureTable::Row> rows = {
      {tr("Length"), {{millimetres(f.lengthMm)}}, tr("Arc length of the sketched curve.")},
      {tr("Control points"), {{QString::number(f.controlPoints)}}, {}},
      {tr("Largest deviation"),
       {{millimetres(f.fromPoints.max)}},
       tr("Largest distance of an edge point from the curve.")},
      {tr("Rms deviation"),
       {{millimetres(f.fromPoints.rms)}},
       tr("Root mean square of the distances of the line's points from the curve.")},
      {tr("95 % of points within"), {{millimetres(f.fromPoints.percentile95)}}, {}},
      {tr("Curvature extrema"),
       {{QString::number(f.extrema)}},
       tr("Local maxima and minima of the curvature: fewer is fairer.")},
      {tr("Inflections"), {{QString::number(f.inflections)}}, tr("Points where the curvature changes sign.")}};
  if (const int added = curve->construct.stationsAdded; added > 0)
    rows.push_back({tr("Stations added"),
                    {{QString::number(added)}},
                    tr("Inserted where the line bends too sharply for the given stations.")});
  if (const int turns = curve->construct.extremaInSharpFeatures; turns > 0)
    rows.push_back({tr("Extrema in sharp features"),
                    {{QString::number(turns)}},
                    tr("At sharp features without a corner mark the curve follows the points closely: these "
                       "extrema are not tested for significance and cannot be removed individually.")});
  addWidthRow(rows);
  addFitRows(rows, *curve);
  figures_->setRows(std::move(rows));
  QString text = QString::fromStdString(curve->construct.note);
  const auto& made = curve->construct.segments;
  const auto typicalCount = std::count_if(made.begin(), made.end(), [](const SegmentNote& n) { return n.typical; });
  const auto monotoneCount =
      std::count_if(made.begin(), made.end(), [](const SegmentNote& n) { return n.typical && n.monotone; });
  if (!made.empty()) {
    const QString counts = tr("%1, %2 of them monotone, and %3; typical: %4 % of the length.")
                               .arg(batten::counted(typicalCount, tr("1 typical curve"), tr("%1 typical curves")))
                               .arg(monotoneCount)
                               .arg(batten::counted(static_cast<qint64>(made.size()) - typicalCount, tr("1 transition"),
                                                    tr("%1 transitions")))
                               .arg(100.0 * typicalShare(made), 0, 'f', 0);
    text = text.isEmpty() ? counts : counts + QLatin1Char(' ') + text;
  }
  if (const auto unmet = static_cast<qint64>(curve->construct.unmetConstraints.size())) {
    if (!text.isEmpty()) text += QLatin1Char('\n');
    text += batten::counted(unmet, tr("1 extremum could not be kept or removed as requested."),
                            tr("%1 extrema could not be kept or removed as requested."));
  }
  note_->setText(text);
  note_->setVisible(!note_->text().isEmpty());
}

}  // namespace batten
