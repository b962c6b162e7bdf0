// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>
#include <optional>

#include "core/contour/corner/corner_marks.h"

namespace batten {

class NumberField;
class SegmentedControl;

/// How a marked corner is rounded: size, what the size measures, and how the rounding joins the lines.
class CornerRounding : public QWidget {
  Q_OBJECT
 public:
  explicit CornerRounding(QWidget* parent = nullptr);
  /// Shows the rounding of a mark; none: there is no mark to round.
  void showMark(const std::optional<CornerMark>& mark);

 signals:
  /// The user changed the rounding of the mark shown. @param what the name of the change
  void changed(const QString& what, const std::function<void(batten::CornerMark&)>& change);

 private:
  void buildSize();
  void buildChoices();

  NumberField* size_;
  SegmentedControl* roundBy_;
  SegmentedControl* joint_;
};

}  // namespace batten
