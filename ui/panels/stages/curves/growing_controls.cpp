// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/growing_controls.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "core/base/angle.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/slider_track.h"
#include "ui/session/growing_player.h"

namespace batten {
namespace {

QString textOf(const GrowingStep& step) {
  const QString number = QString::number(step.segment + 1);
  const QString figures = QObject::tr("normals %1° apart, points %2 away")
                              .arg(step.deviationRad * kDegPerRad, 0, 'f', 1)
                              .arg(shortMillimetres(step.distance));
  switch (step.kind) {
    case GrowingStep::Kind::Seed:
      return QObject::tr("Segment %1: seed").arg(number);
    case GrowingStep::Kind::Extrapolated:
      return QObject::tr("Segment %1: extrapolated").arg(number);
    case GrowingStep::Kind::Fitted:
      return step.stops ? QObject::tr("Segment %1: no longer fits (%2)").arg(number, figures)
                        : QObject::tr("Segment %1: fitted (%2)").arg(number, figures);
    case GrowingStep::Kind::Kept:
      return QObject::tr("Segment %1: this part is kept").arg(number);
  }
  return {};
}

}  // namespace

GrowingControls::GrowingControls(GrowingPlayer& player, QWidget* parent)
    : QWidget(parent),
      player_(player),
      open_(plainButton(tr("Show growing steps"), QStringLiteral("growing.open"), this)),
      steps_(new QWidget(this)),
      previous_(plainButton(tr("Previous"), QStringLiteral("growing.previous"), steps_)),
      play_(plainButton(tr("Play"), QStringLiteral("growing.play"), steps_)),
      next_(plainButton(tr("Next"), QStringLiteral("growing.next"), steps_)),
      track_(new SliderTrack(steps_)),
      text_(note({}, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  open_->setToolTip(tr("Replays how the chain of the selected curve was grown, step by step."));
  open_->setCheckable(true);
  layout->addWidget(open_, 0, Qt::AlignLeft);
  auto* inner = new QVBoxLayout(steps_);
  inner->setContentsMargins(0, 0, 0, 0);
  inner->setSpacing(6);
  track_->setObjectName(QStringLiteral("growing.step"));
  track_->setAccessibleName(tr("Growing step"));
  track_->setSingleStep(1);
  inner->addWidget(track_);
  auto* row = new QHBoxLayout;
  for (QPushButton* button : {previous_, play_, next_}) row->addWidget(button);
  row->addStretch();
  inner->addLayout(row);
  layout->addWidget(steps_);
  layout->addWidget(text_);
  connect(open_, &QPushButton::clicked, this, [this](bool on) { on ? player_.open() : player_.close(); });
  connect(previous_, &QPushButton::clicked, this, [this] {
    player_.setPlaying(false);
    player_.stepBy(-1);
  });
  connect(next_, &QPushButton::clicked, this, [this] {
    player_.setPlaying(false);
    player_.stepBy(1);
  });
  connect(play_, &QPushButton::clicked, this, [this] { player_.setPlaying(!player_.isPlaying()); });
  connect(track_, &QSlider::valueChanged, this, [this](int step) { player_.setStep(step); });
  connect(&player_, &GrowingPlayer::changed, this, &GrowingControls::refresh);
  refresh();
}

void GrowingControls::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  player_.close();
}

void GrowingControls::refresh() {
  const int count = player_.stepCount();
  const auto at = player_.step();
  open_->setChecked(player_.isOpen());
  open_->setText(player_.isOpen() ? tr("Hide growing steps") : tr("Show growing steps"));
  steps_->setVisible(count > 0);
  const QSignalBlocker quiet(track_);
  track_->setRange(0, std::max(count - 1, 0));
  track_->setValue(at.value_or(0));
  track_->update();
  previous_->setEnabled(at && *at > 0);
  next_->setEnabled(at && *at + 1 < count);
  play_->setText(player_.isPlaying() ? tr("Pause") : tr("Play"));
  QString text = player_.problem();
  if (player_.isComputing()) text = tr("Growing…");
  if (at) text = tr("%1 of %2. ").arg(*at + 1).arg(count) + textOf((*player_.steps())[*at]);
  text_->setText(text);
  text_->setVisible(!text.isEmpty());
}

}  // namespace batten
