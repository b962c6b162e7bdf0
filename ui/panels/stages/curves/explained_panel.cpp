// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/explained_panel.h"

#include <QCheckBox>
#include <QLabel>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/explanation_source.h"

namespace batten {

ExplainedPanel::ExplainedPanel(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      show_(new QCheckBox(tr("Show missed and invented ink"), this)),
      figures_(new FigureTable(this)),
      note_(note({}, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  show_->setObjectName(QStringLiteral("curves.showExplained"));
  show_->setToolTip(
      tr("Redraws the page from its curves and compares: orange is ink that no curve explains, magenta "
         "a stretch of a curve without ink  (Alt+E)"));
  figures_->setObjectName(QStringLiteral("curves.explained"));
  note_->setObjectName(QStringLiteral("curves.explainedNote"));
  layout->addWidget(show_);
  layout->addWidget(figures_);
  layout->addWidget(note_);
  connect(show_, &QCheckBox::clicked, this, [this](bool on) { view_.choose(Layer::Explained, on); });
  connect(&view_, &ViewSettings::changed, this, &ExplainedPanel::refresh);
  connect(&session_.explanation(), &ExplanationSource::changed, this, &ExplainedPanel::refresh);
  refresh();
}

void ExplainedPanel::refresh() {
  const bool isShown = view_.isVisible(Layer::Explained);
  show_->setChecked(isShown);
  figures_->setVisible(isShown);
  const auto found = session_.explanation().found();
  const auto percent = [&](double share, int digits) {
    return found                                  ? tr("%1 %").arg(100.0 * share, 0, 'f', digits)
           : session_.explanation().isComputing() ? QStringLiteral("…")
                                                  : QStringLiteral("–");
  };
  static const Explanation none;
  const Explanation& e = found ? *found : none;
  if (isShown)
    figures_->setRows(
        {{tr("Ink explained"),
          {{percent(e.explained, 1), !e.isExplained()}},
          tr("Share of the ink, found at a fixed low contrast, that lies within reach of the curves drawn with the "
             "widths of their strokes. Expected: at least %1 % of pen, %2 % of pencil.")
              .arg(100.0 * kLeastExplainedPen)
              .arg(100.0 * kLeastExplainedPencil)},
         {tr("Missed (orange)"), {{percent(e.missed, 1), !e.isExplained()}}, tr("The rest of the ink.")},
         {tr("Invented (magenta)"),
          {{percent(e.invented, 2), e.isInvented()}},
          tr("Share of the length of the curves that has no ink under it and is no bridged gap. Expected: at most "
             "%1 %.")
              .arg(100.0 * kMostInvented)}});
  note_->setText(QString::fromStdString(e.note));
  note_->setVisible(isShown && !e.note.empty());
}

}  // namespace batten
