// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_head.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/theme/theme.h"

namespace batten {

PlotHead::PlotHead(QWidget* parent)
    : QWidget(parent), tabs_(new QButtonGroup(this)), reverse_(new QToolButton(this)), value_(new QLabel(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(4, 2, 14, 0);
  layout->setSpacing(2);
  const auto add = [&](QToolButton* button, const QString& text, const QString& name, const QString& help) {
    button->setText(text);
    button->setObjectName(name);
    button->setToolTip(help);
    button->setAccessibleName(text);
    button->setAccessibleDescription(help);
    button->setCheckable(true);
    button->setProperty("tab", true);
    button->setFocusPolicy(Qt::TabFocus);
    // Wide enough for the bold state, so that the row does not jump.
    button->setMinimumWidth(QFontMetrics(uiFont(12, QFont::DemiBold)).horizontalAdvance(text) + 16);
    layout->addWidget(button);
  };
  const struct {
    PlotTab tab;
    QString text, name, help;
  } tabs[] = {{PlotTab::Radius, tr("Radius over arc length"), QStringLiteral("plot.radius"),
               tr("Radius of curvature in mm, logarithmic; straight stretches are cut off at the top.")},
              {PlotTab::Curvature, tr("Curvature"), QStringLiteral("plot.curvature"),
               tr("Signed curvature, 1/mm: positive where the curve turns left. The band is the "
                  "uncertainty due to scan noise.")},
              {PlotTab::CurvatureSlope, tr("Curvature slope"), QStringLiteral("plot.slope"),
               tr("Rate of change of the curvature along the curve, dκ/ds in 1/mm²: zero at every "
                  "curvature extremum; small and even is fair.")},
              {PlotTab::Speed, tr("Parameter speed"), QStringLiteral("plot.speed"),
               tr("Magnitude of the first derivative |R′(u)|, in mm per unit of u. Even speed means a good "
                  "parametrisation; it says nothing about the shape.")},
              {PlotTab::Deviation, tr("Deviation"), QStringLiteral("plot.deviation"),
               tr("Distance of the scan's edge points and of the faired curve from the sketched curve, in mm.")}};
  for (const auto& one : tabs) {
    auto* button = new QToolButton(this);
    add(button, one.text, one.name, one.help);
    tabs_->addButton(button, static_cast<int>(one.tab));
  }
  setTab(PlotTab::Radius);
  layout->addStretch();
  value_->setFont(uiFont(12));
  value_->setForegroundRole(QPalette::PlaceholderText);
  layout->addWidget(value_);
  layout->addSpacing(8);
  add(reverse_, tr("Reverse"), QStringLiteral("plot.reverse"),
      tr("Reverses the plot. By default it runs from left to right as on the drawing; arc length "
         "is measured from the end with the arrow."));
  connect(tabs_, &QButtonGroup::idClicked, this, [this](int id) { emit chosen(static_cast<PlotTab>(id)); });
  connect(reverse_, &QToolButton::clicked, this, &PlotHead::reverseAsked);
}

void PlotHead::setTab(PlotTab tab) { tabs_->button(static_cast<int>(tab))->setChecked(true); }

void PlotHead::setValue(const QString& text) { value_->setText(text); }

void PlotHead::setReversed(bool reversed) { reverse_->setChecked(reversed); }

}  // namespace batten
