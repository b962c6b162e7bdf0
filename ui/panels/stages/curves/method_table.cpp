// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/curves/method_table.h"

#include <QAbstractButton>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/piece_construction.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/background/guarded.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/piece_choice.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kMethodRow = 28;  // [px] height
/// Widths of the three columns of figures, from the right.
constexpr int kColumns[] = {34, 40, 62};

void paintColumns(QPainter& painter, const QRectF& box, const QStringList& texts) {
  double right = box.right() - 8;
  for (int c = 0; c < 3; ++c) {
    painter.drawText(QRectF(right - kColumns[c], box.top(), kColumns[c], box.height()),
                     Qt::AlignVCenter | Qt::AlignRight, texts[2 - c]);
    right -= kColumns[c];
  }
}

/// The heads of the columns of figures.
class MethodHead : public QWidget {
 public:
  explicit MethodHead(QWidget* parent) : QWidget(parent) { setFixedHeight(20); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setFont(uiFont(11));
    painter.setPen(themeOf(palette()).mute);
    // On the line of the caption beside it, which has its margin above.
    paintColumns(painter, QRectF(rect()).adjusted(0, kCaptionMargin, 0, 0),
                 {MethodTable::tr("rms"), MethodTable::tr("points"), MethodTable::tr("extr.")});
  }
};

}  // namespace

/// One method: dot, name, figures.
class MethodRow : public QAbstractButton {
 public:
  MethodRow(ConstructMethod method, QWidget* parent) : QAbstractButton(parent) {
    setText(label(method));
    setObjectName(QStringLiteral("construct.method.") + word(method));
    setCheckable(true);
    setAutoExclusive(true);
    setFocusPolicy(Qt::TabFocus);
    setAttribute(Qt::WA_Hover);
    setFixedHeight(kMethodRow);
    setCursor(Qt::PointingHandCursor);
    show({}, false, {});
  }
  /// @param instead why another construction took this one's place; empty = none did.
  void show(const std::optional<CurveFigures>& figures, bool failed, const QString& instead) {
    isOther_ = !instead.isEmpty();
    const QString what = MethodTable::tr(
        "Result of this method for the selected curve: rms deviation from the points of the "
        "line, control points, curvature extrema. Click to use it.");
    setToolTip(isOther_ ? instead + QLatin1Char('\n') + what : what);
    if (figures) {
      texts_ = {shortMillimetres(figures->fromPoints.rms), QString::number(figures->controlPoints),
                QString::number(figures->extrema)};
      setAccessibleName(
          MethodTable::tr("%1: %2 rms, %3 control points, %4 extrema").arg(text(), texts_[0], texts_[1], texts_[2]) +
          (isOther_ ? QStringLiteral(". ") + instead : QString()));
    } else {
      texts_ = {failed ? MethodTable::tr("no curve") : QStringLiteral("…"), {}, {}};
      setAccessibleName(text());
    }
    update();
  }
  QSize sizeHint() const override { return {240, kMethodRow}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = QRectF(rect()).adjusted(0, 1, 0, -1);
    if (isChecked() || underMouse()) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(isChecked() ? theme.selection : theme.hover);
      painter.drawRoundedRect(box, 5, 5);
    }
    if (hasFocus()) drawFocusRing(painter, box, 5, theme);
    painter.setFont(uiFont(12, isChecked() ? QFont::DemiBold : QFont::Normal));
    painter.setPen(theme.text);
    const QString shown =
        isOther_ ? MethodTable::tr("%1 *", "mark: replaced by another construction").arg(text()) : text();
    painter.drawText(box.adjusted(8, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, shown);
    painter.setFont(uiFont(12));
    painter.setPen(theme.mute);
    paintColumns(painter, box, texts_);
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return click();
    QAbstractButton::keyPressEvent(event);
  }

 private:
  QStringList texts_;
  bool isOther_ = false;
};

QString word(ConstructMethod method) {
  Recipe named;
  named.construct.method = method;
  return QString::fromStdString(findParameter("construct.method")->get(named));
}

QString label(ConstructMethod method) {
  const Parameter* parameter = findParameter("construct.method");
  const std::string name = word(method).toStdString();
  for (std::size_t i = 0; i < parameter->choices.size(); ++i)
    if (parameter->choices[i] == name) return QString::fromStdString(parameter->choiceLabels[i]);
  return {};
}

QString helpPage(ConstructMethod method) {
  switch (method) {
    case ConstructMethod::Fair:
      return QStringLiteral("fair-fit");
    case ConstructMethod::Nurbs:
      return QStringLiteral("quintic-nurbs");
    case ConstructMethod::Bezier:
      return QStringLiteral("bezier-path");
    case ConstructMethod::Typical:
      return QStringLiteral("typical-curves");
    case ConstructMethod::ControlPolygon:
      return QStringLiteral("control-polygon");
  }
  return {};
}

MethodTable::MethodTable(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      scope_(new SegmentedControl({tr("Method of all curves"), tr("of the selected")}, this)),
      whose_(new LinesNote(1, this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  setObjectName(QStringLiteral("construct.method.row"));
  setSettingName(this, tr("Method of construction"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* head = new QHBoxLayout;
  head->setSpacing(6);
  head->addWidget(caption(tr("Method"), this));
  auto* help = linkButton(QStringLiteral("?"), QStringLiteral("construct.method.help"), this);
  help->setAccessibleName(tr("Help on this method"));
  help->setToolTip(tr("Uses, operation and limits of this method."));
  head->addWidget(help);
  head->addWidget(new MethodHead(this), 1);
  layout->addLayout(head);
  for (const ConstructMethod method : kMethods) {
    auto* row = new MethodRow(method, this);
    rows_.push_back(row);
    layout->addWidget(row);
    connect(row, &QAbstractButton::clicked, this, [this, method] { choose(method); });
  }
  scope_->setNames(QStringLiteral("construct.scope"), {QStringLiteral("all"), QStringLiteral("one")});
  scope_->setToolTip(tr("Whether a click on a method applies to the selected curve or to the whole drawing."));
  scope_->setCurrent(1);
  whose_->setObjectName(QStringLiteral("construct.method.whose"));
  layout->addSpacing(6);
  layout->addWidget(whose_);
  layout->addSpacing(4);
  layout->addWidget(scope_);
  connect(help, &QPushButton::clicked, this, [this] { emit helpAsked(helpPage(current())); });
  connect(scope_, &SegmentedControl::chosen, this, &MethodTable::refresh);
  connect(&session_, &EditorSession::stopped, this, &MethodTable::stop);
  connect(&session_, &EditorSession::workingChanged, this, &MethodTable::refresh);
  for (const auto signal : {&EditorSession::scanOpened, &EditorSession::recipeChanged, &EditorSession::selectionChanged,
                            &EditorSession::runFinished})
    connect(&session_, signal, this, &MethodTable::refresh);
  refresh();
}

MethodTable::~MethodTable() = default;

ConstructMethod MethodTable::current() const {
  const PieceChoice* choice = choiceOf(session_, session_.selectedCurve());
  return choice && choice->method ? *choice->method : session_.recipe().construct.method;
}

std::optional<CurveFigures> MethodTable::figures(ConstructMethod method) const {
  for (std::size_t i = 0; i < kMethods.size(); ++i)
    if (kMethods[i] == method) return figures_[i];
  return std::nullopt;
}

bool MethodTable::actsOnAll() const {
  return session_.curves().size() < 2 || session_.selected() == nullptr || scope_->current() == 0;
}

void MethodTable::choose(ConstructMethod method) {
  const auto curve = session_.selectedCurve();
  Recipe after = session_.recipe();
  if (actsOnAll()) {
    after.construct.method = method;
    for (PieceChoice& choice : after.choices) choice.method.reset();
  } else {
    const bool isCommon = method == after.construct.method;
    after = withChoice(session_, curve,
                       [&](PieceChoice& own) { own.method = isCommon ? std::nullopt : std::optional(method); });
  }
  std::erase_if(after.choices, [](const PieceChoice& choice) { return choice.isEmpty(); });
  session_.change(tr("Method: %1").arg(label(method)), std::move(after));
  refresh();
}

void MethodTable::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void MethodTable::refresh() {
  const ConstructMethod now = current();
  for (std::size_t i = 0; i < kMethods.size(); ++i) rows_[i]->setChecked(kMethods[i] == now);
  const bool several = session_.curves().size() > 1, isSelected = session_.selected() != nullptr;
  scope_->setVisible(several);
  scope_->setSegmentEnabled(1, isSelected);
  whose_->setVisible(several);
  whose_->setText(isSelected ? tr("The figures are those of %1.").arg(curveName(session_, *session_.selectedCurve()))
                             : QString());
  if (isVisible()) compute();
}

/// The curve that a click on the recipe's method would give.
Result<TracedCurve> MethodTable::constructedAs(const PipelineOutput& output, const Recipe& recipe, const Source& source,
                                               const RunContext& context) {
  if (source.alongside && *source.alongside != recipe.construct.method)
    return constructPiece(output, recipe, source.piece, context);
  auto line = constructLine(output, recipe, source.contour, context);
  if (!line) return fail(line.error());
  for (TracedCurve& each : *line)
    if (each.piece == source.piece && !each.sketched.isEmpty()) return std::move(each);
  return fail(ErrorCode::NoCurve, "No curve could be made from this line.");
}

void MethodTable::compute() {
  const TracedCurve* curve = session_.selected();
  const PipelineOutput& output = session_.output();
  if (!curve || !output.pieces || !output.segments || session_.isStale(StageId::Segments)) return;
  if (session_.isStopped()) return;
  const Recipe& chosen = session_.recipe();
  Source source{output.pieces,          output.segments, chosen.construct, chosen.segmentPoints,
                chosen.extremumChoices, curve->contour,  curve->piece,     output.frame.mmPerPx};
  // Whichever is chosen, all are compared: as the whole line would become, or this piece of it alone.
  source.params.method = ConstructMethod::Fair;
  if (!actsOnAll()) source.alongside = chosen.construct.method;
  if (source_ && *source_ == source) return;
  source_ = source;
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    figures_[i].reset();
    rows_[i]->show({}, false, {});
  }
  session_.setSideWork(this, true);
  worker_->start([this, output, source, base = session_.recipe()](const CancelToken& token) {
    RunContext context;
    context.cancel = token;
    context.threads = 1;
    for (std::size_t i = 0; i < kMethods.size(); ++i) {
      Recipe recipe = base;
      recipe.construct.method = kMethods[i];
      std::optional<CurveFigures> figures;
      QString instead;
      const auto made = guarded<TracedCurve>([&] { return constructedAs(output, recipe, source, context); });
      if (made && !made->sketched.isEmpty()) {
        figures = made->sketchedFigures;
        const bool other = kMethods[i] == ConstructMethod::Typical && made->construct.segments.empty();
        instead = other ? QString::fromStdString(made->construct.note) : QString();
      }
      if (token.isCancelled()) return;
      inbox_.post([this, i, figures, instead, source] {
        if (!source_ || !(*source_ == source)) return;
        show(static_cast<int>(i), figures, instead);
      });
    }
  });
}

void MethodTable::show(int method, const std::optional<CurveFigures>& figures, const QString& instead) {
  figures_[method] = figures;
  rows_[method]->show(figures, !figures, instead);
  if (method + 1 == std::ssize(kMethods)) session_.setSideWork(this, false);
}

void MethodTable::stop() {
  worker_->cancelAll();
  for (std::size_t i = 0; source_ && i < kMethods.size(); ++i)
    if (!figures_[i]) source_.reset();  // Asked for again once the work goes on.
}

}  // namespace batten
