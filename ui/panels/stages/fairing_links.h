// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/fairing/fairing_params.h"

class QPushButton;

namespace batten {

class EditorSession;

/// What can be done with the fairing of the selected curve, as a column of links. All keep their places in every mode:
/// those that have nothing to do are greyed and say why.
class FairingLinks : public QWidget {
  Q_OBJECT
 public:
  explicit FairingLinks(EditorSession& session, QWidget* parent = nullptr);
  /// @param params what the panel shows; `isOwn`: the selected curve's own.
  void refresh(const FairingParams& params, bool isOwn);

 signals:
  void comparisonAsked();
  void useForAllAsked();
  void followAllAsked();
  void savedProfile();  ///< The list of saved profiles may have changed.

 private:
  void explain(const FairingParams& params, bool isDrawn, bool canSplit, bool isOwn);

  EditorSession& session_;
  QPushButton* split_;
  QPushButton* whole_;
  QPushButton* unsplit_;
  QPushButton* draw_;
  QPushButton* forget_;
  QPushButton* like_;
  QPushButton* logAesthetic_;
  QPushButton* useForAll_;
  QPushButton* followAll_;
};

}  // namespace batten
