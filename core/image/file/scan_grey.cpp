// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_grey.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "core/base/parallel.h"
#include "core/image/file/decode_file.h"

namespace batten {
namespace {

/// One row to 16-bit grey. `Unit` is what one step of the sample is worth on the 16-bit scale: 257 for 8 bit, 1 for 16.
template <class Sample, std::uint32_t Unit>
void greyRow(const Sample* in, std::uint16_t* out, int count, int channels, bool associated) {
  constexpr std::uint64_t kWhite = std::numeric_limits<Sample>::max();  // of the samples of the file
  if (channels == 1) {
    for (int i = 0; i < count; ++i) out[i] = static_cast<std::uint16_t>(in[i] * Unit);
    return;
  }
  for (int i = 0; i < count; ++i, in += channels) {
    const std::uint64_t luma =
        channels == 2 ? in[0] * 1000ull : 114ull * in[0] + 587ull * in[1] + 299ull * in[2];  // stored blue first
    if (channels == 3) {
      out[i] = static_cast<std::uint16_t>((luma * Unit + 500) / 1000);
      continue;
    }
    const std::uint64_t alpha = in[channels - 1];
    const std::uint64_t covered = std::min(luma * (associated ? kWhite : alpha), 1000 * kWhite * alpha);
    const std::uint64_t mixed = covered + 1000 * kWhite * (kWhite - alpha);
    out[i] = static_cast<std::uint16_t>((mixed * Unit + 500 * kWhite) / (1000 * kWhite));
  }
}

/// One row to colours of 8 bit, alpha over white. `Unit` as in greyRow. @pre channels is 3 or 4.
template <class Sample, std::uint32_t Unit>
void colourRow(const Sample* in, Rgb8* out, int count, int channels, bool associated) {
  constexpr std::uint64_t kWhite = std::numeric_limits<Sample>::max();  // of the samples of the file
  constexpr std::uint64_t kStep = 257 / Unit;                           // samples a step of 8 bit
  for (int i = 0; i < count; ++i, in += channels) {
    const std::uint64_t alpha = channels == 4 ? in[3] : kWhite;
    const auto level = [&](Sample sample) {
      const std::uint64_t covered =
          associated ? std::min<std::uint64_t>(sample, alpha) : (sample * alpha + kWhite / 2) / kWhite;
      return static_cast<std::uint8_t>((covered + kWhite - alpha + kStep / 2) / kStep);
    };
    out[i] = {level(in[2]), level(in[1]), level(in[0])};
  }
}

template <class Sample>
bool hasColour(const Sample* in, int count, int channels) {
  for (int i = 0; i < count; ++i, in += channels) {
    if (in[0] != in[1] || in[1] != in[2]) return true;
  }
  return false;
}

/// False for grey stored as colour.
bool hasColour(const cv::Mat& picture, const RunContext& context) {
  if (picture.channels() < 3) return false;
  std::atomic<bool> found = false;
  parallelFor(context, picture.rows, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end && !found.load(std::memory_order_relaxed); ++y) {
      if (picture.depth() == CV_16U ? hasColour(picture.ptr<std::uint16_t>(y), picture.cols, picture.channels())
                                    : hasColour(picture.ptr<std::uint8_t>(y), picture.cols, picture.channels()))
        found = true;
    }
  });
  return found;
}

/// The rows [begin, end) of the upright picture.
template <class Image>
void rotateRows(const Image& in, int orientation, int begin, int end, Image& upright) {
  const int lastX = in.width - 1, lastY = in.height - 1;
  const auto from = [&](int x, int y) { return in.row(y)[x]; };
  for (int y = begin; y < end; ++y) {
    auto* row = upright.row(y);
    for (int x = 0; x < upright.width; ++x) {
      switch (orientation) {
        case 2:
          row[x] = from(lastX - x, y);
          break;
        case 3:
          row[x] = from(lastX - x, lastY - y);
          break;
        case 4:
          row[x] = from(x, lastY - y);
          break;
        case 5:
          row[x] = from(y, x);
          break;
        case 6:
          row[x] = from(y, lastY - x);
          break;
        case 7:
          row[x] = from(lastX - y, lastY - x);
          break;
        default:
          row[x] = from(lastX - y, x);
          break;
      }
    }
  }
}

template <class Image>
Image rotatedUpright(Image image, int orientation, const RunContext& context) {
  if (orientation <= 1 || orientation > 8 || image.pixels.empty()) return image;
  const bool swapped = orientation >= 5;
  Image upright(swapped ? image.height : image.width, swapped ? image.width : image.height);
  parallelFor(context, upright.height, kRowsPerBlock,
              [&](int begin, int end) { rotateRows(image, orientation, begin, end, upright); });
  return upright;
}

/// The key level on the 16-bit scale: levels of few bits are spread over it.
std::optional<std::uint16_t> keyLevel(const SampleMeaning& meaning) {
  if (!meaning.transparent) return std::nullopt;
  const std::uint32_t white = (1u << meaning.bits) - 1;
  return static_cast<std::uint16_t>((*meaning.transparent & white) * (65535u / white));
}

}  // namespace

std::optional<DecodedPicture> decodePicture(std::span<std::byte> file, const SampleMeaning& meaning,
                                            const RunContext& context) {
  const cv::Mat picture = decodeFile(file);
  if (picture.empty() || picture.channels() > 4) return std::nullopt;
  if (picture.depth() != CV_8U && picture.depth() != CV_16U) return std::nullopt;
  // TIFFs of up to 8 bit come by way of RGBA: white is white then, and every alpha associated. Wider ones come as
  // stored.
  const bool deep = picture.depth() == CV_16U;
  const bool associated = meaning.isTiff && (!deep || meaning.alphaAssociated);
  const bool inverted = meaning.minIsWhite && deep && picture.channels() == 1;
  const auto key = picture.channels() == 1 ? keyLevel(meaning) : std::nullopt;
  const int channels = picture.channels();
  GreyImage grey(picture.cols, picture.rows);
  ColourImage colour = hasColour(picture, context) ? ColourImage(picture.cols, picture.rows) : ColourImage();
  parallelFor(context, picture.rows, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint16_t* const row = grey.row(y);
      if (deep) {
        greyRow<std::uint16_t, 1>(picture.ptr<std::uint16_t>(y), row, picture.cols, channels, associated);
      } else {
        greyRow<std::uint8_t, 257>(picture.ptr<std::uint8_t>(y), row, picture.cols, channels, associated);
      }
      if (!colour.isEmpty() && deep)
        colourRow<std::uint16_t, 1>(picture.ptr<std::uint16_t>(y), colour.row(y), picture.cols, channels, associated);
      if (!colour.isEmpty() && !deep)
        colourRow<std::uint8_t, 257>(picture.ptr<std::uint8_t>(y), colour.row(y), picture.cols, channels, associated);
      if (inverted) std::transform(row, row + picture.cols, row, [](std::uint16_t v) { return ~v & 0xffff; });
      if (key) std::replace(row, row + picture.cols, *key, std::uint16_t{0xffff});
    }
  });
  return DecodedPicture{std::move(grey), std::move(colour)};
}

GreyImage rotateUpright(GreyImage image, int orientation, const RunContext& context) {
  return rotatedUpright(std::move(image), orientation, context);
}

ColourImage rotateUpright(ColourImage image, int orientation, const RunContext& context) {
  return rotatedUpright(std::move(image), orientation, context);
}

void dropGreyColours(ColourImage& colour, const RunContext& context) {
  std::atomic<bool> hasColour = false;
  parallelFor(context, colour.height, kRowsPerBlock, [&](int begin, int end) {
    if (hasColour.load(std::memory_order_relaxed)) return;
    const Rgb8* first = colour.row(begin);
    const Rgb8* last = first + std::ptrdiff_t{end - begin} * colour.width;
    if (!std::all_of(first, last, [](const Rgb8& c) { return c.isGrey(); })) hasColour = true;
  });
  if (!hasColour) colour = ColourImage();
}

}  // namespace batten
