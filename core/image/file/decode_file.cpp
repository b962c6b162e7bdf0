// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/decode_file.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "core/base/loaded_module.h"
#include "core/image/file/byte_reader.h"
#include "core/image/rare_pictures/rare_pictures.h"

namespace batten {
namespace {

/// Whether a PNG holds nothing that changes its samples on the way: no palette, transparency, gamma other than sRGB's
/// or profile. Chunks that a reader may pass over begin with a small letter.
bool isPlainPng(const ByteReader& file) {
  // chunks that may be passed over and yet change samples
  constexpr std::array<std::string_view, 5> kTelling = {"iCCP", "tRNS", "sBIT", "cICP", "gAMA"};
  constexpr std::array<std::string_view, 2> kNeeded = {"IHDR", "IDAT"};  // needed chunks that change none
  constexpr std::uint32_t kGammaOfSrgb = 45455;                          // 1 / 2.2, times 100 000 as PNG stores it
  const std::uint32_t colour = file.u8(25);
  if (file.u8(24) != 8 || (colour != 0 && colour != 2)) return false;
  for (std::uint64_t at = 8; file.has(at, 12); at += file.u32(at) + 12ull) {
    const auto isOneOf = [&](const auto& names) {
      return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return file.matches(at + 4, name); });
    };
    if (file.matches(at + 4, "IEND")) return true;
    if (file.matches(at + 4, "gAMA") && file.u32(at + 8) == kGammaOfSrgb) continue;
    const bool mayBePassedOver = (file.u8(at + 4) & 0x20u) != 0;
    if (mayBePassedOver ? isOneOf(kTelling) : !isOneOf(kNeeded)) return false;
  }
  return false;
}

cv::Mat decodePng(std::span<const std::byte> file) {
  if (!isPlainPng(ByteReader(file))) return {};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) return {};
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&image, [](png_image* p) { png_image_free(p); });
  const bool isGrey = (image.format & PNG_FORMAT_FLAG_COLOR) == 0;
  image.format = isGrey ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  cv::Mat picture(static_cast<int>(image.height), static_cast<int>(image.width), isGrey ? CV_8UC1 : CV_8UC3);
  const auto stride = static_cast<png_int_32>(picture.step[0]);
  // A warning, too: the other decoder is to say what becomes of such a file.
  if (png_image_finish_read(&image, nullptr, picture.data, stride, nullptr) == 0 || image.warning_or_error != 0)
    return {};
  return picture;
}

cv::Mat decodeJpeg(std::span<const std::byte> file) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  if (!decoder) return {};
  const auto* bytes = reinterpret_cast<const unsigned char*>(file.data());
  int width = 0, height = 0, sampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, file.size(), &width, &height, &sampling, &colours) != 0) return {};
  if (colours != TJCS_GRAY && colours != TJCS_YCbCr) return {};
  const bool isGrey = colours == TJCS_GRAY;
  cv::Mat picture(height, width, isGrey ? CV_8UC1 : CV_8UC3);
  const int done = tjDecompress2(decoder.get(), bytes, file.size(), picture.data, width,
                                 static_cast<int>(picture.step[0]), height, isGrey ? TJPF_GRAY : TJPF_BGR, 0);
  return done == 0 ? picture : cv::Mat();
}

DecodeRarePicture rareDecoder() {
  static const auto decode = reinterpret_cast<DecodeRarePicture>(functionOfModule(kRarePictures, kDecodeRarePicture));
  return decode;
}

}  // namespace

cv::Mat decodePlainFile(std::span<const std::byte> file) {
  const ByteReader reader(file);
  if (reader.matches(0, "\x89PNG\r\n\x1a\n")) return decodePng(file);
  if (reader.matches(0, "\xff\xd8\xff")) return decodeJpeg(file);
  return {};
}

bool hasRareDecoder() { return rareDecoder() != nullptr; }

cv::Mat decodeFile(std::span<const std::byte> file) {
  cv::Mat picture = decodePlainFile(file);
  if (picture.empty() && hasRareDecoder()) rareDecoder()(file.data(), file.size(), picture);
  return picture;
}

}  // namespace batten
