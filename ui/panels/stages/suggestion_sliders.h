// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/gesture_id.h"

namespace batten {

class EditorSession;
class NumberField;
class SliderTrack;
class ViewSettings;
struct SuggestionSettings;

/// What corners are suggested by: how sharp, and over which length of line. Every change is an undo step.
class SuggestionSliders : public QWidget {
  Q_OBJECT
 public:
  SuggestionSliders(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  struct SliderNames {
    QString object, accessible, unit;
    double least, most;
  };
  void addSlider(const QString& title, const QString& help, const SliderNames&, NumberField*, SliderTrack*);
  void followControls();
  void showValues();
  void change(const QString& what, const SuggestionSettings& after);

  EditorSession& session_;
  ViewSettings& view_;
  NumberField* angle_;
  SliderTrack* angleTrack_;
  NumberField* scale_;
  SliderTrack* scaleTrack_;
  GestureId gesture_;  ///< Of the drag in progress.
};

}  // namespace batten
