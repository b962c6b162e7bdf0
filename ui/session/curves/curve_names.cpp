// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curves/curve_names.h"

#include <QCoreApplication>

namespace batten {
namespace {

constexpr qsizetype kMostLetters = 32;  ///< Of an own name, so that lists and hints stay readable.

}  // namespace

QString curveName(const EditorSession& session, int curve) {
  const auto curves = session.curves();
  const bool isThere = curve >= 0 && curve < std::ssize(curves);
  const int number = isThere ? curveNumber(session.output(), curves[curve]) : curve + 1;
  const QString name = QCoreApplication::translate("CurveNames", "Curve %1").arg(number);
  if (!isThere) return name;
  QString own = QString::fromStdString(ownNameOfCurve(session.output(), session.recipe(), curves[curve]));
  if (own.isEmpty()) return name;
  if (own.size() > kMostLetters) own = own.first(kMostLetters - 1) + QChar(0x2026);
  return QStringLiteral("%1 (%2)").arg(name, own);
}

std::optional<int> curveOfNumber(const EditorSession& session, int number) {
  const auto curves = session.curves();
  for (int i = 0; i < std::ssize(curves); ++i)
    if (curveNumber(session.output(), curves[i]) == number) return i;
  return std::nullopt;
}

QString curveOrigin(const EditorSession& session, int curve) {
  const auto curves = session.curves();
  const PipelineOutput& output = session.output();
  if (curve < 0 || curve >= std::ssize(curves) || !output.contours) return {};
  const int line = curves[curve].contour;
  if (line < 0 || line >= std::ssize(output.contours->contours)) return {};
  const auto imported = output.contours->contours[line].imported;
  if (!imported) return {};
  std::ptrdiff_t index = *imported;
  for (const ImportedFile& file : session.recipe().imports) {
    if (index < std::ssize(file.lines)) {
      const QString source = QString::fromStdString(file.source);
      const QString layer = QString::fromStdString(file.lines[index].layer);
      if (layer.isEmpty()) return source;
      return QCoreApplication::translate("CurveNames", "%1, layer %2").arg(source, layer);
    }
    index -= std::ssize(file.lines);
  }
  return {};
}

}  // namespace batten
