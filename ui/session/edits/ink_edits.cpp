// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/edits/ink_edits.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ui/session/editor_session.h"

namespace batten {
namespace {

QString inkText(const char* text) { return QCoreApplication::translate("InkEdits", text); }

}  // namespace

QString inkName(const InkColour& ink) {
  if (!ink.hueDeg) return inkText("Black and grey");
  // From 0 degrees on, as pure colours lie: green 120, blue 240.
  constexpr std::array kNames = {QT_TRANSLATE_NOOP("InkEdits", "Red"),       QT_TRANSLATE_NOOP("InkEdits", "Orange"),
                                 QT_TRANSLATE_NOOP("InkEdits", "Yellow"),    QT_TRANSLATE_NOOP("InkEdits", "Green"),
                                 QT_TRANSLATE_NOOP("InkEdits", "Green"),     QT_TRANSLATE_NOOP("InkEdits", "Green"),
                                 QT_TRANSLATE_NOOP("InkEdits", "Turquoise"), QT_TRANSLATE_NOOP("InkEdits", "Blue"),
                                 QT_TRANSLATE_NOOP("InkEdits", "Blue"),      QT_TRANSLATE_NOOP("InkEdits", "Violet"),
                                 QT_TRANSLATE_NOOP("InkEdits", "Magenta"),   QT_TRANSLATE_NOOP("InkEdits", "Red")};
  constexpr double kStepDeg = 360.0 / static_cast<double>(kNames.size());  // of hue, for each name
  const std::size_t at = std::lround(*ink.hueDeg / kStepDeg) % kNames.size();
  return inkText(kNames[at]);
}

void setInkDropped(EditorSession& session, const InkColour& ink, bool isDropped) {
  Recipe after = session.recipe();
  InkChoice& inks = after.preparation.inks;
  std::erase_if(inks.drop, [&](const InkColour& c) { return isSameInk(c, ink, inks.rangeDeg); });
  if (isDropped)
    inks.drop.push_back(ink);
  else if (!inks.keep.empty() && !isTraced(ink, inks))
    inks.keep.push_back(ink);
  session.change(isDropped ? inkText("Drop ink") : inkText("Trace ink"), std::move(after));
}

bool isOnlyInk(const EditorSession& session, const InkColour& ink) {
  const InkChoice& inks = session.recipe().preparation.inks;
  return inks.keep.size() == 1 && isSameInk(inks.keep.front(), ink, inks.rangeDeg) && isTraced(ink, inks);
}

void keepOnlyInk(EditorSession& session, const InkColour& ink) {
  Recipe after = session.recipe();
  InkChoice& inks = after.preparation.inks;
  const bool isUndone = isOnlyInk(session, ink);
  // What was left out before stays out when the others come back.
  std::erase_if(inks.drop, [&](const InkColour& c) { return isSameInk(c, ink, inks.rangeDeg); });
  inks.keep.clear();
  if (!isUndone) inks.keep.push_back(ink);
  session.change(isUndone ? inkText("Trace the other inks, too") : inkText("Trace one ink alone"), std::move(after));
}

}  // namespace batten
