// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/line_trace_mode.h"

#include <QLabel>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <array>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/session/edits/trace_mode_edits.h"

namespace batten {
namespace {

constexpr std::array kTraceModes = {EdgeMode::Automatic, EdgeMode::Outline, EdgeMode::Centreline};  // as listed

}

LineTraceMode::LineTraceMode(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      modes_(new SegmentedControl({tr("Same as page"), tr("Outline"), tr("Centre line")}, this)),
      hint_(note(tr("Click a line to give it its own trace mode."), this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(caption(tr("Selected line"), this));
  // One place for both, of which one is shown.
  auto* place = new QStackedWidget(this);
  place->addWidget(modes_);
  place->addWidget(hint_);
  place->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  layout->addWidget(place);
  modes_->setNames(QStringLiteral("edges.way"),
                   {QStringLiteral("page"), QStringLiteral("outline"), QStringLiteral("centreline")});
  modes_->setToolTip(tr("Trace mode of the selected line, independent of the page setting."));
  connect(modes_, &SegmentedControl::chosen, this, [this](int index) {
    chooseTraceMode(session_, session_.selectedCurve(), kTraceModes[index]);
    refresh();
  });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished})
    connect(&session_, signal, this, &LineTraceMode::refresh);
  refresh();
}

void LineTraceMode::refresh() {
  // Between new lines and their curves all stays as it is.
  if (session_.isStale(StageId::Contours) != session_.isStale(StageId::Faired)) return;
  const auto curve = session_.selectedCurve();
  const bool isTraced = tracedLineOf(session_, curve) != nullptr;
  qobject_cast<QStackedWidget*>(modes_->parentWidget())->setCurrentIndex(isTraced ? 0 : 1);
  if (!isTraced) return;
  const EdgeMode mode = traceModeOf(session_, curve);
  for (std::size_t i = 0; i < kTraceModes.size(); ++i) {
    if (kTraceModes[i] == mode) modes_->setCurrent(static_cast<int>(i));
  }
}

}  // namespace batten
