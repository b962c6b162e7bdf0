// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "app/cli/batch/batch_command.h"
#include "app/cli/compare_command.h"
#include "app/cli/exit_codes.h"
#include "app/cli/number_option.h"
#include "app/cli/options_command.h"
#include "app/cli/output_arguments.h"
#include "app/cli/parameters_command.h"
#include "app/cli/stage_dump.h"
#include "app/cli/suggest_command.h"
#include "app/cli/trace_command.h"
#include "app/cli/trace_plan.h"
#include "app/cli/usage_error.h"
#include "core/base/platform.h"
#include "core/exchange/import_file.h"
#include "core/exchange/model/export_settings.h"
#include "core/pipeline/recipe/paper_presets.h"

namespace {

using namespace batten;
using namespace batten::cli;

std::string footer() {
  return "Exit codes: " + exitCodeHelp() +
         ".\nAn error is one line on stderr. stdout holds only what programs can read. In its names a byte that is "
         "not valid UTF-8 is \\xHH, and a backslash before such a form is \\x5c.";
}

std::string dumpHelp() {
  std::string text = "Write a stage's output as a picture; may be repeated. Stages:";
  for (const std::string& one : dumpNames()) text += " " + one;
  return text;
}

/// The names of the presets as an option's value is shown: "a|b".
std::string presetWords() {
  std::string words;
  for (const ExportPreset& preset : exportPresets()) words.append(words.empty() ? "" : "|").append(preset.id);
  return words;
}

/// "000|001|002|004|default"
std::string paperWords() {
  std::string words = paperPresetNames();
  for (auto at = words.find(", "); at != std::string::npos; at = words.find(", ")) words.replace(at, 2, "|");
  return words;
}

/// One value per option, so that "-o a.svg scan.png" does not take the scan for an output.
void addRepeated(CLI::App& app, const char* names, std::vector<std::string>& values, const char* what,
                 const std::string& help) {
  app.add_option(names, values, help)->type_name(what)->allow_extra_args(false);
}

/// How a command speaks of its drawing.
struct DrawingHelp {
  std::string scan, recipe, page, pages;
};

constexpr const char* kScanKinds = "PNG, JPEG, TIFF, PDF, JPEG 2000, BMP, WebP, PGM, PBM or PPM";  // words of the help

/// What the drawing is and what is followed on it.
void addDrawing(CLI::App& app, TraceArguments& a, const DrawingHelp& help) {
  app.add_option("scan", a.scan, help.scan)->type_name("SCAN");
  app.add_option("--recipe", a.recipe, help.recipe)->type_name("R.json");
  app.add_option_function<std::string>(
         "--page", [&a](const std::string& text) { a.page = text; }, help.page)
      ->type_name(help.pages);
  app.add_option(
         "--as-in", a.asIn,
         "Use all settings of a paper: " + paperPresetNames() + "; --set overrides it; a note states the drawbacks")
      ->type_name(paperWords());
  addRepeated(app, "--set", a.settings, "NAME=VALUE", "Set a parameter (see batten-cli parameters); may be repeated");
  addRepeated(app, "--outline", a.outlines, "X,Y",
              "Trace the outline of the ink near this point, px from the upper left; may be repeated");
  addRepeated(app, "--pair", a.pairings, "X,Y[,X,Y,X,Y…]",
              "At the junction near the first point, px from the upper left, lead through only the strokes given by "
              "pairs of points on their two branches; may be repeated");
  addRepeated(app, "--centreline", a.centrelines, "X,Y",
              "Trace the centre line of the ink near this point, px from the upper left; may be repeated");
  addRepeated(app, "--roi", a.regions, "X,Y,WIDTH,HEIGHT",
              "Trace only inside this rectangle, px from the upper left; may be repeated");
  app.add_option_function<std::string>(
         "--threads", [&a](const std::string& text) { a.threads = text; },
         "Maximum number of threads, 0 to 1024; 0 = all. Does not affect the result")
      ->type_name("N");
}

// The files that are written, and those that are read besides the scan.
void addFiles(CLI::App& trace, TraceArguments& a) {
  addRepeated(trace, "-o,--output", a.outputs, "OUT",
              "Write the curves; the file extension selects the format (" + allEndings() +
                  "); .report.pdf and .report.html write a printable report; an existing file is replaced; "
                  "may be repeated");
  addRepeated(trace, "--import", a.imports, "FILE",
              "Import lines from a file of curves or points (" + importEndings() + "); may be repeated");
  trace
      .add_option("--import-unit", a.importUnit,
                  "Unit of the imported coordinates, overriding the files: mm, cm, m or in")
      ->type_name("mm|cm|m|in");
}

// How the curves are written.
void addFormatOptions(CLI::App& trace, TraceArguments& a) {
  trace.add_option("--preset", a.preset, "Format options for a receiving program: " + presetNames())
      ->type_name(presetWords());
  trace.add_option("--paper", a.paper, "Paper of a .report.pdf: a4 or letter")->type_name("a4|letter");
  trace.add_option("--unit", a.unit, "Unit of DXF, IGES, STEP, 3DM and CSV: mm or in")->type_name("mm|in");
  trace
      .add_option_function<std::string>(
          "--scale", [&a](const std::string& text) { a.scale = text; },
          "Scale factor of the curves, from 0.000001 to 1000000")
      ->type_name("N");
  trace
      .add_option_function<std::string>(
          "--tolerance", [&a](const std::string& text) { a.tolerance = text; },
          "Maximum deviation of approximated curves from the exact ones, from 0.000001 mm")
      ->type_name("MM");
  trace
      .add_option_function<std::string>(
          "--curves", [&a](const std::string& list) { a.curves = list; },
          "Write only these curves, by their numbers in the report: 1,3-5")
      ->type_name("LIST");
  trace.add_option("--which", a.which, "Which curves to write: faired, sketched or both")
      ->type_name("faired|sketched|both");
  trace.add_flag("--joined", a.joined, "DXF, IGES, STEP, 3DM: join consecutive curves, as the other formats do");
  trace.add_flag("--apart", a.apart,
                 "SVG, PDF, JSON, CSV, DXF for cnc: write every curve separately, as the other formats do");
  trace.add_flag("--splines-only", a.splinesOnly,
                 "DXF, IGES, STEP, 3DM: write lines, arcs and circles as splines of their own degree");
  trace
      .add_option("--flavour", a.flavour,
                  "IGES, STEP, 3DM: exact curves (exact), one Bézier curve per polynomial piece (bezier), or "
                  "degree 3 within the tolerance (cubic)")
      ->type_name("exact|bezier|cubic");
  trace.add_flag("--chords", a.chords, "DXF for cnc: chords only, no arcs");
  trace.add_flag("--width-outline", a.widthOutline,
                 "SVG: write strokes also as filled outlines of their width, in a layer below the curves");
}

// Marks and directions on the drawing, and its size.
void addMarks(CLI::App& trace, TraceArguments& a) {
  addRepeated(trace, "--corner", a.corners, "X,Y[,MM|,rMM][,gN]",
              "Corner near this point, px from the upper left; MM rounds it from that distance on, rMM "
              "to that minimum radius; g1, g2 or g3: continuity of the rounding; may be repeated");
  addRepeated(trace, "--segment-point", a.segmentPoints, "X,Y",
              "Make typical curves meet near this point, px from the upper left; may be repeated");
  trace
      .add_option_function<std::string>(
          "--dpi", [&a](const std::string& text) { a.dpi = text; },
          "Resolution of the scan, 1 to 100000, overriding the file; for a PDF the rendering "
          "resolution, 20 to 4800 (300)")
      ->type_name("N");
  trace
      .add_option_function<std::string>(
          "--known-length", [&a](const std::string& text) { a.knownLength = text; },
          "Resolution from two points, px from the upper left, and their true distance: 100mm, "
          "10cm or 4in")
      ->type_name("X,Y,X,Y,LENGTH");
  addRepeated(trace, "--direction", a.directions, "X,Y,X,Y",
              "Direct the curve near the first point towards the second, px; may be repeated");
  addRepeated(trace, "--start", a.starts, "X,Y", "Start the closed curve near this point there, px; may be repeated");
}

void addReports(CLI::App& trace, TraceArguments& a) {
  trace.add_option("--report", a.report, "Write figures of every stage and curve")->type_name("REPORT.json");
  trace.add_flag("--report-targets", a.reportTargets,
                 "Add the result of each of the six targets for every curve to the report; much slower");
  trace.add_flag("--report-series", a.reportSeries,
                 "Add knots, polynomial coefficients, and radius, curvature and curvature slope along "
                 "every curve to the report");
  trace.add_flag("--explain", a.explain,
                 "Print and report the share of the ink that the curves explain and the share of their "
                 "length without ink; computed after writing");
  addRepeated(trace, "--dump", a.dumps, "STAGE=FILE.png", dumpHelp());
  trace.add_option("--save-recipe", a.saveRecipe, "Write all settings used, for --recipe and the window")
      ->type_name("R.json");
}

void addTrace(CLI::App& app, TraceArguments& a) {
  CLI::App* trace = app.add_subcommand("trace", "Turn a scan into fair curves");
  trace->footer(
      "Prints one line of JSON: the scan, the number of curves, the files written with their "
      "deviation from the curves, and notes.");
  addDrawing(*trace, a,
             {std::string("The scan: ") + kScanKinds +
                  "; or curves or points to fair; omitted for a recipe drawn on an empty page",
              "Use this recipe; --set, --corner and --dpi override it",
              "Page of a TIFF or PDF, 1 to 100000; all: every page, with -p1, -p2 … appended to the output "
              "names",
              "N|all"});
  addFiles(*trace, a);
  addFormatOptions(*trace, a);
  addMarks(*trace, a);
  addReports(*trace, a);
}

CLI::App* addSuggest(CLI::App& app, TraceArguments& a) {
  CLI::App* suggest = app.add_subcommand(
      "suggest", "Suggest a merge distance for overdrawn strokes, list possible corners and doubtful junctions");
  suggest->footer(
      "Prints one line of JSON: a value for edges.merge (0: nothing to merge), how many strokes become how many "
      "lines, whether edges.intent finds lines drawn over more than once and how many curves it makes of them, and "
      "the reason; and every place that may be a corner with its angle in degrees and its certainty from 0 "
      "to "
      "1. Those of 0.95 and more count without a mark (corners.auto). And every junction of strokes that might as well "
      "be paired otherwise: a point on each branch, which of them are one stroke now and which in the next best way, "
      "for --pair. And, of a sheet that was photographed at an angle, its corners, by how many degrees right angles "
      "and parallel sides are off, and its aspect ratio (paper.rectify). Changes nothing.");
  addDrawing(*suggest, a,
             {std::string("The scan: ") + kScanKinds, "Use this recipe; --set and the points given override it",
              "Which page of a TIFF or PDF, 1 to 100000", "N"});
  return suggest;
}

CLI::App* addBatch(CLI::App& app, BatchArguments& a) {
  CLI::App* batch = app.add_subcommand("batch", "Trace many scans; resumes an earlier run");
  batch->footer(
      "Prints one line of JSON per finished page. A page is skipped if its scan, recipe, "
      "settings and the program are unchanged, according to NAME.batch.json next to its first "
      "output NAME. A page without curves is not a failure. Ctrl+C stops after the running "
      "pages; the same command resumes.");
  batch
      ->add_option("inputs", a.inputs,
                   "A manifest (NAME.jsonl, or - for stdin), or scans, folders and patterns of *, ?, [...] and **")
      ->type_name("INPUT")
      ->required();
  batch->add_option("--to", a.to, "Output folder for scans, folders and patterns")->type_name("FOLDER");
  batch->add_option("--formats", a.formats, "Formats to write for each of them (svg,json)")->type_name("LIST");
  batch->add_option("--recipe", a.recipe, "Recipe of the pages that have none of their own")->type_name("R.json");
  addRepeated(*batch, "--set", a.settings, "NAME=VALUE", "Set a parameter of every page; may be repeated");
  addNumber(
      *batch, "--dpi", [&a](double dpi) { a.dpi = dpi; }, {1.0, 1e5, "a number from 1 to 100000"},
      "Resolution of the pages that state none in the manifest, 1 to 100000; of a PDF 20 to 4800")
      ->type_name("N");
  addInteger(
      *batch, "--jobs", [&a](int jobs) { a.jobs = jobs; }, {0, 1024, "a whole number from 0 to 1024"},
      "Pages processed in parallel, 0 to 1024; 0 = one per processor")
      ->type_name("N");
  batch->add_option("--existing", a.existing, "Existing outputs: skip unchanged pages, overwrite all, or abort")
      ->check(CLI::IsMember({"skip", "overwrite", "abort"}).description(""))
      ->type_name("skip|overwrite|abort");
  addInteger(
      *batch, "--first-line", [&a](int line) { a.firstLine = line; },
      {1, 1000000000, "a whole number from 1 to 1000000000"},
      "Line number of the first line of the manifest, if it is part of a larger one, 1 to 1000000000 (1)")
      ->type_name("N");
  batch->add_flag("--resume", a.resume, "Resume an earlier run, regardless of --existing");
  addNumber(
      *batch, "--page-timeout", [&a](double seconds) { a.pageTimeoutSeconds = seconds; },
      {0.001, 1e6, "seconds from 0.001 to 1000000"}, "A page that takes longer fails, 0.001 to 1000000 s")
      ->type_name("S");
  addNumber(
      *batch, "--max-failures", [&a](double share) { a.maxFailures = share; },
      {0.0, 1.0, "a fraction of the pages from 0 to 1"},
      "Stop starting pages once this fraction of all pages has failed, 0 to 1")
      ->type_name("FRACTION");
  batch
      ->add_option("--results", a.results,
                   "Append the lines to this file instead of stdout, one per page; several runs may share "
                   "the file")
      ->type_name("FILE.jsonl");
  batch->add_option("--failures", a.failures, "Write the pages that failed as a manifest")->type_name("FILE.jsonl");
  batch->add_option("--sheet", a.sheet, "Write an HTML overview of all pages")->type_name("FILE.html");
  batch
      ->add_option("--write-manifest", a.writeManifest,
                   "Write the pages as a manifest, - for stdout, and trace nothing")
      ->type_name("FILE.jsonl");
  return batch;
}

int runOrReport(int argc, char** argv, const TraceHost& host);

/// @param program its name as it was called.
int callHere(char* program, const std::vector<std::string>& words, const CancelToken& cancel) {
  std::vector<std::string> kept = words;
  std::vector<char*> pointers{program};
  for (std::string& word : kept) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return runOrReport(static_cast<int>(pointers.size()) - 1, pointers.data(), {cancel, true});
}

int run(int argc, char** argv, const TraceHost& host) {
  CLI::App app("Batten: from a designer's sketch to fair curves", "batten-cli");
  app.set_version_flag("--version", std::string("batten-cli ") + BATTEN_VERSION);
  app.footer(footer());
  app.require_subcommand(1);
  TraceArguments arguments;
  addTrace(app, arguments);
  const CLI::App* suggest = addSuggest(app, arguments);
  BatchArguments many;
  const CLI::App* batch = addBatch(app, many);
  bool asJson = false;
  CLI::App* parameters =
      app.add_subcommand("parameters", "List every parameter: name, unit, range, default, what it does");
  parameters->add_flag("--json", asJson, "As JSON");
  // For packaging: what manual pages and completion are made from. No group: no user needs to see it.
  const CLI::App* options = app.add_subcommand("options", "Commands and options as JSON")->group("");
  std::string first, second;
  CLI::App* compare =
      app.add_subcommand("compare", "Similarity of the curves of two files, independent of size and position");
  compare->footer("Prints one line of JSON: similarity S and Pearson's r of the radii over arc length for every pair.");
  compare->add_option("first", first, "Curves: JSON or SVG written by Batten, DXF, IGES or STEP")
      ->type_name("A")
      ->required();
  compare->add_option("second", second, "Curves to compare them with")->type_name("B")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // --help and --version
      app.exit(e);
      return endOutput();
    }
    return reportError(usageError(app, e, argc, argv));
  }
  if (options->parsed()) return runOptions(app);
  if (compare->parsed()) return runCompare(first, second);
  if (suggest->parsed()) return runSuggest(arguments);
  if (batch->parsed())
    return runBatch(many, argv[0],
                    [&](const auto& words, const auto& cancel) { return callHere(argv[0], words, cancel); });
  return parameters->parsed() ? runParameters(asJson) : runTrace(arguments, host);
}

int runOrReport(int argc, char** argv, const TraceHost& host) {
  try {
    return run(argc, argv, host);
  } catch (const std::bad_alloc&) {
    return reportError(
        {ErrorCode::OutOfMemory, "There is not enough memory. Close other programs or use a smaller scan.", {}});
  } catch (const std::exception& e) {
    return reportError({ErrorCode::Numerical, std::string("Unexpected error: ") + e.what(), {}});
  }
}

}  // namespace

int main(int argc, char** argv) {
  // A file that grows beyond what is allowed is a failed write, with a message, and not the end of the program.
  batten::reportLargeFilesAsErrors();
  return runOrReport(argc, argv, {});
}
