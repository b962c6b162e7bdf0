// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/file_names.h"

#include <string_view>

#include "core/base/platform.h"
#include "core/exchange/save_atomically.h"

namespace batten::cli {

namespace fs = std::filesystem;

std::string fileKey(const fs::path& path) {
  const auto textOf = [](const FileId& id) { return std::to_string(id.device) + ":" + std::to_string(id.number); };
  const fs::path target = saveTarget(path).value_or(path);
  if (const auto id = fileId(target)) return textOf(*id);
  const auto folder = fileId(target.has_parent_path() ? target.parent_path() : fs::path("."));
  if (folder && target.has_filename()) return textOf(*folder) + "/" + target.filename().string();
  std::error_code wrong;
  const fs::path whole = fs::weakly_canonical(fs::absolute(target, wrong), wrong);
  return (wrong ? target : whole).lexically_normal().string();
}

bool isSameFile(const fs::path& first, const fs::path& second) { return fileKey(first) == fileKey(second); }

std::string withPage(const std::string& name, int page) {
  if (name.empty()) return name;
  const fs::path path(name);
  std::string file = path.filename().string(), ending = path.extension().string();
  for (const char* whole : {".poly.csv", ".recipe.json", ".report.pdf", ".report.html"}) {
    if (file.size() > std::string_view(whole).size() && file.ends_with(whole)) ending = whole;
  }
  file.insert(file.size() - ending.size(), "-p" + std::to_string(page));
  return (path.parent_path() / file).string();
}

}  // namespace batten::cli
