// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/scan_grey.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "core/base/parallel.h"

namespace batten {
namespace {

/// One row to 16-bit grey. `Unit` is what one step of the sample is worth on the 16-bit scale: 257 for 8 bit, 1 for 16.
template <class Sample, std::uint32_t Unit>
void greyRow(const Sample* in, std::uint16_t* out, int count, int channels, bool associated) {
  constexpr std::uint64_t kWhite = std::numeric_limits<Sample>::max();
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

/// The key level on the 16-bit scale: levels of few bits are spread over it.
std::optional<std::uint16_t> keyLevel(const SampleMeaning& meaning) {
  if (!meaning.transparent) return std::nullopt;
  const std::uint32_t white = (1u << meaning.bits) - 1;
  return static_cast<std::uint16_t>((*meaning.transparent & white) * (65535u / white));
}

}  // namespace

std::optional<GreyImage> decodeGrey(std::span<std::byte> file, const SampleMeaning& meaning,
                                    const RunContext& context) {
  const cv::Mat raw(1, static_cast<int>(file.size()), CV_8UC1, file.data());
  const cv::Mat picture = cv::imdecode(raw, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
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
  parallelFor(context, picture.rows, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint16_t* const row = grey.row(y);
      if (deep) {
        greyRow<std::uint16_t, 1>(picture.ptr<std::uint16_t>(y), row, picture.cols, channels, associated);
      } else {
        greyRow<std::uint8_t, 257>(picture.ptr<std::uint8_t>(y), row, picture.cols, channels, associated);
      }
      if (inverted) std::transform(row, row + picture.cols, row, [](std::uint16_t v) { return ~v & 0xffff; });
      if (key) std::replace(row, row + picture.cols, *key, std::uint16_t{0xffff});
    }
  });
  return grey;
}

GreyImage turnUpright(GreyImage image, int orientation, const RunContext& context) {
  if (orientation <= 1 || orientation > 8) return image;
  const bool swapped = orientation >= 5;
  GreyImage upright(swapped ? image.height : image.width, swapped ? image.width : image.height);
  const int lastX = image.width - 1, lastY = image.height - 1;
  parallelFor(context, upright.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      std::uint16_t* out = upright.row(y);
      for (int x = 0; x < upright.width; ++x) {
        switch (orientation) {
          case 2:
            out[x] = image.row(y)[lastX - x];
            break;
          case 3:
            out[x] = image.row(lastY - y)[lastX - x];
            break;
          case 4:
            out[x] = image.row(lastY - y)[x];
            break;
          case 5:
            out[x] = image.row(x)[y];
            break;
          case 6:
            out[x] = image.row(lastY - x)[y];
            break;
          case 7:
            out[x] = image.row(lastY - x)[lastX - y];
            break;
          default:
            out[x] = image.row(x)[lastX - y];
            break;
        }
      }
    }
  });
  return upright;
}

}  // namespace batten
