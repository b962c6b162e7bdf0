// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/stage_panel.h"

#include <QLabel>
#include <QMargins>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"

namespace batten {
namespace {

constexpr QMargins kPanelMarginsPx{14, 12, 14, 12};  // left, top, right, bottom
constexpr int kPanelSpacingPx = 8;                   // between rows

}  // namespace

QVBoxLayout* panelColumn(QWidget* panel, const QString& title) {
  auto* column = new QVBoxLayout(panel);
  column->setContentsMargins(kPanelMarginsPx);
  column->setSpacing(kPanelSpacingPx);
  column->addWidget(heading(title, panel));
  return column;
}

void refreshWith(EditorSession& session, QWidget* panel, StageId stage, const std::function<void()>& refresh) {
  QObject::connect(&session, &EditorSession::stageReady, panel, [stage, refresh](StageId ready) {
    if (ready == stage) refresh();
  });
  QObject::connect(&session, &EditorSession::scanOpened, panel, refresh);
  QObject::connect(&session, &EditorSession::runFinished, panel, refresh);
}

}  // namespace batten
