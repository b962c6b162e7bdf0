// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/trace_plan.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/cli/exit_codes.h"
#include "app/cli/file_names.h"
#include "app/cli/stage_dump.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/document/import_curves.h"
#include "core/exchange/format_options.h"
#include "core/exchange/import_file.h"
#include "core/exchange/point_file.h"
#include "core/exchange/save_atomically.h"
#include "core/image/pdf_scan.h"
#include "core/pipeline/recipe/paper_presets.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> wrong(std::string message) { return fail(ErrorCode::BadParameter, std::move(message)); }

std::string extensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

/// Whether the file begins as a PDF does: of those --dpi is how finely they are drawn.
bool isPdfFile(const std::string& path) {
  const auto file = RegularFile::open(path);
  return file && isPdf(*file);
}

/// --dpi and --page.
Result<void> applyPage(const TraceArguments& arguments, Recipe& recipe) {
  if (arguments.dpi) {
    const auto dpi = numberFromText(*arguments.dpi);
    if (!dpi) return wrong("--dpi takes a number from 1 to 100000, not \"" + *arguments.dpi + "\".");
    if (!arguments.scan.empty() && isPdfFile(arguments.scan)) {
      recipe.scanPage.pdfDpi = *dpi;
    } else {
      setResolution(recipe, dpi);
    }
  }
  if (arguments.page.empty()) return {};
  const auto page = integerFromText(arguments.page);
  if (!page || *page < 1)
    return wrong("--page takes the number of a page, from 1, or all, not \"" + arguments.page + "\".");
  if (arguments.scan.empty()) return wrong("--page needs a scan: name the file.");
  recipe.scanPage.number = *page;
  return {};
}

Result<Recipe> readRecipe(const std::string& path) {
  if (path.empty()) return Recipe{};
  const auto text = readWhole(path, kLargestRecipeBytes);
  if (!text) return wrong("The recipe " + path + " cannot be read: it " + describe(text.error()) + ". Check its name.");
  return recipeFromJson(*text);
}

Result<void> applySetting(const std::string& setting, Recipe& recipe) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos) return wrong("--set takes stage.parameter=value, not \"" + setting + "\".");
  return setParameter(recipe, trimmed(std::string_view(setting).substr(0, equals)),
                      std::string_view(setting).substr(equals + 1));
}

/// Numbers between commas, or nothing.
std::optional<std::vector<double>> numbersOf(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const auto comma = text.find(',');
    const auto value = numberFromText(text.substr(0, comma));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

/// X,Y[,MM|,rMM][,g1|,g2|,g3]
std::optional<CornerMark> cornerMarkOf(std::string text) {
  CornerMark mark;
  for (const auto& [ending, joint] : {std::pair{",g1", RoundingJoint::Tangent},
                                      {",g2", RoundingJoint::Curvature},
                                      {",g3", RoundingJoint::CurvatureSlope}}) {
    if (!text.ends_with(ending)) continue;
    mark.joint = joint;
    text.resize(text.size() - 3);
    break;
  }
  if (const auto radius = text.rfind(",r"); radius != std::string::npos) {
    mark.roundBy = RoundingSize::Radius;
    text.erase(radius + 1, 1);
  }
  const auto values = numbersOf(text);
  if (!values || values->size() < 2 || values->size() > 3) return std::nullopt;
  if (mark.roundBy == RoundingSize::Radius && values->size() < 3) return std::nullopt;
  mark.positionPx = Vec2((*values)[0], (*values)[1]);
  if (values->size() == 3) mark.roundMm = (*values)[2];
  return mark;
}

Result<void> applyCorner(const std::string& corner, Recipe& recipe) {
  const auto mark = cornerMarkOf(corner);
  if (!mark) {
    return wrong(
        "--corner takes X,Y in px from the upper left corner, or X,Y,MM to round it from this distance on, or "
        "X,Y,rMM to round it by this radius, each with ,g1 ,g2 or ,g3 behind it, not \"" +
        corner + "\".");
  }
  recipe.cornerMarks.push_back(*mark);
  return {};
}

/// X,Y of an option, in px.
Result<Vec2> placeOf(const char* option, const std::string& text) {
  const auto values = numbersOf(text);
  if (!values || values->size() != 2) {
    return wrong(std::string(option) + " takes X,Y in px from the upper left corner, not \"" + text + "\".");
  }
  return Vec2((*values)[0], (*values)[1]);
}

Result<void> applySegmentPoint(const std::string& point, Recipe& recipe) {
  const auto place = placeOf("--segment-point", point);
  if (!place) return fail(place.error());
  recipe.segmentPoints.push_back({*place});
  return {};
}

/// "100mm", "10 cm", "4in" as millimetres; nothing without a unit, since nobody could say which was meant.
std::optional<double> lengthOf(std::string_view text) {
  constexpr double kMillimetresPerCentimetre = 10.0;
  std::optional<double> unit;
  for (const auto& [word, mm] :
       {std::pair{"mm", 1.0}, {"cm", kMillimetresPerCentimetre}, {"in", kMillimetresPerInch}}) {
    if (!text.ends_with(word)) continue;
    text.remove_suffix(2);
    unit = mm;
    break;
  }
  const auto value = numberFromText(text);
  return value && unit ? std::optional(*value * *unit) : std::nullopt;
}

Result<void> applyKnownLength(const std::string& line, Recipe& recipe) {
  const auto comma = line.rfind(',');
  const auto places = numbersOf(std::string_view(line).substr(0, comma));
  const auto length = comma == std::string::npos ? std::nullopt : lengthOf(std::string_view(line).substr(comma + 1));
  const bool isWhole = places && places->size() == 4 && length;
  const ScaleLine scale =
      isWhole ? ScaleLine{Vec2((*places)[0], (*places)[1]), Vec2((*places)[2], (*places)[3]), *length} : ScaleLine{};
  if (!isWhole || !resolutionOf(scale)) {
    return wrong(
        "--known-length takes X,Y,X,Y,LENGTH: two places in px from the upper left corner and their distance "
        "with its unit, as 100mm, 10cm or 4in, not \"" +
        line + "\".");
  }
  setScaleLine(recipe, scale);
  return {};
}

Result<void> applyDirection(const std::string& direction, Recipe& recipe) {
  const auto values = numbersOf(direction);
  if (!values || values->size() != 4) {
    return wrong(
        "--direction takes X,Y,X,Y in px from the upper left corner, a point on a curve and one "
        "that the curve should run towards, not \"" +
        direction + "\".");
  }
  recipe.directions.push_back({Vec2((*values)[0], (*values)[1]), Vec2((*values)[2], (*values)[3])});
  return {};
}

Result<void> applyStart(const std::string& start, Recipe& recipe) {
  const auto place = placeOf("--start", start);
  if (!place) return fail(place.error());
  recipe.starts.push_back({*place});
  return {};
}

Result<void> applyWay(const std::string& region, EdgeMode mode, Recipe& recipe) {
  const auto place = placeOf(mode == EdgeMode::Outline ? "--outline" : "--centreline", region);
  if (!place) return fail(place.error());
  recipe.edges.choices.push_back({*place, mode});
  return {};
}

Result<void> applyRegion(const std::string& region, Recipe& recipe) {
  const auto numbers = numbersOf(region);
  if (!numbers || numbers->size() != 4 || !((*numbers)[2] > 0.0) || !((*numbers)[3] > 0.0)) {
    return wrong("--roi takes X,Y,WIDTH,HEIGHT in px from the upper left corner, not \"" + region + "\".");
  }
  const Vec2 corner((*numbers)[0], (*numbers)[1]);
  recipe.regions.push_back(rectangleRegion(corner, corner + Vec2((*numbers)[2], (*numbers)[3])));
  return {};
}

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
Result<TracePlan::Output> outputOf(const std::string& path, const TraceArguments& arguments) {
  const auto format = formatOf(path);
  if (!format) {
    return wrong("The output " + path + " must end in one of " + allEndings() + ", .report.pdf, .report.html.");
  }
  ExportSettings settings;
  if (!arguments.preset.empty()) {
    const ExportPreset* preset = findPreset(arguments.preset);
    if (preset == nullptr)
      return wrong("There is no preset \"" + arguments.preset + "\". Presets: " + presetNames() + ".");
    if (isFor(*preset, *format)) settings = settingsFor(*preset, *format);
  }
  settings.format = *format;
  if (arguments.unit == "in") settings.unit = LengthUnit::Inch;
  if (arguments.scale) {
    const auto scale = numberFromText(*arguments.scale);
    if (!scale) return wrong("--scale takes a number above 0, such as 0.5 or 2, not \"" + *arguments.scale + "\".");
    settings.scale = *scale;
  }
  if (arguments.tolerance) {
    settings.toleranceMm = numberFromText(*arguments.tolerance);
    if (!settings.toleranceMm)
      return wrong("--tolerance takes a length in mm, such as 0.005, not \"" + *arguments.tolerance + "\".");
  }
  if (arguments.joined) settings.joined = true;
  if (arguments.apart) settings.joined = false;
  settings.splinesOnly = settings.splinesOnly || arguments.splinesOnly;
  if (arguments.flavour == "exact") settings.flavour = CurveFlavour::Exact;
  if (arguments.flavour == "bezier") settings.flavour = CurveFlavour::BezierSegments;
  if (arguments.flavour == "cubic") settings.flavour = CurveFlavour::Cubic;
  if (arguments.chords) settings.arcs = false;
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  return TracePlan::Output{path, settings};
}

/// A preset that none of the outputs is for is a mistake, as is an unknown word.
Result<void> planExport(const TraceArguments& arguments, TracePlan& plan) {
  if (!arguments.unit.empty() && arguments.unit != "mm" && arguments.unit != "in")
    return wrong("--unit takes mm or in, not \"" + arguments.unit + "\".");
  if (arguments.which == "sketched") plan.which = ExportedCurves::Sketched;
  if (arguments.which == "both") plan.which = ExportedCurves::Both;
  if (!arguments.which.empty() && arguments.which != "faired" && plan.which == ExportedCurves::Faired)
    return wrong("--which takes faired, sketched or both, not \"" + arguments.which + "\".");
  const std::string& flavour = arguments.flavour;
  if (!flavour.empty() && flavour != "exact" && flavour != "bezier" && flavour != "cubic")
    return wrong("--flavour takes exact, bezier or cubic, not \"" + flavour + "\".");
  if (arguments.joined && arguments.apart) return wrong("--joined and --apart exclude each other. Give one of them.");
  if (arguments.curves && arguments.curves->empty())
    return wrong("--curves is empty. Give numbers such as 1,3-5, or omit it to write all.");
  plan.curves = arguments.curves.value_or("");
  if (!arguments.paper.empty() && arguments.paper != "a4" && arguments.paper != "letter")
    return wrong("--paper takes a4 or letter, not \"" + arguments.paper + "\".");
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
  return {};
}

/// An option that changes none of the outputs is a mistake of the user's, who would not see that it was passed over.
Result<void> checkOptions(const TraceArguments& arguments, const TracePlan& plan) {
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
  for (const auto& [word, isGiven, option] : {Given{"--unit", !arguments.unit.empty(), FormatOption::Unit},
                                              {"--tolerance", arguments.tolerance.has_value(), FormatOption::Tolerance},
                                              {"--joined", arguments.joined, FormatOption::Joined},
                                              {"--apart", arguments.apart, FormatOption::Apart},
                                              {"--splines-only", arguments.splinesOnly, FormatOption::SplinesOnly},
                                              {"--flavour", !arguments.flavour.empty(), FormatOption::Flavour},
                                              {"--chords", arguments.chords, FormatOption::Chords}}) {
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

Result<TracePlan::Dump> dumpOf(const std::string& dump) {
  const auto equals = dump.find('=');
  const std::string stage = dump.substr(0, equals);
  const std::vector<std::string> names = dumpNames();
  std::string known;
  for (const std::string& one : names) known.append(known.empty() ? "" : ", ").append(one);
  if (equals == std::string::npos || std::find(names.begin(), names.end(), stage) == names.end()) {
    return wrong("--dump takes STAGE=FILE.png, not \"" + dump + "\". Stages: " + known + ".");
  }
  const std::string path = dump.substr(equals + 1);
  if (extensionOf(path) != ".png") return wrong("The dump " + path + " must end in .png.");
  return TracePlan::Dump{stage, path};
}

/// No file is written over what is read, nor twice. Only the recipe may be saved where it was.
Result<void> checkTargets(const TraceArguments& arguments, const TracePlan& plan) {
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

Result<Recipe> recipeOf(const TraceArguments& arguments) {
  auto recipe = readRecipe(arguments.recipe);
  if (!recipe) return recipe;
  if (!arguments.asIn.empty()) {
    const PaperPreset* paper = findPaperPreset(arguments.asIn);
    if (paper == nullptr)
      return wrong("There is no paper \"" + arguments.asIn + "\". --as-in takes " + paperPresetNames() + ".");
    if (auto set = applyPaperPreset(*paper, *recipe); !set) return fail(set.error());
  }
  for (const std::string& setting : arguments.settings) {
    if (auto set = applySetting(setting, *recipe); !set) return fail(set.error());
  }
  for (const std::string& corner : arguments.corners) {
    if (auto set = applyCorner(corner, *recipe); !set) return fail(set.error());
  }
  for (const std::string& point : arguments.segmentPoints) {
    if (auto set = applySegmentPoint(point, *recipe); !set) return fail(set.error());
  }
  for (const std::string& place : arguments.outlines) {
    if (auto set = applyWay(place, EdgeMode::Outline, *recipe); !set) return fail(set.error());
  }
  for (const std::string& place : arguments.centrelines) {
    if (auto set = applyWay(place, EdgeMode::Centreline, *recipe); !set) return fail(set.error());
  }
  for (const std::string& region : arguments.regions) {
    if (auto set = applyRegion(region, *recipe); !set) return fail(set.error());
  }
  if (auto set = applyPage(arguments, *recipe); !set) return fail(set.error());
  for (const std::string& direction : arguments.directions) {
    if (auto set = applyDirection(direction, *recipe); !set) return fail(set.error());
  }
  for (const std::string& start : arguments.starts) {
    if (auto set = applyStart(start, *recipe); !set) return fail(set.error());
  }
  if (arguments.dpi && !arguments.knownLength.empty())
    return wrong("--dpi and --known-length both set the resolution. Give one of them.");
  if (!arguments.knownLength.empty() && arguments.scan.empty() && !recipe->page)
    return wrong(
        "--known-length sets the resolution of a scan, and none is named. Imported curves have their unit: "
        "use --import-unit or --scale.");
  if (!arguments.knownLength.empty()) {
    if (auto set = applyKnownLength(arguments.knownLength, *recipe); !set) return fail(set.error());
  }
  if (arguments.scan.empty() && !recipe->page && arguments.imports.empty()) {
    return wrong("Name a scan. Only a recipe drawn on an empty page needs none.");
  }
  if (auto problem = validate(*recipe)) return fail(std::move(*problem));
  return recipe;
}

Result<void> checkScanName(const TraceArguments& arguments) {
  const fs::path name(arguments.scan);
  const std::string ending = extensionOf(name);
  for (const char* unread : {".3dm", ".dwg", ".ai", ".eps"}) {
    if (ending != unread) continue;
    return fail(ErrorCode::UnreadableScan, "Curves are not read from " + shownName(name.filename()) +
                                               ". Save them as one of " + importEndings() + " and open that file.");
  }
  return {};
}

std::string presetNames() {
  std::string names;
  for (const ExportPreset& preset : exportPresets()) names.append(names.empty() ? "" : ", ").append(preset.id);
  return names;
}

Result<int> threadsOf(const TraceArguments& arguments) {
  constexpr int kMostThreads = 1024;
  if (!arguments.threads) return 0;
  const auto threads = integerFromText(*arguments.threads);
  if (threads && *threads >= 0 && *threads <= kMostThreads) return *threads;
  return wrong("--threads takes a whole number from 0 to 1024, not \"" + *arguments.threads + "\".");
}

namespace {

/// Of the empty page of a recipe.
PageFrame frameOfPage(const Recipe& recipe) {
  const BlankPage& page = *recipe.page;
  return {page.widthPx, page.heightPx, kMillimetresPerInch / recipe.dpi.value_or(kAssumedDpi), page.leftMm,
          page.bottomMm};
}

}  // namespace

Result<void> importInto(const TraceArguments& arguments, const PageFrame* frame, TracePlan& plan) {
  std::optional<double> unit;
  if (!arguments.importUnit.empty()) {
    unit = millimetresOfUnit(arguments.importUnit);
    if (!unit) return wrong("--import-unit takes mm, cm, m or in, not \"" + arguments.importUnit + "\".");
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
  return {};
}

Result<TracePlan> planTrace(const TraceArguments& arguments) {
  TracePlan plan;
  if (auto planned = planExport(arguments, plan); !planned) return fail(planned.error());
  const auto threads = threadsOf(arguments);
  if (!threads) return fail(threads.error());
  plan.threads = *threads;
  if (arguments.reportTargets && arguments.report.empty())
    return wrong("--report-targets needs a report to write to: add --report REPORT.json.");
  if (arguments.reportSeries && arguments.report.empty())
    return wrong("--report-series needs a report to write to: add --report REPORT.json.");
  for (const std::string& dump : arguments.dumps) {
    auto parsed = dumpOf(dump);
    if (!parsed) return fail(parsed.error());
    plan.dumps.push_back(std::move(*parsed));
  }
  if (auto checked = checkTargets(arguments, plan); !checked) return fail(checked.error());
  if (auto checked = checkOptions(arguments, plan); !checked) return fail(checked.error());
  if (auto checked = checkScanName(arguments); !checked) return fail(checked.error());
  auto recipe = recipeOf(arguments);
  if (!recipe) return fail(recipe.error());
  plan.recipe = std::move(*recipe);
  if (const PaperPreset* paper = findPaperPreset(arguments.asIn); paper != nullptr && !paper->cost.empty())
    plan.notes.push_back("As in paper " + paper->id + ", " + paper->title + ": " + paper->cost);
  // Beside a scan they wait for its page.
  if (arguments.scan.empty()) {
    if (auto imported = importInto(arguments, nullptr, plan); !imported) return fail(imported.error());
  }
  return plan;
}

}  // namespace batten::cli
