// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/top_bar.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <QWidgetAction>

#include "ui/canvas/legend.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/view/view_settings.h"
#include "ui/theme/theme.h"

namespace batten {

TopBar::TopBar(ViewSettings& view, const Actions& actions, QMenu* mainMenu, QMenu* layersMenu, QWidget* parent)
    : QWidget(parent) {
  setFixedHeight(44);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 0, 12, 1);
  layout->setSpacing(4);
  buildTitle(mainMenu);
  layout->addSpacing(4);
  undo_ = addButton(actions.undo, {});
  redo_ = addButton(actions.redo, {});
  for (auto* button : {undo_, redo_}) button->setToolButtonStyle(Qt::ToolButtonIconOnly);
  layout->addStretch(1);
  addButton(actions.scan, tr("Scan"))->setProperty("toggle", true);
  addButton(actions.comb, tr("Comb"))->setProperty("toggle", true);
  buildViewButtons(view, layersMenu);
  addButton(actions.fit, tr("Fit"));
  zoom_ = addButton(actions.actual, QStringLiteral("100 %"));
  zoom_->setMinimumWidth(64);
  layout->addStretch(1);
  find_ = addButton(actions.find, tr("Find an action"));
  find_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  layout->addSpacing(4);
  buildExport(actions.exportCurves);
  setIcons();
}

void TopBar::buildTitle(QMenu* mainMenu) {
  menu_ = new QToolButton(this);
  menu_->setObjectName(QStringLiteral("menuButton"));
  menu_->setAccessibleName(tr("Menu"));
  menu_->setToolTip(tr("Menu  (F10)"));
  menu_->setMenu(mainMenu);
  menu_->setPopupMode(QToolButton::InstantPopup);
  menu_->setFocusPolicy(Qt::TabFocus);
  title_ = new QLabel(this);
  title_->setObjectName(QStringLiteral("documentTitle"));
  title_->setFont(uiFont(13, QFont::DemiBold));
  title_->setMaximumWidth(320);
  layout()->addWidget(menu_);
  layout()->addWidget(title_);
}

void TopBar::buildViewButtons(ViewSettings& view, QMenu* layersMenu) {
  auto* layers = new QToolButton(this);
  layers->setObjectName(QStringLiteral("layersButton"));
  layers->setText(tr("Layers"));
  layers->setToolTip(tr("What is shown on the canvas."));
  layers->setMenu(layersMenu);
  layers->setPopupMode(QToolButton::InstantPopup);
  layers->setFocusPolicy(Qt::TabFocus);
  layout()->addWidget(layers);
  auto* marks = new QToolButton(this);
  marks->setObjectName(QStringLiteral("legendButton"));
  marks->setText(tr("Legend"));
  marks->setToolTip(tr("What the marks on the drawing mean."));
  auto* legend = new QMenu(marks);
  auto* list = new QWidgetAction(legend);
  list->setDefaultWidget(new Legend(legend));
  legend->addAction(list);
  marks->setMenu(legend);
  marks->setPopupMode(QToolButton::InstantPopup);
  marks->setFocusPolicy(Qt::TabFocus);
  layout()->addWidget(marks);
  auto* compare = new QToolButton(this);
  compare->setObjectName(QStringLiteral("compareButton"));
  compare->setText(tr("Scan only"));
  compare->setToolTip(tr("Hold to see the scan alone, or hold \\."));
  compare->setFocusPolicy(Qt::TabFocus);
  connect(compare, &QToolButton::pressed, &view, [&view] { view.setScanOnly(true); });
  connect(compare, &QToolButton::released, &view, [&view] { view.setScanOnly(false); });
  layout()->addWidget(compare);
}

void TopBar::buildExport(QAction* action) {
  auto* send = export_ = new QPushButton(tr("Export…"), this);
  send->setObjectName(QStringLiteral("exportButton"));
  send->setAccessibleName(tr("Export"));
  send->setProperty("primary", true);
  send->setToolTip(action->toolTip());
  send->setEnabled(action->isEnabled());
  connect(action, &QAction::changed, send, [send, action] { send->setEnabled(action->isEnabled()); });
  connect(send, &QPushButton::clicked, action, &QAction::trigger);
  layout()->addWidget(send);
}

void TopBar::setExportIsPrimary(bool isPrimary) {
  if (export_->property("primary").toBool() == isPrimary) return;
  export_->setProperty("primary", isPrimary);
  // A style sheet looks at a property only when it is told.
  export_->style()->unpolish(export_);
  export_->style()->polish(export_);
}

QToolButton* TopBar::addButton(QAction* action, const QString& text) {
  auto* button = new QToolButton(this);
  // The action's own text is for menus; here it must stay as short as the bar is wide.
  button->setText(text);
  button->setObjectName(action->objectName() + QStringLiteral("Button"));
  button->setFocusPolicy(Qt::TabFocus);
  button->setCheckable(action->isCheckable());
  const auto follow = [button, action] {
    button->setEnabled(action->isEnabled());
    button->setChecked(action->isChecked());
    button->setToolTip(action->toolTip());
    button->setAccessibleName(action->text());
  };
  connect(action, &QAction::changed, button, follow);
  connect(button, &QToolButton::clicked, action, &QAction::trigger);
  follow();
  static_cast<QHBoxLayout*>(layout())->addWidget(button);
  return button;
}

void TopBar::setIcons() {
  menu_->setIcon(themedIcon(QStringLiteral("menu"), palette()));
  undo_->setIcon(themedIcon(QStringLiteral("undo"), palette()));
  redo_->setIcon(themedIcon(QStringLiteral("redo"), palette()));
  find_->setIcon(themedIcon(QStringLiteral("find"), palette()));
}

void TopBar::setTitle(const QString& title, bool unsaved, const QString& toolTip) {
  const QString mark = unsaved ? QStringLiteral(" •") : QString();
  const QString name = title_->fontMetrics().elidedText(title, Qt::ElideMiddle, 285);
  title_->setText(name + mark);
  // The mark has its room all the time: what stands beside it does not move when it comes.
  title_->setMinimumWidth(title_->fontMetrics().horizontalAdvance(name + QStringLiteral(" •")));
  title_->setToolTip(unsaved ? QStringList{toolTip, tr("Unsaved changes")}.join(QLatin1Char('\n')).trimmed() : toolTip);
}

void TopBar::setZoom(double zoom) { zoom_->setText(zoomText(zoom)); }

void TopBar::openMenu() { menu_->showMenu(); }

void TopBar::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) setIcons();
}

void TopBar::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.fillRect(rect(), theme.panel);
  painter.fillRect(0, height() - 1, width(), 1, theme.line);
}

}  // namespace batten
