// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/report_content.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/number_text.h"
#include "core/base/shown_text.h"
#include "core/curve/variation_energy.h"
#include "core/document/report_pages/curve_figures.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/piece_numbers.h"

namespace batten {
namespace {

// of figures: two fit beside each other on a page
constexpr double kCombWidthMm = 84.0, kPlotWidthMm = 96.0, kFigureHeightMm = 50.0;

std::string mm(double value) {
  constexpr double kLeast = 1e-5;  // shorter lengths are rounding
  if (value > 0.0 && value < kLeast) return "<0.00001";
  return std::isfinite(value) ? significantText(value, 3) : "-";
}

/// Two digits, with a power of ten where zeros would hide them: "6.8", "4.7e8".
std::string energyText(double value) {
  constexpr double kLeastPlain = 0.01, kMostPlain = 1e4;  // outside, numbers have a power of ten
  if (!std::isfinite(value)) return "-";
  if (value == 0.0 || (value >= kLeastPlain && value < kMostPlain)) return significantText(value, 2);
  const double power = std::floor(std::log10(value));
  return significantText(value / std::pow(10.0, power), 2) + "e" + std::to_string(static_cast<int>(power));
}

/// "12 > 9" where fairing changed it, else the number.
std::string beforeAndAfter(const std::string& before, const std::string& after) {
  return before == after ? after : before + " \u2192 " + after;
}

std::vector<std::string> columnNames() {
  return {"Length, mm", "Control points", "Extrema",     "Inflections", "Variation",
          "Rms, mm",    "95 %, mm",       "Largest, mm", "Moved, mm",   "Tolerance, mm"};
}

std::vector<std::string> cellsOf(const TracedCurve& curve) {
  const CurveFigures &before = curve.sketchedFigures, &after = curve.fairedFigures;
  const bool isFaired = curve.fairingUsed.mode != FairingMode::None;
  const auto count = [](int a, int b) { return beforeAndAfter(std::to_string(a), std::to_string(b)); };
  const NurbsCurve& shape = curve.faired.isEmpty() ? curve.sketched : curve.faired;
  return {roundedText(after.lengthMm, 2),
          count(before.controlPoints, after.controlPoints),
          count(before.extrema, after.extrema),
          count(before.inflections, after.inflections),
          beforeAndAfter(energyText(variationEnergy(curve.sketched)), energyText(variationEnergy(shape))),
          mm(after.fromPoints.rms),
          mm(after.fromPoints.percentile95),
          mm(after.fromPoints.max),
          isFaired ? mm(curve.fairing.maxDeviationMm) : "-",
          isFaired ? mm(curve.fairingUsed.toleranceMm) : "-"};
}

/// A parameter's value with the word that the panels use.
std::string shownValue(const Parameter& parameter, const Recipe& recipe) {
  const std::string value = parameter.get(recipe);
  for (std::size_t i = 0; i < parameter.choices.size() && i < parameter.choiceLabels.size(); ++i)
    if (parameter.choices[i] == value) return parameter.choiceLabels[i];
  if (parameter.type == ParameterType::Boolean) return value == "true" ? "on" : "off";
  return parameter.unit.empty() ? value : value + " " + parameter.unit;
}

std::string fairingLine(const TracedCurve& curve, const std::optional<TargetProfile>& target) {
  Recipe used;
  used.fairing = curve.fairingUsed;
  if (curve.fairingUsed.mode == FairingMode::None) return "Not faired.";
  std::string text = shownValue(*findParameter("fairing.mode"), used);
  if (target && curve.fairingUsed.target == FairingTarget::Drawn) text += ", drawn by hand";
  if (target && curve.fairingUsed.target == FairingTarget::LogAesthetic) text += ", log-aesthetic";
  if (target && isPolynomial(curve.fairingUsed.target)) {
    text += ", degree " + std::to_string(target->degree);
    if (curve.fairingUsed.target == FairingTarget::Recommended) text += " (recommended)";
    text += ", similarity " + roundedText(target->similarity, 4);
  }
  text += "; moved by " + mm(curve.fairing.maxDeviationMm) + " of " + mm(curve.fairingUsed.toleranceMm) + " mm";
  return curve.fairing.note.empty() ? text + "." : text + ". " + curve.fairing.note;
}

ReportContent::CurveSection sectionOf(const TracedCurve& curve, int number, const std::string& ownName) {
  ReportContent::CurveSection section;
  section.name = curveName(number);
  if (!ownName.empty()) section.name += " (" + shownText(ownName) + ")";
  if (curve.construct.isCircle) section.name += ", circle";
  if (curve.construct.isLine) section.name += ", line";
  section.cells = cellsOf(curve);
  const auto target = targetOf(curve);
  section.fairing = shownText(fairingLine(curve, target));
  if (!curve.construct.note.empty()) section.notes.push_back(shownText(curve.construct.note));
  section.comb = combFigure(curve, kCombWidthMm, kFigureHeightMm);
  section.radius = radiusFigure(curve, target, kPlotWidthMm, kFigureHeightMm);
  return section;
}

/// "roof.dxf, in inch, 3 lines: roof, sill, door"; a unit that was assumed is said to be.
std::string importFact(const ImportedFile& file) {
  constexpr std::size_t kMostNames = 12;  // that are listed
  const bool assumed = file.unit.ends_with('?');
  std::string text = file.source + ", unit " + (assumed ? file.unit.substr(0, file.unit.size() - 1) : file.unit) +
                     (assumed ? " (assumed: the file states none)" : "") + ", " + std::to_string(file.lines.size()) +
                     (file.lines.size() == 1 ? " line" : " lines");
  std::size_t named = 0;
  for (const ImportedLine& line : file.lines) {
    if (line.name.empty()) continue;
    if (named == kMostNames) {
      text += " …";
      break;
    }
    text += (named++ == 0 ? ": " : ", ") + line.name;
  }
  return shownText(text);
}

std::string drawingFact(const Recipe& recipe) {
  if (recipe.imports.empty()) return "drawn with the pen on an empty page";
  return recipe.penStrokes.empty() ? "imported curves" : "imported curves, and lines drawn with the pen";
}

std::vector<ReportContent::Fact> factsOf(const Scan& scan, const Recipe& recipe, const PipelineOutput& output,
                                         const ReportOrigin& origin) {
  const PageFrame& frame = output.frame;
  const auto size = [](double width, double height) {
    return roundedText(width, 1) + " \u00d7 " + roundedText(height, 1) + " mm";
  };
  std::vector<ReportContent::Fact> facts;
  if (isBlank(scan)) {
    facts.push_back({"Drawing", drawingFact(recipe)});
  } else {
    facts.push_back({"Scan", scan.info.format + ", " + std::to_string(scan.grey.width) + " \u00d7 " +
                                 std::to_string(scan.grey.height) + " px"});
    facts.push_back({"SHA-256", scan.fileHash.hex()});
  }
  for (const ImportedFile& file : recipe.imports) facts.push_back({"Imported", importFact(file)});
  const std::string dpi = roundedText(25.4 / frame.mmPerPx, 2) + " dpi";
  facts.push_back({"Resolution", isBlank(scan)                  ? dpi + ", of the page of the drawing"
                                 : isScaleAssumed(scan, recipe) ? dpi + ", assumed: the true size is not known"
                                 : recipe.dpi                   ? dpi + ", set by the user"
                                                                : dpi + ", stated by the file"});
  facts.push_back({"Page", size(frame.lengthToModel(frame.widthPx), frame.lengthToModel(frame.heightPx))});
  if (!origin.program.empty()) facts.push_back({"Made by", origin.program});
  if (!origin.date.empty()) facts.push_back({"Date", origin.date});
  return facts;
}

void addCount(std::vector<ReportContent::Fact>& list, const char* name, std::size_t count) {
  if (count > 0) list.push_back({name, std::to_string(count)});
}

std::vector<ReportContent::Fact> settingsOf(const Recipe& recipe) {
  std::vector<ReportContent::Fact> list;
  for (const Parameter& parameter : parameterTable()) {
    if (parameter.isForDisplay || parameter.get(recipe) == defaultValue(parameter)) continue;
    list.push_back({parameter.label, shownText(shownValue(parameter, recipe))});
  }
  addCount(list, "Marked corners", recipe.cornerMarks.size());
  addCount(list, "Refused corners", recipe.refusedCornersPx.size());
  addCount(list, "Junctions paired by hand", recipe.edges.junctions.size());
  addCount(list, "Pen lines", recipe.penStrokes.size());
  addCount(list, "Regions to trace", recipe.regions.size());
  addCount(list, "Segment points", recipe.segmentPoints.size());
  addCount(list, "Choices for single curves", recipe.choices.size());
  addCount(list, "Choices for single extrema", recipe.extremumChoices.size());
  return list;
}

}  // namespace

Result<ReportContent> reportContent(const Scan& scan, const Recipe& recipe, const PipelineOutput& output,
                                    const ReportOrigin& origin, const RunContext& context) {
  ReportContent content;
  std::vector<const TracedCurve*> curves;
  std::vector<int> numbers;
  int left = 0;
  for (std::size_t i = 0; output.faired && i < output.faired->curves.size(); ++i) {
    const TracedCurve& curve = output.faired->curves[i];
    if (!curve.included || curve.sketched.isEmpty()) {
      ++left;
      continue;
    }
    curves.push_back(&curve);
    numbers.push_back(curveNumber(output, curve));
  }
  if (curves.empty()) return fail(ErrorCode::NoCurve, "There is no curve to report on. Include at least one curve.");
  content.title = shownName(std::filesystem::path(scan.path).filename());
  if (content.title.empty()) content.title = "Drawing";
  content.facts = factsOf(scan, recipe, output, origin);
  auto drawing = drawingFigure(curves, numbers);
  if (!drawing) return fail(drawing.error());
  content.drawing = std::move(*drawing);
  const std::string leftOut = left > 0 ? ", " + std::to_string(left) + " left out" : std::string();
  content.facts.push_back({"Curves", std::to_string(curves.size()) + leftOut});
  content.columns = columnNames();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (context.isCancelled()) return cancelled();
    content.curves.push_back(sectionOf(*curves[i], numbers[i], ownNameOfCurve(output, recipe, *curves[i])));
    context.report(static_cast<double>(i + 1) / static_cast<double>(curves.size()));
  }
  content.settings = settingsOf(recipe);
  content.recipeJson = recipeToJson(recipe);
  return content;
}

}  // namespace batten
