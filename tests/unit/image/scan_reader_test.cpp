// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/image/file/scan_grey.h"
#include "tests/unit/image/picture_bytes.h"

namespace batten {
namespace {

using test::big;
using test::chunk;
using test::fromHex;
using test::little;
using test::png;
using test::tiff;
using test::tiffOf;
using testing::HasSubstr;

class ScanReader : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("scan_reader_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::string refusal(const std::filesystem::path& path, const ScanRequest& limits = {}) const {
    const auto scan = readScan(path, limits, {});
    if (scan) return "read";
    EXPECT_EQ(scan.error().code, ErrorCode::UnreadableScan);
    EXPECT_EQ(scan.error().message.find('\n'), std::string::npos);
    return scan.error().message;
  }
  std::filesystem::path folder_;
};

std::vector<int> levels(const GreyImage& grey) {
  std::vector<int> values;
  for (const auto pixel : grey.pixels) values.push_back(static_cast<int>(pixel / 257.0 + 0.5));
  return values;
}

TEST_F(ScanReader, SaysWhatIsWrongWithWhatIsNoPicture) {
  EXPECT_THAT(refusal(folder_ / "none.png"), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(folder_), HasSubstr("directory"));
  EXPECT_THAT(refusal(write("empty.png", "")), HasSubstr("empty"));
  EXPECT_THAT(refusal(write("text.png", "this is no picture at all")), HasSubstr("is not a PNG"));
  EXPECT_THAT(refusal(write("short.png", "\x89PNG\r\n\x1a\n")), HasSubstr("truncated"));
  EXPECT_EQ(probeScan(folder_).error().code, ErrorCode::UnreadableScan);
}

TEST_F(ScanReader, ReadsGreyPngOfEveryDepth) {
  const struct {
    int bits;
    std::string row;
    std::vector<int> expected;
  } cases[] = {
      {1, std::string("\0\xa0", 2), {255, 0, 255}},
      {2, std::string("\0\x6c", 2), {85, 170, 255}},
      {4, std::string("\0\x5a\xf0", 3), {85, 170, 255}},
      {8, std::string("\0\x01\x80\xff", 4), {1, 128, 255}},
      {16, std::string("\0\x01\x01\x80\x80\xff\xff", 7), {1, 128, 255}},
  };
  for (const auto& c : cases) {
    const auto scan = readScan(write("grey.png", png(3, 1, c.bits, 0, c.row)), {}, {});
    ASSERT_TRUE(scan.has_value()) << c.bits << ": " << scan.error().message;
    EXPECT_EQ(levels(scan->grey), c.expected) << c.bits;
    EXPECT_EQ(scan->info.bitsPerChannel, c.bits);
    EXPECT_FALSE(scan->dpi.has_value());
  }
}

TEST_F(ScanReader, LaysAlphaOverWhiteAndTakesTheLumaOfColour) {
  const std::string row = std::string("\0", 1) + std::string("\xff\0\0\xff", 4) + std::string("\0\0\0\x80", 4) +
                          std::string("\x12\x34\x56\0", 4);
  const auto scan = readScan(write("alpha.png", png(3, 1, 8, 6, row)), {}, {});
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(levels(scan->grey), (std::vector<int>{76, 127, 255}));
  const std::string palette = chunk("PLTE", std::string("\0\0\0\xff\xff\xff\0\xff\0", 9));
  const auto indexed = readScan(write("p.png", png(3, 1, 8, 3, std::string("\0\0\1\2", 4), palette)), {}, {});
  ASSERT_TRUE(indexed.has_value());
  EXPECT_EQ(levels(indexed->grey), (std::vector<int>{0, 255, 150}));
}

TEST_F(ScanReader, KeepsTheColoursOfAColourScanOnly) {
  const std::string row = std::string("\0", 1) + std::string("\xff\0\0\xff", 4) + std::string("\0\0\0\x80", 4) +
                          std::string("\x12\x34\x56\0", 4);
  const auto scan = readScan(write("colour.png", png(3, 1, 8, 6, row)), {}, {});
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(scan->colour.pixels, (std::vector<Rgb8>{{255, 0, 0}, {127, 127, 127}, {255, 255, 255}}));
  EXPECT_EQ(scan->colour.width, 3);
  const std::string grey = std::string("\0", 1) + std::string("\x40\x40\x40\x80\x80\x80", 6);
  EXPECT_TRUE(readScan(write("grey.png", png(2, 1, 8, 2, grey)), {}, {})->colour.isEmpty());
  EXPECT_TRUE(
      readScan(write("grey8.png", png(3, 1, 8, 0, std::string("\0\x01\x80\xff", 4))), {}, {})->colour.isEmpty());
  const std::string deep = std::string("\0", 1) + std::string("\x80\x80\x10\x10\xff\xff", 6);
  const auto sixteen = readScan(write("deep.png", png(1, 1, 16, 2, deep)), {}, {});
  ASSERT_TRUE(sixteen.has_value());
  EXPECT_EQ(sixteen->colour.pixels, (std::vector<Rgb8>{{0x80, 0x10, 0xff}}));
}

TEST_F(ScanReader, ReadsResolutionAndHash) {
  const std::string phys = chunk("pHYs", big(11811) + big(11811) + '\1');
  const auto scan = readScan(write("dpi.png", png(1, 1, 8, 0, std::string("\0\7", 2), phys)), {}, {});
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(scan->dpi, 300.0);
  const auto bytes = png(1, 1, 8, 0, std::string("\0\7", 2), phys);
  EXPECT_EQ(scan->fileHash, sha256(std::as_bytes(std::span(bytes))));
  EXPECT_NEAR(pageFrame(*scan, scan->dpi).mmPerPx, 25.4 / 300.0, 1e-12);
  EXPECT_NEAR(pageFrame(*scan, {}).mmPerPx, 25.4 / 96.0, 1e-12);
}

TEST_F(ScanReader, RefusesTruncatedAndDamagedPng) {
  std::string bytes = png(3, 1, 8, 0, std::string("\0\1\2\3", 4));
  EXPECT_THAT(refusal(write("cut.png", bytes.substr(0, bytes.size() - 12))), HasSubstr("truncated"));
  EXPECT_THAT(refusal(write("cut2.png", bytes.substr(0, bytes.size() - 20))), HasSubstr("truncated"));
  bytes[bytes.size() - 20] = static_cast<char>(bytes[bytes.size() - 20] ^ 1);
  EXPECT_THAT(refusal(write("bad.png", bytes)), HasSubstr("damaged"));
}

TEST_F(ScanReader, RefusesWhatDoesNotFitIntoMemory) {
  const auto path = write("huge.png", png(30000, 30000, 8, 0, std::string(1, '\0')));
  const std::string message = refusal(path, {.memoryBytes = 1'000'000'000});
  EXPECT_THAT(message, HasSubstr("30000 x 30000 px need 2.70 GB"));
  EXPECT_THAT(message, HasSubstr("1.00 GB are free. Scan at a lower resolution or crop."));
  EXPECT_EQ(probeScan(path)->width, 30000);
  EXPECT_THAT(refusal(write("more.png", png(60000, 60000, 1, 0, "x"))), HasSubstr("too large"));
}

TEST_F(ScanReader, TurnsTiffUprightByItsOrientation) {
  const std::vector<std::vector<int>> expected = {
      {10, 20, 30, 40, 50, 60}, {30, 20, 10, 60, 50, 40}, {60, 50, 40, 30, 20, 10}, {40, 50, 60, 10, 20, 30},
      {10, 40, 20, 50, 30, 60}, {40, 10, 50, 20, 60, 30}, {60, 30, 50, 20, 40, 10}, {30, 60, 20, 50, 10, 40}};
  for (std::uint32_t orientation = 1; orientation <= 8; ++orientation) {
    const auto scan = readScan(write("turn.tif", tiff(orientation)), {}, {});
    ASSERT_TRUE(scan.has_value()) << scan.error().message;
    EXPECT_EQ(levels(scan->grey), expected[orientation - 1]) << orientation;
    EXPECT_EQ(scan->grey.width, orientation >= 5 ? 2 : 3);
    EXPECT_EQ(scan->dpi, 300.0);
  }
  EXPECT_THAT(refusal(write("cut.tif", tiff(1).substr(0, tiff(1).size() - 2))), HasSubstr("truncated"));
}

TEST(TurnUpright, TurnsColoursAsItTurnsGrey) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    GreyImage grey(4, 3);
    ColourImage colour(4, 3);
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
      grey.pixels[i] = static_cast<std::uint16_t>(i);
      colour.pixels[i] = {static_cast<std::uint8_t>(i), 0, 0};
    }
    grey = rotateUpright(std::move(grey), orientation, {});
    colour = rotateUpright(std::move(colour), orientation, {});
    ASSERT_EQ(colour.width, grey.width);
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) EXPECT_EQ(colour.pixels[i].red, grey.pixels[i]) << orientation;
  }
}

TEST_F(ScanReader, ReadsTiffsWhoseZeroIsWhiteOrBlack) {
  const struct {
    std::uint32_t bits;
    std::string data;
    std::vector<int> expected;
  } cases[] = {
      {1, std::string("\xa0", 1), {255, 0, 255}},
      {8, std::string("\x01\x80\xff", 3), {1, 128, 255}},
      {16, std::string("\x01\x01\x80\x80\xff\xff", 6), {1, 128, 255}},
  };
  for (const auto& c : cases) {
    for (const std::uint32_t photometric : {1u, 0u}) {
      const auto scan = readScan(write("grey.tif", tiffOf(3, 1, {c.bits, photometric, 1, 0}, c.data)), {}, {});
      ASSERT_TRUE(scan.has_value()) << c.bits << ": " << scan.error().message;
      std::vector<int> expected = c.expected;
      if (photometric == 0)
        for (int& level : expected) level = 255 - level;
      EXPECT_EQ(levels(scan->grey), expected) << c.bits << " bit, photometric " << photometric;
    }
  }
}

TEST_F(ScanReader, LaysTheAlphaOfTiffsOverWhiteWhetherAssociatedOrNot) {
  // Full red; black, half covered; a light grey, half covered, as is (200) and multiplied already (100); nothing.
  const std::string straight = fromHex(
      "ff0000ff"
      "00000080"
      "c8c8c880"
      "12345600");
  const std::string associated = fromHex(
      "ff0000ff"
      "00000080"
      "64646480"
      "00000000");
  const std::vector<int> expected{76, 127, 227, 255};
  const auto wide = [](const std::string& data) {  // every sample twice: 16 bit
    std::string twice;
    for (const char c : data) twice.append(2, c);
    return twice;
  };
  for (const auto& [extra, data] : {std::pair{2u, straight}, {1u, associated}}) {
    for (const std::uint32_t bits : {8u, 16u}) {
      const auto scan =
          readScan(write("a.tif", tiffOf(4, 1, {bits, 2, 4, extra}, bits == 8 ? data : wide(data))), {}, {});
      ASSERT_TRUE(scan.has_value()) << scan.error().message;
      const auto found = levels(scan->grey);
      for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(found[i], expected[i], 1) << bits << " bit, " << extra << ", " << i;
    }
  }
}

TEST_F(ScanReader, RefusesGreyTiffsWhoseAlphaTheDecoderDrops) {
  const std::string data = fromHex("c88000ff7700");
  for (const std::uint32_t extra : {1u, 2u})
    EXPECT_THAT(refusal(write("ga.tif", tiffOf(3, 1, {8, 1, 2, extra}, data))), HasSubstr("as PNG"));
  // A second sample that is no alpha, a mask as painting programs keep them, does not matter.
  const auto scan = readScan(write("mask.tif", tiffOf(3, 1, {8, 1, 2, 0}, data)), {}, {});
  ASSERT_TRUE(scan.has_value()) << scan.error().message;
  EXPECT_EQ(levels(scan->grey), (std::vector<int>{200, 0, 119}));
}

TEST_F(ScanReader, TakesTheKeyColourOfPngsForPaper) {
  const struct {
    int bits;
    std::string row, key;
    std::vector<int> expected;
  } greys[] = {
      {1, std::string("\0\x80", 2), std::string("\0\0", 2), {255, 255, 255}},
      {2, std::string("\0\x6c", 2), std::string("\0\1", 2), {255, 170, 255}},
      {4, std::string("\0\x5a\xf0", 3), std::string("\0\xa", 2), {85, 255, 255}},
      {8, std::string("\0\x01\x80\xff", 4), std::string("\0\1", 2), {255, 128, 255}},
      {16, std::string("\0\x01\x01\x80\x80\x80\x81", 7), std::string("\x80\x80", 2), {1, 255, 128}},
  };
  for (const auto& c : greys) {
    const auto scan = readScan(write("key.png", png(3, 1, c.bits, 0, c.row, chunk("tRNS", c.key))), {}, {});
    ASSERT_TRUE(scan.has_value()) << c.bits << ": " << scan.error().message;
    EXPECT_EQ(levels(scan->grey), c.expected) << c.bits << " bit";
  }
  const std::string key8 = fromHex("000a00140001"), row8 = std::string("\0", 1) + fromHex(
                                                                                      "0a1401"
                                                                                      "0a1402"
                                                                                      "000000");
  const auto colour = readScan(write("rgb.png", png(3, 1, 8, 2, row8, chunk("tRNS", key8))), {}, {});
  ASSERT_TRUE(colour.has_value()) << colour.error().message;
  EXPECT_EQ(levels(colour->grey), (std::vector<int>{255, 15, 0}));
  const std::string key16 = fromHex("0a0014000100");
  const std::string row16 = std::string("\0", 1) + fromHex(
                                                       "0a0014000100"
                                                       "0a0014000101"
                                                       "000000000000");
  const auto deep = readScan(write("deep.png", png(3, 1, 16, 2, row16, chunk("tRNS", key16))), {}, {});
  ASSERT_TRUE(deep.has_value()) << deep.error().message;
  EXPECT_EQ(levels(deep->grey), (std::vector<int>{255, 15, 0}));
}

TEST_F(ScanReader, ReadsPnmAndRefusesItTruncated) {
  const auto grey = readScan(write("a.pgm", "P5\n# made by hand\n3 1\n255\n\x0a\x14\x1e"), {}, {});
  ASSERT_TRUE(grey.has_value()) << grey.error().message;
  EXPECT_EQ(levels(grey->grey), (std::vector<int>{10, 20, 30}));
  const auto bits = readScan(write("a.pbm", "P4\n3 1\n\xa0"), {}, {});
  ASSERT_TRUE(bits.has_value()) << bits.error().message;
  EXPECT_EQ(levels(bits->grey), (std::vector<int>{0, 255, 0}));
  EXPECT_THAT(refusal(write("b.pgm", "P5\n3 2\n255\nabc")), HasSubstr("truncated"));
}

TEST_F(ScanReader, ReadsBmpFromTheBottomUp) {
  const auto row = std::string("\x0a\x0a\x0a\x14\x14\x14\x1e\x1e\x1e\0\0\0", 12);  // three bytes fill the row
  const auto last = std::string("\xff\0\0\0\xff\0\0\0\xff\0\0\0", 12);             // blue, green, red
  const std::string bytes = "BM" + little(54 + 24, 4) + little(0, 4) + little(54, 4) + little(40, 4) + little(3, 4) +
                            little(2, 4) + little(1, 2) + little(24, 2) + little(0, 4) + little(24, 4) +
                            little(11811, 4) + little(11811, 4) + little(0, 4) + little(0, 4) + last + row;
  const auto scan = readScan(write("a.bmp", bytes), {}, {});
  ASSERT_TRUE(scan.has_value()) << scan.error().message;
  EXPECT_EQ(levels(scan->grey), (std::vector<int>{10, 20, 30, 29, 150, 76}));
  EXPECT_EQ(scan->info.format, "BMP");
  EXPECT_EQ(scan->dpi, 300.0);
  EXPECT_THAT(refusal(write("cut.bmp", bytes.substr(0, bytes.size() - 9))), HasSubstr("truncated"));
}

/// 3 x 2 pixels of grey 120 each, written once by a common encoder.
TEST_F(ScanReader, ReadsJpegAndWebp) {
  const std::string jpeg = fromHex(
      "ffd8ffe000104a46494600010100000100010000ffdb00430001010101010101010101010101010101010101010101010101010101010101"
      "01"
      "0101010101010101010101010101010101010101010101010101010101010101ffc0000b080002000301011100ffc4001400010000000000"
      "00"
      "00000000000000000007ffc40014100100000000000000000000000000000000ffda0008010100003f003f7fffd9");
  const std::string webp = fromHex("524946461e000000574542505650384c110000002f024000000750bce215afff8188e87f0000");
  for (const auto& [name, format, bytes] : {std::tuple{"a.jpg", "JPEG", jpeg}, std::tuple{"a.webp", "WebP", webp}}) {
    const auto path = write(name, bytes);
    const auto scan = readScan(path, {}, {});
    ASSERT_TRUE(scan.has_value()) << scan.error().message;
    EXPECT_EQ(scan->info.format, format);
    EXPECT_EQ(scan->grey.width, 3);
    EXPECT_EQ(levels(scan->grey), std::vector<int>(6, 120));
    EXPECT_EQ(probeScan(path)->height, 2);
    EXPECT_THAT(refusal(write(std::string("cut") + name, bytes.substr(0, bytes.size() - 6))), HasSubstr("truncated"));
  }
}

TEST_F(ScanReader, NamesTheFileAsItWasGiven) {
  EXPECT_THAT(refusal("/nonexist"), HasSubstr("\"/nonexist\""));
  EXPECT_THAT(refusal("no such folder/none.png"), HasSubstr("\"no such folder/none.png\""));
}

TEST_F(ScanReader, StopsWhenCancelled) {
  RunContext context;
  context.cancel.cancel();
  const auto scan = readScan(write("a.png", png(1, 1, 8, 0, std::string("\0\7", 2))), {}, context);
  EXPECT_EQ(scan.error().code, ErrorCode::Cancelled);
}

/// Grey TIFF of one tile, uncompressed, whose tags state any size of picture and tile.
std::string tiledTiff(std::uint32_t width, std::uint32_t height, std::uint32_t tileWidth, std::uint32_t tileHeight,
                      const std::string& data) {
  const auto entry = [](std::uint32_t tag, std::uint32_t value) {
    return little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
  };
  const std::uint32_t start = 8 + 2 + 10 * 12 + 4;
  return "II" + little(42, 2) + little(8, 4) + little(10, 2) + entry(256, width) + entry(257, height) + entry(258, 8) +
         entry(259, 1) + entry(262, 1) + entry(277, 1) + entry(322, tileWidth) + entry(323, tileHeight) +
         entry(324, start) + entry(325, static_cast<std::uint32_t>(data.size())) + little(0, 4) + data;
}

TEST_F(ScanReader, TilesFarLargerThanThePictureAreRefusedBeforeTheyTakeMemory) {
  for (const auto& [w, h] : {std::pair{32752u, 32752u}, {1u << 20, 4096u}, {0xfffffff0u, 0xfffffff0u}}) {
    EXPECT_THAT(refusal(write("bomb.tif", tiledTiff(60, 40, w, h, std::string(64, '\0')))), HasSubstr("tiles"));
  }
  // A tile may well be larger than a small picture.
  std::string pixels(256 * 256, '\xff');
  pixels[0] = 10;
  const auto scan = readScan(write("tile.tif", tiledTiff(60, 40, 256, 256, pixels)), {}, {});
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_EQ(scan->grey.width, 60);
  EXPECT_EQ(levels(scan->grey)[0], 10);
  // And counts as memory.
  EXPECT_THAT(refusal(folder_ / "tile.tif", {.memoryBytes = 200'000}), HasSubstr("memory"));
}

/// The picture of tiff() with a second directory behind it, of that kind (NewSubfileType).
std::string tiffOfTwo(std::uint32_t kind) {
  std::string file = tiff(1);
  const std::size_t next = 8 + 2 + 13 * 12;  // where the first directory names the next one
  file.replace(next, 4, little(static_cast<std::uint32_t>(file.size()), 4));
  const auto entry = [](std::uint32_t tag, std::uint32_t value) {
    return little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
  };
  return file + little(3, 2) + entry(254, kind) + entry(256, 3) + entry(257, 2) + little(0, 4);
}

TEST_F(ScanReader, CountsThePagesOfATiff) {
  const auto pagesOf = [&](const std::string& bytes) {
    const auto path = write("pages.tif", bytes);
    EXPECT_TRUE(readScan(path, {}, {}));
    return countPages(path);
  };
  EXPECT_EQ(pagesOf(tiff(1)), 1);
  EXPECT_EQ(pagesOf(tiffOfTwo(0)), 2);
  EXPECT_EQ(pagesOf(tiffOfTwo(2)), 2) << "a page of several";
  EXPECT_EQ(pagesOf(tiffOfTwo(1)), 1) << "a thumbnail";
  // A directory that names itself as the next one.
  std::string round = tiff(1);
  round.replace(8 + 2 + 13 * 12, 4, little(8, 4));
  EXPECT_EQ(pagesOf(round), 1);
  EXPECT_EQ(countPages(folder_ / "none.tif"), 1);
}

}  // namespace
}  // namespace batten
