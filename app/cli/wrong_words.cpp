// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/wrong_words.h"

#include <algorithm>
#include <cctype>

namespace batten::cli {

std::string endingOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace batten::cli
