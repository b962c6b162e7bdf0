// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curve_list.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/curve_names.h"
#include "ui/session/piece_choice.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kCurveRow = 26;
constexpr int kEyeWidth = 26;
constexpr int kIconSize = 14;
constexpr int kApart = 8;  ///< Between a name, which may be cut, and its figures.
enum Role { IncludedRole = Qt::UserRole, FiguresRole, WarnsRole };

class CurveDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {120, kCurveRow}; }
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Theme& theme = themeOf(option.palette);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(option.rect).adjusted(0, 1, 0, -1);
    if (option.state & (QStyle::State_Selected | QStyle::State_MouseOver)) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(option.state & QStyle::State_Selected ? theme.selection : theme.hover);
      painter->drawRoundedRect(box, 5, 5);
    }
    if (option.state & QStyle::State_HasFocus) drawFocusRing(*painter, box, 5, theme);
    const bool included = index.data(IncludedRole).toBool();
    const QIcon eye = themedIcon(included ? QStringLiteral("eye") : QStringLiteral("eye-off"), option.palette);
    eye.paint(painter, iconBox(option, 6));
    painter->setFont(uiFont(12));
    painter->setPen(included ? theme.text : theme.mute);
    const QString figures = index.data(FiguresRole).toString();
    const int sign = index.data(WarnsRole).toBool() ? kIconSize + 6 : 0;
    const int room = static_cast<int>(box.width()) - kEyeWidth - sign - kApart - 6 -
                     painter->fontMetrics().horizontalAdvance(figures);
    const QString name = painter->fontMetrics().elidedText(index.data().toString(), Qt::ElideRight, room);
    painter->drawText(box.adjusted(kEyeWidth, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, name);
    if (index.data(WarnsRole).toBool()) {
      const int after = kEyeWidth + painter->fontMetrics().horizontalAdvance(name) + 6;
      themedIcon(QStringLiteral("warning"), option.palette).paint(painter, iconBox(option, after));
    }
    painter->setPen(theme.mute);
    painter->drawText(box.adjusted(0, 0, -6, 0), Qt::AlignVCenter | Qt::AlignRight, figures);
    painter->restore();
  }

 private:
  static QRect iconBox(const QStyleOptionViewItem& option, int x) {
    return {option.rect.left() + x, option.rect.top() + (kCurveRow - kIconSize) / 2, kIconSize, kIconSize};
  }
};

}  // namespace

CurveList::CurveList(EditorSession& session, Judged judged, QWidget* parent)
    : QListWidget(parent), session_(session), judged_(judged) {
  setObjectName(QStringLiteral("curves.list"));
  setAccessibleName(tr("Curves"));
  setItemDelegate(new CurveDelegate(this));
  setMouseTracking(true);
  setUniformItemSizes(true);
  setFrameShape(QFrame::NoFrame);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setToolTip(
      tr("Click a curve to select it; click its eye, or press Space, to exclude it from fairing "
         "and export."));
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

QSize CurveList::sizeHint() const { return {240, kCurveRow * std::clamp(count(), 1, 10) + 2}; }

void CurveList::refresh() {
  filling_ = true;
  const auto curves = session_.curves();
  while (count() > static_cast<int>(curves.size())) delete takeItem(count() - 1);
  while (count() < static_cast<int>(curves.size())) addItem(QString());
  for (int i = 0; i < count(); ++i) {
    const TracedCurve& curve = curves[static_cast<std::size_t>(i)];
    const CurveFigures& figures = judgedFigures(curve, curve.included ? judged_ : Judged::Sketched);
    const QString whyStill = judged_ == Judged::Result ? whyLeftAsDrawn(curve) : QString();
    const QString shape = curve.construct.isCircle ? tr(", circle")
                          : curve.construct.isLine ? tr(", line")
                          : curve.closed           ? tr(", closed")
                                                   : QString();
    const QString name = curveName(session_, i) + shape;
    const QString right = !curve.included ? tr("left out")
                          : whyStill.isEmpty()
                              ? tr("%1 pts · %2").arg(figures.controlPoints).arg(millimetres(figures.lengthMm))
                              : tr("unchanged · %1").arg(millimetres(figures.lengthMm));
    item(i)->setText(name);
    item(i)->setData(IncludedRole, curve.included);
    item(i)->setData(FiguresRole, right);
    const QString warning = curve.included ? QString::fromStdString(curve.construct.note) : QString();
    item(i)->setData(WarnsRole, !warning.isEmpty());
    QStringList said;
    const QString origin = curveOrigin(session_, i);
    const QString whence = origin.isEmpty() ? QString() : name + QStringLiteral(", ") + origin;
    for (const QString& one : {whence, whyStill, warning})
      if (!one.isEmpty()) said << one;
    item(i)->setData(Qt::ToolTipRole, said.isEmpty() ? QVariant() : said.join(QLatin1Char('\n')));
    item(i)->setData(Qt::AccessibleTextRole,
                     (QStringList{name + QStringLiteral(", ") + right} + said).join(QStringLiteral(". ")));
  }
  setCurrentRow(session_.selectedCurve());
  filling_ = false;
  setFixedHeight(sizeHint().height());
}

void CurveList::keyPressEvent(QKeyEvent* event) {
  const auto curves = session_.curves();
  if (event->key() == Qt::Key_Space && currentRow() >= 0 && currentRow() < static_cast<int>(curves.size()))
    return setIncluded(session_, currentRow(), !curves[currentRow()].included);
  QListWidget::keyPressEvent(event);
}

void CurveList::mousePressEvent(QMouseEvent* event) {
  const int row = indexAt(event->pos()).row();
  const auto curves = session_.curves();
  if (row >= 0 && row < static_cast<int>(curves.size()) && event->pos().x() < kEyeWidth)
    return setIncluded(session_, row, !curves[row].included);
  QListWidget::mousePressEvent(event);
}

}  // namespace batten
