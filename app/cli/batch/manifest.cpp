// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/manifest.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/number_text.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

tl::unexpected<Error> wrongLine(std::string message) { return fail(ErrorCode::BadParameter, std::move(message)); }

/// One name for one file, without asking the disk: a manifest may have a hundred thousand lines.
std::string plainName(const std::string& name) {
  std::error_code code;
  const fs::path whole = fs::absolute(name, code);
  return (code ? fs::path(name) : whole).lexically_normal().generic_string();
}

/// "name=value" of a JSON value that is a text, a number or a truth value.
std::optional<std::string> settingOf(const std::string& name, const Json& value) {
  if (value.is_string()) return name + "=" + value.get<std::string>();
  if (value.is_boolean()) return name + (value.get<bool>() ? "=true" : "=false");
  if (value.is_number()) return name + "=" + numberToText(value.get<double>());
  return std::nullopt;
}

/// Takes one entry of a line over; what is wrong with it, if anything.
std::optional<std::string> takeEntry(const std::string& key, const Json& value, BatchPage& page) {
  const auto isText = [](const Json& one) { return one.is_string() && !one.get<std::string>().empty(); };
  if (key == "scan") {
    if (!isText(value)) return "\"scan\" takes the name of a file";
    page.scan = value.get<std::string>();
  } else if (key == "outputs") {
    if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), isText)) {
      return "\"outputs\" takes a list of names that end in .svg or .json";
    }
    for (const Json& one : value) page.outputs.push_back(one.get<std::string>());
  } else if (key == "recipe") {
    if (!isText(value)) return "\"recipe\" takes the name of a file";
    page.recipe = value.get<std::string>();
  } else if (key == "set") {
    if (!value.is_object() && !value.is_array()) return "\"set\" takes {\"stage.parameter\": value}";
    for (const auto& [name, one] : value.items()) {
      const auto setting = value.is_array() ? (isText(one) ? std::optional(one.get<std::string>()) : std::nullopt)
                                            : settingOf(name, one);
      if (!setting) return "\"set\" takes {\"stage.parameter\": value}";
      page.settings.push_back(*setting);
    }
  } else if (key == "dpi") {
    if (!value.is_number()) return "\"dpi\" takes a number";
    page.dpi = value.get<double>();
  } else if (key == "page") {
    const auto number = value.is_number_integer() ? integerFromText(value.dump()) : std::nullopt;
    if (!number || *number < 1) return "\"page\" takes the number of a page of the scan, from 1";
    page.page = *number;
  } else {
    return "there is no \"" + key + "\": a line has scan, outputs, recipe, set, dpi and page";
  }
  return std::nullopt;
}

Result<BatchPage> pageOf(std::string_view text, int line, const PageDefaults& defaults) {
  const std::string where = "Line " + std::to_string(line) + " of the manifest: ";
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object())
    return wrongLine(where + "it is no JSON object. Write {\"scan\": \"a.png\", \"outputs\": [\"a.svg\"]}.");
  BatchPage page;
  page.line = line;
  page.recipe = defaults.recipe;
  page.settings = defaults.settings;
  page.dpi = defaults.dpi;
  for (const auto& [key, value] : json.items()) {
    if (const auto problem = takeEntry(key, value, page)) return wrongLine(where + *problem + ".");
  }
  if (page.scan.empty()) return wrongLine(where + "\"scan\" is missing.");
  if (page.outputs.empty()) return wrongLine(where + "\"outputs\" is missing.");
  return page;
}

/// No file is written twice, nor over a scan or a recipe.
Result<void> checkFiles(const std::vector<BatchPage>& pages) {
  std::set<std::string> read;
  std::map<std::string, int> written;
  for (const BatchPage& page : pages) {
    read.insert(plainName(page.scan));
    if (!page.recipe.empty()) read.insert(plainName(page.recipe));
  }
  for (const BatchPage& page : pages) {
    const std::string where = "Line " + std::to_string(page.line) + " of the manifest: ";
    for (const std::string& output : page.outputs) {
      const std::string name = plainName(output);
      if (read.contains(name))
        return wrongLine(where + output + " is a scan or a recipe. Give the output another name.");
      const auto [before, isNew] = written.emplace(name, page.line);
      if (!isNew) {
        return wrongLine(where + output + " is written by line " + std::to_string(before->second) +
                         " as well. Give every output its own name.");
      }
    }
  }
  return {};
}

bool isScanName(const fs::path& path) {
  static const std::set<std::string> known = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".pdf",
                                              ".jp2", ".j2k", ".webp", ".pgm", ".pbm",  ".ppm", ".pnm"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return known.contains(extension);
}

/// Whether a name matches a pattern in which * is any text and ? any letter.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, mark = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++p, ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++, mark = n;
    } else if (star != std::string_view::npos) {
      p = star + 1, n = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

struct FoundScan {
  fs::path scan;
  fs::path inFolder;  ///< The folder within the one that was searched.
};

/// The scans that an input names, in the order of names; what lies in the folder of the outputs is none.
Result<std::vector<FoundScan>> scansOf(const std::string& input, const std::string& outputs) {
  const fs::path path(input);
  std::error_code code;
  std::vector<FoundScan> found;
  if (fs::is_directory(path, code)) {
    for (auto it = fs::recursive_directory_iterator(path, fs::directory_options::skip_permission_denied, code);
         !code && it != fs::recursive_directory_iterator(); it.increment(code)) {
      std::error_code ignored;
      if (it->is_directory(ignored) && fs::equivalent(it->path(), outputs, ignored)) it.disable_recursion_pending();
      if (!it->is_regular_file(ignored) || !isScanName(it->path())) continue;
      found.push_back({it->path(), it->path().lexically_relative(path).parent_path()});
    }
  } else if (const std::string last = path.filename().string(); last.find_first_of("*?") != std::string::npos) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (auto it = fs::directory_iterator(folder, code); !code && it != fs::directory_iterator(); it.increment(code)) {
      if (!matches(last, it->path().filename().string()) || !isScanName(it->path())) continue;
      found.push_back({path.has_parent_path() ? it->path() : it->path().filename(), {}});
    }
  } else if (fs::exists(path, code)) {
    found.push_back({path, {}});
  }
  if (found.empty()) {
    return wrongLine("There is no scan in " + input +
                     ". Name scans, a folder of them, a pattern, a manifest that ends in .jsonl, or - for stdin.");
  }
  std::sort(found.begin(), found.end(), [](const FoundScan& a, const FoundScan& b) { return a.scan < b.scan; });
  return found;
}

}  // namespace

Result<std::vector<BatchPage>> readManifest(std::string_view text, const PageDefaults& defaults) {
  std::vector<BatchPage> pages;
  int line = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view one = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line;
    if (one.empty()) continue;
    auto page = pageOf(one, line, defaults);
    if (!page) return fail(page.error());
    pages.push_back(std::move(*page));
  }
  if (pages.empty()) return wrongLine("The manifest holds no page. Write one JSON object a line.");
  if (auto checked = checkFiles(pages); !checked) return fail(checked.error());
  return pages;
}

std::string manifestLine(const BatchPage& page) {
  Json json{{"scan", page.scan}, {"outputs", page.outputs}};
  if (!page.recipe.empty()) json["recipe"] = page.recipe;
  if (!page.settings.empty()) json["set"] = page.settings;
  if (page.dpi) json["dpi"] = *page.dpi;
  if (page.page != 1) json["page"] = page.page;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<std::vector<BatchPage>> pagesOf(const std::vector<std::string>& inputs, const std::string& folder,
                                       const std::vector<std::string>& extensions, const PageDefaults& defaults) {
  std::vector<FoundScan> scans;
  for (const std::string& input : inputs) {
    auto found = scansOf(input, folder);
    if (!found) return fail(found.error());
    scans.insert(scans.end(), found->begin(), found->end());
  }
  const auto stemOf = [&](const FoundScan& one) { return (fs::path(folder) / one.inFolder / one.scan.stem()); };
  std::map<fs::path, int> sameStem;
  for (const FoundScan& one : scans) ++sameStem[stemOf(one)];
  std::vector<BatchPage> pages;
  for (const FoundScan& one : scans) {
    BatchPage page;
    page.line = static_cast<int>(pages.size()) + 1;
    page.scan = one.scan.generic_string();
    page.recipe = defaults.recipe;
    page.settings = defaults.settings;
    page.dpi = defaults.dpi;
    std::error_code code;
    const fs::path beside = fs::path(one.scan).replace_extension(".recipe.json");
    if (page.recipe.empty() && fs::is_regular_file(beside, code)) page.recipe = beside.generic_string();
    std::string name = stemOf(one).generic_string();
    if (sameStem[stemOf(one)] > 1) name += one.scan.extension().string();
    for (const std::string& extension : extensions) page.outputs.push_back(name + "." + extension);
    pages.push_back(std::move(page));
  }
  if (auto checked = checkFiles(pages); !checked) return fail(checked.error());
  return pages;
}

std::vector<std::string> traceWords(const BatchPage& page, int threads) {
  std::vector<std::string> words{"trace", page.scan.starts_with("-") ? "./" + page.scan : page.scan};
  for (const std::string& output : page.outputs) words.insert(words.end(), {"-o", output});
  if (!page.recipe.empty()) words.insert(words.end(), {"--recipe", page.recipe});
  for (const std::string& setting : page.settings) words.insert(words.end(), {"--set", setting});
  if (page.dpi) words.insert(words.end(), {"--dpi", numberToText(*page.dpi)});
  if (page.page != 1) words.insert(words.end(), {"--page", std::to_string(page.page)});
  words.insert(words.end(), {"--threads", std::to_string(threads)});
  return words;
}

}  // namespace batten::cli
