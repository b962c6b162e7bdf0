// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/new_drawing_dialog.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/conventions.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"

namespace batten {
namespace {

const QSizeF kFormats[] = {{297, 210}, {210, 297}, {420, 297}};
constexpr double kSmallestMm = 10.0, kLargestMm = 1500.0;                    // of a side
constexpr double kLowestDpi = 50.0, kHighestDpi = 600.0, kUsualDpi = 150.0;  // range and what is offered
constexpr double kMostPx = 20000.0;                                          // of a side: limit of a recipe

}  // namespace

NewDrawingDialog::NewDrawingDialog(QWidget* parent)
    : QDialog(parent),
      format_(new SegmentedControl({tr("A4 landscape"), tr("A4 portrait"), tr("A3 landscape")}, this)),
      width_(new NumberField(this)),
      height_(new NumberField(this)),
      dpi_(new NumberField(this)),
      begin_(plainButton(tr("Create"), QStringLiteral("newDrawing.begin"), this)) {
  setObjectName(QStringLiteral("newDrawing"));
  setWindowTitle(tr("New drawing"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(20, 16, 20, 16);
  grid->setVerticalSpacing(10);
  grid->setHorizontalSpacing(16);
  auto* about = note(tr("An empty page to draw on with the pen. It can be saved as a recipe and opened again."), this);
  about->setFixedWidth(320);
  grid->addWidget(about, 0, 0, 1, 2);
  format_->setNames(QStringLiteral("newDrawing.format"),
                    {QStringLiteral("a4-wide"), QStringLiteral("a4-high"), QStringLiteral("a3-wide")});
  grid->addWidget(format_, 1, 0, 1, 2);
  addField(width_,
           {tr("Width"), QStringLiteral("newDrawing.width"), kSmallestMm, kLargestMm, kFormats[0].width(), tr("mm")});
  addField(height_, {tr("Height"), QStringLiteral("newDrawing.height"), kSmallestMm, kLargestMm, kFormats[0].height(),
                     tr("mm")});
  addField(dpi_, {tr("Resolution"), QStringLiteral("newDrawing.dpi"), kLowestDpi, kHighestDpi, kUsualDpi, tr("dpi")});
  addButtons();
  connect(format_, &SegmentedControl::chosen, this, [this](int index) {
    width_->setValue(kFormats[index].width());
    height_->setValue(kFormats[index].height());
    follow();
  });
  follow();
}

void NewDrawingDialog::addField(NumberField* field, const FieldRow& its) {
  field->setRange(its.low, its.high);
  field->setStep(1);
  field->setUnit(its.unit);
  field->setFixedWidth(100);
  field->edit()->setObjectName(its.name);
  field->edit()->setAccessibleName(its.label);
  field->setValue(its.value);
  auto* grid = static_cast<QGridLayout*>(layout());
  const int row = grid->rowCount();
  grid->addWidget(new QLabel(its.label, this), row, 0);
  grid->addWidget(field, row, 1, Qt::AlignRight);
  connect(field, &NumberField::committed, this, [this, field](double now) {
    field->setValue(now);
    follow();
  });
}

void NewDrawingDialog::addButtons() {
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  auto* cancel = plainButton(tr("Cancel"), QStringLiteral("newDrawing.cancel"), this);
  begin_->setProperty("primary", true);
  begin_->setDefault(true);
  cancel->setAutoDefault(false);
  buttons->addStretch();
  buttons->addWidget(cancel);
  buttons->addWidget(begin_);
  auto* grid = static_cast<QGridLayout*>(layout());
  grid->addLayout(buttons, grid->rowCount(), 0, 1, 2);
  connect(cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(begin_, &QPushButton::clicked, this, &QDialog::accept);
}

void NewDrawingDialog::follow() {
  std::optional<int> chosen;
  for (int i = 0; i < 3; ++i)
    if (QSizeF(width_->value(), height_->value()) == kFormats[i]) chosen = i;
  format_->setCurrent(chosen);
}

Recipe NewDrawingDialog::recipe() const { return recipeFor({width_->value(), height_->value()}, dpi_->value()); }

Recipe NewDrawingDialog::recipeFor(QSizeF millimetres, double dpi) {
  // A page too large for its resolution is drawn coarser rather than refused.
  const double longest = std::max(millimetres.width(), millimetres.height());
  const double bounded = std::min(dpi, kMostPx * kMillimetresPerInch / longest);
  const auto pixels = [bounded](double mm) {
    return std::max(16, static_cast<int>(std::lround(mm / kMillimetresPerInch * bounded)));
  };
  Recipe recipe;
  recipe.page = BlankPage{pixels(millimetres.width()), pixels(millimetres.height())};
  recipe.dpi = bounded;
  return recipe;
}

}  // namespace batten
