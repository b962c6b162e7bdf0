// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_options.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "core/exchange/format_options.h"
#include "core/exchange/occt/open_cascade.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"

namespace batten {
namespace {

const QString kPresetKey = QStringLiteral("export/preset"), kUnitKey = QStringLiteral("export/unit"),
              kWhichKey = QStringLiteral("export/which"), kJoinedKey = QStringLiteral("export/joined"),
              kToleranceKey = QStringLiteral("export/accuracy"), kWidthsKey = QStringLiteral("export/widths");
constexpr const char* kFirstPreset = "illustrator";  // the receiver before one was chosen
constexpr std::array kExportedCurves = {ExportedCurves::Faired, ExportedCurves::Sketched,
                                        ExportedCurves::Both};  // as listed
constexpr int kFieldWidth = 118, kPresetLetters = 16;           // px; letters

bool canWrite(ExportFormat format) {
  return hasOpenCascade() || (format != ExportFormat::Iges && format != ExportFormat::Step);
}
QString nameOfFormat(ExportFormat format) {
  switch (format) {
    case ExportFormat::Svg:
      return QStringLiteral("SVG");
    case ExportFormat::Json:
      return ExportOptions::tr("Curve JSON");
    case ExportFormat::Dxf:
      return QStringLiteral("DXF");
    case ExportFormat::Iges:
      return QStringLiteral("IGES");
    case ExportFormat::Step:
      return QStringLiteral("STEP");
    case ExportFormat::Pdf:
      return QStringLiteral("PDF");
    case ExportFormat::Rhino:
      return QStringLiteral("3DM");
    default:
      return QStringLiteral("CSV");
  }
}

}  // namespace

ExportOptions::ExportOptions(QWidget* parent)
    : QWidget(parent),
      presets_(new QComboBox(this)),
      note_(note({}, this)),
      which_(new QComboBox(this)),
      unit_(new QComboBox(this)),
      scale_(new NumberField(this)),
      tolerance_(new NumberField(this)),
      joined_(new QCheckBox(tr("Join consecutive curves"), this)),
      widths_(new QCheckBox(tr("Outline strokes"), this)) {
  build();
  restore();
  connect(presets_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    choosePreset();
    emit formatChanged();
  });
  for (QComboBox* box : {which_, unit_})
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
      save();
      emit changed();
    });
  for (NumberField* field : {scale_, tolerance_})
    connect(field, &NumberField::committed, this, [this] {
      save();
      emit changed();
    });
  for (QCheckBox* box : {joined_, widths_})
    connect(box, &QCheckBox::toggled, this, [this] {
      save();
      emit changed();
    });
}

QWidget* ExportOptions::row(const QString& label, QWidget* control, const QString& help) {
  auto* line = new QWidget(this);
  auto* layout = new QHBoxLayout(line);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* name = new QLabel(label, line);
  name->setToolTip(help);
  control->setToolTip(help);
  if (auto* field = qobject_cast<NumberField*>(control)) {
    field->edit()->setAccessibleName(label);
  } else {
    control->setAccessibleName(label);
  }
  // One edge for all values; only the receiver's name needs more.
  if (control != presets_) control->setFixedWidth(kFieldWidth);
  layout->addWidget(name);
  layout->addStretch();
  layout->addWidget(control);
  return line;
}

void ExportOptions::build() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  presets_->setObjectName(QStringLiteral("export.preset"));
  // The longest name of all must not make the inspector wider.
  presets_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  presets_->setMinimumContentsLength(kPresetLetters);
  for (const ExportPreset& preset : exportPresets()) {
    const ExportFormat format = preset.settings.format;
    const QString label = canWrite(format) ? tr("%1 (%2)") : tr("%1 (%2, not in this build)");
    presets_->addItem(label.arg(QString::fromUtf8(preset.label), nameOfFormat(format)), QString::fromLatin1(preset.id));
  }
  layout->addWidget(row(tr("For"), presets_, tr("Receiving program: sets the format and its options.")));
  layout->addWidget(note_);
  which_->setObjectName(QStringLiteral("export.which"));
  which_->addItems({tr("Faired"), tr("Sketched"), tr("Both")});
  layout->addWidget(row(tr("Curves"), which_, tr("Faired, as fitted to the scan, or both.")));
  unit_->setObjectName(QStringLiteral("export.unit"));
  unit_->addItems({tr("Millimetres"), tr("Inches")});
  unitRow_ = row(tr("Unit"), unit_, tr("Unit of the coordinates. The file states it, so the true size is unchanged."));
  layout->addWidget(unitRow_);
  scale_->edit()->setObjectName(QStringLiteral("export.scale"));
  scale_->setRange(0.001, 1000.0);
  scale_->setDecimals(3);
  scale_->setStep(0.1);
  scale_->setValue(1.0);
  layout->addWidget(row(tr("Scale"), scale_, tr("Scale factor of the exported curves.")));
  tolerance_->edit()->setObjectName(QStringLiteral("export.tolerance"));
  tolerance_->setRange(0.0001, 1.0);
  tolerance_->setDecimals(4);
  tolerance_->setStep(0.001);
  tolerance_->setUnit(tr("mm"));
  toleranceRow_ = row(tr("Tolerance"), tolerance_,
                      tr("Maximum deviation where the format cannot hold the curves exactly. Smaller: more pieces."));
  layout->addWidget(toleranceRow_);
  joined_->setObjectName(QStringLiteral("export.joined"));
  joined_->setToolTip(
      tr("On: a line with corners is exported as one curve or path. Off: every curve is exported "
         "separately."));
  layout->addWidget(joined_);
  widths_->setObjectName(QStringLiteral("export.widths"));
  widths_->setToolTip(
      tr("On: strokes are also written as filled outlines of their width, in a layer of their own below "
         "the curves."));
  layout->addWidget(widths_);
}

const ExportPreset& ExportOptions::preset() const {
  const ExportPreset* found = findPreset(presets_->currentData().toString().toStdString());
  return found != nullptr ? *found : exportPresets().front();
}

void ExportOptions::choosePreset() {
  const ExportPreset& chosen = preset();
  note_->setText(QString::fromUtf8(chosen.note));
  unitRow_->setVisible(actsOn(FormatOption::Unit, chosen.settings));
  toleranceRow_->setVisible(actsOn(FormatOption::Tolerance, chosen.settings));
  widths_->setVisible(actsOn(FormatOption::WidthOutlines, chosen.settings));
  const QSettings settings;
  const QSignalBlocker quiet(joined_);
  const QString own = QLatin1Char('/') + QString::fromLatin1(chosen.id);
  tolerance_->setValue(settings.value(kToleranceKey + own, defaultTolerance(chosen.settings)).toDouble());
  joined_->setChecked(settings.value(kJoinedKey + own, isJoined(chosen.settings)).toBool());
  QSettings().setValue(kPresetKey, QString::fromLatin1(chosen.id));
}

void ExportOptions::restore() {
  const QSettings settings;
  const int known = presets_->findData(settings.value(kPresetKey, QString::fromLatin1(kFirstPreset)));
  presets_->setCurrentIndex(std::max(0, known >= 0 ? known : presets_->findData(QString::fromLatin1(kFirstPreset))));
  which_->setCurrentIndex(std::clamp(settings.value(kWhichKey, 0).toInt(), 0, 2));
  unit_->setCurrentIndex(std::clamp(settings.value(kUnitKey, 0).toInt(), 0, 1));
  widths_->setChecked(settings.value(kWidthsKey, false).toBool());
  choosePreset();
}

void ExportOptions::save() const {
  QSettings settings;
  const QString own = QLatin1Char('/') + QString::fromLatin1(preset().id);
  settings.setValue(kToleranceKey + own, tolerance_->value());
  settings.setValue(kJoinedKey + own, joined_->isChecked());
  settings.setValue(kWhichKey, which_->currentIndex());
  settings.setValue(kUnitKey, unit_->currentIndex());
  settings.setValue(kWidthsKey, widths_->isChecked());
}

ExportSettings ExportOptions::settings() const {
  ExportSettings settings = preset().settings;
  const bool isInch = actsOn(FormatOption::Unit, settings) && unit_->currentIndex() == 1;
  settings.unit = isInch ? LengthUnit::Inch : LengthUnit::Millimetre;
  settings.scale = scale_->value();
  settings.joined = joined_->isChecked();
  settings.widthOutlines = actsOn(FormatOption::WidthOutlines, settings) && widths_->isChecked();
  if (actsOn(FormatOption::Tolerance, settings)) settings.toleranceMm = tolerance_->value();
  return settings;
}

ExportedCurves ExportOptions::which() const { return kExportedCurves.at(which_->currentIndex()); }

QString ExportOptions::suffix() const { return QString::fromLatin1(endingsOf(preset().settings.format)[0] + 1); }

QString ExportOptions::filter() const {
  return QStringLiteral("%1 (*.%2)").arg(nameOfFormat(preset().settings.format), suffix());
}

QString ExportOptions::obstacle() const {
  if (canWrite(preset().settings.format)) return {};
  return tr("This build is without Open CASCADE and cannot write IGES or STEP. Choose a receiver of DXF or 3DM.");
}

}  // namespace batten
