// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/region_edits.h"

#include <utility>

#include "ui/session/editor_session.h"

namespace batten {

void clearRegions(EditorSession& session) {
  Recipe recipe = session.recipe();
  if (recipe.regions.empty()) return;
  recipe.regions.clear();
  session.change(QObject::tr("Clear regions"), std::move(recipe));
}

}  // namespace batten
