// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/split_profile.h"

#include <algorithm>
#include <cmath>

#include "core/fairing/profile/polynomial_fit.h"

namespace batten {
namespace {

/// Cubic pieces that stand for a polynomial of degree 6 or less, exact to 1e-6 of its range.
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

std::vector<ProfileNode> fitSplitProfile(std::span<const double> perimeter, std::span<const double> kappa,
                                         std::span<const double> splits, int degree, bool monotone, bool closed,
                                         int& coefficientCount) {
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
  coefficientCount = closed ? 0 : 1;
  for (std::size_t k = 0; k < count; ++k) {
    const bool first = !closed && k == 0, last = !closed && k + 1 == count;
    fitPart(parts[k], degree, monotone, first ? std::nullopt : std::optional(joint[(k + count - 1) % count]),
            last ? std::nullopt : std::optional(joint[k]));
    if (parts[k].coefficients.empty()) return {};
    coefficientCount += std::max(1, static_cast<int>(parts[k].coefficients.size()) - 1);
  }
  std::vector<ProfileNode> nodes;
  for (const Part& part : parts) {
    const double width = part.to - part.from;
    for (int i = 0; i <= kNodesPerPart; ++i) {
      const double x = static_cast<double>(i) / kNodesPerPart;
      nodes.push_back({part.from + x * width, valueOf(part.coefficients, x), slopeOf(part.coefficients, x) / width});
    }
  }
  if (!closed) return nodes;
  // The part over the seam is cut at it: its end comes first.
  const Part& over = parts.back();
  const double width = over.to - over.from, x = (1.0 - over.from) / width;
  const ProfileNode seam{1.0, valueOf(over.coefficients, x), slopeOf(over.coefficients, x) / width};
  std::vector<ProfileNode> head{{0.0, seam.value, seam.slope}}, tail;
  for (const ProfileNode& node : nodes) {
    if (node.f > 1.0) head.push_back({node.f - 1.0, node.value, node.slope});
    if (node.f < 1.0) tail.push_back(node);
  }
  head.insert(head.end(), tail.begin(), tail.end());
  head.push_back(seam);
  return head;
}

}  // namespace batten
