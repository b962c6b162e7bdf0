// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/view/judged_view.h"

namespace batten {

Judged judgedIn(const ViewSettings& view) { return view.isVisible(Layer::Faired) ? Judged::Result : Judged::Sketched; }

void forgetDrawing(ViewSettings& view) {
  const ViewSettings usual;
  view.setSelectedRegion(usual.selectedRegion());
  view.setSuggestionAngleDeg(usual.suggestionAngleDeg());
  view.setSuggestionScalePx(usual.suggestionScalePx());
}

}  // namespace batten
