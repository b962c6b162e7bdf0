// SPDX-License-Identifier: GPL-3.0-or-later
// Traces rough sketches whose strokes a person has grouped into curves, as pages, through the whole program, and prints
// how far the curves are those that were meant: pair F1, precision and recall over pairs of strokes, the number of
// curves, and their distance from the middle of each group in stroke widths. Three ways: every stroke for itself,
// merged as suggested, and edges.intent. Medians over all drawings and over either half of them.
// With --folds N also the lines that the intent gives before they are fitted, with the weights of the program and with
// weights learned in each of N folds from the drawings of the others.
// With --learn nothing but that: weights are learned from all drawings and printed for intent_weights.cpp.
//
//   BATTEN_STROKES=FOLDER bench_strokes [--each] [--only NAME] [--folds N] [--learn] [stage.parameter=value …]
//
// FOLDER holds .scap files: `@thickness`, `{ #stroke group x y pressure … }`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/contour/intent/intended_lines.h"
#include "core/curve/arc_length.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/merge_advice.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/intent_learning.h"
#include "tests/bench/stroke_drawing.h"

using namespace batten;
namespace fs = std::filesystem;

namespace {

struct Way {
  const char* name;
  bool isSuggested, isIntent;
};
constexpr Way kWays[] = {
    {"single strokes", false, false}, {"merge as suggested", true, false}, {"edges.intent", false, true}};

// One polyline for every line, through its pieces.
std::vector<std::vector<Vec2>> curvesOf(const Scan& scan, const Recipe& recipe) {
  constexpr double kStepPx = 3.0;
  StageCache cache;
  PipelineRequest request;
  request.needEdges = false;
  const PipelineOutput output = runPipeline(scan, recipe, cache, request, {});
  std::vector<std::vector<Vec2>> curves;
  if (!output.faired) {
    std::fprintf(stderr, "no curves: %s\n", output.error ? output.error->message.c_str() : "the run ended early");
    return curves;
  }
  int last = -1;
  for (const TracedCurve& c : output.faired->curves) {
    if (c.contour != last) curves.emplace_back();
    last = c.contour;
    const double length = output.frame.lengthToImage(c.sketchedFigures.lengthMm);
    for (const CurveSample& s : sampleByArcLength(c.faired, std::max(8, static_cast<int>(length / kStepPx))))
      curves.back().push_back(output.frame.pointToImage(s.point));
  }
  return curves;
}

Recipe recipeFor(const Way& way, const Scan& scan, Recipe recipe) {
  recipe.edges.mode = EdgeMode::Centreline;
  recipe.edges.intent = way.isIntent;
  if (way.isSuggested) {
    StageCache cache;
    if (const auto advice = adviseMerge(scan, recipe, cache, {}))
      recipe.edges.mergeWidths = advice->widths.value_or(0.0);
  }
  return recipe;
}

void printSummary(const char* what, const std::vector<test::StrokeFigures>& all, int from, int step) {
  std::vector<double> f1, precision, recall, mean, p95;
  double sum = 0.0, right = 0.0;
  for (std::size_t i = from; i < all.size(); i += step) {
    f1.push_back(all[i].f1);
    precision.push_back(all[i].precision);
    recall.push_back(all[i].recall);
    mean.push_back(all[i].meanWidths);
    p95.push_back(all[i].p95Widths);
    sum += all[i].f1;
    right += all[i].isCountRight() ? 1.0 : 0.0;
  }
  if (f1.empty()) return;
  const auto n = static_cast<double>(f1.size());
  const auto middle = [](std::vector<double> v) {
    const double upper = upperMedian(v);
    return v.size() % 2 == 1 ? upper : 0.5 * (upper + elementOfRank(v, std::ssize(v) / 2 - 1));
  };
  std::printf(
      "%-20s %-12s %3.0f drawings  F1 %.3f (mean %.3f)  precision %.3f  recall %.3f  count right %3.0f %%  off %.2f, "
      "95 %% %.2f widths\n",
      what,
      step == 1   ? "all"
      : from == 0 ? "first half"
                  : "second half",
      n, middle(f1), sum / n, middle(precision), middle(recall), 100.0 * right / n, middle(mean), middle(p95));
}

void printSummaries(const char* what, const std::vector<test::StrokeFigures>& figures) {
  printSummary(what, figures, 0, 1);
  printSummary(what, figures, 0, 2);
  printSummary(what, figures, 1, 2);
  std::fflush(stdout);
}

void printEach(const test::StrokeDrawing& drawing, const char* way, const test::StrokeFigures& f) {
  std::printf("%-30s %-20s F1 %.2f  precision %.2f  recall %.2f  %3d curves of %3d  off %.2f, 95 %% %.2f widths\n",
              drawing.name.c_str(), way, f.f1, f.precision, f.recall, f.curves, f.clusters, f.meanWidths, f.p95Widths);
  std::fflush(stdout);
}

struct StrokeOptions {
  Recipe recipe;
  bool each = false, learn = false;
  int folds = 0;
  std::string only;
};

std::optional<StrokeOptions> optionsOf(int argc, char** argv) {
  StrokeOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    if (word == "--each") {
      options.each = true;
    } else if (word == "--learn") {
      options.learn = true;
    } else if (word == "--only" && i + 1 < argc) {
      options.only = argv[++i];
    } else if (word == "--folds" && i + 1 < argc) {
      options.folds = std::atoi(argv[++i]);
    } else if (equals == std::string::npos) {
      std::fprintf(stderr, "%s is no option; settings are given as stage.parameter=value\n", word.c_str());
      return std::nullopt;
    } else if (const auto done = setParameter(options.recipe, word.substr(0, equals), word.substr(equals + 1)); !done) {
      std::fprintf(stderr, "%s\n", done.error().message.c_str());
      return std::nullopt;
    }
  }
  return options;
}

std::vector<test::StrokeDrawing> drawingsOf(const fs::path& folder, const std::string& only) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".scap" && entry.path().stem().string().find(only) != std::string::npos)
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<test::StrokeDrawing> drawings;
  for (const fs::path& file : files) {
    if (auto drawing = test::StrokeDrawing::read(file)) {
      drawings.push_back(std::move(*drawing));
    } else {
      std::printf("%s holds no strokes\n", file.filename().c_str());
    }
  }
  return drawings;
}

std::vector<test::LearningPage> learningPages(const std::vector<test::StrokeDrawing>& drawings,
                                              const std::vector<Scan>& scans, Recipe recipe) {
  recipe.edges.mode = EdgeMode::Centreline;
  std::vector<test::LearningPage> pages;
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    StageCache cache;
    PipelineRequest request;
    request.needEdges = false;
    request.upTo = StageId::Contours;
    const PipelineOutput output = runPipeline(scans[i], recipe, cache, request, {});
    pages.push_back({&drawings[i], {}, 1.0});
    if (!output.contours) continue;
    pages.back().lines = output.contours->contours;
    pages.back().widthPx = std::max(1.0, output.contours->report.widthPx.value_or(0.0));
  }
  return pages;
}

// Of the lines that the weights give, before curves are fitted.
test::StrokeFigures judgeLines(const test::LearningPage& page, const test::StrokeJudge& judge,
                               const IntentWeights& weights) {
  const auto meant = intendedLines(page.lines, page.widthPx, {}, {}, {weights});
  std::vector<std::vector<Vec2>> lines;
  for (const Contour& c : meant ? *meant : page.lines) {
    lines.push_back(positionsOf(c.points));
    if (c.closed) lines.back().push_back(lines.back().front());
  }
  return judge.judge(lines);
}

// Grouped with weights that were not learned from the drawing itself.
void printCrossValidated(const std::vector<test::LearningPage>& pages, const std::vector<test::StrokeJudge>& judges,
                         const StrokeOptions& options) {
  const std::vector<IntentWeights> others = test::crossValidatedWeights(pages, options.folds);
  std::vector<test::StrokeFigures> own, fair;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    own.push_back(judgeLines(pages[i], judges[i], learnedWeights()));
    fair.push_back(judgeLines(pages[i], judges[i], others[i]));
    if (options.each) printEach(*pages[i].drawing, "not learned from", fair.back());
  }
  printSummaries("lines, as learned", own);
  printSummaries("lines, not learned", fair);
}

// Pairs of strokes first, wrong pairs more than missed ones, and the number of curves.
double scoreOf(const test::StrokeFigures& f) {
  constexpr double kPrecisionShare = 0.2, kCountShare = 0.3;
  const double curves = std::max(1, f.curves), meant = std::max(1, f.clusters);
  return f.f1 + kPrecisionShare * f.precision - kCountShare * std::min(1.0, std::fabs(std::log(curves / meant)));
}

void printLearned(const std::vector<test::LearningPage>& pages, const std::vector<test::StrokeJudge>& judges) {
  const auto score = [&](const IntentWeights& weights) {
    double sum = 0.0;
    for (std::size_t i = 0; i < pages.size(); ++i) sum += scoreOf(judgeLines(pages[i], judges[i], weights));
    return sum / std::max<double>(1.0, static_cast<double>(pages.size()));
  };
  const IntentWeights learned = test::crossValidatedWeights(pages, 1).front();
  const IntentWeights tuned = test::tunedCautions(learned, score);
  std::printf("score: of the program %.4f, learned %.4f, cautions tuned %.4f\n", score(learnedWeights()),
              score(learned), score(tuned));
  test::printWeights(tuned);
}

}  // namespace

int main(int argc, char** argv) {
  const char* folder = std::getenv("BATTEN_STROKES");
  if (folder == nullptr || !fs::is_directory(folder)) {
    std::puts("skipped: BATTEN_STROKES names no folder of .scap drawings");
    return 0;
  }
  const auto options = optionsOf(argc, argv);
  if (!options) return 2;
  const std::vector<test::StrokeDrawing> drawings = drawingsOf(folder, options->only);
  std::vector<test::StrokeJudge> judges(drawings.begin(), drawings.end());
  std::vector<Scan> scans;
  for (const test::StrokeDrawing& drawing : drawings) scans.push_back(drawing.page());
  if (options->learn) {
    printLearned(learningPages(drawings, scans, options->recipe), judges);
    return 0;
  }
  for (const Way& way : kWays) {
    std::vector<test::StrokeFigures> figures;
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      figures.push_back(judges[i].judge(curvesOf(scans[i], recipeFor(way, scans[i], options->recipe))));
      if (options->each) printEach(drawings[i], way.name, figures.back());
    }
    printSummaries(way.name, figures);
  }
  if (options->folds > 1) printCrossValidated(learningPages(drawings, scans, options->recipe), judges, *options);
  return 0;
}
