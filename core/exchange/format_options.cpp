// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/format_options.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace batten {
namespace {

bool isCnc(const ExportSettings& s) { return s.format == ExportFormat::Dxf && s.dxf == DxfProfile::Cnc; }

bool isCadFormat(const ExportSettings& s) {
  return s.format == ExportFormat::Dxf || s.format == ExportFormat::Iges || s.format == ExportFormat::Step ||
         s.format == ExportFormat::Rhino;
}

bool hasUnit(const ExportSettings& s) {
  return s.format != ExportFormat::Svg && s.format != ExportFormat::Pdf && s.format != ExportFormat::Json;
}

/// One row for each option: where it acts, in words and as a rule.
struct OptionRow {
  FormatOption option;
  const char* where;
  bool (*acts)(const ExportSettings&);
};

// every option and what it has an effect on
constexpr std::array kOptionRows = {
    OptionRow{FormatOption::Unit, ".dxf, .igs, .step, .3dm, .csv and .poly.csv", hasUnit},
    OptionRow{FormatOption::Tolerance,
              ".svg, .pdf, .dxf with --preset laser or cnc, and .igs, .step and .3dm with --flavour cubic",
              isApproximate},
    OptionRow{FormatOption::Joined, ".dxf, .igs, .step and .3dm", isCadFormat},
    OptionRow{FormatOption::Apart, ".svg, .pdf, .json, .csv, .poly.csv, and .dxf with --preset cnc",
              [](const ExportSettings& s) { return !isCadFormat(s) || isCnc(s); }},
    OptionRow{FormatOption::SplinesOnly, ".dxf (not with --preset cnc), .igs, .step and .3dm",
              [](const ExportSettings& s) { return isCadFormat(s) && !isCnc(s); }},
    OptionRow{FormatOption::Flavour, ".igs, .step and .3dm",
              [](const ExportSettings& s) { return isCadFormat(s) && s.format != ExportFormat::Dxf; }},
    OptionRow{FormatOption::Chords, ".dxf with --preset cnc", isCnc},
    OptionRow{FormatOption::WidthOutlines, ".svg",
              [](const ExportSettings& s) { return s.format == ExportFormat::Svg; }}};

const OptionRow& rowOf(FormatOption option) {
  return *std::find_if(kOptionRows.begin(), kOptionRows.end(),
                       [&](const OptionRow& row) { return row.option == option; });
}

using Formats = std::vector<ExportFormat>;

/// Receivers that read more than the format of their preset.
struct ReceiverRow {
  std::string_view preset;
  Formats others;
};

const std::vector<ReceiverRow>& receivers() {
  static const std::vector<ReceiverRow> rows = {{"alias", {ExportFormat::Step, ExportFormat::Dxf}},
                                                {"rhino", {ExportFormat::Iges, ExportFormat::Rhino, ExportFormat::Dxf}},
                                                {"fusion", {ExportFormat::Step, ExportFormat::Iges}},
                                                {"catia", {ExportFormat::Iges}},
                                                {"icem", {ExportFormat::Step}},
                                                {"cubic", {ExportFormat::Step, ExportFormat::Rhino}},
                                                {"illustrator", {ExportFormat::Pdf}},
                                                {"inkscape", {ExportFormat::Pdf}},
                                                {"laser", {ExportFormat::Svg, ExportFormat::Pdf}},
                                                {"matlab", {ExportFormat::Csv}}};
  return rows;
}

}  // namespace

bool actsOn(FormatOption option, const ExportSettings& settings) { return rowOf(option).acts(settings); }

const char* whereItActs(FormatOption option) { return rowOf(option).where; }

std::vector<ExportFormat> formatsOf(const ExportPreset& preset) {
  Formats formats{preset.settings.format};
  const auto row = std::find_if(receivers().begin(), receivers().end(),
                                [&](const ReceiverRow& one) { return one.preset == preset.id; });
  if (row != receivers().end()) formats.insert(formats.end(), row->others.begin(), row->others.end());
  return formats;
}

ExportSettings settingsFor(const ExportPreset& preset, ExportFormat format) {
  ExportSettings settings = preset.settings;
  settings.format = format;
  return settings;
}

}  // namespace batten
