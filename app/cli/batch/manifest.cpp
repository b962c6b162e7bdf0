// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/manifest.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "app/cli/batch/name_json.h"
#include "app/cli/file_names.h"
#include "core/base/json_text.h"
#include "core/base/name_text.h"
#include "core/base/number_text.h"
#include "core/base/platform.h"
#include "core/base/shown_text.h"
#include "core/image/file/scan_reader.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

tl::unexpected<Error> wrongLine(std::string message) { return fail(ErrorCode::BadParameter, std::move(message)); }

/// "name=value" of a JSON value that is a text, a number or a truth value.
std::optional<std::string> settingOf(const std::string& name, const Json& value) {
  if (value.is_string()) return name + "=" + value.get<std::string>();
  if (value.is_boolean()) return name + (value.get<bool>() ? "=true" : "=false");
  if (value.is_number()) return name + "=" + numberToText(value.get<double>());
  return std::nullopt;
}

constexpr int kAllPages = 0;  // stands in BatchPage::page until the scan's pages are counted

/// Takes one entry of a line over; what is wrong with it, if anything.
std::optional<std::string> takeEntry(const std::string& key, const Json& value, BatchPage& page) {
  const auto nameIn = [](const Json& one) {
    return one.is_string() ? nameOfText(one.get<std::string>()) : std::string();
  };
  const auto isText = [&](const Json& one) {
    const std::string name = nameIn(one);
    return !name.empty() && name.find('\0') == std::string::npos;
  };
  if (key == "scan") {
    if (!isText(value)) return "\"scan\" takes the name of a file";
    page.scan = nameIn(value);
  } else if (key == "outputs") {
    if (!value.is_array() || value.empty() || !std::all_of(value.begin(), value.end(), isText)) {
      return "\"outputs\" takes a list of names that end in .svg, .json or another format's ending";
    }
    for (const Json& one : value) page.outputs.push_back(nameIn(one));
  } else if (key == "recipe") {
    if (!isText(value)) return "\"recipe\" takes the name of a file";
    page.recipe = nameIn(value);
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
    if (value == "all") {
      page.page = kAllPages;
      return std::nullopt;
    }
    const auto number = value.is_number_integer() ? integerFromText(value.dump()) : std::nullopt;
    if (!number || *number < 1) return "\"page\" takes the number of a page of the scan, from 1, or \"all\"";
    page.page = *number;
    page.isPageNamed = true;
  } else {
    return "there is no " + quotedText(key) + ": a line has scan, outputs, recipe, set, dpi and page";
  }
  return std::nullopt;
}

Result<BatchPage> pageOf(std::string_view text, int line, const PageDefaults& defaults) {
  const std::string where = "Line " + std::to_string(line) + " of the manifest: ";
  const auto parsed = parseJson(parsableLine(text));
  // A limit says what is wrong; that the text is no JSON at all is said with the form it should have.
  if (!parsed && parsed.error().detail.empty()) return wrongLine(where + parsed.error().message + ".");
  if (!parsed || !parsed->is_object())
    return wrongLine(where + "not a JSON object. Write {\"scan\": \"a.png\", \"outputs\": [\"a.svg\"]}.");
  BatchPage page;
  page.line = line;
  page.recipe = defaults.recipe;
  page.settings = defaults.settings;
  page.dpi = defaults.dpi;
  for (const auto& [key, value] : parsed->items()) {
    if (const auto problem = takeEntry(key, value, page)) return wrongLine(where + *problem + ".");
  }
  if (page.scan.empty()) return wrongLine(where + "\"scan\" is missing.");
  if (page.outputs.empty()) return wrongLine(where + "\"outputs\" is missing.");
  return page;
}

/// No file is written twice, nor over a scan or a recipe.
Result<void> checkFiles(const std::vector<BatchPage>& pages) {
  std::unordered_set<std::string> read;
  struct Writer {
    int line = 0;
    bool isRecord = false;
  };
  std::unordered_map<std::string, Writer> written;
  for (const BatchPage& page : pages) {
    read.insert(fileKey(page.scan));
    if (!page.recipe.empty()) read.insert(fileKey(page.recipe));
  }
  for (const BatchPage& page : pages) {
    const std::string where = "Line " + std::to_string(page.line) + " of the manifest: ";
    const auto take = [&](const std::string& file, bool isRecord) -> Result<void> {
      const std::string key = fileKey(file),
                        what = isRecord ? shownText(file) + ", which is kept beside the output," : shownText(file);
      if (read.contains(key)) return wrongLine(where + what + " is a scan or a recipe. Give the output another name.");
      const auto [before, isNew] = written.emplace(key, Writer{page.line, isRecord});
      if (isNew) return {};
      return wrongLine(where + what + " is written by line " + std::to_string(before->second.line) + " as well" +
                       (before->second.isRecord ? ", to keep what is known of its page" : "") +
                       ". Give every output its own name.");
    };
    for (const std::string& output : page.outputs) {
      if (auto taken = take(output, false); !taken) return taken;
    }
    for (const std::string& own : {recordName(page), lockName(page)}) {
      if (auto taken = take(own, true); !taken) return taken;
    }
  }
  return {};
}

/// One page for each that the scan's file holds, if all are wanted; else the page itself.
std::vector<BatchPage> everyPageOf(const BatchPage& page) {
  if (page.page != kAllPages) return {page};
  const QuietStderr quiet;
  std::vector<BatchPage> pages(countPages(page.scan), page);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    pages[i].page = static_cast<int>(i) + 1;
    pages[i].isPageNamed = pages.size() > 1;
    for (std::string& output : pages[i].outputs) output = withPage(output, pages[i].page);
  }
  return pages;
}

std::string endingOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Whether a scan of this name may hold several pages, and does.
bool holdsPages(const fs::path& scan) {
  const std::string ending = endingOf(scan);
  if (ending != ".tif" && ending != ".tiff" && ending != ".pdf") return false;
  const QuietStderr quiet;
  return countPages(scan) > 1;
}

bool isScanName(const fs::path& path) {
  static const std::set<std::string> known = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".pdf",
                                              ".jp2", ".j2k", ".webp", ".pgm", ".pbm",  ".ppm", ".pnm"};
  return known.contains(endingOf(path));
}

/// The place behind what one letter of a name has to match, if it does: a letter, ?, or a set as in [a-f7] and [!a-f7].
/// A set that does not end is the letter [ itself.
std::optional<std::size_t> behindLetter(std::string_view pattern, std::size_t p, char letter) {
  if (p >= pattern.size() || pattern[p] == '*') return std::nullopt;
  const bool isNegated = pattern.substr(p).starts_with("[!");
  const std::size_t first = p + (isNegated ? 2 : 1);
  const std::size_t end = pattern[p] == '[' ? pattern.find(']', first + 1) : std::string_view::npos;
  if (end == std::string_view::npos) {
    return pattern[p] == '?' || pattern[p] == letter ? std::optional(p + 1) : std::nullopt;
  }
  bool isInSet = false;
  for (std::size_t i = first; i < end; ++i) {
    const bool isRange = i + 2 < end && pattern[i + 1] == '-';
    isInSet = isInSet || (pattern[i] <= letter && letter <= pattern[isRange ? i + 2 : i]);
    if (isRange) i += 2;
  }
  return isInSet != isNegated ? std::optional(end + 1) : std::nullopt;
}

/// Whether a name matches a pattern in which * is any text, ? any letter and [...] a letter of a set.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, mark = 0;
  while (n < name.size()) {
    if (const auto next = behindLetter(pattern, p, name[n])) {
      p = *next, ++n;
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

bool isPattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

/// The scans of a folder and of all that lies in it, but for the folder of the outputs.
void searchFolder(const fs::path& folder, const std::string& outputs,
                  const std::function<void(const fs::path&)>& hear) {
  std::error_code code;
  for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, code);
       !code && it != fs::recursive_directory_iterator(); it.increment(code)) {
    std::error_code ignored;
    if (it->is_directory(ignored) && fs::equivalent(it->path(), outputs, ignored)) it.disable_recursion_pending();
    if (it->is_regular_file(ignored) && isScanName(it->path())) hear(it->path());
  }
}

/// Whether the parts of a path match those of a pattern; ** is any number of folders.
bool partsMatch(std::span<const std::string> patterns, std::span<const std::string> parts) {
  if (patterns.empty()) return parts.empty();
  if (patterns.front() == "**") {
    for (std::size_t skipped = 0; skipped <= parts.size(); ++skipped) {
      if (partsMatch(patterns.subspan(1), parts.subspan(skipped))) return true;
    }
    return false;
  }
  return !parts.empty() && matches(patterns.front(), parts.front()) &&
         partsMatch(patterns.subspan(1), parts.subspan(1));
}

std::vector<std::string> partsOf(const fs::path& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : path) parts.push_back(part.string());
  return parts;
}

/// The scans that match a pattern. Folders below the one that the pattern begins with stay for the outputs.
std::vector<FoundScan> scansLike(const fs::path& path, const std::string& outputs) {
  fs::path fixed, rest;
  for (const fs::path& part : path) (rest.empty() && !isPattern(part.string()) ? fixed : rest) /= part;
  const std::vector<std::string> patterns = partsOf(rest);
  const fs::path begin = fixed.empty() ? fs::path(".") : fixed;
  std::vector<FoundScan> found;
  const auto take = [&](const fs::path& scan) {
    const fs::path below = scan.lexically_relative(begin);
    if (isScanName(scan) && partsMatch(patterns, partsOf(below))) found.push_back({fixed / below, below.parent_path()});
  };
  std::error_code code;
  if (patterns.size() == 1 && patterns.front() != "**") {  // no folder below is looked into
    for (auto it = fs::directory_iterator(begin, code); !code && it != fs::directory_iterator(); it.increment(code))
      take(it->path());
  } else {
    searchFolder(begin, outputs, take);
  }
  return found;
}

/// The scans that an input names, in the order of names; what lies in the folder of the outputs is none.
Result<std::vector<FoundScan>> scansOf(const std::string& input, const std::string& outputs) {
  const fs::path path(input);
  std::error_code code;
  std::vector<FoundScan> found;
  if (fs::is_directory(path, code)) {
    searchFolder(path, outputs, [&](const fs::path& scan) {
      found.push_back({scan, scan.lexically_relative(path).parent_path()});
    });
  } else if (fs::exists(path, code)) {
    found.push_back({path, {}});
  } else if (isPattern(input)) {
    found = scansLike(path, outputs);
  }
  if (found.empty()) {
    return wrongLine("There is no scan in " + shownText(input) +
                     ". Name scans, a folder of them, a pattern, a manifest that ends in .jsonl, or - for stdin.");
  }
  std::sort(found.begin(), found.end(), [](const FoundScan& a, const FoundScan& b) { return a.scan < b.scan; });
  return found;
}

}  // namespace

Result<std::vector<BatchPage>> readManifest(std::string_view text, const PageDefaults& defaults) {
  std::vector<BatchPage> pages;
  int line = defaults.firstLine - 1;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view one = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line;
    if (one.empty()) continue;
    auto page = pageOf(one, line, defaults);
    if (!page) return fail(page.error());
    for (BatchPage& each : everyPageOf(*page)) pages.push_back(std::move(each));
  }
  if (pages.empty()) return wrongLine("The manifest is empty. Write one JSON object per line.");
  if (auto checked = checkFiles(pages); !checked) return fail(checked.error());
  return pages;
}

std::string manifestLine(const BatchPage& page) {
  Json outputs = Json::array(), settings = Json::array();
  for (const std::string& output : page.outputs) outputs.push_back(nameText(output));
  for (const std::string& setting : page.settings) settings.push_back(nameText(setting));
  Json json{{"scan", nameText(page.scan)}, {"outputs", outputs}};
  if (!page.recipe.empty()) json["recipe"] = nameText(page.recipe);
  if (!page.settings.empty()) json["set"] = settings;
  if (page.dpi) json["dpi"] = *page.dpi;
  if (page.isPageNamed) json["page"] = page.page;
  return jsonLine(json);
}

std::string recordName(const BatchPage& page) { return page.outputs.front() + ".batch.json"; }
std::string lockName(const BatchPage& page) { return recordName(page) + ".lock"; }

std::map<std::string, std::string> filesOf(const std::vector<BatchPage>& pages) {
  std::map<std::string, std::string> files;
  for (const BatchPage& page : pages) {
    const std::string line = " of line " + std::to_string(page.line) + " of the manifest";
    files.emplace(fileKey(page.scan), "the scan" + line);
    if (!page.recipe.empty()) files.emplace(fileKey(page.recipe), "the recipe" + line);
    for (const std::string& output : page.outputs) files.emplace(fileKey(output), "an output" + line);
    for (const std::string& own : {recordName(page), lockName(page)})
      files.emplace(fileKey(own), "the record of the page" + line);
  }
  return files;
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
    if (holdsPages(one.scan)) page.page = kAllPages;
    for (BatchPage& each : everyPageOf(page)) {
      each.line = static_cast<int>(pages.size()) + 1;
      pages.push_back(std::move(each));
    }
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
  if (page.isPageNamed) words.insert(words.end(), {"--page", std::to_string(page.page)});
  words.insert(words.end(), {"--threads", std::to_string(threads)});
  return words;
}

}  // namespace batten::cli
