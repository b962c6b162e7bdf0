// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/corner_rounding.h"

#include <QAbstractButton>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"

namespace batten {
namespace {

// In the order of their segments.
constexpr std::array kRoundingSizes = {RoundingSize::Distance, RoundingSize::Radius};
// As they are listed.
constexpr std::array kRoundingJoints = {RoundingJoint::Tangent, RoundingJoint::Curvature,
                                        RoundingJoint::CurvatureSlope};

template <typename Values, typename Value>
int positionIn(const Values& values, Value value) {
  return static_cast<int>(std::ranges::find(values, value) - values.begin());
}

}  // namespace

CornerRounding::CornerRounding(QWidget* parent)
    : QWidget(parent),
      size_(new NumberField(this)),
      roundBy_(new SegmentedControl({tr("Distance"), tr("Radius")}, this)),
      joint_(new SegmentedControl({tr("G1"), tr("G2"), tr("G3")}, this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  buildSize();
  buildChoices();
}

void CornerRounding::buildSize() {
  auto* row = new QHBoxLayout;
  auto* name = new QLabel(tr("Rounding"), this);
  const QString help = tr("Size of the rounding of the selected corner. 0 keeps it sharp.");
  name->setToolTip(help);
  size_->setToolTip(help);
  size_->edit()->setObjectName(QStringLiteral("corners.rounding"));
  size_->setRange(0.0, 500.0);
  size_->setDecimals(2);
  size_->setStep(0.5);
  size_->setUnit(QStringLiteral("mm"));
  size_->setFixedWidth(92);
  size_->edit()->setAccessibleName(tr("Rounding of the selected corner"));
  row->addWidget(name);
  row->addStretch();
  row->addWidget(size_);
  static_cast<QVBoxLayout*>(layout())->addLayout(row);
  connect(size_, &NumberField::committed, this, [this](double mm) {
    emit changed(mm > 0.0 ? tr("Round corner") : tr("Sharpen corner"), [mm](CornerMark& mark) { mark.roundMm = mm; });
  });
}

void CornerRounding::buildChoices() {
  roundBy_->setNames(QStringLiteral("corners.roundBy"), {QStringLiteral("distance"), QStringLiteral("radius")});
  roundBy_->setToolTip(
      tr("Distance: from the corner to where the rounding begins. Radius: the smallest radius of the rounding."));
  setSettingName(roundBy_, tr("Measure of the rounding"));
  joint_->setNames(QStringLiteral("corners.joint"), {QStringLiteral("g1"), QStringLiteral("g2"), QStringLiteral("g3")});
  joint_->setToolTip(
      tr("Continuity with the adjacent curves. G1: tangent, by two typical curves. G2: curvature. "
         "G3: rate of change of curvature."));
  setSettingName(joint_, tr("Continuity of the rounding"));
  auto* choices = new QHBoxLayout;
  choices->addWidget(roundBy_, 1);
  choices->addWidget(joint_, 1);
  static_cast<QVBoxLayout*>(layout())->addLayout(choices);
  connect(roundBy_, &SegmentedControl::chosen, this, [this](int index) {
    emit changed(tr("Rounding"), [index](CornerMark& mark) { mark.roundBy = kRoundingSizes.at(index); });
  });
  connect(joint_, &SegmentedControl::chosen, this, [this](int index) {
    emit changed(tr("Rounding"), [index](CornerMark& mark) { mark.joint = kRoundingJoints.at(index); });
  });
}

void CornerRounding::showMark(const std::optional<CornerMark>& mark) {
  size_->setEnabled(mark.has_value());
  // What a sharp corner would be rounded by is of no interest, but a gap that fills later would be.
  const bool isRound = mark && mark->roundMm > 0.0;
  roundBy_->setEnabled(isRound);
  joint_->setEnabled(isRound);
  for (auto* choice : {roundBy_, joint_})
    for (auto* segment : choice->findChildren<QAbstractButton*>())
      segment->setToolTip(isRound ? choice->toolTip() : tr("Only for a corner with a rounding above 0: set it first."));
  if (isRound) {
    roundBy_->setCurrent(positionIn(kRoundingSizes, mark->roundBy));
    joint_->setCurrent(positionIn(kRoundingJoints, mark->joint));
  }
  if (mark) {
    size_->setValue(mark->roundMm);
  } else {
    size_->setEmpty(QStringLiteral("–"));
  }
}

}  // namespace batten
