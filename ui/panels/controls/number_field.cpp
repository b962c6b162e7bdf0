// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/number_field.h"

#include <QFocusEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QStyle>
#include <algorithm>
#include <cmath>

#include "ui/theme/theme.h"

namespace batten {

NumberField::NumberField(QWidget* parent) : QFrame(parent), edit_(new QLineEdit(this)), unit_(new QLabel(this)) {
  QFrame::setObjectName(QStringLiteral("numberFrame"));
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(6, 2, 6, 2);
  layout->setSpacing(4);
  edit_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  edit_->setFrame(false);
  edit_->installEventFilter(this);
  unit_->setFont(uiFont(11));
  unit_->setForegroundRole(QPalette::PlaceholderText);
  unit_->hide();
  layout->addWidget(edit_, 1);
  layout->addWidget(unit_);
  setFixedHeight(24);
  connect(edit_, &QLineEdit::editingFinished, this, &NumberField::commit);
  connect(edit_, &QLineEdit::returnPressed, this, [this] {
    commit();
    if (!property("wrong").toBool()) emit entered();
  });
  connect(edit_, &QLineEdit::textEdited, this, [this] { show("wrong", false); });
}

// No focus proxy: with one, Tab stops at the frame wherever Qt has put it in the chain, and never comes to what
// follows.
void NumberField::focusInEvent(QFocusEvent* event) { edit_->setFocus(event->reason()); }

void NumberField::setRange(double minimum, double maximum) {
  minimum_ = minimum;
  maximum_ = maximum;
}

void NumberField::setUnit(const QString& unit) {
  unit_->setText(unit);
  unit_->setVisible(!unit.isEmpty());
}

void NumberField::setMinimumText(const QString& text) {
  minimumText_ = text;
  if (!empty_) edit_->setText(format(value_));
}

QString NumberField::format(double value) const {
  if (!minimumText_.isEmpty() && value <= minimum_) return minimumText_;
  return QString::number(value, 'f', decimals_);
}

void NumberField::setValue(double value) {
  const QString text = format(value);
  if (!empty_ && value_ == value && edit_->text() == text) return;
  value_ = value;
  empty_ = false;
  show("wrong", false);
  edit_->setText(text);
}

void NumberField::setEmpty(const QString& placeholder) {
  empty_ = true;
  edit_->setPlaceholderText(placeholder);
  edit_->clear();
  show("wrong", false);
}

std::optional<double> NumberField::read(QString text) const {
  if (!minimumText_.isEmpty() && text.compare(minimumText_, Qt::CaseInsensitive) == 0) return minimum_;
  const auto isOfNumber = [](QChar c) { return c.isDigit() || QStringLiteral("+-.eE").contains(c); };
  const auto end = std::find_if_not(text.cbegin(), text.cend(), isOfNumber) - text.cbegin();
  QString unit = text.mid(end), own = unit_->text();
  // Who has no raised 2 types a plain one.
  for (QString* one : {&unit, &own}) one->replace(QChar(0x00b2), QLatin1Char('2'));
  double factor = 1.0;
  if (!unit.isEmpty() && unit != own) factor = inOwnUnits_ ? inOwnUnits_(unit) : 0.0;
  bool ok = false;
  const double typed = QLocale::c().toDouble(text.left(end), &ok) * factor;
  return ok && factor > 0.0 && std::isfinite(typed) ? std::optional(typed) : std::nullopt;
}

void NumberField::commit() {
  QString text = edit_->text().trimmed();
  text.replace(QLatin1Char(','), QLatin1Char('.')).remove(QChar(0x2009)).remove(QLatin1Char(' '));
  if (text.isEmpty() && empty_) return;
  const std::optional<double> typed = read(text);
  if (!typed) {
    // A word in a number field: keep it visible and marked; Escape brings the number back.
    show("wrong", true);
    return;
  }
  if (!empty_ && text == format(value_)) return;
  const double bounded = std::clamp(*typed, minimum_, maximum_);
  const bool changed = empty_ || bounded != value_;
  empty_ = false;
  value_ = bounded;
  edit_->setText(format(bounded));
  show("wrong", false);
  if (changed) emit committed(bounded);
}

void NumberField::stepBy(int steps) {
  const double step = step_ > 0 ? step_ : std::pow(10.0, -decimals_);
  const double next = std::clamp((empty_ ? minimum_ : value_) + steps * step, minimum_, maximum_);
  if (!empty_ && next == value_) return;
  setValue(next);
  emit committed(next);
}

void NumberField::show(const char* property, bool on) {
  if (this->property(property).toBool() == on) return;
  setProperty(property, on);
  style()->unpolish(this);
  style()->polish(this);
}

bool NumberField::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusIn) show("live", true);
  // Escape belongs to a number that cannot be read before it stops any work.
  if (event->type() == QEvent::ShortcutOverride && property("wrong").toBool() &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
    event->accept();
  if (event->type() == QEvent::FocusOut) show("live", false);
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const int pace = key->modifiers() & Qt::ShiftModifier ? 10 : 1;
    if (key->key() == Qt::Key_Up) return stepBy(pace), true;
    if (key->key() == Qt::Key_Down) return stepBy(-pace), true;
    if (key->key() == Qt::Key_Escape && property("wrong").toBool()) {
      empty_ ? edit_->clear() : edit_->setText(format(value_));
      show("wrong", false);
      return true;
    }
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace batten
