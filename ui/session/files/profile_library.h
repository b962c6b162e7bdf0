// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <vector>

#include "core/base/result.h"
#include "core/fairing/profile/drawn_profile.h"

namespace batten {

/// The user's own French curves: shapes (shapeOf) by name, each a small file in the program's data folder. They belong
/// to the user and not to a drawing; a drawing that uses one holds the profile itself.
class ProfileLibrary {
 public:
  QStringList names() const;
  Result<std::vector<ProfilePoint>> load(const QString& name) const;
  /// Letters, digits, blanks, dots, dashes and underscores; 1 to 60 of them. One of this name is replaced.
  Result<void> save(const QString& name, const std::vector<ProfilePoint>& shape) const;
  /// One that is no longer there is no error.
  Result<void> remove(const QString& name) const;
};

}  // namespace batten
