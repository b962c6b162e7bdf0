// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/paint_controls.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/session/edits/trace_mode_edits.h"

namespace batten {
namespace {

constexpr std::array kBrushModes = {EdgeMode::Outline, EdgeMode::Centreline, EdgeMode::Automatic};  // as listed

}

PaintControls::PaintControls(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      paint_(plainButton(tr("Trace brush"), QStringLiteral("edges.paint"), this)),
      forget_(linkButton(tr("Forget painted"), QStringLiteral("edges.forgetPainted"), this)),
      modes_(new SegmentedControl({tr("Outline"), tr("Centre line"), tr("Same as page")}, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* row = new QHBoxLayout;
  row->addWidget(paint_);
  row->addStretch();
  row->addWidget(forget_);
  layout->addLayout(row);
  layout->addWidget(modes_);
  paint_->setCheckable(true);
  paint_->setToolTip(
      tr("Drag over ink to trace just that part by its outline or its centre line; orange ink is traced by its "
         "outline, teal ink by its centre line  (B)"));
  forget_->setToolTip(tr("All ink is traced as if nothing had been painted."));
  modes_->setNames(QStringLiteral("edges.brush"),
                   {QStringLiteral("outline"), QStringLiteral("centreline"), QStringLiteral("page")});
  keepRoom(modes_);
  modes_->setToolTip(tr("What the brush makes of ink; [ and ] change its size."));
  connect(paint_, &QPushButton::clicked, this, [this](bool on) { view_.setTool(on ? Tool::Paint : Tool::Select); });
  connect(forget_, &QPushButton::clicked, this, [this] { forgetPainted(session_); });
  connect(modes_, &SegmentedControl::chosen, this, [this](int index) { view_.setPaintedMode(kBrushModes[index]); });
  connect(&view_, &ViewSettings::changed, this, &PaintControls::refresh);
  connect(&view_, &ViewSettings::toolChanged, this, &PaintControls::refresh);
  connect(&session_, &EditorSession::recipeChanged, this, &PaintControls::refresh);
  connect(&session_, &EditorSession::scanOpened, this, &PaintControls::refresh);
  refresh();
}

void PaintControls::refresh() {
  const bool isPainting = view_.tool() == Tool::Paint;
  paint_->setChecked(isPainting);
  modes_->setVisible(isPainting);
  modes_->setCurrent(static_cast<int>(std::ranges::find(kBrushModes, view_.paintedMode()) - kBrushModes.begin()));
  forget_->setVisible(!session_.recipe().edges.painted.empty());
}

}  // namespace batten
