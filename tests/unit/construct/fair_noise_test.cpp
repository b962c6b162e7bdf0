// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

/// Squares of standard normal values times `variance(u)`, a block every 8 px.
NoiseTrace traceOf(double length, std::uint32_t seed, const std::function<double(double)>& variance) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  NoiseTrace trace;
  trace.length = length;
  double z[3] = {normal(random), normal(random), 0.0};
  for (double u = 4.0; u < length; u += 8.0) {
    z[2] = normal(random);
    const double d = z[0] - 2.0 * z[1] + z[2];
    trace.blocks.push_back({u, variance(u) * d * d / 6.0});
    z[0] = z[1];
    z[1] = z[2];
  }
  return trace;
}

TEST(LocalNoise, EqualNoiseStaysEqual) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto noise = localNoise(
        {traceOf(2000.0, seed, [](double) { return 1.0; }), traceOf(150.0, seed + 50, [](double) { return 1.0; })});
    for (const LocalNoise& n : noise) {
      for (const auto& place : n.places) EXPECT_NEAR(std::log(place.factor), 0.0, 0.35) << seed;
    }
  }
}

TEST(LocalNoise, FollowsNoiseAlongALineAndBetweenPieces) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto noise = localNoise({traceOf(2000.0, seed, [](double u) { return u < 1000.0 ? 0.5 : 8.0; }),
                                   traceOf(600.0, seed + 50, [](double) { return 0.5; })});
    const double ratio = noise[0].at(1500.0) / noise[0].at(500.0);
    EXPECT_GT(ratio, 5.0) << seed;
    EXPECT_LT(ratio, 30.0) << seed;
    EXPECT_LT(noise[1].at(300.0), 0.5 * noise[0].at(1500.0)) << seed;
  }
}

TEST(LocalNoise, KnowsNothingWithoutBlocks) {
  const auto noise = localNoise({NoiseTrace{}, NoiseTrace{}});
  ASSERT_EQ(noise.size(), 2U);
  EXPECT_EQ(noise[0].at(12.0), 1.0);
}

/// Points every px with white noise across the line.
std::vector<Vec2> unevenPoints(const test::TrueCurve& c, const std::function<double(double)>& sigma,
                               std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec2> out;
  for (std::size_t i = 8; i < c.points.size(); i += 16)
    out.push_back(c.points[i] + sigma(static_cast<double>(i) * c.step) * normal(random) * c.normals[i]);
  return out;
}

constexpr double kLength = 1200.0;
double trueKappa(double s) { return 0.003 + 0.002 * std::sin(2.0 * std::numbers::pi * s / kLength); }
double unevenSigma(double s) { return s < 0.5 * kLength ? 0.04 : 0.3; }

ConstructedPiece fitUneven(std::uint32_t seed, bool told) {
  const auto truth = test::curveOfCurvature(kLength, trueKappa);
  ConstructContour contour;
  contour.pieces.resize(1);
  ConstructPiece& piece = contour.pieces[0];
  piece.points = piecePoints(unevenPoints(truth, unevenSigma, seed));
  for (std::size_t i = 0; told && i < piece.points.size(); ++i)
    piece.points[i].sigmaPx = static_cast<float>(unevenSigma((static_cast<double>(i) + 0.5)));
  auto fit = fairFit(contour, {}, {});
  EXPECT_TRUE(fit.has_value());
  return fit ? fit->front() : ConstructedPiece{};
}

/// rms of (kappa - truth) over the reported sigma in each half, away from the ends, and the share beyond two sigma.
struct NoiseBand {
  double square[2] = {0.0, 0.0}, beyond[2] = {0.0, 0.0}, kappaError[2] = {0.0, 0.0};
  int count[2] = {0, 0};
  void add(const ConstructedPiece& fit) {
    const auto profile = test::profileOf(fit.curve);
    const auto& report = fit.report;
    for (std::size_t i = 0; i < profile.s.size(); ++i) {
      const double s = profile.s[i];
      if (s < 80.0 || s > kLength - 80.0 || std::abs(s - 0.5 * kLength) < 60.0) continue;
      const auto at = std::ranges::lower_bound(report.noise.begin(), report.noise.end() - 1, s, {}, &NoiseNote::s);
      const double e = profile.kappa[i] - trueKappa(s), z = e / at->sigma;
      const int half = s < 0.5 * kLength ? 0 : 1;
      square[half] += z * z;
      kappaError[half] += e * e;
      beyond[half] += std::abs(z) > 2.0 ? 1.0 : 0.0;
      ++count[half];
    }
  }
};

TEST(FairFit, NoiseBandHoldsTheTruthWhereverTheNoiseIs) {
  for (const bool told : {false, true}) {
    NoiseBand band;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) band.add(fitUneven(seed, told));
    for (const int half : {0, 1}) {
      const double rms = std::sqrt(band.square[half] / band.count[half]);
      RecordProperty(std::string(told ? "told" : "untold") + std::to_string(half), std::to_string(rms));
      EXPECT_LT(band.beyond[half] / band.count[half], told ? 0.14 : 0.2) << told << half << ": rms " << rms;
      EXPECT_GT(rms, 0.45) << told << half;
    }
  }
}

TEST(FairFit, NoiseOfOneHalfDoesNotSpoilTheOther) {
  // The calm half may be as good as if all the line were calm, and all of it better than by equal weights.
  const auto truth = test::curveOfCurvature(kLength, trueKappa);
  NoiseBand uneven, calm;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    const ConstructedPiece fit = fitUneven(seed, true);
    uneven.add(fit);
    EXPECT_EQ(test::extremaOf(fit.curve, false).size(), 2U) << seed;
    auto all = test::fitOne(unevenPoints(
                                truth, [](double) { return 0.04; }, seed),
                            false);
    ASSERT_TRUE(all.has_value());
    calm.add(all->front());
  }
  EXPECT_LT(uneven.kappaError[0], 2.5 * calm.kappaError[0]);
}

TEST(FairFit, WeightsBringTheCurveNearer) {
  const auto truth = test::curveOfCurvature(kLength, trueKappa);
  const auto sigma = [](double s) { return std::fmod(s, 60.0) < 30.0 ? 0.03 : 0.3; };  // shorter than it can see itself
  double told = 0.0, untold = 0.0;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    ConstructContour contour;
    contour.pieces.resize(1);
    ConstructPiece& piece = contour.pieces[0];
    piece.points = piecePoints(unevenPoints(truth, sigma, seed));
    const auto without = fairFit(contour, {}, {});
    for (std::size_t i = 0; i < piece.points.size(); ++i)
      piece.points[i].sigmaPx = static_cast<float>(sigma(static_cast<double>(i) + 0.5));
    const auto with = fairFit(contour, {}, {});
    ASSERT_TRUE(with.has_value() && without.has_value());
    told += std::pow(test::rmsFrom(truth, with->front().curve), 2);
    untold += std::pow(test::rmsFrom(truth, without->front().curve), 2);
  }
  EXPECT_LT(told, 0.5 * untold);
}

TEST(FairFit, ChangesOfCurvatureHaveNoPlateaus) {
  // Rising curvature under noise: what the constraints hold flat is where the noise would have it fall.
  const auto truth = test::curveOfCurvature(900.0, [](double s) { return 0.001 + 4e-6 * s; });
  double flat = 0.0, all = 0.0;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const auto fit = test::fitOne(test::noisyPoints(truth, 0.2, seed), false);
    ASSERT_TRUE(fit.has_value());
    const auto p = test::profileOf(fit->front().curve, 6);
    const double mean = (p.kappa.back() - p.kappa.front()) / p.s.back();
    for (std::size_t i = 1; i < p.s.size(); ++i) {
      const double step = p.s[i] - p.s[i - 1];
      if (!(step > 0.0)) continue;
      all += step;
      if (std::abs(p.kappa[i] - p.kappa[i - 1]) < 0.05 * std::abs(mean) * step) flat += step;
    }
  }
  RecordProperty("flat", std::to_string(flat / all));
  EXPECT_LT(flat / all, 0.02);
}

/// The mean of strokes that were drawn over an arc: off it by waves that nobody meant.
ConstructContour wanderingArc(float spreadPx, double waves = 1.0) {
  const auto truth = test::curveOfCurvature(600.0, [](double s) { return 0.002 + 6e-6 * s; });
  ConstructContour contour;
  contour.isStroke = true;
  contour.pieces.resize(1);
  ConstructPiece& piece = contour.pieces[0];
  piece.points = piecePoints(test::noisyPoints(truth, 0.03, 5));
  for (std::size_t i = 0; i < piece.points.size(); ++i) {
    const double s = static_cast<double>(i);
    const double off = waves * (0.3 * std::sin(s / 11.0) + 0.2 * std::sin(s / 17.0 + 1.0));
    piece.points[i].at += off * truth.normals[std::min(truth.normals.size() - 1, 16 * i)];
    piece.points[i].spreadPx = spreadPx;
  }
  return contour;
}

TEST(FairNoise, WavesOfMergedStrokesAreNotDrawn) {
  const auto wavy = fairFit(wanderingArc(0.0f), {}, {}), fair = fairFit(wanderingArc(5.0f), {}, {});
  ASSERT_TRUE(wavy && fair);
  EXPECT_GE(test::extremaOf(wavy->front().curve, false).size(), 8U);
  EXPECT_EQ(test::extremaOf(fair->front().curve, false).size(), 0U);
  EXPECT_LT(fair->front().curve.controlPointCount(), wavy->front().curve.controlPointCount() / 2);
  const auto truth = test::curveOfCurvature(600.0, [](double s) { return 0.002 + 6e-6 * s; });
  EXPECT_LT(test::rmsFrom(truth, fair->front().curve), 0.3);
  const auto widest = [](const ConstructedPiece& p) {
    return std::ranges::max(p.report.noise, {}, &NoiseNote::sigma).sigma;
  };
  const auto calm = fairFit(wanderingArc(0.0f, 0.0), {}, {});
  ASSERT_TRUE(calm);
  EXPECT_GT(widest(fair->front()), 2.0 * widest(calm->front()));
}

TEST(FairNoise, StrokesThatWereNotMergedLeaveTheFitAsItWas) {
  ConstructContour one = wanderingArc(0.0f), none = one;
  for (PiecePoint& p : none.pieces[0].points) p.spreadPx.reset();
  const auto a = fairFit(one, {}, {}), b = fairFit(none, {}, {});
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(a->front().curve == b->front().curve);
}

}  // namespace
}  // namespace batten
