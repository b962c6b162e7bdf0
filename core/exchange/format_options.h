// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/exchange/model/export_settings.h"

namespace batten {

/// What a user may say of the way curves are written. Scale is missing: it acts on every format.
enum class FormatOption { Unit, Tolerance, Joined, Apart, SplinesOnly, Flavour, Chords, WidthOutlines };

/// Whether an option can make a difference to a file of these settings: the tolerance only where something is
/// approximated, "joined" where pieces are written apart by default, and so on. The command line refuses an option that
/// acts on none of the outputs, the window shows no control for it.
bool actsOn(FormatOption, const ExportSettings&);

/// Where the option acts, for messages: ".dxf, .igs and .step".
const char* whereItActs(FormatOption);

/// The formats that the receiver of a preset reads, the one that is proposed first.
std::vector<ExportFormat> formatsOf(const ExportPreset&);

/// The settings of a preset for one of its formats.
ExportSettings settingsFor(const ExportPreset&, ExportFormat);

}  // namespace batten
