// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/text/csv_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/model/read_back.h"

namespace batten {
namespace {

constexpr std::size_t kColumns = 8;   // of a row
constexpr int kMostRows = 1'000'000;  ///< Of one curve; more is a mistyped spacing.

std::string header(const PageFrame& frame, const std::string& unit, int rows) {
  return std::string(
             "# Curvature is positive where the curve turns left (counter-clockwise); x to the right, y up, from ") +
         originOf(frame) + ". " + std::string(kRowsStated) + std::to_string(rows) + ".\ncurve,piece,s_" + unit + ",x_" +
         unit + ",y_" + unit + ",tangent_deg,kappa_per_" + unit + ",radius_" + unit + "\n";
}

/// The piece at the size and in the unit of the file.
NurbsCurve inFile(const NurbsCurve& curve, const ExportSettings& settings) {
  const double size = settings.scale / millimetresPer(settings.unit);
  return curve.mapped(size * Eigen::Matrix2d::Identity(), Vec2::Zero());
}

std::string row(const std::string& begin, const CurveSample& sample, double straight) {
  std::string text = begin;
  const double degrees = std::atan2(sample.tangent.y(), sample.tangent.x()) * kDegPerRad;
  for (const double value : {sample.s, sample.point.x(), sample.point.y(), degrees, sample.kappa})
    text.append(",").append(exactNumber(value));
  text += ",";
  if (std::abs(sample.kappa) >= straight) text += exactNumber(1.0 / sample.kappa);
  return text + "\n";
}

/// The lines of a text but those that begin with #, without their ends.
std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (!line.empty() && line.front() != '#') lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

}  // namespace

Result<std::string> writeCsv(const ExportDocument& document, const ExportSettings& settings,
                             const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  std::string text;
  int written = 0;
  std::size_t done = 0;
  for (const ExportCurve& line : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
      const NurbsCurve curve = inFile(line.pieces[i].curve, settings);
      const double length = ArcLength(curve).total() * millimetresPer(settings.unit);
      if (!(length / settings.spacingMm < kMostRows))
        return fail(
            ErrorCode::BadParameter,
            "A curve of this length has over a million rows in a CSV. Choose a smaller scale or another format.");
      const int rows = std::max(2, static_cast<int>(std::ceil(length / settings.spacingMm - 1e-9)) + 1);
      const std::string begin = csvField(line.name.empty() ? line.id : line.name) + "," + csvField(entityName(line, i));
      const double straight = kStraightCurvature / extent(curve);
      if (context.isCancelled()) return cancelled();
      for (const CurveSample& sample : sampleByArcLength(curve, rows)) {
        text += row(begin, sample, straight);
        ++written;
      }
    }
  }
  return header(document.frame, nameOf(settings.unit), written) + text;
}

Result<double> checkCsv(std::string_view text, const ExportDocument& document, const ExportSettings& settings,
                        const RunContext& context) {
  const std::vector<std::string_view> lines = linesOf(text);
  std::size_t at = 1;  // behind the names of the columns
  double most = 0.0;
  std::size_t done = 0;
  for (const ExportCurve& line : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
      const NurbsCurve curve = inFile(line.pieces[i].curve, settings);
      const ArcLength length(curve);
      const std::string name = entityName(line, i);
      std::optional<double> last;
      while (at < lines.size()) {
        constexpr std::size_t kRowsBetweenLooks = 1024;  // at whether the run was cancelled
        if (at % kRowsBetweenLooks == 0 && context.isCancelled()) return cancelled();
        const std::vector<std::string> fields = csvFields(lines[at]);
        if (fields.size() != kColumns) return readsBackOtherwise("a row of another length");
        std::array<double, 3> values{};
        for (std::size_t k = 0; k < values.size(); ++k) {
          const auto value = numberFromText(fields[k + 2]);
          if (!value) return readsBackOtherwise("a field that is no number");
          values[k] = *value;
        }
        if (fields[1] != name || (last && values[0] <= *last)) break;
        last = values[0];
        most = std::max(most, (curve.point(length.parameter(values[0])) - Vec2(values[1], values[2])).norm());
        ++at;
      }
      if (!last || std::abs(*last - length.total()) > 1e-9 * length.total())
        return readsBackOtherwise("rows are missing of " + name);
    }
  }
  if (at != lines.size()) return readsBackOtherwise("more rows than curves");
  return most * millimetresPer(settings.unit);
}

}  // namespace batten
