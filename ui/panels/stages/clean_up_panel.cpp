// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/clean_up_panel.h"

#include <QLabel>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/parameter_editor.h"
#include "ui/panels/controls/stage_panel.h"

namespace batten {

CleanUpPanel::CleanUpPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent), session_(session), figures_(new FigureTable(this)), warning_(note({}, this)) {
  auto* layout = panelColumn(this, tr("Clean-up"));
  layout->addWidget(new ParameterEditor(
      session, {"filter.coefficient", "filter.iterations", "filter.max_change", "filter.order", "filter.border"},
      this));
  layout->addWidget(caption(tr("Result"), this));
  layout->addWidget(figures_);
  layout->addWidget(warning_);
  layout->addStretch();
  refreshWith(session, this, StageId::Filtered, [this] { refresh(); });
  refresh();
}

void CleanUpPanel::refresh() {
  const auto& filtered = session_.output().filtered;
  if (!filtered) {
    figures_->setRows({{tr("Ink"), {{QStringLiteral("–")}}, {}}});
    warning_->hide();
    return;
  }
  const FilterReport& report = filtered->report;
  const auto share = [&](std::int64_t pixels) {
    const double percent = report.inkBefore > 0 ? 100.0 * double(pixels) / double(report.inkBefore) : 0.0;
    return QStringLiteral("%1 %").arg(percent, 0, 'f', 1);
  };
  QString iterations = QString::number(report.iterations);
  if (report.why == Termination::FixedPoint) iterations = tr("%1, then no change").arg(report.iterations);
  if (report.why == Termination::IterationLimit) iterations = tr("%1, still changing").arg(report.iterations);
  if (report.why == Termination::NotRun) iterations = tr("none");
  figures_->setRows(
      {{tr("Ink before, px"), {{grouped(report.inkBefore)}}, tr("Pixels that count as ink after the threshold.")},
       {tr("Ink after, px"), {{grouped(report.inkAfter)}}, tr("Pixels that count as ink after the clean-up.")},
       {tr("Removed"), {{share(report.inkLost), report.thinStrokesLost}}, tr("Ink that became paper.")},
       {tr("Filled"), {{share(report.inkGained)}}, tr("Paper that became ink.")},
       {tr("Taken back"),
        {{share(report.undone)}},
        tr("Changes larger than the largest change: thin strokes, tips, gaps.")},
       {tr("Iterations"),
        {{iterations}},
        tr("An iteration is one erosion and one dilation; the filter stops when nothing changes.")}});
  warning_->setVisible(report.thinStrokesLost);
  warning_->setText(
      tr("Much of the ink was removed, including thin strokes. Set a largest change, a larger "
         "coefficient or fewer iterations."));
}

}  // namespace batten
