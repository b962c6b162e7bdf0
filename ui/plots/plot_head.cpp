// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_head.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

#include "ui/theme/elided_label.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kValueWidthPx = 160;  ///< That the value under the cursor takes at least, beside whole names.

/// [px] Of a tab: wide enough for the bold state, so that the row does not jump.
int widthOf(const QString& text) { return QFontMetrics(uiFont(12, QFont::DemiBold)).horizontalAdvance(text) + 16; }

}  // namespace

PlotHead::PlotHead(QWidget* parent)
    : QWidget(parent), tabs_(new QButtonGroup(this)), reverse_(new QToolButton(this)), value_(new ElidedLabel(this)) {
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
    button->setMinimumWidth(widthOf(text));
    layout->addWidget(button);
  };
  const struct {
    PlotTab tab;
    QString text, shortText, name, help;
  } tabs[] = {{PlotTab::Radius, tr("Radius over arc length"), tr("Radius"), QStringLiteral("plot.radius"),
               tr("Radius of curvature in mm, logarithmic; straight stretches are cut off at the top.")},
              {PlotTab::Curvature, tr("Curvature"), tr("Curvature"), QStringLiteral("plot.curvature"),
               tr("Signed curvature, 1/mm: positive where the curve turns left. The band is the "
                  "uncertainty due to scan noise.")},
              {PlotTab::CurvatureSlope, tr("Curvature slope"), tr("Slope"), QStringLiteral("plot.slope"),
               tr("Rate of change of the curvature along the curve, dκ/ds in 1/mm²: zero at every "
                  "curvature extremum; small and even is fair.")},
              {PlotTab::Speed, tr("Parameter speed"), tr("Speed"), QStringLiteral("plot.speed"),
               tr("Magnitude of the first derivative |R′(u)|, in mm per unit of u. Even speed means a good "
                  "parametrisation; it says nothing about the shape.")},
              {PlotTab::Deviation, tr("Deviation"), tr("Deviation"), QStringLiteral("plot.deviation"),
               tr("Distance of the scan's edge points and of the faired curve from the sketched curve, in mm.")}};
  for (const auto& one : tabs) {
    auto* button = new QToolButton(this);
    add(button, one.text, one.name, one.help);
    tabs_->addButton(button, static_cast<int>(one.tab));
    names_.push_back({button, one.text, one.shortText});
  }
  setTab(PlotTab::Radius);
  layout->addStretch();
  value_->setObjectName(QStringLiteral("plot.value"));
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

QSize PlotHead::minimumSizeHint() const { return {0, QWidget::minimumSizeHint().height()}; }

void PlotHead::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const QMargins margins = layout()->contentsMargins();
  int longest = margins.left() + margins.right() + widthOf(reverse_->text()) + kValueWidthPx;
  for (const TabNames& one : names_) longest += widthOf(one.text) + layout()->spacing();
  const bool isNarrow = longest > width();
  for (const TabNames& one : names_) {
    const QString& text = isNarrow ? one.shortText : one.text;
    if (one.button->text() == text) continue;
    one.button->setText(text);
    one.button->setMinimumWidth(widthOf(text));
  }
}

void PlotHead::setTab(PlotTab tab) { tabs_->button(static_cast<int>(tab))->setChecked(true); }

void PlotHead::setValue(const QString& text) { value_->setText(text); }

void PlotHead::setReversed(bool reversed) { reverse_->setChecked(reversed); }

}  // namespace batten
