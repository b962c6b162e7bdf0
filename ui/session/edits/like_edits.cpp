// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/like_edits.h"

#include "core/fairing/profile/like_profile.h"
#include "ui/session/edits/fairing_edits.h"
#include "ui/session/files/profile_library.h"

namespace batten {

void followShape(EditorSession& session, const std::vector<ProfilePoint>& shape) {
  if (const TracedCurve* curve = session.selected())
    drawTarget(session, profileLike(shape, curve->sketched, curve->closed));
}

Result<void> followSavedProfile(EditorSession& session, const QString& name) {
  const auto shape = ProfileLibrary().load(name);
  if (!shape) return fail(shape.error());
  if (session.selected() == nullptr) return fail(ErrorCode::BadParameter, "Select a curve first.");
  followShape(session, *shape);
  return {};
}

}  // namespace batten
