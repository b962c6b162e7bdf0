// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/curve_list.h"

#include <QElapsedTimer>
#include <QKeyEvent>
#include <QLayout>
#include <QMouseEvent>
#include <QScrollArea>
#include <QSpacerItem>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/curves/curve_row.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/guarded.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/session/text/fairness_text.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kLeastRows = 10;         ///< That are seen without scrolling in the list itself, where there are as many.
constexpr int kFewRows = 4;            ///< A drawing of so many curves gets a list as short as they are.
constexpr int kMostKept = 20;          ///< For more rows no room is kept: a high panel would scroll because of it.
constexpr double kShareOfPanel = 0.4;  ///< That the list may take of a high one.
constexpr int kApart = 8;              ///< Between a name, which may be cut, and its figures.
constexpr int kTellEveryMs = 200;      // While results come in, the list is brought up to date this often.
constexpr int kNoRow = -1;             ///< What Qt takes for none.

int heightOfRows(int rows) { return CurveRow::kHeight * std::max(1, rows) + 2; }

}  // namespace

CurveList::CurveList(EditorSession& session, Judged judged, QWidget* parent)
    : QListWidget(parent),
      session_(session),
      judged_(judged),
      below_(new QSpacerItem(0, 0)),
      worker_(std::make_unique<BackgroundWorker>()) {
  setObjectName(QStringLiteral("curves.list"));
  setAccessibleName(tr("Curves"));
  setItemDelegate(new CurveRow(*this));
  setMouseTracking(true);
  setUniformItemSizes(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setToolTip(
      tr("Click a curve to select it; click its eye, or press Space, to exclude it from fairing "
         "and export. M: how near the curve is to one whose curvature only rises or only falls."));
  connect(&session_, &EditorSession::scanOpened, this, [this] { isLong_ = false; });
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::runFinished, &EditorSession::selectionChanged})
    connect(&session_, signal, this, &CurveList::refresh);
  connect(&session_, &EditorSession::stageReady, this, [this](StageId stage) {
    if (stage == StageId::Curves || stage == StageId::Faired) refresh();
  });
  connect(this, &QListWidget::currentRowChanged, this, [this](int row) {
    if (!filling_ && row >= 0) session_.selectCurve(row);
  });
  refresh();
}

CurveList::~CurveList() = default;

void CurveList::showEvent(QShowEvent* event) {
  QListWidget::showEvent(event);
  for (QWidget* one = parentWidget(); one && !scroll_; one = one->parentWidget()) {
    scroll_ = qobject_cast<QScrollArea*>(one);
    if (scroll_) scroll_->viewport()->installEventFilter(this);
  }
  fitHeight();
  judge();
  if (!std::exchange(wasSeen_, true)) showFromTop();
}

/// The row selected is scrolled to while the list has not got its height yet, which leaves rows above it out of sight.
void CurveList::showFromTop() {
  QTimer::singleShot(0, this, [this] {
    scrollToTop();
    scrollTo(currentIndex());
  });
}

QSize CurveList::sizeHint() const { return {240, heightOfRows(std::min(count(), kLeastRows))}; }

void CurveList::refresh() {
  filling_ = true;
  const auto curves = session_.curves();
  if (count() != std::ssize(curves)) showFromTop();
  while (count() > std::ssize(curves)) delete takeItem(count() - 1);
  while (count() < std::ssize(curves)) addItem(QString());
  for (int i = 0; i < count(); ++i) {
    const TracedCurve& curve = curves[i];
    const CurveFigures& figures = judgedFigures(curve, curve.included ? judged_ : Judged::Sketched);
    const QString whyStill = judged_ == Judged::Result ? whyLeftAsDrawn(curve) : QString();
    const QString shape = curve.construct.isCircle ? tr(", circle")
                          : curve.construct.isLine ? tr(", line")
                          : curve.closed           ? tr(", closed")
                                                   : QString();
    const QString name = curveName(session_, i) + shape;
    const QString counts = tr("%1 extr. · %2 pts").arg(figures.extrema).arg(figures.controlPoints);
    const QString right = !curve.included ? tr("excluded") : !whyStill.isEmpty() ? tr("= %1").arg(counts) : counts;
    // The row has no room for the word; it is the first of the tool tip.
    const QString spoken = whyStill.isEmpty() || !curve.included ? right : tr("unchanged, %1").arg(counts);
    const QString length = tr("Length %1").arg(millimetres(figures.lengthMm));
    item(i)->setText(name);
    item(i)->setData(CurveRow::IncludedRole, curve.included);
    item(i)->setData(CurveRow::FiguresRole, right);
    item(i)->setData(CurveRow::ExtremaRole, curve.included ? tr("%1 extr.").arg(figures.extrema) : QString());
    item(i)->setData(CurveRow::PointsRole, curve.included ? tr(" · %1 pts").arg(figures.controlPoints) : QString());
    item(i)->setData(CurveRow::SameRole, curve.included && !whyStill.isEmpty());
    item(i)->setData(CurveRow::ShapeRole, shape);
    const QString warning = curve.included ? QString::fromStdString(curve.construct.note) : QString();
    item(i)->setData(CurveRow::WarnsRole, !warning.isEmpty());
    QStringList said;
    const QString origin = curveOrigin(session_, i);
    const QString whence = origin.isEmpty() ? QString() : name + QStringLiteral(", ") + origin;
    const QString faired = judged_ == Judged::Result ? QString::fromStdString(curve.fairing.note) : QString();
    const QString fairingSays = curve.included && faired != whyStill ? faired : QString();
    for (const QString& one : {whence, whyStill, fairingSays, warning, length})
      if (!one.isEmpty()) said << one;
    item(i)->setData(CurveRow::OwnTipRole, said.join(QLatin1Char('\n')));
    item(i)->setData(CurveRow::OwnTextRole,
                     (QStringList{name + QStringLiteral(", ") + spoken} + said).join(QStringLiteral(". ")));
  }
  setCurrentRow(session_.selectedCurve().value_or(kNoRow));
  showFairness();
  filling_ = false;
  measure();
  judge();
  fitHeight();
}

// As many rows as a share of the panel holds: what stands below does not move when other parts of the panel grow.
void CurveList::fitHeight() {
  const int share = scroll_ ? static_cast<int>(kShareOfPanel * scroll_->viewport()->height()) / CurveRow::kHeight : 0;
  const int rows = std::max(kLeastRows, share), shown = std::min(count(), rows);
  setFixedHeight(heightOfRows(shown));
  // Nor when a setting brings or takes curves: the room for them stays once there were more than a few.
  isLong_ = isLong_ || count() > kFewRows;
  const int left = isLong_ ? std::max(0, heightOfRows(std::min(rows, kMostKept)) - heightOfRows(shown)) : 0;
  if (left == below_->sizeHint().height()) return;
  below_->changeSize(0, left, QSizePolicy::Minimum, QSizePolicy::Fixed);
  if (parentWidget()->layout()) parentWidget()->layout()->invalidate();
}

bool CurveList::eventFilter(QObject* watched, QEvent* event) {
  if (scroll_ && watched == scroll_->viewport() && event->type() == QEvent::Resize) fitHeight();
  return QListWidget::eventFilter(watched, event);
}

void CurveList::measure() {
  const QFontMetrics metrics(uiFont(12));
  const auto widen = [&](int& width, const QString& text) { width = std::max(width, metrics.horizontalAdvance(text)); };
  Columns columns;
  int shortest = 0;
  for (int i = 0; i < count(); ++i) {
    widen(columns.extrema, item(i)->data(CurveRow::ExtremaRole).toString());
    widen(columns.points, item(i)->data(CurveRow::PointsRole).toString());
    if (item(i)->data(CurveRow::SameRole).toBool()) widen(columns.same, QStringLiteral("= "));
    if (item(i)->data(CurveRow::ExtremaRole).toString().isEmpty())
      widen(columns.words, item(i)->data(CurveRow::FiguresRole).toString());
    if (item(i)->data(CurveRow::WarnsRole).toBool()) columns.warning = CurveRow::kIconSize + 6;
    if (!item(i)->data(CurveRow::BadgeRole).toString().isEmpty())
      columns.badge = CurveRow::kBadgeWidth + CurveRow::kBadgeGap;
    widen(shortest, shortNameOf(item(i)->text()));
  }
  columns_ = columns;
  // The name is what canvas and files call the curve by: it goes after the control points, and its number never.
  if (shortest > nameRoom() && columns_.points > 0) {
    columns_.points = 0;
    columns_.hasPoints = false;
  }
  columns_.isNumberOnly = shortest > nameRoom();
  viewport()->update();
}

QString CurveList::shortNameOf(const QString& name) {
  return name.section(QStringLiteral(" ("), 0, 0).section(QLatin1Char(','), 0, 0);
}

int CurveList::nameRoom() const {
  return viewport()->width() - CurveRow::kEyeWidth - columns_.warning - columns_.badge - columns_.figures() - kApart -
         CurveRow::kRightMargin;
}

QString CurveList::shownName(int row) const {
  if (row < 0 || row >= count()) return {};
  const QString whole = item(row)->text(), shape = item(row)->data(CurveRow::ShapeRole).toString();
  const QString name = shortNameOf(whole);
  // The number is what canvas, files and report call the curve by: it is the last to go.
  if (columns_.isNumberOnly) return name.section(QLatin1Char(' '), -1);
  const QFontMetrics metrics(uiFont(12));
  if (metrics.horizontalAdvance(whole) <= nameRoom()) return whole;
  const QString withoutShape = whole.chopped(shape.size());
  const QString cut = metrics.elidedText(withoutShape, Qt::ElideRight, nameRoom());
  return cut.size() > name.size() + 3 ? cut : name;  // at least a letter of an own name
}

void CurveList::resizeEvent(QResizeEvent* event) {
  QListWidget::resizeEvent(event);
  measure();
}

void CurveList::showFairness() {
  const auto curves = session_.curves();
  for (int i = 0; i < std::min(count(), static_cast<int>(curves.size())); ++i) {
    const TracedCurve& curve = curves[i];
    const bool isKnown = known_ && i < std::ssize(*known_) && curve.included &&
                         (*known_)[i].curve == judgedCurve(curve, judged_) && (*known_)[i].fairness;
    item(i)->setData(CurveRow::BadgeRole, isKnown ? fairnessBadge(*(*known_)[i].fairness) : QString());
    item(i)->setData(CurveRow::SimilarityRole, isKnown ? (*known_)[i].fairness->similarity : 0.0);
    const QString why = isKnown ? fairnessSentence(*(*known_)[i].fairness) : QString();
    QStringList said;
    const QString own = item(i)->data(CurveRow::OwnTipRole).toString();
    for (const QString& one : {own, why})
      if (!one.isEmpty()) said << one;
    item(i)->setData(Qt::ToolTipRole, said.isEmpty() ? QVariant() : said.join(QLatin1Char('\n')));
    QString spoken = item(i)->data(CurveRow::OwnTextRole).toString();
    if (isKnown) spoken += QStringLiteral(". ") + why;
    item(i)->setData(Qt::AccessibleTextRole, spoken);
  }
}

std::shared_ptr<const CurveList::Judgements> CurveList::wantedJudgements() const {
  auto wanted = std::make_shared<Judgements>();
  bool isAllKnown = true, isAsked = asked_ != nullptr;
  const auto curves = session_.curves();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Judgement one{judgedCurve(curves[i], judged_), curves[i].closed, std::nullopt, false};
    const bool isSame = known_ && i < known_->size() && (*known_)[i].curve == one.curve &&
                        (*known_)[i].closed == one.closed && (*known_)[i].isJudged;
    if (isSame) one = (*known_)[i];
    isAllKnown = isAllKnown && isSame;
    isAsked = isAsked && i < asked_->size() && (*asked_)[i].curve == one.curve && (*asked_)[i].closed == one.closed;
    wanted->push_back(std::move(one));
  }
  return isAllKnown || isAsked ? nullptr : wanted;
}

std::optional<CurveFairness> CurveList::fairnessOf(const Judgement& one, const Judgements* before) {
  if (before) {
    const auto same = [&](const Judgement& b) { return b.isJudged && b.closed == one.closed && b.curve == one.curve; };
    const auto earlier = std::find_if(before->begin(), before->end(), same);
    if (earlier != before->end() && earlier->fairness) return earlier->fairness;
  }
  // A curve that cannot be judged leaves the others theirs.
  const auto judged = guarded<std::optional<CurveFairness>>(
      [&]() -> Result<std::optional<CurveFairness>> { return curveFairness(one.curve, one.closed); });
  return judged ? *judged : std::nullopt;
}

Result<CurveList::Judgements> CurveList::judgeAll(Judgements all, std::size_t first, const Judgements* before,
                                                  const CancelToken& token,
                                                  const std::function<void(const Judgements&)>& tell) {
  QElapsedTimer sinceTold;
  sinceTold.start();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (token.isCancelled()) return cancelled();
    Judgement& one = all[(k + first) % all.size()];
    if (one.isJudged) continue;
    one.isJudged = true;
    if (!one.fairness) one.fairness = fairnessOf(one, before);
    if (k > 0 && sinceTold.elapsed() < kTellEveryMs) continue;
    tell(all);
    sinceTold.restart();
  }
  return all;
}

void CurveList::judge() {
  if (!isVisible()) return;
  const auto wanted = wantedJudgements();
  if (!wanted) return;
  asked_ = wanted;
  const std::size_t first = session_.selectedCurve().value_or(0);
  worker_->start([this, wanted, before = known_, first](const CancelToken& token) {
    const auto post = [&](const std::function<void(CurveList&)>& act) {
      if (token.isCancelled()) return;
      inbox_.post([this, wanted, act] {
        if (asked_ == wanted) act(*this);
      });
    };
    const auto tell = [&](const Judgements& found, bool isAll) {
      post([made = std::make_shared<const Judgements>(found), isAll](CurveList& its) { its.take(made, isAll); });
    };
    const auto found = guarded<Judgements>([&] {
      return judgeAll(*wanted, first, before.get(), token, [&](const Judgements& soFar) { tell(soFar, false); });
    });
    if (found) return tell(*found, true);
    // What could not be found may be asked for again.
    post([](CurveList& its) { its.asked_.reset(); });
  });
}

void CurveList::take(const std::shared_ptr<const Judgements>& found, bool isAll) {
  known_ = found;
  if (isAll) asked_.reset();
  filling_ = true;
  showFairness();
  filling_ = false;
  measure();
  if (isAll) judge();
}

void CurveList::keyPressEvent(QKeyEvent* event) {
  const auto curves = session_.curves();
  if (event->key() == Qt::Key_Space && currentRow() >= 0 && currentRow() < std::ssize(curves))
    return setIncluded(session_, currentRow(), !curves[currentRow()].included);
  QListWidget::keyPressEvent(event);
}

void CurveList::mousePressEvent(QMouseEvent* event) {
  const int row = indexAt(event->pos()).row();
  const auto curves = session_.curves();
  if (row >= 0 && row < std::ssize(curves) && event->pos().x() < CurveRow::kEyeWidth)
    return setIncluded(session_, row, !curves[row].included);
  QListWidget::mousePressEvent(event);
}

}  // namespace batten
