// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/suggestion_sliders.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <cmath>

#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/slider_track.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/change_view.h"
#include "ui/session/view/view_settings.h"

namespace batten {
namespace {

constexpr double kLowestAngleDeg = 10.0, kHighestAngleDeg = 150.0;  // range of the slider
constexpr double kLeastScalePx = 6.0, kLargestScalePx = 60.0;       // range of the slider

}  // namespace

SuggestionSliders::SuggestionSliders(EditorSession& session, ViewSettings& view, QWidget* parent)
    : QWidget(parent),
      session_(session),
      view_(view),
      angle_(new NumberField(this)),
      angleTrack_(new SliderTrack(this)),
      scale_(new NumberField(this)),
      scaleTrack_(new SliderTrack(this)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  addSlider(tr("Sharper than"),
            tr("Suggests corners that turn by more than this angle. Larger: fewer, sharper corners."),
            {QStringLiteral("corners.suggestAngle"), tr("Smallest angle of a suggested corner"), QStringLiteral("°"),
             kLowestAngleDeg, kHighestAngleDeg},
            angle_, angleTrack_);
  addSlider(tr("Window length"),
            tr("Length of line on either side used to measure the turn. Larger: less sensitive to "
               "ragged edges, but small corners are missed."),
            {QStringLiteral("corners.suggestScale"), tr("Window length of corner suggestions"), QStringLiteral("px"),
             kLeastScalePx, kLargestScalePx},
            scale_, scaleTrack_);
  followControls();
  connect(&view_, &ViewSettings::changed, this, &SuggestionSliders::showValues);
  showValues();
}

void SuggestionSliders::addSlider(const QString& title, const QString& help, const SliderNames& names,
                                  NumberField* field, SliderTrack* track) {
  auto* row = new QHBoxLayout;
  auto* name = new QLabel(title, this);
  name->setToolTip(help);
  track->setToolTip(help);
  track->setObjectName(names.object);
  track->setAccessibleName(names.accessible);
  track->setRange(static_cast<int>(names.least), static_cast<int>(names.most));
  track->setSingleStep(1);
  field->setRange(names.least, names.most);
  field->setUnit(names.unit);
  field->setStep(1);
  field->setFixedWidth(76);
  field->edit()->setObjectName(names.object + QStringLiteral(".field"));
  field->edit()->setAccessibleName(names.accessible);
  row->addWidget(name);
  row->addStretch();
  row->addWidget(field);
  auto* rows = new QVBoxLayout;
  rows->setSpacing(2);  // as in the rows of other parameters
  rows->addLayout(row);
  rows->addWidget(track);
  static_cast<QVBoxLayout*>(layout())->addLayout(rows);
}

void SuggestionSliders::followControls() {
  const auto setAngle = [this](double degrees) { change(tr("Sharper than"), {degrees, view_.suggestionScalePx()}); };
  const auto setScale = [this](double px) { change(tr("Window length"), {view_.suggestionAngleDeg(), px}); };
  connect(angle_, &NumberField::committed, this, setAngle);
  connect(angleTrack_, &QSlider::valueChanged, this, setAngle);
  connect(scale_, &NumberField::committed, this, setScale);
  connect(scaleTrack_, &QSlider::valueChanged, this, setScale);
  for (SliderTrack* track : {angleTrack_, scaleTrack_}) {
    connect(track, &QSlider::sliderPressed, this, [this] { gesture_ = session_.newGesture(); });
    connect(track, &QSlider::sliderReleased, this, [this] { gesture_.reset(); });
  }
}

void SuggestionSliders::change(const QString& what, const SuggestionSettings& after) {
  if (after == suggestionSettings(view_)) return;
  session_.undoStack()->push(new ChangeSuggestions(view_, what, after, gesture_));
}

void SuggestionSliders::showValues() {
  const auto show = [](NumberField* field, SliderTrack* track, double value) {
    field->setValue(value);
    const QSignalBlocker quiet(track);
    track->setValue(static_cast<int>(std::lround(value)));
    track->update();
  };
  show(angle_, angleTrack_, view_.suggestionAngleDeg());
  show(scale_, scaleTrack_, view_.suggestionScalePx());
}

}  // namespace batten
