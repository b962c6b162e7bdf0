// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/rail/stage_rail.h"

#include <QAbstractButton>
#include <QKeyEvent>
#include <QPainter>
#include <QVBoxLayout>

#include "ui/session/editor_session.h"
#include "ui/theme/theme.h"

namespace batten {

/// One stage: dot, name, tally.
class StageButton : public QAbstractButton {
 public:
  StageButton(PanelStage stage, QWidget* parent) : QAbstractButton(parent) {
    setText(label(stage));
    setObjectName(QStringLiteral("stage.") + key(stage));
    setCheckable(true);
    setAutoExclusive(true);
    setFocusPolicy(Qt::TabFocus);
    setAttribute(Qt::WA_Hover);
    setFixedHeight(36);
    setCursor(Qt::PointingHandCursor);
  }
  void show(StageState state, const QString& tally) {
    state_ = state;
    tally_ = tally;
    static const char* const kWords[] = {QT_TR_NOOP("not reached"), QT_TR_NOOP("done"), QT_TR_NOOP("being updated"),
                                         QT_TR_NOOP("failed")};
    const QString word = tr(kWords[static_cast<int>(state)]);
    setToolTip(word);
    setAccessibleName(text() + QStringLiteral(", ") + word +
                      (tally.isEmpty() ? QString() : QStringLiteral(", ") + tally));
    update();
  }
  QSize sizeHint() const override { return {132, 36}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = rect();
    if (isChecked() || underMouse()) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(isChecked() ? theme.selection : theme.hover);
      painter.drawRoundedRect(box, 7, 7);
    }
    if (hasFocus()) drawFocusRing(painter, box, 7, theme);
    QColor dot = theme.line;
    if (state_ == StageState::Done) dot = theme.good;
    if (state_ == StageState::Stale) dot = theme.amber;
    if (state_ == StageState::Failed) dot = theme.bad;
    if (isChecked() && (state_ == StageState::Done || state_ == StageState::Open)) dot = theme.accent;
    painter.setPen(Qt::NoPen);
    painter.setBrush(dot);
    painter.drawEllipse(QPointF(14, box.center().y()), 4, 4);
    painter.setFont(uiFont(13, isChecked() ? QFont::DemiBold : QFont::Normal));
    painter.setPen(theme.text);
    painter.drawText(box.adjusted(27, 0, -8, 0), Qt::AlignVCenter | Qt::AlignLeft, text());
    painter.setFont(uiFont(12));
    painter.setPen(theme.mute);
    painter.drawText(box.adjusted(0, 0, -10, 0), Qt::AlignVCenter | Qt::AlignRight, tally_);
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
    QAbstractButton::keyPressEvent(event);
  }

 private:
  StageState state_ = StageState::Open;
  QString tally_;
};

StageRail::StageRail(EditorSession& session, QWidget* parent) : QWidget(parent), session_(session) {
  setFixedWidth(148);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 10, 8, 8);
  layout->setSpacing(2);
  for (const PanelStage stage : kPanelStages) {
    auto* button = new StageButton(stage, this);
    layout->addWidget(button);
    buttons_.push_back(button);
    connect(button, &QAbstractButton::clicked, this, [this, stage] {
      current_ = stage;
      emit chosen(stage);
    });
  }
  layout->addStretch();
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::runFinished,
                            &EditorSession::failureCleared})
    connect(&session_, signal, this, &StageRail::refresh);
  connect(&session_, &EditorSession::stageReady, this, &StageRail::refresh);
  refresh();
  setCurrent(PanelStage::Scan);
}

void StageRail::setCurrent(PanelStage stage) {
  current_ = stage;
  buttons_[indexOf(stage)]->setChecked(true);
}

void StageRail::setExported(bool exported) {
  exported_ = exported;
  refresh();
}

void StageRail::refresh() {
  for (const PanelStage stage : kPanelStages) {
    const bool written = stage == PanelStage::Export && exported_;
    buttons_[indexOf(stage)]->show(written ? StageState::Done : stateOf(stage, session_),
                                   written ? QStringLiteral("✓") : tally(stage, session_));
  }
}

void StageRail::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.fillRect(rect(), theme.panel);
  painter.fillRect(width() - 1, 0, 1, height(), theme.line);
}

}  // namespace batten
