// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters and marks drawn at random from their ranges, over contour, construction and fairing of small pages.
#include <cstdint>
#include <cstdlib>
#include <random>

#include "core/base/number_text.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/render_page.h"

namespace {

using namespace batten;

constexpr int kWidth = 240, kHeight = 160;

const std::vector<Scan>& pages() {
  static const std::vector<Scan> kPages = [] {
    std::vector<Scan> all;
    for (const char* shape : {"ellipse", "car", "clothoid"}) {
      const auto truth = test::truthShape(shape, kWidth, kHeight);
      all.push_back(test::renderPage(test::fillCoverage(truth.outline(), kWidth, kHeight), kWidth, kHeight,
                                     test::scannedPage(3)));
    }
    return all;
  }();
  return kPages;
}

/// A value of the parameter's own range; its ends more often than chance would have it.
std::string valueOf(const Parameter& p, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  if (!p.choices.empty()) return p.choices[random() % p.choices.size()];
  if (p.type == ParameterType::Text) return p.get(Recipe{});
  const double end = share(random), at = end < 0.1 ? 0.0 : end > 0.9 ? 1.0 : share(random);
  const double value = p.minimum + at * (p.maximum - p.minimum);
  return p.type == ParameterType::Integer ? std::to_string(static_cast<int>(value)) : numberToText(value);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::seed_seq seed(data, data + size);
  std::mt19937 random(seed);
  Recipe recipe;
  for (const Parameter& p : parameterTable()) {
    // Most stay as they are: drawn all at once, the image stages would leave no line to go on with.
    if (random() % 4 != 0) continue;
    if (!p.set(recipe, valueOf(p, random))) std::abort();  // a value of its own range is refused
  }
  for (unsigned i = 0; i < random() % 6; ++i) {
    recipe.cornerMarks.push_back({Vec2(random() % kWidth, random() % kHeight), random() % 2 == 0 ? 0.0 : 1.5});
  }
  if (validate(recipe)) return 0;
  StageCache nothingKept(0);
  RunContext context;
  context.threads = 1;
  const auto output = runPipeline(pages()[random() % pages().size()], recipe, nothingKept, {}, context);
  if (output.error && output.error->message.empty()) std::abort();
  if (!output.error && (!output.faired || output.faired->curves.empty())) std::abort();
  return 0;
}
