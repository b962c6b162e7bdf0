// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QVariant>
#include <QWidget>

namespace batten {

inline constexpr const char* kSettingName = "settingName";  // property of a widget: how the palette calls it

/// Gives a control that is no row of a parameter the name under which the action finder finds it.
inline void setSettingName(QWidget* control, const QString& name) { control->setProperty(kSettingName, name); }
inline QString settingName(const QWidget& control) { return control.property(kSettingName).toString(); }

}  // namespace batten
