// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/trace_command.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/curve_notes.h"
#include "app/cli/exit_codes.h"
#include "app/cli/note_list.h"
#include "app/cli/recipe_arguments.h"
#include "app/cli/report_output.h"
#include "app/cli/shown_digits.h"
#include "app/cli/stage_dump.h"
#include "app/cli/trace_plan.h"
#include "core/base/conventions.h"
#include "core/base/json_text.h"
#include "core/base/name_text.h"
#include "core/base/number_text.h"
#include "core/base/platform.h"
#include "core/base/platform_memory.h"
#include "core/document/explain/explanation.h"
#include "core/document/export_builder.h"
#include "core/document/report.h"
#include "core/exchange/export_file.h"
#include "core/exchange/save_atomically.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/direction_owners.h"
#include "core/pipeline/run/piece_choices.h"

namespace batten::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kDecimalsOfMs = 1;  // tenths

nlohmann::ordered_json explanationFigures(const Explanation& e) {
  constexpr int kDecimals = 4;  // a hundredth of a per cent
  return {{"explained", withDecimals(e.explained, kDecimals)},
          {"missed", withDecimals(e.missed, kDecimals)},
          {"invented", withDecimals(e.invented, kDecimals)}};
}

nlohmann::ordered_json rectificationFigures(const Rectification& made) {
  auto corners = nlohmann::ordered_json::array();
  for (const Vec2& p : made.cornersPx) corners.push_back({withDecimals(p.x(), 2), withDecimals(p.y(), 2)});
  return {{"corners", std::move(corners)},
          {"width", made.widthPx},
          {"height", made.heightPx},
          {"aspect", withDecimals(made.aspect, 4)},
          {"aspect_error", withDecimals(made.aspectError, 4)},
          {"outside", withDecimals(made.outsideShare, 4)}};
}

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// One trace from the plan to the files. Each step returns an error or nothing; the first error ends the command.
class Trace {
 public:
  Trace(const TraceArguments& arguments, TracePlan plan, const TraceHost& host)
      : arguments_(arguments), plan_(std::move(plan)), isShared_(host.isShared) {
    context_.threads = plan_.threads;
    context_.cancel = host.cancel;
    // Alone in its process, a drawing also takes what the start of the program did.
    if (isShared_ || arguments_.isOneOfAll) processorSecondsBefore_ = processorSeconds();
  }

  Result<void> run() {
    if (auto checked = checkOutputs(); !checked) return checked;
    auto scan = readDrawing();
    if (!scan) return fail(scan.error());
    auto page = rectified(std::move(*scan), plan_.recipe.preparation.rectify, context_);
    if (!page) return fail(page.error());
    scan_ = std::move(*page);
    // The places of the recipe are those of this page: the corners that it was made with belong to them.
    if (scan_.rectification)
      plan_.recipe.preparation.rectify = scan_.rectify = withCorners(scan_.rectify, scan_.rectification->cornersPx);
    readMilliseconds_ = millisecondsSince(begin_);
    if (!arguments_.scan.empty()) {
      const PageFrame frame = frameFor(scan_, plan_.recipe);
      auto imported = withImports(arguments_, &frame, std::move(plan_));
      if (!imported) return fail(imported.error());
      plan_ = std::move(*imported);
    }

    PipelineRequest request;
    const auto isOfEdges = [](const auto& dump) { return dump.stage == "edges"; };
    request.needEdges = !arguments_.report.empty() || std::any_of(plan_.dumps.begin(), plan_.dumps.end(), isOfEdges);
    StageCache nothingKept(0);
    out_ = runPipeline(scan_, plan_.recipe, nothingKept, request, context_);

    // The curves first: nothing else is to delay them.
    if (!out_.error) {
      if (auto written = writeCurves(); !written) return written;
      if (auto explained = explainCurves(); !explained) return explained;
    }
    // Without a curve the pictures and the report are still wanted: they show why.
    if (auto written = writeDumps(); !written) return written;
    if (auto written = writeReport(); !written) return written;
    if (!arguments_.saveRecipe.empty()) {
      Recipe used = plan_.recipe;
      if (out_.numbers) used.curveNumbers = out_.numbers->known;
      if (auto saved = save(arguments_.saveRecipe, recipeToJson(used)); !saved) return saved;
    }
    if (out_.error) return fail(*out_.error);
    return {};
  }

  std::string summary() const {
    nlohmann::ordered_json json{{"scan", nameText(arguments_.scan)}};
    if (!arguments_.imports.empty()) {
      auto& imports = json["imports"] = nlohmann::ordered_json::array();
      for (const std::string& name : arguments_.imports) imports.push_back(nameText(name));
    }
    if (scan_.pages > 1) json["page"] = scan_.page.number;
    json["curves"] = curves_;
    json["pieces"] = pieces_;
    json["corners_without_mark"] = unmarkedCornerCount(*out_.pieces);
    json["doubtful_junctions"] = doubtfulCount(*out_.contours);
    json["milliseconds"] = withDecimals(millisecondsSince(begin_), kDecimalsOfMs);
    json["processor_milliseconds"] =
        withDecimals(1000.0 * (processorSeconds() - processorSecondsBefore_), kDecimalsOfMs);
    if (!isShared_) json["peak_memory_bytes"] = peakMemoryBytes().value_or(0);
    json["files"] = files_;
    json["checks"] = checks_;
    if (scan_.rectification) json["rectified"] = rectificationFigures(*scan_.rectification);
    if (explanation_) json["explanation"] = explanationFigures(*explanation_);
    json["notes"] = notes();
    return jsonLine(json);
  }

 private:
  /// A folder that takes no file is known before all the work.
  Result<void> checkOutputs() const {
    std::vector<std::filesystem::path> names;
    for (const auto& output : plan_.outputs) names.push_back(output.path);
    for (const auto& report : plan_.reports) names.push_back(report.path);
    for (const auto& dump : plan_.dumps) names.push_back(dump.path);
    for (const std::string& name : {arguments_.report, arguments_.saveRecipe}) {
      if (!name.empty()) names.emplace_back(name);
    }
    for (const auto& name : names) {
      if (auto checked = checkSaving(name); !checked) return checked;
    }
    return {};
  }

  /// The scan named; without a name the empty page on which the recipe was drawn.
  Result<Scan> readDrawing() const {
    if (!arguments_.scan.empty()) {
      const QuietStderr quiet;
      return readScan(arguments_.scan, {.page = plan_.recipe.scanPage}, context_);
    }
    const BlankPage& page = *plan_.recipe.page;
    return blankScan(page.widthPx, page.heightPx, plan_.recipe.dpi.value_or(kAssumedDpi));
  }

  Result<void> save(const std::filesystem::path& path, std::string_view bytes) {
    auto saved = saveAtomically(path, bytes);
    if (saved) files_.push_back(nameText(path.string()));
    return saved;
  }

  Result<void> writeDumps() {
    for (const auto& dump : plan_.dumps) {
      auto picture = dumpStage(dump.stage, scan_, plan_.recipe, out_);
      if (!picture && out_.error) continue;  // the run's own error says more, and follows
      if (!picture) return fail(picture.error());
      auto png = encodePng(*picture);
      if (!png) return fail(png.error());
      if (auto saved = save(dump.path, *png); !saved) return saved;
    }
    return {};
  }

  Result<void> explainCurves() {
    if (!arguments_.explain) return {};
    auto explanation = explainPage(scan_, plan_.recipe, out_, context_);
    if (!explanation) return fail(explanation.error());
    explanation_ = std::move(*explanation);
    return {};
  }

  Result<void> writeReport() {
    if (arguments_.report.empty()) return {};
    ReportExtras extras;
    extras.readMilliseconds = readMilliseconds_;
    if (out_.faired && arguments_.reportTargets) extras.targets = targetsForAll(out_.faired->curves, context_);
    extras.series = arguments_.reportSeries;
    extras.explanation = explanation_;
    if (!isShared_) extras.peakMemoryBytes = peakMemoryBytes();
    return save(arguments_.report, reportToJson(scan_, plan_.recipe, out_, extras));
  }

  Result<void> writeCurves() {
    const bool anyWidths = std::any_of(plan_.outputs.begin(), plan_.outputs.end(),
                                       [](const auto& output) { return holdsWidths(output.settings); });
    ExportDocument document = exportDocument(out_, plan_.recipe, scan_, plan_.which,
                                             anyWidths ? ExportedWidths::Measured : ExportedWidths::None);
    if (!plan_.curves.empty()) {
      auto chosen = chosenCurves(document, plan_.curves);
      if (!chosen) return fail(chosen.error());
      document = std::move(*chosen);
    }
    curves_ = document.curves.size();
    for (const ExportCurve& curve : document.curves) pieces_ += curve.pieces.size();
    for (const auto& output : plan_.outputs) {
      const auto report = exportToFile(document, output.settings, output.path, context_);
      if (!report) return fail(report.error());
      files_.push_back(nameText(output.path.string()));
      checks_.push_back(nameText(output.path.filename().string()) + ": " + sentenceOf(*report));
    }
    if (auto written = writeReportPages(plan_.reports, scan_, plan_.recipe, out_, context_); !written) return written;
    for (const auto& report : plan_.reports) files_.push_back(nameText(report.path.string()));
    return {};
  }

  static std::string placeText(const Vec2& px) {
    return std::to_string(std::lround(px.x())) + "," + std::to_string(std::lround(px.y()));
  }

  void addCornerNotes(std::vector<std::string>& list) const {
    const auto& marks = plan_.recipe.cornerMarks;
    const auto placeOf = [&](int mark) { return placeText(marks[mark].positionPx); };
    const auto numbers = [](const MarkPair& pair) {
      return std::to_string(pair.other + 1) + " and " + std::to_string(pair.mark + 1);
    };
    addNotes(
        list, out_.pieces->lostMarks, [&](int mark) { return "No line lies near the corner " + placeOf(mark) + "."; },
        [](const std::string& count) { return "No line lies near " + count + " more corners."; });
    addNotes(
        list, out_.pieces->sameCorner,
        [&](const MarkPair& pair) {
          return "Corners " + numbers(pair) + ", at " + placeOf(pair.other) + " and " + placeOf(pair.mark) +
                 ", snap to the same corner: remove one, or reduce corners.snap if you mean two corners.";
        },
        [](const std::string& count) { return count + " more pairs of corners snap to the same corner."; });
    addNotes(
        list, out_.pieces->closeCorners,
        [&](const MarkPair& pair) {
          return "Corners " + numbers(pair) + " are " + std::to_string(std::lround(pair.apartPx)) +
                 " px apart: remove one of them.";
        },
        [](const std::string& count) { return count + " more pairs of corners are as close together."; });
  }

  void addDirectionNotes(std::vector<std::string>& list) const {
    const Recipe& recipe = plan_.recipe;
    const DirectionOwners owners = assignDirections(*out_.pieces, recipe);
    const auto addLost = [&](const std::vector<std::size_t>& lost, const auto& marks, const std::string& option) {
      addNotes(
          list, lost,
          [&](std::size_t mark) {
            return "No curve near " + placeText(marks[mark].positionPx) + " for " + option + ".";
          },
          [&](const std::string& count) { return "No curve near " + count + " more places of " + option + "."; });
    };
    addLost(owners.lostDirections, recipe.directions, "--direction");
    addLost(owners.lostStarts, recipe.starts, "--start");
    std::vector<std::size_t> onOpenLines;
    for (const auto& [contour, mark] : owners.startOfContour) {
      if (!out_.contours->contours[contour].closed) onOpenLines.push_back(mark);
    }
    addNotes(
        list, onOpenLines,
        [&](std::size_t mark) {
          return "The line at " + placeText(recipe.starts[mark].positionPx) + " is open, so --start has no effect.";
        },
        [](const std::string& count) { return count + " more places of --start are on open lines."; });
  }

  /// Choices that wait for a line at their place.
  void addChoiceNotes(std::vector<std::string>& list) const {
    std::vector<std::string> places;
    for (const std::size_t choice : assignChoices(*out_.pieces, plan_.recipe.choices).waiting) {
      const std::vector<Vec2>& anchors = plan_.recipe.choices[choice].anchorsPx;
      if (!anchors.empty()) places.push_back(placeText(anchors[anchors.size() / 2]));
    }
    addNotes(
        list, places,
        [](const std::string& place) {
          return "No line at the position of the choice at " + place + "; the choice is kept in the recipe.";
        },
        [](const std::string& count) { return "No line at the positions of " + count + " more choices."; });
  }

  /// What the user should know although the trace was made.
  std::vector<std::string> notes() const {
    std::vector<std::string> list = plan_.notes;
    if (isScaleAssumed(scan_, plan_.recipe))
      list.emplace_back("The scan states no resolution; 96 dpi was assumed. Set --dpi.");
    if (const auto note = otherPagesNote(arguments_, plan_.recipe, scan_)) list.push_back(*note);
    list.insert(list.end(), out_.page->notes.begin(), out_.page->notes.end());
    if (!out_.thresholds->note.empty() && !isBlank(scan_)) list.push_back(out_.thresholds->note);
    if (out_.filtered && out_.filtered->report.thinStrokesLost) {
      list.emplace_back("The clean-up removed thin strokes. Set filter.max_change to 8 or reduce filter.iterations.");
    }
    if (!out_.contours->report.note.empty()) list.push_back(out_.contours->report.note);
    if (explanation_ && !explanation_->note.empty()) list.push_back(explanation_->note);
    addCornerNotes(list);
    addDirectionNotes(list);
    addChoiceNotes(list);
    addNotes(
        list, out_.constructed->failures, [](const Error& failure) { return failure.message; },
        [](const std::string& count) { return count + " more lines gave no curve."; });
    for (std::string& note : curveNotes(out_)) list.push_back(std::move(note));
    return list;
  }

  const TraceArguments& arguments_;
  TracePlan plan_;
  bool isShared_ = false;  ///< As of TraceHost.
  double processorSecondsBefore_ = 0.0;
  RunContext context_;
  Clock::time_point begin_ = Clock::now();
  Scan scan_;
  double readMilliseconds_ = 0.0;
  PipelineOutput out_;
  std::optional<Explanation> explanation_;
  std::size_t curves_ = 0, pieces_ = 0;
  std::vector<std::string> files_, checks_;  ///< Names as nameText gives them.
};

}  // namespace

namespace {

/// One of all pages that could not be traced has its line, too: which page, and why.
int reportPage(const TraceArguments& arguments, Error error) {
  const std::string why = error.message;
  error.message = "Page " + arguments.page.value_or("") + ": " + why;
  const int code = reportError(error);
  const nlohmann::ordered_json json{{"scan", nameText(arguments.scan)},
                                    {"page", integerFromText(arguments.page.value_or("")).value_or(0)},
                                    {"curves", 0},
                                    {"pieces", 0},
                                    {"files", nlohmann::ordered_json::array()},
                                    {"exit", code},
                                    {"error", why}};
  std::cout << jsonLine(json) << '\n';
  const int written = endOutput();
  return written == kDone ? code : written;
}

int traceOne(const TraceArguments& arguments, const TraceHost& host) {
  auto plan = planTrace(arguments);
  if (!plan) return reportError(plan.error());
  Trace trace(arguments, std::move(*plan), host);
  if (auto done = trace.run(); !done)
    return arguments.isOneOfAll ? reportPage(arguments, done.error()) : reportError(done.error());
  std::cout << trace.summary() << '\n';
  return endOutput();
}

}  // namespace

int runTrace(const TraceArguments& given, const TraceHost& host) {
  const TraceArguments arguments = withCurvesAsImport(given);
  if (arguments.page != "all") return traceOne(arguments, host);
  if (arguments.scan.empty()) return reportError({ErrorCode::BadParameter, "--page needs a scan: name the file.", {}});
  int code = kDone;
  const int pages = [&] {
    const QuietStderr quiet;
    return countPages(arguments.scan);
  }();
  for (int page = 1; page <= pages; ++page) {
    TraceArguments one = argumentsForPage(arguments, page);
    one.isOneOfAll = true;
    // Words that are wrong are so for all pages.
    if (auto plan = planTrace(one); !plan) return reportError(plan.error());
    if (const int ended = traceOne(one, host); code == kDone) code = ended;
  }
  return code;
}

}  // namespace batten::cli
