// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/compare_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/exit_codes.h"
#include "app/cli/shown_digits.h"
#include "core/base/json_text.h"
#include "core/base/name_text.h"
#include "core/base/regular_file.h"
#include "core/exchange/curve_file.h"
#include "core/exchange/model/export_settings.h"
#include "core/fairing/profile/curve_comparison.h"

namespace batten::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDecimals = 6;  // of the figures, which lie between -1 and 1

struct NamedShape {
  std::string name;
  ShapeProfile profile;
};

Result<std::vector<NamedShape>> shapesOf(const std::string& path) {
  const auto document = readCurveFile(path);
  if (!document) {
    Error error = ofInput(document.error());
    // Damaged files of Batten's own can be made anew; what to do about others is said already.
    const auto format = formatOf(path);
    const bool isOwn = format == ExportFormat::Json || format == ExportFormat::Svg;
    std::error_code none;
    if (isOwn && std::filesystem::exists(path, none))
      error.message += " Create it again with batten-cli trace SCAN -o FILE.json.";
    return fail(std::move(error));
  }
  std::vector<NamedShape> shapes;
  for (const ExportCurve& curve : document->curves) {
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
      const bool closed = curve.closed && curve.pieces.size() == 1;
      std::string name = curve.name.empty() ? curve.id : curve.name;
      if (curve.pieces.size() > 1)
        name = curve.pieces[i].name.empty() ? name + "/" + std::to_string(i + 1) : curve.pieces[i].name;
      ShapeProfile profile = shapeProfile(curve.pieces[i].curve, closed);
      if (!profile.radius.empty()) shapes.push_back({std::move(name), std::move(profile)});
    }
  }
  if (shapes.empty()) return fail(ErrorCode::NoCurve, "There is no curve in " + path + ".");
  return shapes;
}

}  // namespace

int runCompare(const std::string& first, const std::string& second) {
  const auto a = shapesOf(first), b = shapesOf(second);
  if (!a) return reportError(a.error());
  if (!b) return reportError(b.error());
  std::vector<Json> pairs;
  for (const NamedShape& one : *a) {
    for (const NamedShape& other : *b) {
      const ShapeComparison c = compareShapes(one.profile, other.profile);
      pairs.push_back({{"first", one.name},
                       {"second", other.name},
                       {"similarity", withDecimals(c.similarity, kDecimals)},
                       {"pearson", withDecimals(c.pearson, kDecimals)},
                       {"curvature_similarity", withDecimals(c.curvatureSimilarity, kDecimals)},
                       {"curvature_pearson", withDecimals(c.curvaturePearson, kDecimals)},
                       {"mirrored", c.mirrored},
                       {"reversed", c.reversed},
                       {"shift", withDecimals(c.shift, kDecimals)}});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Json& x, const Json& y) {
    return x.at("similarity").get<double>() > y.at("similarity").get<double>();
  });
  const Json result{{"first", nameText(first)}, {"second", nameText(second)}, {"pairs", pairs}};
  std::cout << jsonLine(result) << '\n';
  return endOutput();
}

}  // namespace batten::cli
