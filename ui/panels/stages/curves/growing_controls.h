// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace batten {

class GrowingPlayer;
class SliderTrack;

/// Shows how a typical chain grows, step by step: opens the player, and moves it.
class GrowingControls : public QWidget {
  Q_OBJECT
 public:
  explicit GrowingControls(GrowingPlayer& player, QWidget* parent = nullptr);

 protected:
  void hideEvent(QHideEvent*) override;

 private:
  void refresh();
  GrowingPlayer& player_;
  QPushButton* open_;
  QWidget* steps_;
  QPushButton* previous_;
  QPushButton* play_;
  QPushButton* next_;
  SliderTrack* track_;
  QLabel* text_;
};

}  // namespace batten
