// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/scale_controls.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/conventions.h"
#include "core/image/rectification.h"
#include "core/pipeline/recipe/scale_line.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"

namespace batten {
namespace {

/// A scan whose sides are as those of the paper but for this share is the whole sheet.
constexpr double kSameShape = 0.03;
constexpr double kMillimetresPerCm = 10.0;             // by definition
constexpr int kScaleFieldWidth = 92, kUnitWidth = 60;  // px
/// Millimetres of each unit, in the order of the list.
constexpr std::array kScaleUnitMm = {1.0, kMillimetresPerCm, kMillimetresPerInch};
const QString kScaleUnitKey = QStringLiteral("scale/unit");

QString nameOf(const PaperSize& paper) {
  return QString::fromLatin1(paper.name.data(), static_cast<qsizetype>(paper.name.size()));
}

/// Sides of the page in the order of the scan's.
double ratioOf(double a, double b) { return std::max(a, b) / std::min(a, b); }

QWidget* rowOf(const QString& label, const QString& help, std::initializer_list<QWidget*> controls, QWidget* parent) {
  auto* row = new QWidget(parent);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  auto* name = new QLabel(label, row);
  name->setToolTip(help);
  layout->addWidget(name);
  layout->addStretch();
  for (QWidget* control : controls) {
    control->setToolTip(help);
    layout->addWidget(control);
  }
  return row;
}

}  // namespace

ScaleControls::ScaleControls(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      measure_(plainButton(tr("Measure on the drawing"), QStringLiteral("scale.measure"), this)),
      length_(new NumberField(this)),
      unit_(new QComboBox(this)),
      paper_(new QComboBox(this)),
      width_(new NumberField(this)),
      note_(note({}, this)) {
  build();
  connect(measure_, &QPushButton::clicked, this, [this] { view_.setTool(Tool::Scale); });
  connect(length_->edit(), &QLineEdit::textEdited, this, [this] { namedUnit_ = false; });
  connect(length_, &NumberField::committed, this, &ScaleControls::setLength);
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
    QSettings().setValue(kScaleUnitKey, index);
    chooseUnit();
  });
  connect(paper_, qOverload<int>(&QComboBox::activated), this, &ScaleControls::choosePaper);
  connect(width_, &NumberField::committed, this, &ScaleControls::setWidth);
  connect(&view_, &ViewSettings::measureChanged, this, &ScaleControls::measureTaken);
  connect(&session_, &EditorSession::scanOpened, this, [this] {
    typed_.reset();
    view_.setMeasure(std::nullopt);
    refresh();
  });
  connect(&session_, &EditorSession::recipeChanged, this, &ScaleControls::refresh);
  refresh();
}

void ScaleControls::build() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  const QString widthHelp = tr("True width of the whole picture. Enter mm, cm or in.");
  width_->setFixedWidth(kScaleFieldWidth);
  width_->setRange(0.1, 100000.0);
  width_->setDecimals(1);
  width_->setStep(1.0);
  width_->setUnit(tr("mm"));
  width_->setOtherUnits([](const QString& unit) {
    return unit == QLatin1String("cm") ? kMillimetresPerCm : unit == QLatin1String("in") ? kMillimetresPerInch : 0.0;
  });
  width_->edit()->setObjectName(QStringLiteral("scale.width"));
  width_->edit()->setAccessibleName(tr("Width of the picture in mm"));
  layout->addWidget(rowOf(tr("Width"), widthHelp, {width_}, this));
  paper_->setObjectName(QStringLiteral("scale.paper"));
  paper_->setAccessibleName(tr("Paper"));
  paper_->setFixedWidth(kScaleFieldWidth);
  paper_->addItem(QStringLiteral("–"));
  for (const PaperSize& paper : paperSizes()) paper_->addItem(nameOf(paper));
  layout->addWidget(rowOf(tr("Paper"), tr("The whole picture is one sheet of this paper."), {paper_}, this));
  measure_->setToolTip(tr("Drag along something of known length.  (M)"));
  layout->addWidget(measure_);
  length_->setFixedWidth(kScaleFieldWidth);
  length_->setRange(0.01, 100000.0);
  length_->setDecimals(2);
  length_->setStep(1.0);
  length_->setOtherUnits([this](const QString& unit) { return lengthTypedIn(unit); });
  length_->edit()->setObjectName(QStringLiteral("scale.length"));
  length_->edit()->setAccessibleName(tr("True length of the line"));
  unit_->setObjectName(QStringLiteral("scale.unit"));
  unit_->setAccessibleName(tr("Unit of the length"));
  unit_->setFixedWidth(kUnitWidth);
  unit_->addItems({tr("mm"), tr("cm"), tr("in")});
  unit_->setCurrentIndex(std::clamp(QSettings().value(kScaleUnitKey, 0).toInt(), 0, 2));
  lengthRow_ =
      rowOf(tr("Is"), tr("True length of the line on the drawing. Enter mm, cm or in."), {length_, unit_}, this);
  layout->addWidget(lengthRow_);
  note_->setObjectName(QStringLiteral("scale.note"));
  layout->addWidget(note_);
}

double ScaleControls::millimetresPerUnit() const { return kScaleUnitMm.at(unit_->currentIndex()); }

void ScaleControls::change(const QString& what, Recipe after) {
  view_.setMeasure(std::nullopt);
  session_.change(what, std::move(after));
}

double ScaleControls::lengthTypedIn(const QString& unit) {
  namedUnit_ = true;
  const double mm = unit == QLatin1String("mm")   ? 1.0
                    : unit == QLatin1String("cm") ? kMillimetresPerCm
                    : unit == QLatin1String("in") ? kMillimetresPerInch
                                                  : 0.0;
  return mm / millimetresPerUnit();
}

// Who picks the unit behind the number means the number in that unit; a length that was not typed just now stays.
void ScaleControls::chooseUnit() {
  const auto& known = session_.recipe().scaleLine;
  if (typed_ && !view_.measure() && known && known->lengthMm == typed_->lengthMm) return setLength(typed_->number);
  refresh();
}

void ScaleControls::measureTaken() {
  refresh();
  if (!view_.measure()) return;
  length_->edit()->setFocus(Qt::OtherFocusReason);
  length_->edit()->selectAll();
}

void ScaleControls::setLength(double length) {
  const auto& known = session_.recipe().scaleLine;
  ScaleLine line;
  if (view_.measure()) {
    line = {view_.measure()->fromPx, view_.measure()->toPx, 0.0};
  } else if (known) {
    line = *known;
  } else {
    return;
  }
  line.lengthMm = length * millimetresPerUnit();
  typed_ = namedUnit_ ? std::nullopt : std::optional(Typed{length, line.lengthMm});
  Recipe after = session_.recipe();
  setScaleLine(after, line);
  if (const auto problem = validate(after)) return note_->setText(QString::fromStdString(problem->message));
  change(tr("Measured scale"), std::move(after));
}

void ScaleControls::choosePaper(int index) {
  if (index < 1 || index > std::ssize(paperSizes()) || !session_.hasScan()) return;
  const PaperSize& paper = paperSizes()[index - 1];
  const PageFrame frame = frameFor(*session_.scan(), session_.recipe());
  const double longPx = std::max(frame.widthPx, frame.heightPx);
  Recipe after = session_.recipe();
  setResolution(after, longPx * kMillimetresPerInch / paper.longMm);
  const double scan = ratioOf(frame.widthPx, frame.heightPx), sheet = ratioOf(paper.shortMm, paper.longMm);
  change(tr("Paper %1").arg(nameOf(paper)), std::move(after));
  // Said after the change, which writes its own note.
  if (std::abs(scan - sheet) > kSameShape * sheet)
    note_->setText(tr("The picture is not a whole sheet of %1: its aspect ratio is 1 : %2, not 1 : %3. The "
                      "longer side is used.")
                       .arg(nameOf(paper))
                       .arg(scan, 0, 'f', 2)
                       .arg(sheet, 0, 'f', 2));
}

void ScaleControls::setWidth(double mm) {
  if (!session_.hasScan()) return;
  const PageFrame frame = frameFor(*session_.scan(), session_.recipe());
  Recipe after = session_.recipe();
  setResolution(after, frame.widthPx * kMillimetresPerInch / mm);
  if (const auto problem = validate(after)) return note_->setText(QString::fromStdString(problem->message));
  change(tr("Known width"), std::move(after));
}

void ScaleControls::refresh() {
  const bool has = session_.hasScan();
  for (QWidget* one : {static_cast<QWidget*>(measure_), static_cast<QWidget*>(paper_), static_cast<QWidget*>(width_)})
    one->setEnabled(has);
  const auto& measured = view_.measure();
  const auto& known = session_.recipe().scaleLine;
  lengthRow_->setVisible(has && (measured || known));
  paper_->setCurrentIndex(0);
  if (!has) {
    width_->setEmpty(QStringLiteral("–"));
    note_->hide();
    return;
  }
  const PageFrame frame = frameFor(*session_.scan(), session_.recipe());
  const double width = frame.lengthToModel(frame.widthPx), height = frame.lengthToModel(frame.heightPx);
  const bool assumed = isScaleAssumed(*session_.scan(), session_.recipe());
  if (assumed)
    width_->setEmpty(QStringLiteral("–"));
  else
    width_->setValue(width);
  for (std::size_t i = 0; i < paperSizes().size() && !assumed; ++i) {
    const PaperSize& paper = paperSizes()[i];
    const double slack = 0.5;  // [mm] half a mm of cutting tells no paper from another
    if (std::abs(std::min(width, height) - paper.shortMm) < slack &&
        std::abs(std::max(width, height) - paper.longMm) < slack)
      paper_->setCurrentIndex(static_cast<int>(i) + 1);
  }
  QString text;
  if (measured) {
    const double px = (measured->toPx - measured->fromPx).norm();
    length_->setEmpty(assumed ? QString()
                              : tr("now %1").arg(frame.lengthToModel(px) / millimetresPerUnit(), 0, 'f', 2));
    text = tr("Enter the true length of the line (%1 px).").arg(px, 0, 'f', 1);
  } else if (known) {
    length_->setValue(known->lengthMm / millimetresPerUnit());
    text = tr("Drag the ends of the line to move it; press Delete to remove it.");
  }
  note_->setText(text);
  note_->setVisible(!text.isEmpty());
}

}  // namespace batten
