// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/edges_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/line_trace_mode.h"
#include "ui/panels/stages/merge_suggestion.h"
#include "ui/panels/stages/paint_controls.h"
#include "ui/panels/stages/pen_panel.h"
#include "ui/session/edits/junction_edits.h"
#include "ui/session/edits/region_edits.h"

namespace batten {
namespace {

qint64 unlocatedCount(const ContourSet& set) {
  qint64 count = 0;
  for (const Contour& contour : set.contours)
    count +=
        std::count_if(contour.points.begin(), contour.points.end(), [](const ContourPoint& p) { return !p.refined; });
  return count;
}

}  // namespace

EdgesPanel::EdgesPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      tools_(new SegmentedControl({tr("Select"), tr("Lines"), tr("Rectangle"), tr("Lasso")}, this)),
      regions_(note({}, this)),
      clear_(linkButton(tr("Clear"), QStringLiteral("edges.clearRegions"), this)),
      strokes_(new QCheckBox(tr("Show stroke widths, merges, bridges"), this)),
      fallback_(new QCheckBox(tr("Show points not located"), this)),
      junctions_(new QCheckBox(tr("Show doubtful junctions"), this)),
      pair_(plainButton(tr("Pair strokes"), QStringLiteral("edges.pair"), this)),
      unpair_(linkButton(tr("Pair all by rule"), QStringLiteral("edges.pairByRule"), this)),
      figures_(new FigureTable(this)),
      note_(note({}, this)) {
  auto* layout = panelColumn(this, tr("Edges"));
  auto* editor = new ParameterEditor(
      session,
      {"edges.mode", "contours.min_widths", "contours.min_length", "edges.internal", "edges.subpixel", "edges.gap",
       "edges.merge", "edges.intent", "edges.stroke_width", "edges.spur", "edges.bend", "contours.max_count"},
      this);
  editor->addBelow("edges.merge", new MergeSuggestion(session, editor));
  auto* paint = new PaintControls(session, view, this);
  tracing_ = {editor, new LineTraceMode(session, this), caption(tr("Lines found"), this), figures_, paint};
  layout->addWidget(tracing_[0]);
  layout->addWidget(tracing_[1]);
  layout->addWidget(paint);
  buildChoice();
  buildJunctions();
  layout->addWidget(new PenPanel(session, view, this));
  // Last: the figures have more rows of some lines than of others.
  layout->addWidget(tracing_[2]);
  layout->addWidget(figures_);
  layout->addWidget(note_);
  layout->addStretch();
  refreshWith(session, this, StageId::Contours, [this] { refresh(); });
  refresh();
}

void EdgesPanel::buildChoice() {
  auto* layout = static_cast<QVBoxLayout*>(this->layout());
  layout->addWidget(caption(tr("What is traced"), this));
  tools_->setNames(QStringLiteral("edges.tool"), {QStringLiteral("select"), QStringLiteral("lines"),
                                                  QStringLiteral("rectangle"), QStringLiteral("lasso")});
  tools_->setToolTip(
      tr("What a click on the drawing does: select a curve, exclude or include a line, or draw a "
         "region."));
  layout->addWidget(tools_);
  auto* row = new QHBoxLayout;
  row->addWidget(regions_, 1);
  row->addWidget(clear_);
  layout->addLayout(row);
  strokes_->setObjectName(QStringLiteral("edges.showStrokes"));
  fallback_->setObjectName(QStringLiteral("edges.showFallback"));
  layout->addWidget(strokes_);
  layout->addWidget(fallback_);
  // tools of this panel, as listed
  static constexpr Tool kChoices[] = {Tool::Select, Tool::Lines, Tool::Rectangle, Tool::Lasso};
  connect(tools_, &SegmentedControl::chosen, this, [this](int index) { view_.setTool(kChoices[index]); });
  connect(clear_, &QPushButton::clicked, this, [this] { clearRegions(session_); });
  connect(strokes_, &QCheckBox::clicked, this, [this](bool on) { view_.choose(Layer::Strokes, on); });
  connect(fallback_, &QCheckBox::clicked, this, [this](bool on) { view_.choose(Layer::Fallback, on); });
  connect(&view_, &ViewSettings::toolChanged, this, &EdgesPanel::refreshChoice);
  connect(&view_, &ViewSettings::changed, this, &EdgesPanel::refreshChoice);
  connect(&session_, &EditorSession::recipeChanged, this, &EdgesPanel::refreshChoice);
  refreshChoice();
}

void EdgesPanel::buildJunctions() {
  auto* layout = static_cast<QVBoxLayout*>(this->layout());
  junctions_->setObjectName(QStringLiteral("edges.showJunctions"));
  layout->addWidget(junctions_);
  auto* row = new QHBoxLayout;
  pair_->setCheckable(true);
  pair_->setToolTip(
      tr("Click a junction for the next pairing of its strokes, or click two of its branches to join them  (J)"));
  row->addWidget(pair_);
  row->addStretch();
  row->addWidget(unpair_);
  layout->addLayout(row);
  tracing_.insert(tracing_.end(), {junctions_, pair_});
  connect(junctions_, &QCheckBox::clicked, this, [this](bool on) { view_.choose(Layer::Junctions, on); });
  connect(pair_, &QPushButton::clicked, this, [this](bool on) { view_.setTool(on ? Tool::Junctions : Tool::Select); });
  connect(unpair_, &QPushButton::clicked, this, [this] { forgetPairings(session_); });
  connect(&view_, &ViewSettings::changed, this, &EdgesPanel::refreshJunctions);
  connect(&view_, &ViewSettings::toolChanged, this, &EdgesPanel::refreshJunctions);
  connect(&session_, &EditorSession::recipeChanged, this, &EdgesPanel::refreshJunctions);
  refreshJunctions();
}

void EdgesPanel::refreshJunctions() {
  junctions_->setChecked(view_.isVisible(Layer::Junctions));
  pair_->setChecked(view_.tool() == Tool::Junctions);
  unpair_->setVisible(!session_.recipe().edges.junctions.empty());
}

void EdgesPanel::refreshChoice() {
  switch (view_.tool()) {
    case Tool::Select:
      tools_->setCurrent(0);
      break;
    case Tool::Lines:
      tools_->setCurrent(1);
      break;
    case Tool::Rectangle:
      tools_->setCurrent(2);
      break;
    case Tool::Lasso:
      tools_->setCurrent(3);
      break;
    default:
      tools_->setCurrent(std::nullopt);
      break;
  }
  const auto count = static_cast<qint64>(session_.recipe().regions.size());
  regions_->setText(count == 0 ? tr("The whole page is traced.")
                               : counted(count, tr("Only 1 region is traced."), tr("Only %1 regions are traced.")));
  clear_->setVisible(count > 0);
  strokes_->setChecked(view_.isVisible(Layer::Strokes));
  fallback_->setChecked(view_.isVisible(Layer::Fallback));
}

void EdgesPanel::refresh() {
  // On an empty page there is nothing to follow: the pen alone is left.
  for (QWidget* one : tracing_) one->setVisible(!session_.isBlankPage());
  const auto& set = session_.output().contours;
  if (!set) {
    figures_->setRows({{tr("Kept"), {{QStringLiteral("–")}}, {}}});
    note_->hide();
    return;
  }
  qint64 strokes = 0, closed = 0;
  for (const Contour& contour : set->contours) {
    strokes += contour.kind == ContourKind::Centreline ? 1 : 0;
    closed += contour.closed ? 1 : 0;
  }
  const ContourReport& report = set->report;
  const qint64 kept = static_cast<qint64>(set->contours.size());
  std::vector<FigureTable::Row> rows = {
      {tr("Kept"), {{grouped(kept)}}, tr("Lines that become curves.")},
      {tr("of which strokes"), {{grouped(strokes)}}, tr("Followed along the middle of the pen stroke.")},
      {tr("of which closed"), {{grouped(closed)}}, tr("Lines that return to their start.")},
      {tr("Too short"),
       {{grouped(report.droppedShort)}},
       tr("Dropped because they are shorter than %1.")
           .arg(millimetres(session_.recipe().contours.minLengthPx * session_.output().frame.mmPerPx))}};
  rows.push_back({tr("Gaps bridged"),
                  {{grouped(bridgeCount(*set))}},
                  tr("Gaps in the ink across which two ends were joined: dashes on the drawing.")});
  if (const int doubtful = doubtfulCount(*set); doubtful > 0)
    rows.push_back({tr("Doubtful junctions"),
                    {{grouped(doubtful)}},
                    tr("Where strokes might also be paired otherwise: rings on the drawing; click one for the next "
                       "way.")});
  if (report.droppedMargins > 0)
    rows.push_back({tr("Border lines dropped"),
                    {{grouped(report.droppedMargins)}},
                    tr("Lines along the border of the page: margins of the scanner and edges of a sheet.")});
  if (report.droppedFaint > 0)
    rows.push_back({tr("Faint specks dropped"),
                    {{grouped(report.droppedFaint)}},
                    tr("Much fainter than the strokes around them.")});
  if (report.droppedGrain > 0)
    rows.push_back({tr("Grain of tones dropped"),
                    {{grouped(report.droppedGrain)}},
                    tr("Short lines no darker than the grain of the shading around them.")});
  if (report.droppedHoles > 0) rows.push_back({tr("Inner outlines dropped"), {{grouped(report.droppedHoles)}}, {}});
  rows.push_back({tr("Points not located"),
                  {{grouped(unlocatedCount(*set))}},
                  tr("Points without a clear edge in the grey values, shown as amber dots. There an outline "
                     "follows the pixel borders and a centre line the skeleton of the ink, mostly where "
                     "strokes meet.")});
  rows.push_back({tr("Located on grey values"),
                  {{QStringLiteral("%1 %").arg(100 * report.refinedShare, 0, 'f', 0)}},
                  tr("Share of the points located on the grey values, to sub-pixel accuracy.")});
  figures_->setRows(std::move(rows));
  note_->setText(QString::fromStdString(report.note));
  note_->setVisible(!note_->text().isEmpty());
}

}  // namespace batten
