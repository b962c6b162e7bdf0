// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/trace_plan.h"

#include <utility>

#include "app/cli/exit_codes.h"
#include "app/cli/file_names.h"
#include "app/cli/output_arguments.h"
#include "app/cli/recipe_arguments.h"
#include "app/cli/wrong_words.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/shown_text.h"
#include "core/document/import_curves.h"
#include "core/exchange/import_file.h"
#include "core/exchange/point_file.h"
#include "core/pipeline/recipe/paper_presets.h"

namespace batten::cli {
namespace {

/// Of the empty page of a recipe.
PageFrame frameOfPage(const Recipe& recipe) {
  const BlankPage& page = *recipe.page;
  return {page.widthPx, page.heightPx, kMillimetresPerInch / recipe.dpi.value_or(kAssumedDpi), page.leftMm,
          page.bottomMm};
}

}  // namespace

TraceArguments withCurvesAsImport(TraceArguments arguments) {
  if (arguments.scan.empty() || !isImportName(arguments.scan)) return arguments;
  arguments.imports.insert(arguments.imports.begin(), std::exchange(arguments.scan, {}));
  return arguments;
}

TraceArguments argumentsForPage(TraceArguments arguments, int page) {
  arguments.page = std::to_string(page);
  for (std::string& output : arguments.outputs) output = withPage(output, page);
  arguments.report = withPage(arguments.report, page);
  arguments.saveRecipe = withPage(arguments.saveRecipe, page);
  for (std::string& dump : arguments.dumps) {
    const auto equals = dump.find('=');
    if (equals != std::string::npos) dump = dump.substr(0, equals + 1) + withPage(dump.substr(equals + 1), page);
  }
  return arguments;
}

Result<void> checkScanName(const TraceArguments& arguments) {
  const std::filesystem::path name(arguments.scan);
  const std::string ending = endingOf(name);
  for (const char* unread : {".3dm", ".dwg", ".ai", ".eps"}) {
    if (ending != unread) continue;
    return fail(ErrorCode::UnreadableScan, "Curves are not read from " + shownName(name.filename()) +
                                               ". Save them as one of " + importEndings() + " and open that file.");
  }
  return {};
}

Result<int> threadsOf(const TraceArguments& arguments) {
  constexpr int kMostThreads = 1024;  // limit of input
  if (!arguments.threads) return 0;
  const auto threads = integerFromText(*arguments.threads);
  if (threads && *threads >= 0 && *threads <= kMostThreads) return *threads;
  return wrong("--threads takes a whole number from 0 to 1024, not " + quotedText(*arguments.threads) + ".");
}

Result<TracePlan> withImports(const TraceArguments& arguments, const PageFrame* frame, TracePlan plan) {
  std::optional<double> unit;
  if (!arguments.importUnit.empty()) {
    unit = millimetresOfUnit(arguments.importUnit);
    if (!unit) return wrong("--import-unit takes mm, cm, m or in, not " + quotedText(arguments.importUnit) + ".");
    if (arguments.imports.empty()) return wrong("--import-unit needs a file: add --import FILE.");
  }
  for (const std::string& name : arguments.imports) {
    auto read = readImportFile(name, unit);
    if (!read) return fail(ofInput(read.error()));
    plan.notes.insert(plan.notes.end(), read->notes.begin(), read->notes.end());
    if (frame == nullptr && !plan.recipe.page) {
      Recipe drawing = drawingOf(std::move(read->file), read->parts);
      plan.recipe.page = drawing.page;
      plan.recipe.imports.push_back(std::move(drawing.imports.front()));
      if (plan.recipe.curveNumbers.lastGiven == 0) plan.recipe.curveNumbers = std::move(drawing.curveNumbers);
      if (!plan.recipe.dpi) plan.recipe.dpi = drawing.dpi;
      continue;
    }
    const PageFrame page = frame != nullptr ? *frame : frameOfPage(plan.recipe);
    auto added = withImport(std::move(plan.recipe), std::move(read->file), page);
    plan.recipe = std::move(added.recipe);
    if (added.moved && frame != nullptr)
      plan.notes.push_back("The lines of " + name + " were outside the page and have been centred on it.");
  }
  if (auto problem = validate(plan.recipe)) return fail(std::move(*problem));
  return plan;
}

Result<TracePlan> planTrace(const TraceArguments& arguments) {
  TracePlan plan;
  const auto threads = threadsOf(arguments);
  if (!threads) return fail(threads.error());
  plan.threads = *threads;
  if (arguments.reportTargets && arguments.report.empty())
    return wrong("--report-targets needs a report to write to: add --report REPORT.json.");
  if (arguments.reportSeries && arguments.report.empty())
    return wrong("--report-series needs a report to write to: add --report REPORT.json.");
  auto outputs = planOutputs(arguments);
  if (!outputs) return fail(outputs.error());
  static_cast<OutputPlan&>(plan) = std::move(*outputs);
  if (auto checked = checkScanName(arguments); !checked) return fail(checked.error());
  auto recipe = recipeOf(arguments);
  if (!recipe) return fail(recipe.error());
  plan.recipe = std::move(*recipe);
  if (const PaperPreset* paper = findPaperPreset(arguments.asIn); paper != nullptr && !paper->cost.empty())
    plan.notes.push_back("As in paper " + paper->id + ", " + paper->title + ": " + paper->cost);
  // Beside a scan they wait for its page.
  if (arguments.scan.empty()) return withImports(arguments, nullptr, std::move(plan));
  return plan;
}

}  // namespace batten::cli
