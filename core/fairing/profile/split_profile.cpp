// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/split_profile.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/profile/polynomial_fit.h"

namespace batten {
namespace {

/// Cubic pieces that stand for a target polynomial, exact to 1e-6 of its range.
constexpr int kNodesPerPart = 24;

/// From split to split: samples over 0..1 of the part.
struct Part {
  double from = 0.0, to = 1.0;  ///< Perimeter; beyond 1 where the part goes on over the seam.
  std::vector<double> x, y;
  std::vector<double> coefficients;
};

double valueOf(const std::vector<double>& c, double x) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) v = v * x + c[k];
  return v;
}
double slopeOf(const std::vector<double>& c, double x) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 1;) v = v * x + static_cast<double>(k) * c[k];
  return v;
}

std::vector<Part> partsOf(std::span<const double> perimeter, std::span<const double> kappa,
                          std::span<const double> splits, bool closed) {
  std::vector<double> borders;
  if (!closed) borders.push_back(0.0);
  borders.insert(borders.end(), splits.begin(), splits.end());
  borders.push_back(closed ? splits.front() + 1.0 : 1.0);
  std::vector<Part> parts;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    Part part;
    part.from = borders[k];
    part.to = borders[k + 1];
    for (std::size_t i = 0; i < perimeter.size(); ++i) {
      const bool seam = closed && i + 1 == perimeter.size();  // the same place as the first sample
      const double f = perimeter[i] < part.from && part.to > 1.0 ? perimeter[i] + 1.0 : perimeter[i];
      if (seam || f < part.from || f > part.to) continue;
      part.x.push_back((f - part.from) / (part.to - part.from));
      part.y.push_back(kappa[i]);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

void fitPart(Part& part, int degree, bool monotone, std::optional<double> start, std::optional<double> end) {
  const int most = static_cast<int>(part.x.size()) - 1 + (start ? 1 : 0) + (end ? 1 : 0);
  // Where the constraints of a degree do not settle, a lower one does.
  for (int d = std::max(0, std::min(degree, most)); d >= 0; --d) {
    part.coefficients = fitPinnedPolynomial(part.x, part.y, d, monotone, start, end);
    if (!part.coefficients.empty()) return;
  }
}

}  // namespace

SplitProfile fitSplitProfile(std::span<const double> perimeter, std::span<const double> kappa,
                             std::span<const double> splits, int degree, bool monotone, bool closed) {
  std::vector<Part> parts = partsOf(perimeter, kappa, splits, closed);
  for (Part& part : parts) {
    fitPart(part, degree, monotone, std::nullopt, std::nullopt);
    if (part.coefficients.empty()) return {};
  }
  // joint[k] lies at the end of part k.
  const std::size_t count = parts.size();
  std::vector<double> joint(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    joint[k] = 0.5 * (valueOf(parts[k].coefficients, 1.0) + valueOf(parts[(k + 1) % count].coefficients, 0.0));
  }
  SplitProfile made{{}, closed ? 0 : 1};
  for (std::size_t k = 0; k < count; ++k) {
    const bool first = !closed && k == 0, last = !closed && k + 1 == count;
    fitPart(parts[k], degree, monotone, first ? std::nullopt : std::optional(joint[(k + count - 1) % count]),
            last ? std::nullopt : std::optional(joint[k]));
    if (parts[k].coefficients.empty()) return {};
    made.coefficients += std::max(1, static_cast<int>(parts[k].coefficients.size()) - 1);
  }
  for (const Part& part : parts) {
    const double width = part.to - part.from;
    for (int i = 0; i <= kNodesPerPart; ++i) {
      const double x = static_cast<double>(i) / kNodesPerPart;
      made.nodes.push_back(
          {part.from + x * width, valueOf(part.coefficients, x), slopeOf(part.coefficients, x) / width});
    }
  }
  if (!closed) return made;
  // The part over the seam is cut at it: its end comes first.
  const Part& over = parts.back();
  const double width = over.to - over.from, x = (1.0 - over.from) / width;
  made.nodes = cutAtSeam(made.nodes, valueOf(over.coefficients, x), slopeOf(over.coefficients, x) / width);
  return made;
}

std::vector<ProfileNode> cutAtSeam(const std::vector<ProfileNode>& nodes, double value, double slope) {
  std::vector<ProfileNode> cut{{0.0, value, slope}};
  for (const ProfileNode& node : nodes)
    if (node.f > 1.0) cut.push_back({node.f - 1.0, node.value, node.slope});
  for (const ProfileNode& node : nodes)
    if (node.f < 1.0) cut.push_back(node);
  cut.push_back({1.0, value, slope});
  return cut;
}

}  // namespace batten
