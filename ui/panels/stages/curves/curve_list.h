// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/cancel_token.h"
#include "core/base/result.h"
#include "core/fairing/curve_fairness.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/judged_curve.h"

class QScrollArea;
class QSpacerItem;

namespace batten {

class BackgroundWorker;

/// All curves of the drawing: an eye that takes a curve in or leaves it out (Space does the same), its name, its
/// figures, and a sign where its construction has something to say, which the tool tip does. Of results it says which
/// ones fairing left as drawn, and why. Beside each stands its fairness (CurveFairness), found in the background.
class CurveList : public QListWidget {
  Q_OBJECT
 public:
  /// @param judged whose figures stand beside the names.
  CurveList(EditorSession& session, Judged judged, QWidget* parent = nullptr);
  /// Of an item: what stands in its badge of fairness; empty as long as that is not known.
  static constexpr int kBadgeRole = Qt::UserRole + 3;
  ~CurveList() override;
  /// [px] What stands right of the names in every row; 0 where no row has it.
  struct Columns {
    int same = 0, extrema = 0, points = 0, words = 0, warning = 0, badge = 0;
    bool hasPoints = true;      ///< The control points are said; else only in the tip.
    bool isNumberOnly = false;  ///< "2" instead of "Curve 2", in all rows.
    int figures() const { return same + extrema + points > words ? same + extrema + points : words; }
  };
  const Columns& columns() const { return columns_; }
  /// For below the list in its layout, which owns it: what the list leaves of its room while it is short.
  QSpacerItem* roomBelow() { return below_; }
  /// The name in a row, as far as there is room for it.
  QString shownName(int row) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {120, 30}; }

 protected:
  void showEvent(QShowEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  bool eventFilter(QObject*, QEvent*) override;

 private:
  /// A curve and how fair it is; none as long as that is not known.
  struct Judgement {
    NurbsCurve curve;
    bool closed = false;
    std::optional<CurveFairness> fairness;
    bool isJudged = false;  ///< A curve without length has none all the same.
  };
  using Judgements = std::vector<Judgement>;

  void refresh();
  void showFromTop();
  void fitHeight();
  void measure();
  static QString shortNameOf(const QString& name);  ///< "Curve 2"
  int nameRoom() const;
  void showFairness();
  /// Asks for what is not known of the curves that are shown.
  void judge();
  /// The curves that are shown, with what is known of them; null where all is known, or asked for.
  std::shared_ptr<const Judgements> wantedJudgements() const;
  /// Judges what is not judged yet, the curve `first` before all others, and tells from time to time what it has.
  /// @param before what may be taken over; null: nothing
  static Result<Judgements> judgeAll(Judgements all, std::size_t first, const Judgements* before,
                                     const CancelToken& token, const std::function<void(const Judgements&)>& tell);
  static std::optional<CurveFairness> fairnessOf(const Judgement& one, const Judgements* before);
  void take(const std::shared_ptr<const Judgements>& found, bool isAll);
  EditorSession& session_;
  Judged judged_;
  bool filling_ = false, wasSeen_ = false;
  bool isLong_ = false;  ///< The drawing has, or had, so many curves that the list has a room of its own.
  QSpacerItem* below_;
  QScrollArea* scroll_ = nullptr;  ///< In which the panel is scrolled.
  Columns columns_;
  std::shared_ptr<const Judgements> known_, asked_;  ///< Of the curves in their order.
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;  ///< Last, so that it is joined before anything goes.
};

}  // namespace batten
