// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/compare_command.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cli/exit_codes.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/exchange/curve_file.h"
#include "core/fairing/curve_comparison.h"

namespace batten::cli {
namespace {

using Json = nlohmann::ordered_json;

struct NamedShape {
  std::string name;
  ShapeProfile profile;
};

Result<std::vector<NamedShape>> shapesOf(const std::string& path) {
  const auto document = readCurveFile(path);
  if (!document) {
    return fail(document.error().code,
                document.error().message + " Create it again with batten-cli trace SCAN -o FILE.json.");
  }
  std::vector<NamedShape> shapes;
  for (const ExportCurve& curve : document->curves) {
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
      const bool closed = curve.closed && curve.pieces.size() == 1;
      std::string name = curve.id;
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
                       {"similarity", c.similarity},
                       {"pearson", c.pearson},
                       {"curvature_similarity", c.curvatureSimilarity},
                       {"curvature_pearson", c.curvaturePearson},
                       {"mirrored", c.mirrored},
                       {"reversed", c.reversed},
                       {"shift", c.shift}});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Json& x, const Json& y) {
    return x.at("similarity").get<double>() > y.at("similarity").get<double>();
  });
  const Json result{{"first", first}, {"second", second}, {"pairs", pairs}};
  std::cout << withoutControls(result.dump(-1, ' ', false, Json::error_handler_t::replace)) << '\n';
  return endOutput();
}

}  // namespace batten::cli
