// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// How the window calls one of session.curves(), in lists, hints and chips alike: by the number that stays with its
/// line and by the name that an imported curve brought: "Curve 3", "Curve 3 (roof)". A long name is cut.
QString curveName(const EditorSession& session, int curve);

/// The index of the curve of a number.
std::optional<int> curveOfNumber(const EditorSession& session, int number);

/// Where an imported curve comes from: "roof.dxf, layer body"; empty for other curves.
QString curveOrigin(const EditorSession& session, int curve);

}  // namespace batten
