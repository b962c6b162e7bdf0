// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/status_line.h"

#include <QAccessible>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <cmath>
#include <utility>

#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/text/page_text.h"
#include "ui/theme/elided_label.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kMessageMs = 5000;  // that a message is shown

QString decimal(double value, int decimals) {
  const double whole = std::trunc(value);
  QString fraction = QString::number(std::abs(value - whole), 'f', decimals).mid(1);
  if (fraction.isEmpty() || std::abs(value - whole) >= 1.0 - 0.5 * std::pow(10.0, -decimals))
    return QString::number(value, 'f', decimals);
  return (value < 0 && whole == 0 ? QStringLiteral("-") : QString()) + grouped(static_cast<qint64>(whole)) + fraction;
}

}  // namespace

StatusLine::StatusLine(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      setScale_(linkButton(tr("no scale: set it"), QStringLiteral("status.setScale"), this)),
      progress_(new QProgressBar(this)),
      cancel_(linkButton(tr("Stop"), QStringLiteral("status.cancel"), this)),
      again_(linkButton(tr("Compute again"), QStringLiteral("status.again"), this)),
      act_(linkButton({}, QStringLiteral("status.act"), this)) {
  setObjectName(QStringLiteral("statusLine"));
  setFixedHeight(30);
  act_->setAccessibleName(tr("Show what has changed"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 1, 14, 0);
  row->setSpacing(20);
  millimetres_ = addLabel("status.mm", QStringLiteral("x 2888.88 mm  y 2888.88 mm"));
  pixels_ = addLabel("status.px", QStringLiteral("px 28 888.8, 28 888.8"));
  scale_ = addLabel("status.scale", {});
  row->addWidget(setScale_);
  zoom_ = addLabel("status.zoom", QStringLiteral("888 %"));
  buildHint();
  buildWork();
  for (QPushButton* button : {setScale_, cancel_, again_, act_}) button->setFont(uiFont(12));
  connect(setScale_, &QPushButton::clicked, this, &StatusLine::scaleAsked);
  followSession();
  refreshScale();
  refreshWork();
  setPlace(std::nullopt);
}

QLabel* StatusLine::addLabel(const char* name, const QString& widest) {
  auto* label = new QLabel(this);
  label->setObjectName(QString::fromLatin1(name));
  label->setFont(uiFont(12));
  label->setForegroundRole(QPalette::PlaceholderText);
  // A fixed width for what changes with every move, so that the line stands still.
  if (!widest.isEmpty()) label->setMinimumWidth(QFontMetrics(uiFont(12)).horizontalAdvance(widest));
  layout()->addWidget(label);
  return label;
}

void StatusLine::buildHint() {
  hint_ = new ElidedLabel(this);
  hint_->setObjectName(QStringLiteral("status.hint"));
  hint_->setFont(uiFont(12));
  hint_->setForegroundRole(QPalette::PlaceholderText);
  hint_->setAlignment(Qt::AlignCenter);
  static_cast<QHBoxLayout*>(layout())->addWidget(hint_, 1);
  layout()->addWidget(act_);
  act_->hide();
  connect(act_, &QPushButton::clicked, this, [this] {
    if (const auto action = std::exchange(action_, {})) action();
    act_->hide();
  });
  messageTimer_.setSingleShot(true);
  messageTimer_.setInterval(kMessageMs);
  connect(&messageTimer_, &QTimer::timeout, this, [this] {
    message_.clear();
    action_ = {};
    refreshHint();
  });
}

void StatusLine::buildWork() {
  progress_->setFixedWidth(96);
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress"));
  for (QWidget* widget :
       {static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_), static_cast<QWidget*>(again_)})
    layout()->addWidget(widget);
  work_ = addLabel("status.work", QStringLiteral("exact · 888 ms"));
  work_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  again_->setToolTip(tr("Resume the stopped computation.  (Ctrl+R)"));
  connect(cancel_, &QPushButton::clicked, &session_, &EditorSession::cancel);
  connect(again_, &QPushButton::clicked, &session_, &EditorSession::computeAgain);
}

void StatusLine::followSession() {
  connect(&session_, &EditorSession::scanOpened, this, &StatusLine::refreshScale);
  connect(&session_, &EditorSession::recipeChanged, this, &StatusLine::refreshScale);
  connect(&session_, &EditorSession::workingChanged, this, &StatusLine::refreshWork);
  connect(&session_, &EditorSession::busyChanged, this, &StatusLine::refreshWork);
  connect(&session_, &EditorSession::runFinished, this, &StatusLine::refreshWork);
  connect(&session_, &EditorSession::progress, this,
          [this](double fraction) { progress_->setValue(static_cast<int>(fraction * 100)); });
}

void StatusLine::setPlace(std::optional<Vec2> imagePx) {
  if (!imagePx || !session_.hasScan()) {
    millimetres_->clear();
    pixels_->clear();
    return;
  }
  const PageFrame frame = frameFor(*session_.scan(), session_.recipe());
  const Vec2 mm = frame.pointToModel(*imagePx);
  millimetres_->setText(tr("x %1 mm  y %2 mm").arg(mm.x(), 0, 'f', 2).arg(mm.y(), 0, 'f', 2));
  pixels_->setText(tr("px %1, %2").arg(decimal(imagePx->x(), 1), decimal(imagePx->y(), 1)));
}

void StatusLine::setZoom(double zoom) { zoom_->setText(zoomText(zoom)); }

void StatusLine::setHint(const QString& text) {
  placeHint_ = text;
  refreshHint();
}

void StatusLine::showMessage(const QString& text, const QString& actionText, std::function<void()> action) {
  message_ = text;
  action_ = std::move(action);
  act_->setText(actionText);
  act_->setAccessibleName(actionText);
  messageTimer_.start();
  refreshHint();
}

void StatusLine::refreshHint() {
  act_->setVisible(action_ != nullptr);
  const bool showsTrouble = message_.isEmpty() && !troubles_.empty();
  hint_->setForegroundRole(showsTrouble ? QPalette::WindowText : QPalette::PlaceholderText);
  hint_->setText(!message_.isEmpty()    ? message_
                 : showsTrouble         ? troubles_.begin()->second
                 : placeHint_.isEmpty() ? stageHint_
                                        : placeHint_);
}

void StatusLine::setTrouble(Trouble trouble, const QString& text) {
  const auto found = troubles_.find(trouble);
  if (found == troubles_.end() ? text.isEmpty() : text == found->second) return;
  if (text.isEmpty())
    troubles_.erase(found);
  else
    troubles_[trouble] = text;
  refreshHint();
  if (text.isEmpty()) return;
  QAccessibleEvent event(hint_, QAccessible::Alert);
  QAccessible::updateAccessibility(&event);
}

void StatusLine::updateStageHint(const QString& text) {
  stageHint_ = text;
  refreshHint();
}

void StatusLine::setStageHint(const QString& text) {
  stageHint_ = text;
  message_.clear();
  action_ = {};
  refreshHint();
}

void StatusLine::refreshScale() {
  if (!session_.hasScan()) {
    scale_->hide();
    setScale_->hide();
    return;
  }
  const bool assumed = isScaleAssumed(*session_.scan(), session_.recipe());
  const auto own = session_.recipe().dpi;
  scale_->setVisible(!assumed);
  setScale_->setVisible(assumed);
  if (assumed) return;
  const PageFrame frame = frameFor(*session_.scan(), session_.recipe());
  // The size of the page stands in the corner of the drawing.
  scale_->setText(tr("%1 dpi").arg(resolutionText(own ? *own : session_.scan()->dpi.value_or(0.0))));
  const QString origin = session_.recipe().scaleLine ? tr("Resolution measured on the drawing; the page is %1.")
                         : own                       ? tr("Resolution set by you; the page is %1.")
                                                     : tr("Resolution from the file; the page is %1.");
  scale_->setToolTip(origin.arg(pageSizeText(frame)));
}

void StatusLine::refreshWork() {
  const bool busy = session_.isBusy(), working = session_.isWorking();
  progress_->setVisible(busy);
  cancel_->setVisible(working);
  again_->setVisible(!working && session_.isStopped());
  if (working) {
    work_->setText(busy ? tr("working") : session_.isTargeting() ? tr("computing targets") : tr("comparing"));
    return;
  }
  progress_->setValue(0);
  const bool isBeginning =
      session_.isBlankPage() && session_.recipe().penStrokes.empty() && session_.recipe().imports.empty();
  if (!session_.hasScan() || isBeginning) return work_->clear();
  const double ms = session_.lastRunMilliseconds();
  const bool whole = !session_.isStale(StageId::Faired) && session_.output().faired;
  work_->setText(session_.isStopped() || !whole ? tr("stopped")
                 : ms < 0.5                     ? tr("exact")
                                                : tr("exact · %1 ms").arg(ms, 0, 'f', 0));
  work_->setToolTip(whole ? tr("Everything shown matches the current settings.")
                          : tr("Some of what is shown was computed with earlier settings."));
}

void StatusLine::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.fillRect(rect(), theme.panel);
  painter.fillRect(0, 0, width(), 1, theme.line);
}

}  // namespace batten
