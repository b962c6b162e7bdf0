// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curve_names.h"

#include <QCoreApplication>

namespace batten {

QString curveName(const EditorSession& session, int curve) {
  const auto curves = session.curves();
  const bool isThere = curve >= 0 && curve < std::ssize(curves);
  const int number = isThere ? curveNumber(session.output(), curves[curve]) : curve + 1;
  return QCoreApplication::translate("CurveNames", "Curve %1").arg(number);
}

}  // namespace batten
