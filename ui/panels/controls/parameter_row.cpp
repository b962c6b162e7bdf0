// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/parameter_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QFontMetrics>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/slider_track.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kInnerWidth = 272;  // [px] of a panel within its margins

QString text(const std::string& s) { return QString::fromStdString(s); }

QStringList list(const std::vector<std::string>& words) {
  QStringList out;
  for (const auto& word : words) out << text(word);
  return out;
}

/// What a parameter takes for a wanted value: where that one is refused, the next on the way.
double taken(const Parameter& parameter, double wanted, double before) {
  const double least = parameter.leastAbove.value_or(parameter.minimum);
  if (wanted <= parameter.minimum || wanted >= least) return wanted;
  return before < least ? least : parameter.minimum;
}

}  // namespace

ParameterRow::ParameterRow(EditorSession& session, const Parameter& parameter, QWidget* parent)
    : QWidget(parent),
      session_(session),
      parameter_(parameter),
      binding_{parameter.get, parameter.set},
      low_(parameter.minimum),
      high_(parameter.maximum) {
  setObjectName(text(parameter.name) + QStringLiteral(".row"));
  build();
  connect(&session_, &EditorSession::recipeChanged, this, &ParameterRow::sync);
  sync();
}

void ParameterRow::build() {
  const QString help = text(parameter_.help);
  setToolTip(help + QStringLiteral("\n") +
             tr("Double-click the name for the default, %1.").arg(text(defaultValue(parameter_))));
  name_ = new QLabel(text(parameter_.label), this);
  name_->installEventFilter(this);
  switch (parameter_.type) {
    case ParameterType::Boolean:
      buildBoolean();
      break;
    case ParameterType::Choice:
      buildChoice();
      break;
    case ParameterType::Integer:
    case ParameterType::Real:
      buildNumber();
      break;
    case ParameterType::Text:
      buildText();
      break;
  }
  for (QWidget* control :
       {static_cast<QWidget*>(check_), static_cast<QWidget*>(segments_), static_cast<QWidget*>(combo_),
        static_cast<QWidget*>(track_), static_cast<QWidget*>(text_)}) {
    if (!control) continue;
    control->setAccessibleName(text(parameter_.label));
    control->setAccessibleDescription(help);
  }
}

void ParameterRow::buildBoolean() {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  check_ = new QCheckBox(name_->text(), this);
  check_->setObjectName(text(parameter_.name));
  check_->installEventFilter(this);
  name_->hide();
  layout->addWidget(check_);
  layout->addStretch();
  connect(check_, &QCheckBox::toggled, this,
          [this](bool on) { give(on ? QStringLiteral("true") : QStringLiteral("false")); });
}

void ParameterRow::buildChoice() {
  const QStringList labels = list(parameter_.choiceLabels), words = list(parameter_.choices);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(name_);
  const auto pick = [this, words](int index) {
    if (index >= 0 && index < words.size()) give(words[index]);
  };
  if (labels.size() <= 4 && SegmentedControl::fits(labels, kInnerWidth)) {
    segments_ = new SegmentedControl(labels, this);
    segments_->setNames(text(parameter_.name), words);
    layout->addWidget(segments_);
    connect(segments_, &SegmentedControl::chosen, this, pick);
  } else {
    combo_ = new QComboBox(this);
    combo_->setObjectName(text(parameter_.name));
    combo_->addItems(labels);
    layout->addWidget(combo_);
    connect(combo_, &QComboBox::activated, this, pick);
  }
}

void ParameterRow::buildNumber() {
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setHorizontalSpacing(8);
  layout->setVerticalSpacing(2);
  layout->setColumnStretch(0, 1);
  field_ = new NumberField(this);
  field_->setRange(parameter_.minimum, parameter_.maximum);
  field_->setStep(parameter_.step);
  field_->setDecimals(parameter_.decimals);
  field_->setUnit(text(parameter_.unit));
  field_->setMinimumText(text(parameter_.minimumWord));
  field_->edit()->setObjectName(text(parameter_.name) + QStringLiteral(".field"));
  field_->edit()->setAccessibleName(text(parameter_.label));
  field_->setOtherUnits([this](const QString& unit) { return inOwnUnits(unit); });
  const int unitWidth = QFontMetrics(uiFont(11)).horizontalAdvance(text(parameter_.unit));
  field_->setFixedWidth(std::max(76, 60 + unitWidth));
  track_ = new SliderTrack(this);
  track_->setObjectName(text(parameter_.name));
  layout->addWidget(name_, 0, 0);
  layout->addWidget(field_, 0, 1);
  layout->addWidget(track_, 1, 0, 1, 2);
  connect(field_, &NumberField::committed, this, [this](double value) { giveNumber(value, gestureOfKeys()); });
  connect(track_, &QSlider::sliderPressed, this, [this] { gesture_ = session_.newGesture(); });
  connect(track_, &QSlider::valueChanged, this, [this](int position) {
    giveNumber(fromTrack(position), track_->isSliderDown() ? gesture_ : gestureOfKeys());
  });
  connect(track_, &QSlider::sliderReleased, this, [this] {
    gesture_.reset();
    sync();
  });
}

double ParameterRow::inOwnUnits(const QString& unit) const {
  const double mm = session_.output().frame.mmPerPx;
  if (!(mm > 0.0)) return 0.0;
  if (parameter_.unit == "px" && unit == QLatin1String("mm")) return 1.0 / mm;
  if (parameter_.unit == "px²" && unit == QLatin1String("mm2")) return 1.0 / (mm * mm);
  if (parameter_.unit == "mm" && unit == QLatin1String("px")) return mm;
  return 0.0;
}

void ParameterRow::showOtherUnit(double value) {
  const double mm = session_.output().frame.mmPerPx;
  QString other;
  if (mm > 0.0 && parameter_.unit == "px")
    other = tr("%1 mm. Millimetres can also be entered.").arg(value * mm, 0, 'g', 3);
  if (mm > 0.0 && parameter_.unit == "px²")
    other = tr("%1. Square millimetres can also be entered, for example 0.5 mm2.").arg(areaText(value * mm * mm));
  field_->setToolTip(other);
}

void ParameterRow::buildText() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(name_);
  text_ = new QLineEdit(this);
  text_->setObjectName(text(parameter_.name));
  layout->addWidget(text_);
  connect(text_, &QLineEdit::editingFinished, this, [this] { give(text_->text()); });
}

void ParameterRow::setBinding(Binding binding) {
  binding_ = std::move(binding);
  sync();
}

void ParameterRow::setLabel(const QString& label) {
  name_->setText(label);
  name_->setVisible(!label.isEmpty() && !check_);
  if (check_) check_->setText(label);
}

QString ParameterRow::title() const {
  const QString shown = check_ ? check_->text() : name_->text();
  return shown.isEmpty() ? text(parameter_.label) : shown;
}

QWidget* ParameterRow::control() const {
  if (field_) return field_->edit();
  for (QWidget* one : {static_cast<QWidget*>(check_), static_cast<QWidget*>(segments_), static_cast<QWidget*>(combo_)})
    if (one) return one;
  return text_;
}

void ParameterRow::setUnit(const QString& unit) {
  if (field_) field_->setUnit(unit);
}

void ParameterRow::setSliderRange(double minimum, double maximum) {
  low_ = minimum;
  high_ = maximum;
  sync();
}

void ParameterRow::give(const QString& value, GestureId gesture) {
  Recipe after = session_.recipe();
  const auto done = binding_.set(after, value.toStdString());
  if (!done) {
    sync();
    return;
  }
  if (!(after == session_.recipe())) session_.change(text(parameter_.label), std::move(after), gesture);
}

void ParameterRow::giveNumber(double value, GestureId gesture) {
  value = std::clamp(value, parameter_.minimum, parameter_.maximum);
  if (parameter_.type == ParameterType::Integer) value = std::round(value);
  value = taken(parameter_, value, text(binding_.get(session_.recipe())).toDouble());
  give(QString::number(value, 'g', 17), gesture);
}

GestureId ParameterRow::gestureOfKeys() {
  // Arrow keys held or tapped in a row make one undo step.
  if (!gesture_ || !lastKey_.isValid() || lastKey_.elapsed() > 1000) gesture_ = session_.newGesture();
  lastKey_.start();
  return gesture_;
}

double ParameterRow::fromTrack(int position) const {
  const double t = double(position) / SliderTrack::kSteps;
  double value = low_ + t * (high_ - low_);
  if (parameter_.logarithmic)
    value = low_ > 0 ? low_ * std::pow(high_ / low_, t) : low_ + std::expm1(t * std::log1p(high_ - low_));
  // Round to what the field shows, so that number and curve agree; the ends stay exact.
  if (position > 0 && position < SliderTrack::kSteps) {
    const double grain =
        parameter_.logarithmic || parameter_.step <= 0 ? std::pow(10.0, -parameter_.decimals) : parameter_.step;
    value = std::clamp(std::round(value / grain) * grain, low_, high_);
  }
  return value;
}

int ParameterRow::toTrack(double value) const {
  value = std::clamp(value, low_, high_);
  double t = high_ > low_ ? (value - low_) / (high_ - low_) : 0.0;
  if (parameter_.logarithmic)
    t = low_ > 0 ? std::log(value / low_) / std::log(high_ / low_)
                 : std::log1p(value - low_) / std::log1p(high_ - low_);
  return static_cast<int>(std::lround(t * SliderTrack::kSteps));
}

void ParameterRow::sync() {
  const QString value = text(binding_.get(session_.recipe()));
  if (check_) {
    const QSignalBlocker quiet(check_);
    check_->setChecked(value == QLatin1String("true"));
  }
  const int index = static_cast<int>(list(parameter_.choices).indexOf(value));
  if (segments_) segments_->setCurrent(index);
  if (combo_) combo_->setCurrentIndex(index);
  if (field_) {
    field_->setValue(value.toDouble());
    showOtherUnit(value.toDouble());
    const QSignalBlocker quiet(track_);
    if (!track_->isSliderDown()) track_->setValue(toTrack(value.toDouble()));
    track_->update();
  }
  if (text_ && !text_->hasFocus()) text_->setText(value);
}

bool ParameterRow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonDblClick && (watched == name_)) {
    give(text(defaultValue(parameter_)));
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace batten
