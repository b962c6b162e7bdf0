// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <vector>

#include "core/base/result.h"
#include "core/fairing/profile/drawn_profile.h"
#include "ui/session/editor_session.h"

namespace batten {

/// Mime type of a saved profile that is being dragged: its name, UTF-8.
inline constexpr const char* kProfileMime = "application/x-batten-profile";

/// A shape (shapeOf) becomes the drawn target of the selected curve, which is then made fair to it.
void followShape(EditorSession&, const std::vector<ProfilePoint>& shape);
/// The same of one in the user's library. @return why it cannot be read.
Result<void> followSavedProfile(EditorSession&, const QString& name);

}  // namespace batten
