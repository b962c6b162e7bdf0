// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <memory>

#include "core/document/explain/explanation.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"

namespace batten {

class EditorSession;

/// How well the shown curves explain the ink of the page, found in the background when a run has ended and for as long
/// as someone looks: the curves never wait for it. A new run stops it. Belongs to the GUI thread.
class ExplanationSource : public QObject {
  Q_OBJECT
 public:
  explicit ExplanationSource(EditorSession& session);
  /// Whether someone looks; `changed` follows.
  void setWanted(bool wanted);
  bool isWanted() const { return isWanted_; }
  /// Of the curves that are shown; null while it is not known.
  std::shared_ptr<const Explanation> found() const;
  bool isComputing() const { return isComputing_; }

 signals:
  void changed();

 private:
  void follow();
  void stop();
  void forget();

  EditorSession& session_;
  bool isWanted_ = false, isComputing_ = false;
  std::shared_ptr<const FairedSet> of_;  ///< Whose explanation is computed or was found.
  std::shared_ptr<const Explanation> found_;
  Inbox inbox_;
  BackgroundWorker worker_;  ///< Last: joined before what its jobs use goes away.
};

}  // namespace batten
