// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "ui/session/editor_session.h"

namespace batten {

/// The piece that one of curves() was made from, by its index in the pieces of output(); none while the two do not
/// belong together, for a moment.
inline std::optional<std::size_t> pieceOf(const EditorSession& session, std::optional<int> curve) {
  const TracedCurve* of = session.curveAt(curve);
  const auto& pieces = session.output().pieces;
  if (!pieces || !of || of->piece < 0 || of->piece >= std::ssize(pieces->pieces)) return std::nullopt;
  return of->piece;
}

}  // namespace batten
