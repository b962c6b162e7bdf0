// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "ui/session/editor_session.h"

class QPushButton;
class QWidget;

namespace batten {

/// "Make it like…": a menu of the other curves and of the user's own profiles; the one that is chosen becomes the drawn
/// target of the selected curve. Its last entry saves the profile of the selected curve.
/// @param saved called when a profile has been saved.
QPushButton* likeLink(EditorSession& session, QWidget* parent, std::function<void()> saved);

}  // namespace batten
