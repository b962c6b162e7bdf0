// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <string>

#include "core/image/file/scan_reader.h"
#include "core/image/pdf/pdf_page.h"

namespace batten {
namespace {

using testing::HasSubstr;

class ScanPages : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("batten-pages-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

std::string numberOf(std::uint32_t value, int count, bool big) {
  std::string text;
  for (int i = 0; i < count; ++i) text.push_back(static_cast<char>(value >> (8 * (big ? count - 1 - i : i)) & 0xffu));
  return text;
}

/// Grey pages of one row each, of their own width and resolution, one behind the other.
std::string tiffPages(const std::vector<std::string>& rows, bool big) {
  const auto n = [big](std::uint32_t value, int count) { return numberOf(value, count, big); };
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t value) {
    return n(tag, 2) + n(type, 2) + n(1, 4) + (type == 3 ? n(value, 2) + n(0, 2) : n(value, 4));
  };
  std::string file = (big ? "MM" : "II") + n(42, 2) + n(8, 4);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    constexpr std::uint32_t kEntries = 11;
    const auto at = static_cast<std::uint32_t>(file.size()), data = at + 2 + kEntries * 12 + 4;
    const auto width = static_cast<std::uint32_t>(rows[i].size());
    const std::uint32_t next = i + 1 < rows.size() ? data + 8 + width + width % 2 : 0;
    file += n(kEntries, 2) + entry(256, 3, width) + entry(257, 3, 1) + entry(258, 3, 8) + entry(259, 3, 1) +
            entry(262, 3, 1) + entry(273, 4, data + 8) + entry(278, 3, 1) + entry(279, 4, width) + entry(282, 5, data) +
            entry(283, 5, data) + entry(296, 3, 2) + n(next, 4) + n(100 * (static_cast<std::uint32_t>(i) + 1), 4) +
            n(1, 4) + rows[i] + std::string(width % 2, ' ');
  }
  return file;
}

TEST_F(ScanPages, EveryPageOfATiffIsReadByItsNumber) {
  const std::vector<std::string> rows = {"\x0a\x14", "\x1e\x28\x32", "\x3c\x46\x50\x5a"};
  for (const bool big : {false, true}) {
    const auto path = write("stack.tif", tiffPages(rows, big));
    EXPECT_EQ(countPages(path), 3);
    ContentHash hash;
    for (int page = 1; page <= 3; ++page) {
      const auto scan = readScan(path, {.page = {page, 300.0}}, {});
      ASSERT_TRUE(scan) << scan.error().message;
      EXPECT_EQ(scan->page.number, page);
      EXPECT_EQ(scan->pages, 3);
      EXPECT_EQ(scan->dpi, 100.0 * page);
      const std::string& row = rows[page - 1];
      ASSERT_EQ(scan->grey.width, std::ssize(row));
      for (int x = 0; x < scan->grey.width; ++x) {
        EXPECT_EQ(scan->grey.row(0)[x], 257 * row[x]) << page;
      }
      EXPECT_EQ(probeScan(path, {page, 300.0})->width, std::ssize(row));
      if (page > 1) {
        EXPECT_EQ(scan->fileHash.hex(), hash.hex()) << "the hash is that of the file";
      }
      hash = scan->fileHash;
    }
  }
}

TEST_F(ScanPages, APageThatIsNotThereIsRefused) {
  const auto stack = write("stack.tif", tiffPages({"ab", "cd"}, false));
  const auto third = readScan(stack, {.page = {3, 300.0}}, {});
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().code, ErrorCode::UnreadableScan);
  EXPECT_THAT(third.error().message, HasSubstr("has 2 pages: there is no page 3"));
  const auto pgm = readScan(write("a.pgm", "P5\n2 1\n255\nab"), {.page = {2, 300.0}}, {});
  ASSERT_FALSE(pgm);
  EXPECT_THAT(pgm.error().message, HasSubstr("one page only"));
  EXPECT_FALSE(readScan(stack, {.page = {0, 300.0}}, {}));
  EXPECT_FALSE(readScan(stack, {.page = {1, 5.0}}, {}));
  EXPECT_FALSE(probeScan(stack, {9, 300.0}));
}

std::string fromHexText(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

/// 8 x 6 grey, 10 + 20 x + 3 y, lossless; written by OpenJPEG.
const std::string kJp2 = fromHexText(
    "0000000c6a5020200d0a870a00000014667479706a703220000000006a7032200000002d6a7032680000001669686472000000060000"
    "00080001070700000000000f636f6c7201000000000011000000ac6a703263ff4fff5100290000000000080000000600000000000000"
    "00000000080000000600000000000000000001070101ff52000c00000001000004040001ff5c00044040ff6400250001437265617465"
    "64206279204f70656e4a5045472076657273696f6e20322e352e30ff90000a00000000003a0001ff93cfb4a4115023dd0fa9164a072e"
    "4298d7f67c23ca952538d6fcef5976f4756fb6e97cf3c22be31a8005101347ffd9");
constexpr std::size_t kCodestreamAt = 85;

/// A box of JP2.
std::string box(const std::string& type, const std::string& content) {
  return numberOf(static_cast<std::uint32_t>(content.size() + 8), 4, true) + type + content;
}

TEST_F(ScanPages, ReadsJpeg2000InAFileAndBare) {
  for (const std::string& bytes : {kJp2, kJp2.substr(kCodestreamAt)}) {
    const auto scan = readScan(write("a.jp2", bytes), {}, {});
    ASSERT_TRUE(scan) << scan.error().message;
    EXPECT_EQ(scan->info.format, "JPEG 2000");
    EXPECT_EQ(scan->info.bitsPerChannel, 8);
    EXPECT_FALSE(scan->dpi);
    ASSERT_EQ(scan->grey.width, 8);
    ASSERT_EQ(scan->grey.height, 6);
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 8; ++x) EXPECT_EQ(scan->grey.row(y)[x], 257 * (10 + 20 * x + 3 * y));
    }
  }
}

TEST_F(ScanPages, TakesTheResolutionOfJpeg2000) {
  // 11811 places a metre: 300 dpi, as 11811 / 1 and as 1.1811e4.
  const auto ratio = [](std::uint32_t above, std::uint32_t below) {
    return numberOf(above, 2, true) + numberOf(below, 2, true);
  };
  const std::string plain = ratio(11811, 1) + ratio(11811, 1) + std::string(2, '\0');
  const std::string power = ratio(11811, 10000) + ratio(11811, 10000) + std::string(2, '\4');
  for (const std::string& content : {plain, power}) {
    // The header box grows by that of the resolution.
    const std::string more = box("res ", box("resc", content));
    std::string bytes = kJp2;
    bytes.replace(32, 4, numberOf(45 + static_cast<std::uint32_t>(more.size()), 4, true));
    bytes.insert(32 + 45, more);
    const auto info = probeScan(write("r.jp2", bytes));
    ASSERT_TRUE(info) << info.error().message;
    EXPECT_EQ(info->dpi, 300.0);
    EXPECT_TRUE(readScan(folder_ / "r.jp2", {}, {}));
  }
}

TEST_F(ScanPages, DamagedJpeg2000IsToldFromWhole) {
  for (std::size_t length = 12; length < kJp2.size(); ++length) {
    const auto scan = readScan(write("cut.jp2", kJp2.substr(0, length)), {}, {});
    ASSERT_FALSE(scan) << length;
    EXPECT_EQ(scan.error().code, ErrorCode::UnreadableScan);
  }
  // A size of 2 gigapixels is refused before anything is allocated.
  std::string bomb = kJp2;
  bomb.replace(kCodestreamAt + 8, 8, numberOf(50000, 4, true) + numberOf(40000, 4, true));
  bomb.replace(kCodestreamAt + 24, 8, numberOf(50000, 4, true) + numberOf(40000, 4, true));  // one tile
  EXPECT_THAT(readScan(write("bomb.jp2", bomb), {.memoryBytes = 1'000'000'000}, {}).error().message,
              HasSubstr("memory"));
  // A million tiles.
  std::string tiles = kJp2;
  tiles.replace(kCodestreamAt + 8, 8, numberOf(30000, 4, true) + numberOf(30000, 4, true));
  tiles.replace(kCodestreamAt + 24, 8, numberOf(1, 4, true) + numberOf(1, 4, true));
  EXPECT_FALSE(readScan(write("tiles.jp2", tiles), {}, {}));
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = kJp2;
    for (int flips = 0; flips < 3; ++flips) {
      char& byte = bytes[12 + random() % (bytes.size() - 12)];
      byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    }
    const auto scan = readScan(write("turned.jp2", bytes), {.memoryBytes = 100'000'000}, {});
    if (!scan) {
      EXPECT_EQ(scan.error().code, ErrorCode::UnreadableScan);
    }
  }
}

/// A PDF of pages of 72 x 36 points: a black square of 18 points in the lower left corner, its side growing by 9 with
/// every page; the second is turned by a quarter.
std::string pdfOf(int pages) {
  std::string objects, kids, file = "%PDF-1.4\n";
  std::vector<std::size_t> places;
  const auto add = [&](const std::string& content) {
    places.push_back(file.size());
    file += std::to_string(places.size()) + " 0 obj\n" + content + "\nendobj\n";
  };
  for (int i = 0; i < pages; ++i) kids += std::to_string(3 + 2 * i) + " 0 R ";
  add("<< /Type /Catalog /Pages 2 0 R >>");
  add("<< /Type /Pages /Kids [ " + kids + "] /Count " + std::to_string(pages) + " >>");
  for (int i = 0; i < pages; ++i) {
    const std::string side = std::to_string(18 + 9 * i), stream = "0 0 0 rg 0 0 " + side + " " + side + " re f";
    add("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 72 36]" + std::string(i == 1 ? " /Rotate 90" : "") +
        " /Contents " + std::to_string(4 + 2 * i) + " 0 R /Resources << >> >>");
    add("<< /Length " + std::to_string(stream.size()) + " >>\nstream\n" + stream + "\nendstream");
  }
  const std::size_t table = file.size();
  file += "xref\n0 " + std::to_string(places.size() + 1) + "\n0000000000 65535 f \n";
  for (const std::size_t place : places) {
    const std::string digits = std::to_string(place);
    file += std::string(10 - digits.size(), '0') + digits + " 00000 n \n";
  }
  return file + "trailer\n<< /Size " + std::to_string(places.size() + 1) + " /Root 1 0 R >>\nstartxref\n" +
         std::to_string(table) + "\n%%EOF\n";
}

/// Pixels darker than the middle.
int darkPixels(const GreyImage& grey) {
  int dark = 0;
  for (const auto pixel : grey.pixels) dark += pixel < 32768 ? 1 : 0;
  return dark;
}

TEST_F(ScanPages, DrawsThePagesOfAPdfAtTheResolutionAskedFor) {
  const auto path = write("scan.pdf", pdfOf(3));
  if (!hasPdf()) {
    const auto scan = readScan(path, {}, {});
    ASSERT_FALSE(scan);
    EXPECT_THAT(scan.error().message, HasSubstr("libpoppler-qt6-dev"));
    return;
  }
  EXPECT_EQ(countPages(path), 3);
  for (const double dpi : {100.0, 300.0}) {
    const auto scan = readScan(path, {.page = {1, dpi}}, {});
    ASSERT_TRUE(scan) << scan.error().message;
    EXPECT_EQ(scan->info.format, "PDF");
    EXPECT_EQ(scan->dpi, dpi);
    EXPECT_EQ(scan->grey.width, dpi);
    EXPECT_EQ(scan->grey.height, 0.5 * dpi);
    EXPECT_EQ(scan->pages, 3);
    const double side = 18.0 * dpi / 72.0;
    EXPECT_NEAR(darkPixels(scan->grey), side * side, 2.5 * side);
    EXPECT_LT(scan->grey.row(scan->grey.height - 3)[2], 100) << "the square is at the lower left";
    EXPECT_GT(scan->grey.row(2)[2], 65000);
  }
  const auto turned = readScan(path, {.page = {2, 100.0}}, {});
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->grey.width, 50);
  EXPECT_EQ(turned->grey.height, 100);
  EXPECT_LT(turned->grey.row(2)[2], 100) << "turned clockwise, the corner is at the upper left";
  EXPECT_THAT(readScan(path, {.page = {4, 300.0}}, {}).error().message, HasSubstr("has 3 pages"));
  EXPECT_THAT(readScan(path, {.memoryBytes = 1000, .page = {1, 300.0}}, {}).error().message, HasSubstr("memory"));
  EXPECT_EQ(probeScan(path, {1, 600.0})->width, 600);
}

TEST_F(ScanPages, ADamagedPdfIsRefusedOrDrawn) {
  const std::string whole = pdfOf(2);
  for (std::size_t length = 5; length < whole.size(); length += 13) {
    const auto scan = readScan(write("cut.pdf", whole.substr(0, length)), {.page = {1, 50.0}}, {});
    if (!scan) {
      EXPECT_EQ(scan.error().code, ErrorCode::UnreadableScan);
    }
  }
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::string bytes = whole;
    for (int flips = 0; flips < 5; ++flips) {
      char& byte = bytes[5 + random() % (bytes.size() - 5)];
      byte = static_cast<char>(byte ^ (1 << (random() % 8)));
    }
    (void)readScan(write("turned.pdf", bytes), {.memoryBytes = 200'000'000, .page = {1, 50.0}}, {});
  }
  CancelToken token;
  token.cancel();
  RunContext context;
  context.cancel = token;
  const auto cancelledScan = readScan(write("whole.pdf", whole), {}, context);
  ASSERT_FALSE(cancelledScan);
  if (hasPdf()) {
    EXPECT_EQ(cancelledScan.error().code, ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace batten
