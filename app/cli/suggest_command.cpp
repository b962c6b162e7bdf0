// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/suggest_command.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/exit_codes.h"
#include "app/cli/trace_plan.h"
#include "core/base/platform.h"
#include "core/base/shown_text.h"
#include "core/image/scan_reader.h"
#include "core/pipeline/run/merge_advice.h"

namespace batten::cli {
namespace {

Result<MergeAdvice> adviceFor(const TraceArguments& arguments) {
  if (arguments.scan.empty()) return fail(ErrorCode::BadParameter, "Name the scan to look at.");
  const auto recipe = recipeOf(arguments);
  if (!recipe) return fail(recipe.error());
  RunContext context;
  const auto threads = threadsOf(arguments);
  if (!threads) return fail(threads.error());
  context.threads = *threads;
  auto scan = [&] {
    const QuietStderr quiet;
    return readScan(arguments.scan, {.page = recipe->scanPage}, context);
  }();
  if (!scan) return fail(scan.error());
  StageCache cache;
  return adviseMerge(*scan, *recipe, cache, context);
}

}  // namespace

int runSuggest(const TraceArguments& arguments) {
  const auto advice = adviceFor(arguments);
  if (!advice) return reportError(advice.error());
  nlohmann::ordered_json json{{"scan", arguments.scan},           {"edges.merge", advice->widths},
                              {"strokes", advice->strokes},       {"lines", advice->lines},
                              {"overdrawn_share", advice->share}, {"reason", describe(*advice)}};
  std::cout << withoutControls(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) << '\n';
  return endOutput();
}

}  // namespace batten::cli
