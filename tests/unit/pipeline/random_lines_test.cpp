// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing diverges: random lines, noise up to 2 px, 6 to 60 stations, inflections and nearly straight parts, through
// every construction and every way of fairing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/construct/construct.h"
#include "core/construct/pieces.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/fairing/edge_length_fairing.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "tests/support/asked_count.h"

namespace batten {
namespace {

constexpr double kSpacing = 12.0;

/// Points about 2 px apart along a random turning with a straight middle, and the stations that regression finds.
ConstructPiece randomPiece(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const int stations = 6 + static_cast<int>(uniform(random) * uniform(random) * 55.0);
  const double length = kSpacing * (stations - 1), bend = 5.0 * uniform(random) * uniform(random);
  const double wave = 8.0 * uniform(random), phase = 6.0 * uniform(random),
               noise = 2.0 * std::pow(uniform(random), 2.0);
  const double straightFrom = uniform(random), straightTo = straightFrom + 0.4 * uniform(random);
  std::normal_distribution<double> normal(0.0, noise);
  Piece piece;
  Vec2 at(300.0 * uniform(random), 300.0 * uniform(random));
  double angle = 6.28 * uniform(random);
  const int steps = static_cast<int>(length / 2.0);
  for (int i = 0; i <= steps; ++i) {
    const double x = normal(random), y = normal(random);
    piece.points.push_back({at + Vec2(x, y)});
    const double f = static_cast<double>(i) / steps;
    const bool straight = f > straightFrom && f < straightTo;
    angle += straight ? 0.0 : bend / steps * (0.3 + std::sin(wave * f + phase));
    at += 2.0 * Vec2(std::cos(angle), std::sin(angle));
  }
  piece.lengthPx = length;
  PieceSet set;
  set.pieces.push_back(piece);
  SegmentParams params;
  params.count = stations;
  ConstructPiece made;
  made.points = piece.points;
  const auto segments = regressionSegments(set, params, {});
  if (segments) made.stations = segments->pieces[0].stations;
  made.startIsCorner = uniform(random) < 0.5;
  made.endIsCorner = uniform(random) < 0.5;
  return made;
}

bool isFinite(const NurbsCurve& curve) {
  for (const Vec2& p : curve.controlPoints()) {
    if (!p.allFinite()) return false;
  }
  return true;
}

struct Way {
  std::string name;
  std::vector<std::string> settings;
};

/// All words of a choice, so that a new way is tested as soon as it is there.
std::vector<std::string> wordsOf(const char* parameter) { return findParameter(parameter)->choices; }

std::vector<Way> constructions() {
  std::vector<Way> all;
  for (const std::string& word : wordsOf("construct.method")) all.push_back({word, {"construct.method=" + word}});
  all.push_back({"growing", {"construct.method=typical", "construct.typical=growing"}});
  all.push_back({"directions", {"construct.method=nurbs", "construct.gradients=directions"}});
  all.push_back({"no low pass", {"construct.method=bezier", "construct.lowpass=0"}});
  return all;
}

std::vector<Way> fairings() {
  std::vector<Way> all;
  for (const std::string& word : wordsOf("fairing.mode")) {
    if (word != "none") all.push_back({word, {"fairing.mode=" + word}});
  }
  all.push_back({"whole tolerance", {"fairing.mode=tolerance", "fairing.spend=all"}});
  all.push_back({"edge lengths", {"fairing.mode=target", "fairing.moves=edges"}});
  all.push_back({"edge lengths, low pass", {"fairing.mode=lowpass", "fairing.moves=edges"}});
  return all;
}

Recipe recipeOf(const Way& way) {
  Recipe recipe;
  for (const std::string& setting : way.settings) {
    const auto equals = setting.find('=');
    EXPECT_TRUE(setParameter(recipe, setting.substr(0, equals), setting.substr(equals + 1)));
  }
  return recipe;
}

void expectSoundConstruction(const ConstructedPiece& made, const ConstructPiece& piece) {
  ASSERT_TRUE(isFinite(made.curve));
  EXPECT_NE(made.report.why, Termination::NotRun);
  const NurbsCurve& curve = made.curve;
  const double size = extent(curve);
  if (piece.startIsCorner) {
    EXPECT_LT((curve.point(curve.start()) - piece.points.front().at).norm(), 1e-9 * size);
  }
  if (piece.endIsCorner) {
    EXPECT_LT((curve.point(curve.end()) - piece.points.back().at).norm(), 1e-9 * size);
  }
  for (const SegmentNote& note : made.report.segments) {
    EXPECT_TRUE(std::isfinite(note.length) && std::isfinite(note.startKappa) && std::isfinite(note.endKappa));
    if (note.typical) {
      EXPECT_TRUE(note.monotone);
    }
  }
}

/// Largest distance of places of one curve from the other, each against the whole of it.
double farthest(const NurbsCurve& from, const NurbsCurve& to) {
  constexpr int kPlaces = 611;  // none of the places at which the fairing looks
  std::vector<Vec2> points;
  for (int i = 0; i <= kPlaces; ++i)
    points.push_back(from.point(from.start() + (from.end() - from.start()) * i / kPlaces));
  return deviation(to, points, false).max;
}

void expectSoundFairing(const NurbsCurve& start, const FairedCurve& faired, double tolerance) {
  ASSERT_TRUE(isFinite(faired.curve));
  const double size = extent(start);
  EXPECT_NE(faired.report.why, Termination::NotRun);
  EXPECT_LE(faired.report.maxDeviationMm, tolerance * (1.0 + 1e-9));
  EXPECT_LE(farthest(faired.curve, start), 1.005 * tolerance);
  EXPECT_LT((faired.curve.point(faired.curve.start()) - start.point(start.start())).norm(), 1e-9 * size);
  EXPECT_LT((faired.curve.point(faired.curve.end()) - start.point(start.end())).norm(), 1e-9 * size);
}

/// Lines of a case: 5, a dozen seconds of processor time; BATTEN_LINES_OF_A_CASE sets another number (packaging/check:
/// 100).
int linesOfACase() { return test::askedCount("BATTEN_LINES_OF_A_CASE", 3); }

/// Every construction of its line, then every way of fairing one of the curves.
class RandomLines : public testing::TestWithParam<int> {};

TEST_P(RandomLines, GiveSoundCurvesInEveryWay) {
  std::mt19937 random(static_cast<unsigned>(1000 + GetParam()));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto ways = constructions();
  const std::vector<Way> modes = fairings();
  for (int trial = 0; trial < linesOfACase(); ++trial) {
    ConstructContour contour;
    contour.pieces.push_back(randomPiece(random));
    std::vector<NurbsCurve> curves;
    for (const Way& way : ways) {
      SCOPED_TRACE(way.name + ", line " + std::to_string(trial));
      const auto made = construct(contour, recipeOf(way).construct, {});
      ASSERT_TRUE(made) << made.error().message;
      expectSoundConstruction(made->front(), contour.pieces[0]);
      // Fairing starts from the dense curve, where it is kept beside a light one.
      const ConstructedPiece& first = made->front();
      curves.push_back(first.dense.value_or(first.curve));
    }
    for (std::size_t i = 0; i < modes.size(); ++i) {
      // The curves take turns: every mode meets every construction.
      const NurbsCurve& curve = curves[(trial + i) % curves.size()];
      SCOPED_TRACE("fairing " + modes[i].name + ", line " + std::to_string(trial));
      Recipe recipe = recipeOf(modes[i]);
      recipe.fairing.target = *targetOfNumber(trial % 7);
      recipe.fairing.toleranceMm = 0.02 * std::pow(100.0, uniform(random));
      recipe.fairing.targets.monotone = trial % 3 != 0;
      const FairingLine line{trial % 2 == 0 ? positionsOf(contour.pieces[0].points) : std::vector<Vec2>{}, 1.0};
      const auto faired = movesEdgeLengths(recipe.fairing) ? fairByEdgeLengths(curve, false, recipe.fairing, {})
                                                           : fair(curve, false, recipe.fairing, {}, line);
      ASSERT_TRUE(faired) << faired.error().message;
      expectSoundFairing(curve, *faired, recipe.fairing.toleranceMm);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TenTimes, RandomLines, testing::Range(0, 10));

}  // namespace
}  // namespace batten
