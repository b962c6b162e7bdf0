// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/log_transform.h"

namespace batten {

class EditorSession;
class ViewSettings;

/// The scale on which grey levels are shown and entered: the tones of the log picture while it is on the screen, else
/// the scan's own grey. The recipe holds scan grey in any case.
class GreyScale {
 public:
  GreyScale(const EditorSession& session, const ViewSettings& view);
  double shown(double grey) const { return logTone(grey, log_); }
  double grey(double shown) const { return greyOfTone(shown, log_); }
  bool operator==(const GreyScale&) const = default;

 private:
  LogParams log_;
};

}  // namespace batten
