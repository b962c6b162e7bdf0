// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>
#include <functional>

#include "core/pipeline/recipe/stage_id.h"
#include "ui/session/editor_session.h"

class QVBoxLayout;

namespace batten {

/// What all panels of stages begin with: a column with the panel's margins, the title on top.
QVBoxLayout* panelColumn(QWidget* panel, const QString& title);

/// Calls `refresh` when the stage has a new result, a scan was opened or a run has ended, as long as the panel lives.
void refreshWith(EditorSession& session, QWidget* panel, StageId stage, const std::function<void()>& refresh);

}  // namespace batten
