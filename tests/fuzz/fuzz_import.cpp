// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as curves or points of another program: refused with a reason, or lines that a recipe keeps and that become
// lines of a drawing. The first byte selects the kind of file.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/exchange/import_file.h"
#include "core/pipeline/recipe/recipe_file.h"
#include "core/pipeline/run/imported_lines.h"

namespace {

constexpr std::array<const char*, 6> kNames = {"in.dxf", "in.igs", "in.stp", "in.svg", "in.csv", "in.json"};
constexpr batten::PageFrame kFrame{100, 80, 0.1};

std::filesystem::path folder() {
  static const std::filesystem::path kFolder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "batten-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return std::filesystem::path(name);
  }();
  return kFolder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::filesystem::path path = folder() / kNames[data[0] % kNames.size()];
  std::ofstream(path, std::ios::binary) << std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto report = batten::readImportFile(path);
  if (!report) {
    if (report.error().message.empty()) std::abort();
    return 0;
  }
  batten::Recipe recipe;
  recipe.imports = {report->file};
  if (validate(recipe)) std::abort();  // what was read must be kept
  const auto again = batten::recipeFromJson(batten::recipeToJson(recipe));
  if (!again || *again != recipe) std::abort();
  const auto lines = batten::withImports({}, recipe.imports, kFrame);
  if (lines.contours.size() != report->file.lines.size()) std::abort();
  return 0;
}
