// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/comb_controls.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <cmath>
#include <functional>

#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"
#include "ui/panels/controls/slider_track.h"

namespace batten {
namespace {

/// What a slider with a field is for; both follow `get`.
struct ViewRow {
  QString label, name, help;
  double low = 0.0, high = 1.0;
  int decimals = 0;
  std::function<double()> get;
  std::function<void(double)> set;
};

void addViewRow(QGridLayout* grid, ViewSettings& view, QWidget* parent, const ViewRow& its) {
  const int row = grid->rowCount();
  auto* text = new QLabel(its.label, parent);
  auto* field = new NumberField(parent);
  auto* track = new SliderTrack(parent);
  for (QWidget* widget : {static_cast<QWidget*>(text), static_cast<QWidget*>(field), static_cast<QWidget*>(track)})
    widget->setToolTip(its.help);
  field->setRange(its.low, its.high);
  field->setDecimals(its.decimals);
  field->setFixedWidth(76);
  field->edit()->setObjectName(its.name + QStringLiteral(".field"));
  field->edit()->setAccessibleName(its.label);
  track->setObjectName(its.name);
  track->setAccessibleName(its.label);
  grid->addWidget(text, row, 0);
  grid->addWidget(field, row, 1);
  grid->addWidget(track, row + 1, 0, 1, 2);
  const auto show = [=] {
    field->setValue(its.get());
    const QSignalBlocker quiet(track);
    if (!track->isSliderDown())
      track->setValue(static_cast<int>(
          std::lround(std::log(its.get() / its.low) / std::log(its.high / its.low) * SliderTrack::kSteps)));
    track->update();
  };
  QObject::connect(field, &NumberField::committed, parent, its.set);
  QObject::connect(track, &QSlider::valueChanged, parent, [its](int position) {
    its.set(its.low * std::pow(its.high / its.low, double(position) / SliderTrack::kSteps));
  });
  QObject::connect(&view, &ViewSettings::changed, parent, show);
  show();
}

}  // namespace

CombControls::CombControls(ViewSettings& view, QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(0, 1);
  auto* quantity = new SegmentedControl({tr("Curvature"), tr("Radius")}, this);
  quantity->setNames(QStringLiteral("view.combQuantity"), {QStringLiteral("curvature"), QStringLiteral("radius")});
  quantity->setToolTip(tr("Quantity plotted by the comb: curvature, or radius of curvature as in the papers."));
  quantity->setAccessibleName(tr("Quills show"));
  setSettingName(quantity, tr("Quills show curvature or radius"));
  grid->addWidget(quantity, 0, 0, 1, 2);
  auto* axis = new SegmentedControl({tr("Logarithmic"), tr("Linear")}, this);
  axis->setNames(QStringLiteral("view.radiusAxis"), {QStringLiteral("logarithmic"), QStringLiteral("linear")});
  axis->setToolTip(tr("Axis of the radius plot: logarithmic, or linear as in the papers."));
  axis->setAccessibleName(tr("Axis of the radius plot"));
  setSettingName(axis, tr("Axis of the radius plot"));
  grid->addWidget(new QLabel(tr("Axis of the radius plot"), this), 1, 0, 1, 2);
  grid->addWidget(axis, 2, 0, 1, 2);
  connect(axis, &SegmentedControl::chosen, this, [&view](int index) { view.setRadiusIsLinear(index == 1); });
  const auto showQuantity = [quantity, axis, &view] {
    quantity->setCurrent(view.combShowsRadius() ? 1 : 0);
    axis->setCurrent(view.radiusIsLinear() ? 1 : 0);
  };
  connect(quantity, &SegmentedControl::chosen, this, [&view](int index) { view.setCombShowsRadius(index == 1); });
  connect(&view, &ViewSettings::changed, this, showQuantity);
  showQuantity();
  addViewRow(grid, view, this,
             {.label = tr("Comb height"),
              .name = QStringLiteral("view.combScale"),
              .help = tr("Height of the curvature comb; 1 is automatic."),
              .low = 0.05,
              .high = 20.0,
              .decimals = 2,
              .get = [&view] { return view.combScale(); },
              .set = [&view](double value) { view.setCombScale(value); }});
  addViewRow(grid, view, this,
             {.label = tr("Comb density"),
              .name = QStringLiteral("view.combDensity"),
              .help = tr("Number of comb lines on a curve."),
              .low = 20.0,
              .high = 1000.0,
              .decimals = 0,
              .get = [&view] { return double(view.combDensity()); },
              .set = [&view](double value) { view.setCombDensity(static_cast<int>(std::lround(value))); }});
}

}  // namespace batten
