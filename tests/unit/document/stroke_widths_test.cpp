// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stroke_widths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/curve/arc_length.h"
#include "core/document/export_builder.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/arrangement.h"
#include "core/exchange/model/cad_drawing.h"
#include "tests/support/render_page.h"
#include "tests/support/width_page.h"

namespace batten {
namespace {

struct TracedPage {
  Scan scan;
  Recipe recipe;
  PipelineOutput output;
};

TracedPage traced(const std::vector<test::WidthStroke>& strokes, const test::PageStyle& style, Recipe recipe = {}) {
  TracedPage page;
  page.scan = test::renderPage(test::widthCoverage(strokes), test::kWidthPagePx, test::kWidthPagePx, style);
  page.recipe = std::move(recipe);
  page.recipe.edges.mode = EdgeMode::Centreline;
  StageCache cache;
  page.output = runPipeline(page.scan, page.recipe, cache, {}, {});
  return page;
}

/// How far a profile is from the true width, place by place along its curve.
struct WidthError {
  double rmsPx = 0.0, worstPx = 0.0;
  int curves = 0, samples = 0;
};

WidthError errorOf(const NurbsCurve& curve, const WidthProfile& profile, const test::WidthStroke& truth,
                   const PageFrame& frame) {
  constexpr int kPlaces = 400;
  WidthError error;
  double sum = 0.0;
  for (const CurveSample& sample : sampleByArcLength(curve, kPlaces)) {
    const Vec2 at = frame.pointToImage(sample.point);
    const auto nearest = std::min_element(truth.places.begin(), truth.places.end(), [&](const auto& a, const auto& b) {
      return (a.at - at).squaredNorm() < (b.at - at).squaredNorm();
    });
    const double off = profile.at(sample.s) / frame.mmPerPx - nearest->width;
    sum += off * off / kPlaces;
    error.worstPx = std::max(error.worstPx, std::abs(off));
  }
  error.rmsPx = std::sqrt(sum);
  error.samples = static_cast<int>(profile.samples.size());
  return error;
}

/// The stroke that a curve is the middle of.
const test::WidthStroke& truthOf(const std::vector<test::WidthStroke>& strokes, const NurbsCurve& curve,
                                 const PageFrame& frame) {
  const Vec2 at = frame.pointToImage(curve.point(0.5 * (curve.start() + curve.end())));
  const auto away = [&](const test::WidthStroke& stroke) {
    double nearest = 1e9;
    for (const auto& place : stroke.places) nearest = std::min(nearest, (place.at - at).norm());
    return nearest;
  };
  return *std::min_element(strokes.begin(), strokes.end(),
                           [&](const auto& a, const auto& b) { return away(a) < away(b); });
}

std::map<std::string, WidthError> errorsOf(const ExportDocument& document) {
  const auto strokes = test::widthStrokes();
  std::map<std::string, WidthError> errors;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      EXPECT_TRUE(piece.width.has_value());
      if (!piece.width) continue;
      EXPECT_TRUE(isValid(*piece.width));
      EXPECT_NEAR(piece.width->length(), ArcLength(piece.curve).total(), 1e-9);
      const auto& truth = truthOf(strokes, piece.curve, document.frame);
      WidthError error = errorOf(piece.curve, *piece.width, truth, document.frame);
      error.curves = errors[truth.name].curves + 1;
      error.rmsPx = std::max(error.rmsPx, errors[truth.name].rmsPx);
      errors[truth.name] = error;
    }
  }
  return errors;
}

ExportDocument documentOn(const test::PageStyle& style, const Recipe& recipe = {}) {
  const TracedPage page = traced(test::widthStrokes(), style, recipe);
  return exportDocument(page.output, page.recipe, page.scan);
}

TEST(StrokeWidths, FollowTheWidthThatWasDrawn) {
  const struct {
    const char* name;
    test::PageStyle style;
    double allowedPx;
  } pages[] = {{"clean", test::cleanPage(), 0.1}, {"scan", test::scannedPage(7), 0.25}};
  for (const auto& page : pages) {
    const auto errors = errorsOf(documentOn(page.style));
    EXPECT_EQ(errors.size(), 4u);
    for (const auto& [name, error] : errors) {
      EXPECT_EQ(error.curves, 1) << name;
      EXPECT_LT(error.rmsPx, page.allowedPx) << page.name << " " << name;
    }
  }
}

TEST(StrokeWidths, EndWhenTheRunIsCancelled) {
  const TracedPage page = traced(test::widthStrokes(), test::cleanPage(), {});
  ASSERT_FALSE(page.output.faired->curves.empty());
  const TracedCurve& curve = page.output.faired->curves.front();
  RunContext context;
  EXPECT_TRUE(strokeWidthsAlong(page.output, page.scan, curve, curve.sketched, context));
  context.cancel.cancel();
  EXPECT_FALSE(strokeWidthsAlong(page.output, page.scan, curve, curve.sketched, context));
  EXPECT_TRUE(
      exportDocument(page.output, page.recipe, page.scan, ExportedCurves::Faired, ExportedWidths::Measured, context)
          .curves.empty());
}

TEST(StrokeWidths, StayWithTheCurveHoweverItIsMade) {
  Recipe faired;
  faired.fairing.mode = FairingMode::Tolerance;
  Recipe simplified;
  simplified.construct.detail = 0.3;
  for (const Recipe& recipe : {faired, simplified}) {
    for (const auto& [name, error] : errorsOf(documentOn(test::cleanPage(), recipe)))
      EXPECT_LT(error.rmsPx, 0.1) << name;
  }
}

TEST(StrokeWidths, FollowCurvesThatAreTurnedAndBegunElsewhere) {
  ExportDocument document = documentOn(test::cleanPage());
  for (ExportCurve& line : document.curves) {
    if (line.closed) {
      const NurbsCurve& curve = line.pieces[0].curve;
      line.startMm = curve.point(0.3 * curve.start() + 0.7 * curve.end());
    }
    for (ExportPiece& piece : line.pieces) piece.direction = PieceDirection{0, true};
  }
  const auto made = arranged(document, true);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->document.curves.size(), document.curves.size());
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    const NurbsCurve &before = document.curves[i].pieces[0].curve, &after = made->document.curves[i].pieces[0].curve;
    EXPECT_GT((before.point(before.start()) - after.point(after.start())).norm(), 1.0);
  }
  for (const auto& [name, error] : errorsOf(made->document)) EXPECT_LT(error.rmsPx, 0.1) << name;
  const ExportDocument twice = scaled(made->document, 2.0);
  for (const auto& [name, error] : errorsOf(twice)) EXPECT_LT(error.rmsPx, 0.1) << name;
}

TEST(StrokeWidths, GoOnThroughTheCornersOfALine) {
  // Two straight legs at a right angle, thinning from one end to the other.
  test::WidthStroke roof{"roof", false, {}};
  constexpr int kSteps = 2000;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = 600.0 * i / kSteps;
    const Vec2 at = s < 300.0 ? Vec2(200.3 + s, 200.4) : Vec2(500.3, 200.4 + s - 300.0);
    roof.places.push_back({at, s, 10.0 - s / 100.0});
  }
  const TracedPage page = traced({roof}, test::scannedPage(3));
  const ExportDocument document = exportDocument(page.output, page.recipe, page.scan);
  ASSERT_EQ(document.curves.size(), 1u);
  ASSERT_EQ(document.curves[0].pieces.size(), 2u);
  for (const ExportPiece& piece : document.curves[0].pieces) {
    ASSERT_TRUE(piece.width);
    EXPECT_LE(piece.width->samples.size(), 5u);
    EXPECT_LT(errorOf(piece.curve, *piece.width, roof, document.frame).rmsPx, 0.25);
  }
}

TEST(StrokeWidths, LinesWithoutWidthsHaveNone) {
  TracedPage page;
  page.scan = test::renderPage(test::widthCoverage(test::widthStrokes()), test::kWidthPagePx, test::kWidthPagePx,
                               test::cleanPage());
  page.recipe.edges.mode = EdgeMode::Outline;
  StageCache cache;
  page.output = runPipeline(page.scan, page.recipe, cache, {}, {});
  const ExportDocument document = exportDocument(page.output, page.recipe, page.scan);
  EXPECT_FALSE(document.curves.empty());
  for (const ExportCurve& line : document.curves)
    for (const ExportPiece& piece : line.pieces) EXPECT_FALSE(piece.width);
}

TEST(StrokeWidths, FilesThatHoldNoneAreTheSameWithoutMeasuringThem) {
  const TracedPage page = traced(test::widthStrokes(), test::scannedPage(3));
  const ExportDocument with = exportDocument(page.output, page.recipe, page.scan);
  const ExportDocument without =
      exportDocument(page.output, page.recipe, page.scan, ExportedCurves::Faired, ExportedWidths::None);
  for (const ExportCurve& line : without.curves)
    for (const ExportPiece& piece : line.pieces) EXPECT_FALSE(piece.width);
  for (const ExportFormat format : {ExportFormat::Svg, ExportFormat::Json, ExportFormat::Dxf, ExportFormat::Csv,
                                    ExportFormat::Polynomials, ExportFormat::Rhino}) {
    ExportSettings settings;
    settings.format = format;
    settings.widthOutlines = format == ExportFormat::Svg;
    const auto a = exportedFile(with, settings), b = exportedFile(without, settings);
    ASSERT_TRUE(a && b) << static_cast<int>(format);
    EXPECT_EQ(a->bytes == b->bytes, !holdsWidths(settings)) << static_cast<int>(format);
  }
}

}  // namespace
}  // namespace batten
