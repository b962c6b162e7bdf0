// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/error_strip.h"

#include <QAccessible>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>

#include "ui/panels/controls/panel_parts.h"
#include "ui/theme/theme.h"

namespace batten {

ErrorStrip::ErrorStrip(QWidget* parent)
    : QWidget(parent),
      text_(new QLabel(this)),
      action_(plainButton(tr("Open…"), QStringLiteral("error.action"), this)),
      dismiss_(linkButton(tr("Dismiss"), QStringLiteral("error.dismiss"), this)) {
  setObjectName(QStringLiteral("errorStrip"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(16, 6, 12, 7);
  layout->setSpacing(8);
  text_->setObjectName(QStringLiteral("error.text"));
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  layout->addWidget(text_, 1);
  layout->addWidget(action_);
  layout->addWidget(dismiss_);
  connect(action_, &QPushButton::clicked, this, &ErrorStrip::actionPressed);
  connect(dismiss_, &QPushButton::clicked, this, [this] {
    hide();
    emit dismissed();
  });
  hide();
}

void ErrorStrip::layOver(QWidget* drawing) {
  drawing_ = drawing;
  drawing->installEventFilter(this);
}

bool ErrorStrip::eventFilter(QObject* watched, QEvent* event) {
  if (watched == drawing_ && (event->type() == QEvent::Resize || event->type() == QEvent::Move)) place();
  return QWidget::eventFilter(watched, event);
}

void ErrorStrip::place() {
  if (drawing_ == nullptr || isHidden()) return;
  const int width = drawing_->width();
  setGeometry(QRect(drawing_->mapTo(parentWidget(), QPoint(0, 0)), QSize(width, layout()->heightForWidth(width))));
  raise();
}

void ErrorStrip::show(const QString& message, const QString& action, const QString& dismiss) {
  text_->setText(message);
  text_->setAccessibleName(message);
  action_->setText(action);
  action_->setAccessibleName(action);
  action_->setVisible(!action.isEmpty());
  dismiss_->setText(dismiss.isEmpty() ? tr("Dismiss") : dismiss);
  dismiss_->setAccessibleName(dismiss_->text());
  QWidget::show();
  place();
  QAccessibleEvent event(text_, QAccessible::Alert);
  QAccessible::updateAccessibility(&event);
}

QString ErrorStrip::message() const { return isHidden() ? QString() : text_->text(); }

void ErrorStrip::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  QColor wash = theme.bad;
  wash.setAlphaF(theme.dark ? 0.16F : 0.08F);
  painter.fillRect(rect(), theme.panel);
  painter.fillRect(rect(), wash);
  painter.fillRect(0, 0, 4, height(), theme.bad);
  painter.fillRect(0, height() - 1, width(), 1, theme.line);
}

}  // namespace batten
