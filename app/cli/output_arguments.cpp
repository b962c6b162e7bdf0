// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/output_arguments.h"

#include <algorithm>
#include <utility>

#include "app/cli/file_names.h"
#include "app/cli/stage_dump.h"
#include "app/cli/wrong_words.h"
#include "core/base/number_text.h"
#include "core/base/shown_text.h"
#include "core/exchange/format_options.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

bool isFor(const ExportPreset& preset, ExportFormat format) {
  const auto formats = formatsOf(preset);
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// ".dxf, .svg or .pdf"
std::string endingsFor(const ExportPreset& preset) {
  std::vector<std::string> endings;
  for (const ExportFormat format : formatsOf(preset))
    for (const char* ending : endingsOf(format)) endings.emplace_back(ending);
  std::string text;
  for (std::size_t i = 0; i < endings.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < endings.size() ? ", " : " or ").append(endings[i]);
  return text;
}

/// The settings of an output: those of the preset if it is for this format, then what is said beside it.
Result<OutputPlan::Output> outputOf(const std::string& path, const TraceArguments& arguments) {
  const auto format = formatOf(path);
  if (!format) {
    return wrong("The output " + path + " must end in one of " + allEndings() + ", .report.pdf, .report.html.");
  }
  ExportSettings settings;
  if (!arguments.preset.empty()) {
    const ExportPreset* preset = findPreset(arguments.preset);
    if (preset == nullptr)
      return wrong("There is no preset " + quotedText(arguments.preset) + ". Presets: " + presetNames() + ".");
    if (isFor(*preset, *format)) settings = settingsFor(*preset, *format);
  }
  settings.format = *format;
  if (arguments.unit == "in") settings.unit = LengthUnit::Inch;
  if (arguments.scale) {
    const auto scale = numberFromText(*arguments.scale);
    if (!scale)
      return wrong("--scale takes a number from 0.000001 to 1000000, such as 0.5 or 2, not " +
                   quotedText(*arguments.scale) + ".");
    settings.scale = *scale;
  }
  if (arguments.tolerance) {
    settings.toleranceMm = numberFromText(*arguments.tolerance);
    if (!settings.toleranceMm)
      return wrong("--tolerance takes a length in mm, such as 0.005, not " + quotedText(*arguments.tolerance) + ".");
  }
  if (arguments.joined) settings.joined = true;
  if (arguments.apart) settings.joined = false;
  settings.splinesOnly = settings.splinesOnly || arguments.splinesOnly;
  if (arguments.flavour == "exact") settings.flavour = CurveFlavour::Exact;
  if (arguments.flavour == "bezier") settings.flavour = CurveFlavour::BezierSegments;
  if (arguments.flavour == "cubic") settings.flavour = CurveFlavour::Cubic;
  if (arguments.chords) settings.arcs = false;
  settings.widthOutlines = arguments.widthOutline;
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  return OutputPlan::Output{path, settings};
}

/// A preset that none of the outputs is for is a mistake, as is an unknown word.
Result<OutputPlan> planExport(const TraceArguments& arguments) {
  OutputPlan plan;
  if (!arguments.unit.empty() && arguments.unit != "mm" && arguments.unit != "in")
    return wrong("--unit takes mm or in, not " + quotedText(arguments.unit) + ".");
  if (arguments.which == "sketched") plan.which = ExportedCurves::Sketched;
  if (arguments.which == "both") plan.which = ExportedCurves::Both;
  if (!arguments.which.empty() && arguments.which != "faired" && plan.which == ExportedCurves::Faired)
    return wrong("--which takes faired, sketched or both, not " + quotedText(arguments.which) + ".");
  const std::string& flavour = arguments.flavour;
  if (!flavour.empty() && flavour != "exact" && flavour != "bezier" && flavour != "cubic")
    return wrong("--flavour takes exact, bezier or cubic, not " + quotedText(flavour) + ".");
  if (arguments.joined && arguments.apart) return wrong("--joined and --apart exclude each other. Give one of them.");
  if (arguments.curves && arguments.curves->empty())
    return wrong("--curves is empty. Give numbers such as 1,3-5, or omit it to write all.");
  plan.curves = arguments.curves.value_or("");
  if (!arguments.paper.empty() && arguments.paper != "a4" && arguments.paper != "letter")
    return wrong("--paper takes a4 or letter, not " + quotedText(arguments.paper) + ".");
  for (const std::string& path : arguments.outputs) {
    if (const auto report = reportFormatOf(path)) {
      plan.reports.push_back({path, *report, arguments.paper == "letter" ? ReportPaper::Letter : ReportPaper::A4});
      continue;
    }
    auto output = outputOf(path, arguments);
    if (!output) return fail(output.error());
    plan.outputs.push_back(std::move(*output));
  }
  const ExportPreset* preset = findPreset(arguments.preset);
  const auto isForIt = [&](const auto& output) { return isFor(*preset, output.settings.format); };
  if (preset != nullptr && std::none_of(plan.outputs.begin(), plan.outputs.end(), isForIt)) {
    return wrong("The preset " + arguments.preset + " is for files that end in " + endingsFor(*preset) +
                 ", and no output does. Other presets: batten-cli trace --help.");
  }
  return plan;
}

/// An option that changes none of the outputs is a mistake of the user's, who would not see that it was passed over.
Result<void> checkOptions(const TraceArguments& arguments, const OutputPlan& plan) {
  struct Given {
    const char* word;
    bool isGiven;
    FormatOption option;
  };
  std::string names;
  const auto add = [&](const fs::path& path) { names.append(names.empty() ? "" : ", ").append(path.string()); };
  for (const auto& output : plan.outputs) add(output.path);
  for (const auto& report : plan.reports) add(report.path);
  if (names.empty()) names = "what is written here";
  for (const auto& [word, isGiven, option] :
       {Given{"--unit", !arguments.unit.empty(), FormatOption::Unit},
        {"--tolerance", arguments.tolerance.has_value(), FormatOption::Tolerance},
        {"--joined", arguments.joined, FormatOption::Joined},
        {"--apart", arguments.apart, FormatOption::Apart},
        {"--splines-only", arguments.splinesOnly, FormatOption::SplinesOnly},
        {"--flavour", !arguments.flavour.empty(), FormatOption::Flavour},
        {"--chords", arguments.chords, FormatOption::Chords},
        {"--width-outline", arguments.widthOutline, FormatOption::WidthOutlines}}) {
    const auto acts = [&](const auto& output) { return actsOn(option, output.settings); };
    if (isGiven && std::none_of(plan.outputs.begin(), plan.outputs.end(), acts)) {
      return wrong(std::string(word) + " has no effect on " + names + ". It acts on " + whereItActs(option) + ".");
    }
  }
  for (const auto& [word, isGiven] : {std::pair{"--scale", arguments.scale.has_value()},
                                      {"--curves", arguments.curves.has_value()},
                                      {"--which", !arguments.which.empty()},
                                      {"--preset", !arguments.preset.empty()}}) {
    if (isGiven && plan.outputs.empty())
      return wrong(std::string(word) + " acts on files of curves, and none is written. Add -o OUT.svg or another.");
  }
  const auto isPdf = [](const auto& report) { return report.format == ReportFormat::Pdf; };
  if (!arguments.paper.empty() && std::none_of(plan.reports.begin(), plan.reports.end(), isPdf))
    return wrong("--paper has no effect on " + names + ". It acts on .report.pdf.");
  return {};
}

Result<OutputPlan::Dump> dumpOf(const std::string& dump) {
  const auto equals = dump.find('=');
  const std::string stage = dump.substr(0, equals);
  const std::vector<std::string> names = dumpNames();
  std::string known;
  for (const std::string& one : names) known.append(known.empty() ? "" : ", ").append(one);
  if (equals == std::string::npos || std::find(names.begin(), names.end(), stage) == names.end()) {
    return wrong("--dump takes STAGE=FILE.png, not " + quotedText(dump) + ". Stages: " + known + ".");
  }
  const std::string path = dump.substr(equals + 1);
  if (endingOf(path) != ".png") return wrong("The dump " + path + " must end in .png.");
  return OutputPlan::Dump{stage, path};
}

/// No file is written over what is read, nor twice. Only the recipe may be saved where it was.
Result<void> checkTargets(const TraceArguments& arguments, const OutputPlan& plan) {
  std::vector<fs::path> targets;
  for (const auto& output : plan.outputs) targets.push_back(output.path);
  for (const auto& report : plan.reports) targets.push_back(report.path);
  for (const auto& dump : plan.dumps) targets.push_back(dump.path);
  if (!arguments.report.empty()) targets.emplace_back(arguments.report);
  const std::size_t withoutRecipe = targets.size();
  if (!arguments.saveRecipe.empty()) targets.emplace_back(arguments.saveRecipe);
  if (targets.empty()) return wrong("No output is named. Add -o OUT.svg, -o OUT.dxf or another.");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const std::string name = targets[i].string();
    if (!arguments.scan.empty() && isSameFile(targets[i], arguments.scan)) {
      return wrong("The file " + name + " is the scan itself. Give the output another name.");
    }
    if (i < withoutRecipe && !arguments.recipe.empty() && isSameFile(targets[i], arguments.recipe)) {
      return wrong("The file " + name + " is the recipe itself. Give the output another name.");
    }
    for (const std::string& import : arguments.imports) {
      if (isSameFile(targets[i], import))
        return wrong("The file " + name + " is an imported file. Give the output another name.");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (isSameFile(targets[i], targets[k])) {
        return wrong("The file " + name + " is named twice. Give every output its own name.");
      }
    }
  }
  return {};
}

}  // namespace

Result<OutputPlan> planOutputs(const TraceArguments& arguments) {
  auto plan = planExport(arguments);
  if (!plan) return plan;
  for (const std::string& dump : arguments.dumps) {
    auto parsed = dumpOf(dump);
    if (!parsed) return fail(parsed.error());
    plan->dumps.push_back(std::move(*parsed));
  }
  if (auto checked = checkTargets(arguments, *plan); !checked) return fail(checked.error());
  if (auto checked = checkOptions(arguments, *plan); !checked) return fail(checked.error());
  return plan;
}

std::string presetNames() {
  std::string names;
  for (const ExportPreset& preset : exportPresets()) names.append(names.empty() ? "" : ", ").append(preset.id);
  return names;
}

}  // namespace batten::cli
