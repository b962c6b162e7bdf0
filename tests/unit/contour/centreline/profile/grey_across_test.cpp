// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/profile/grey_across.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/contour/centreline/profile/stroke_profile.h"

using namespace batten;

namespace {

GreyImage randomGrey(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  GreyImage grey(width, height);
  for (std::uint16_t& pixel : grey.pixels) pixel = static_cast<std::uint16_t>(random());
  return grey;
}

std::vector<float> randomRow(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> level(0.0f, 255.0f);
  std::vector<float> row(count);
  for (float& value : row) value = level(random);
  return row;
}

// Inside the page, across its borders and beyond them.
TEST(GreyAcross, SamplesAreThoseOfOnePlaceAfterTheOther) {
  std::mt19937 random(5);
  const GreyImage grey = randomGrey(97, 61, 1);
  std::uniform_real_distribution<double> x(-8.0, 105.0), y(-8.0, 69.0), angle(0.0, 7.0);
  for (int round = 0; round < 600; ++round) {
    const int half = 1 + round % 100;
    Vec2 at(x(random), y(random));
    if (round % 7 == 0) at = {std::floor(at.x()) + 0.5, std::floor(at.y())};
    const double turn = round % 11 == 0 ? 0.0 : angle(random);
    const Vec2 normal(std::cos(turn), std::sin(turn));
    std::vector<float> found(2 * half + 1);
    sampleAcross(grey, at, normal, half, found.data());
    for (int k = 0; k <= 2 * half; ++k) {
      const double u = (k - half) * kStrokeStepPx;
      ASSERT_EQ(found[k], sampleGrey(grey, at.x() + u * normal.x(), at.y() + u * normal.y())) << round << " " << k;
    }
  }
}

// Where all pixels around lie on the page, one need not look for its borders.
TEST(GreyAcross, SamplesInsideAreThoseOfAnywhere) {
  std::mt19937 random(6);
  const GreyImage grey = randomGrey(97, 61, 1);
  std::uniform_real_distribution<double> x(0.5, 96.5), y(0.5, 60.5);
  for (int round = 0; round < 2000; ++round) {
    const Vec2 at(round % 9 == 0 ? std::floor(x(random)) + 0.5 : x(random), y(random));
    if (at.x() >= 96.5) continue;
    ASSERT_EQ(sampleGreyInside(grey, at.x(), at.y()), sampleGrey(grey, at.x(), at.y())) << at.transpose();
  }
}

TEST(GreyAcross, MeansOfBoxesAddTheirSamplesUpInOrder) {
  for (const int box : {1, 3, kPaperSamples, 8}) {
    for (const int count : {1, 4, 31}) {
      const std::vector<float> row = randomRow(std::size_t(count + box), 9);
      std::vector<double> found(count);
      meansOfBoxes(row.data(), box, count, found.data());
      for (int k = 0; k < count; ++k) {
        double sum = 0.0;
        for (int j = 0; j < box; ++j) sum += row[k + j];
        ASSERT_EQ(found[k], sum / box) << box << " " << k;
      }
    }
  }
}

TEST(GreyAcross, MeanOfProfilesAddsThemUpInOrder) {
  for (const int count : {1, 7, 8, 33, 69, 300}) {
    const std::vector<float> rows = randomRow(std::size_t(kMeanRows) * std::size_t(count), 2);
    std::vector<float> weights(kMeanHalf + 1), found(count);
    float sum = 0.0f;
    for (int k = 0; k <= kMeanHalf; ++k) weights[k] = std::exp(-0.1f * static_cast<float>(k * k));
    for (int d = -kMeanHalf; d <= kMeanHalf; ++d) sum += weights[std::abs(d)];
    meanOfProfiles(rows.data(), count, weights.data(), sum, found.data());
    for (int k = 0; k < count; ++k) {
      float mean = 0.0f;
      for (int r = 0; r < kMeanRows; ++r) mean += weights[std::abs(r - kMeanHalf)] * rows[r * count + k];
      ASSERT_EQ(found[k], mean / sum);
    }
  }
}

TEST(GreyAcross, SmoothingKeepsALineAndLosesNoLightAtTheEnds) {
  for (const int count : {1, 3, 9, 10, 11, 12, 40, 71}) {
    std::vector<float> line(count), found(count);
    for (int k = 0; k < count; ++k) line[k] = 10.0f + 2.0f * static_cast<float>(k);
    smoothAcrossStroke(line.data(), count, found.data());
    for (int k = 0; k < count; ++k) EXPECT_NEAR(found[k], line[k], 1e-4) << count << " " << k;
  }
}

// A Gaussian of two samples, five to either side: an impulse shows it.
TEST(GreyAcross, SmoothingIsAGaussian) {
  std::vector<float> impulse(41, 0.0f), found(41);
  impulse[20] = 1.0f;
  smoothAcrossStroke(impulse.data(), 41, found.data());
  double sum = 0.0;
  for (int d = -5; d <= 5; ++d) sum += std::exp(-d * d / 8.0);
  for (int k = 0; k < 41; ++k) {
    const int d = k - 20;
    EXPECT_NEAR(found[k], std::abs(d) <= 5 ? std::exp(-d * d / 8.0) / sum : 0.0, 5e-3) << k;
  }
}

}  // namespace
