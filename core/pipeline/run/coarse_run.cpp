// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/coarse_run.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/base/parallel.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_places.h"

namespace batten {
namespace {

constexpr double kQuickPage = 8e6, kCoarsePage = 3e6;  // [px]
constexpr double kLeastDpi = 1.0;                      // of a recipe

/// A length or area that the table knows, divided. One that stands for a word ("auto") says the same on any page.
void divide(const Parameter& p, double by, Recipe& recipe) {
  const auto value = numberFromText(p.get(recipe));
  if (!value || (!p.minimumWord.empty() && *value <= p.minimum)) return;
  double divided = std::clamp(*value / by, p.leastAbove.value_or(p.minimum), p.maximum);
  if (p.type == ParameterType::Integer) divided = std::clamp(std::round(divided), p.minimum, p.maximum);
  if (*value == 0.0) divided = 0.0;
  // Within its range by now: the value before stays if the table has further rules.
  (void)p.set(recipe, numberToText(divided));
}

/// Means over factor x factor pixels, of the size of the coarse grey.
ColourImage coarseColours(const ColourImage& colour, const GreyImage& grey, int factor, const RunContext& context) {
  ColourImage coarse(grey.width, grey.height);
  const int area = factor * factor;
  parallelFor(context, coarse.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        int red = area / 2, green = area / 2, blue = area / 2;
        for (int i = 0; i < area; ++i) {
          const Rgb8& c = colour.row(std::min(y * factor + i / factor,
                                              colour.height - 1))[std::min(x * factor + i % factor, colour.width - 1)];
          red += c.red;
          green += c.green;
          blue += c.blue;
        }
        coarse.row(y)[x] = {static_cast<std::uint8_t>(red / area), static_cast<std::uint8_t>(green / area),
                            static_cast<std::uint8_t>(blue / area)};
      }
    }
  });
  return coarse;
}

double dpiOf(const Recipe& recipe, const Scan& scan) { return recipe.dpi.value_or(scan.dpi.value_or(kAssumedDpi)); }

}  // namespace

int coarseFactor(int widthPx, int heightPx) {
  const double pixels = static_cast<double>(widthPx) * heightPx;
  return pixels <= kQuickPage ? 1 : static_cast<int>(std::ceil(std::sqrt(pixels / kCoarsePage)));
}

int coarseFactor(const Scan& scan, const Recipe& recipe) {
  const int factor = coarseFactor(scan.grey.width, scan.grey.height);
  return dpiOf(recipe, scan) / factor < kLeastDpi ? 1 : factor;
}

Scan coarsePage(const Scan& scan, int factor, const RunContext& context) {
  Scan coarse;
  coarse.info = scan.info;
  coarse.info.width = coarse.info.height = 0;  // of no file
  coarse.dpi = scan.dpi ? std::optional(*scan.dpi / factor) : std::nullopt;
  coarse.page = scan.page;
  coarse.pages = scan.pages;
  // Where no file stands for the pixels, they stand for themselves.
  if (scan.fileHash != ContentHash{})
    coarse.fileHash = HashBuilder().text("coarse page").hash(scan.fileHash).integer(factor).finish();
  coarse.path = scan.path;
  coarse.rectify = scan.rectify;
  coarse.rectification = scan.rectification;
  coarse.grey = GreyImage(std::max(1, scan.grey.width / factor), std::max(1, scan.grey.height / factor));
  if (!scan.colour.isEmpty()) coarse.colour = coarseColours(scan.colour, coarse.grey, factor, context);
  const auto area = static_cast<std::uint32_t>(factor * factor);
  parallelFor(context, coarse.grey.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<std::uint32_t> sums(coarse.grey.width);
    for (int y = begin; y < end; ++y) {
      std::fill(sums.begin(), sums.end(), 0u);
      for (int dy = 0; dy < factor; ++dy) {
        const std::uint16_t* row = scan.grey.row(std::min(y * factor + dy, scan.grey.height - 1));
        for (int x = 0; x < coarse.grey.width; ++x)
          for (int dx = 0; dx < factor; ++dx) sums[x] += row[std::min(x * factor + dx, scan.grey.width - 1)];
      }
      std::uint16_t* to = coarse.grey.row(y);
      for (int x = 0; x < coarse.grey.width; ++x) to[x] = static_cast<std::uint16_t>((sums[x] + area / 2) / area);
    }
  });
  return coarse;
}

Recipe coarseRecipe(Recipe recipe, const Scan& scan, int factor) {
  const double by = factor;
  const double dpi = dpiOf(recipe, scan);
  recipe.dpi = dpi / by;
  for (const Parameter& p : parameterTable()) {
    if (p.unit == "px") divide(p, by, recipe);
    if (p.unit == "px²") divide(p, by * by, recipe);
  }
  if (recipe.page) {
    // What is left over at the lower border is no part of the coarse page, which begins above it.
    const int restPx = scan.grey.height % factor;
    recipe.page->widthPx = scan.grey.width / factor;
    recipe.page->heightPx = scan.grey.height / factor;
    recipe.page->bottomMm += restPx * kMillimetresPerInch / dpi;
  }
  recipe.curveNumbers = {};
  movePlaces(
      recipe, [by](const Vec2& place) -> Vec2 { return place / by; }, 1.0 / by);
  return recipe;
}

PageFrame coarseFrame(const PageFrame& coarse, int factor) {
  PageFrame frame = coarse;
  frame.widthPx *= factor;
  frame.heightPx *= factor;
  frame.mmPerPx /= factor;
  return frame;
}

}  // namespace batten
