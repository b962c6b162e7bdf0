// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/curve_names.h"

#include <QCoreApplication>

namespace batten {
namespace {

template <class Curve>
QString storedName(const Curve& curve) {
  if constexpr (requires { curve.name; })
    return QString::fromStdString(curve.name);
  else
    return {};
}

}  // namespace

QString curveName(const EditorSession& session, int curve) {
  const auto curves = session.curves();
  if (curve >= 0 && static_cast<std::size_t>(curve) < curves.size()) {
    if (const QString name = storedName(curves[static_cast<std::size_t>(curve)]); !name.isEmpty()) return name;
  }
  return QCoreApplication::translate("CurveNames", "Curve %1").arg(curve + 1);
}

}  // namespace batten
