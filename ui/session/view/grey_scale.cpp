// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/view/grey_scale.h"

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

namespace batten {

GreyScale::GreyScale(const EditorSession& session, const ViewSettings& view) : log_(session.recipe().log) {
  log_.enabled = view.isVisible(Layer::LogImage);
}

}  // namespace batten
