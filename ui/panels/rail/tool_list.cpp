// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/rail/tool_list.h"

#include <QAbstractButton>
#include <QAction>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>

#include "ui/panels/controls/panel_parts.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

class ToolButton : public QAbstractButton {
 public:
  ToolButton(QAction* action, QWidget* parent) : QAbstractButton(parent), action_(action) {
    setObjectName(action->objectName() + QStringLiteral(".button"));
    setCheckable(true);
    setFocusPolicy(Qt::TabFocus);
    setAttribute(Qt::WA_Hover);
    setFixedHeight(28);
    setCursor(Qt::PointingHandCursor);
    connect(this, &QAbstractButton::clicked, action, &QAction::trigger);
    connect(action, &QAction::changed, this, [this] { follow(); });
    follow();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = rect();
    if (isEnabled() && (isChecked() || underMouse())) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(isChecked() ? theme.selection : theme.hover);
      painter.drawRoundedRect(box, 6, 6);
    }
    if (hasFocus()) drawFocusRing(painter, box, 6, theme);
    painter.setFont(uiFont(12, isChecked() ? QFont::DemiBold : QFont::Normal));
    painter.setPen(isEnabled() ? theme.text : theme.mute);
    painter.drawText(box.adjusted(10, 0, -26, 0), Qt::AlignVCenter | Qt::AlignLeft, text());
    painter.setFont(uiFont(11));
    painter.setPen(theme.mute);
    painter.drawText(box.adjusted(0, 0, -10, 0), Qt::AlignVCenter | Qt::AlignRight,
                     action_->shortcut().toString(QKeySequence::NativeText));
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
    QAbstractButton::keyPressEvent(event);
  }

 private:
  void follow() {
    setText(action_->text());
    setAccessibleName(action_->text());
    setToolTip(action_->toolTip());
    setEnabled(action_->isEnabled());
    setChecked(action_->isChecked());
    update();
  }
  QAction* action_;
};

}  // namespace

ToolList::ToolList(const QList<QAction*>& tools, QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(1);
  auto* title = caption(tr("Tools"), this);
  title->setContentsMargins(10, 0, 0, 4);
  layout->addWidget(title);
  for (QAction* tool : tools) layout->addWidget(new ToolButton(tool, this));
}

}  // namespace batten
