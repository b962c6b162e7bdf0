// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/view/view_settings.h"

namespace batten {

/// Height and density of the curvature comb; a matter of view, not of the drawing.
class CombControls : public QWidget {
  Q_OBJECT
 public:
  explicit CombControls(ViewSettings& view, QWidget* parent = nullptr);
};

}  // namespace batten
