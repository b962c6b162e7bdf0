// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "ui/session/editor_session.h"

namespace batten {

/// How the window calls one of session.curves(), in lists, hints and chips alike: by the name that stays with its line,
/// which files carry, too.
QString curveName(const EditorSession& session, int curve);

}  // namespace batten
