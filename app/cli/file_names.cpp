// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/file_names.h"

#include <string_view>

#include "core/base/platform.h"
#include "core/exchange/save_atomically.h"

namespace batten::cli {

namespace fs = std::filesystem;

std::string fileKey(const fs::path& path) {
  const auto textOf = [](const FileId& id) { return std::to_string(id.device) + ":" + std::to_string(id.number); };
  const auto keyOf = [&](const fs::path& name) -> std::string {
    if (const auto id = fileId(name)) return textOf(*id);
    const auto folder = fileId(name.has_parent_path() ? name.parent_path() : fs::path("."));
    return folder && name.has_filename() ? textOf(*folder) + "/" + name.filename().string() : std::string();
  };
  const fs::path target = saveTarget(path).value_or(path);
  if (std::string key = keyOf(target); !key.empty()) return key;
  // Of "none/../scan.png", where there is no folder "none", the name counts that is left without both.
  std::error_code wrong;
  const fs::path whole = fs::weakly_canonical(fs::absolute(target, wrong), wrong);
  const fs::path plain = (wrong ? target : whole).lexically_normal();
  const std::string key = keyOf(plain);
  return key.empty() ? plain.string() : key;
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
