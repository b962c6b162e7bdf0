// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "ui/session/editor_session.h"

namespace batten {

/// The curves that the window shows: faired ones where there are some, else the sketched ones (their `faired` is empty).
inline const std::vector<TracedCurve>* shownCurves(const EditorSession& session) {
  if (session.output().faired) return &session.output().faired->curves;
  if (session.output().constructed) return &session.output().constructed->curves;
  return nullptr;
}

/// The selected one of them, or null.
inline const TracedCurve* shownCurve(const EditorSession& session) {
  const auto* curves = shownCurves(session);
  const int index = session.selectedCurve();
  if (!curves || index < 0 || index >= static_cast<int>(curves->size())) return nullptr;
  return &(*curves)[static_cast<std::size_t>(index)];
}

}  // namespace batten
