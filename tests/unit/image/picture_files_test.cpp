// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/picture_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "core/image/file/scan_grey.h"

namespace batten {
namespace {

using test::pictureFile, test::readByOpenCv;

ColourImage shadedPicture(int width, int height) {
  ColourImage picture(width, height);
  std::mt19937 random(3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto level = [&](double phase) {
        return static_cast<std::uint8_t>(120.0 + 90.0 * std::sin(0.07 * x + phase) * std::cos(0.05 * y) +
                                         random() % 20);
      };
      picture.row(y)[x] = {level(0.0), level(1.0), level(2.0)};
    }
  }
  return picture;
}

/// The program's own reading of a file beside that of OpenCV alone.
void expectSameAsOpenCv(std::vector<std::byte> file, bool isGrey) {
  const ColourImage expected = readByOpenCv(file);
  const auto read = decodePicture(file, {}, {});
  ASSERT_TRUE(read);
  ASSERT_EQ(read->grey.width, expected.width);
  ASSERT_EQ(read->grey.height, expected.height);
  ASSERT_EQ(read->colour.isEmpty(), isGrey);
  std::int64_t wrong = 0;
  for (int y = 0; y < expected.height; ++y) {
    for (int x = 0; x < expected.width; ++x) {
      const Rgb8& c = expected.row(y)[x];
      const auto luma =
          static_cast<std::uint16_t>((257ull * (299ull * c.red + 587ull * c.green + 114ull * c.blue) + 500) / 1000);
      wrong += read->grey.row(y)[x] != (isGrey ? 257 * c.red : luma) ? 1 : 0;
      wrong += !isGrey && !(read->colour.row(y)[x] == c) ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(PictureFiles, OfEveryKindGiveTheBytesThatOpenCvGives) {
  for (const char* ending : {".png", ".jpg", ".bmp", ".webp", ".tiff", ".pgm", ".ppm"}) {
    for (const bool isGrey : {true, false}) {
      if (isGrey ? std::string(ending) == ".ppm" : std::string(ending) == ".pgm") continue;
      if (std::string(ending) == ".webp" && isGrey) continue;  // has no grey
      SCOPED_TRACE(std::string(ending) + (isGrey ? " grey" : " colour"));
      expectSameAsOpenCv(pictureFile(shadedPicture(203, 151), ending, isGrey), isGrey);
    }
  }
}

TEST(PictureFiles, WithAChunkThatMayChangeThemAreReadToo) {
  std::vector<std::byte> file = pictureFile(shadedPicture(64, 48), ".png", true);
  // A gamma that is not sRGB's, behind the header of 33 bytes: 100000 = 1.
  constexpr unsigned char kGamma[] = {0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 1, 0x86, 0xa0, 0x31, 0xe8, 0x96, 0x5f};
  const auto* bytes = reinterpret_cast<const std::byte*>(kGamma);
  file.insert(file.begin() + 33, bytes, bytes + sizeof kGamma);
  expectSameAsOpenCv(file, true);
}

TEST(PictureFiles, ThatAreDamagedGiveNothingOrWhatOpenCvGives) {
  for (const char* ending : {".png", ".jpg"}) {
    std::vector<std::byte> file = pictureFile(shadedPicture(120, 90), ending, true);
    file.resize(file.size() / 2);
    const auto read = decodePicture(file, {}, {});
    if (read) {
      EXPECT_EQ(read->grey.width, 120);
    }
    std::vector<std::byte> none(file.begin(), file.begin() + 8);
    EXPECT_FALSE(decodePicture(none, {}, {}));
  }
}

}  // namespace
}  // namespace batten
