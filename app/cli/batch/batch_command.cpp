// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/batch_command.h"

#include <QCoreApplication>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <thread>

#include "app/cli/batch/batch_run.h"
#include "app/cli/batch/contact_sheet.h"
#include "app/cli/exit_codes.h"
#include "app/cli/file_names.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/document/report_pages/report_file.h"
#include "core/exchange/model/export_settings.h"
#include "core/exchange/save_atomically.h"

namespace batten::cli {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> wrong(std::string message) { return fail(ErrorCode::BadParameter, std::move(message)); }

bool isManifest(const std::string& input) { return input == "-" || input.ends_with(".jsonl"); }

Result<std::string> textOf(const std::string& input) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;  // some two million pages
  if (input == "-") {
    constexpr std::size_t kBlock = std::size_t{1} << 16;  // bytes that are read at once
    std::string lines;
    while (lines.size() <= kMostBytes) {
      const std::size_t before = lines.size();
      lines.resize(before + kBlock);
      std::cin.read(lines.data() + before, kBlock);
      lines.resize(before + std::cin.gcount());
      if (lines.size() == before) return lines;
    }
    return wrong("The manifest from stdin is too large: split it.");
  }
  auto text = readWhole(input, kMostBytes);
  if (text) return std::move(*text);
  return wrong("The manifest " + shownText(input) + " cannot be read: it " + describe(text.error()) +
               ". Check its name.");
}

/// What --formats takes: the endings without their dots.
std::string formatWords() {
  std::string words = " " + allEndings() + ", .report.pdf, .report.html";
  for (auto at = words.find(" ."); at != std::string::npos; at = words.find(" .", at)) words.erase(at + 1, 1);
  return words.substr(1);
}

Result<std::vector<std::string>> extensionsOf(const std::string& formats) {
  std::vector<std::string> extensions;
  for (std::size_t from = 0; from <= formats.size();) {
    const auto comma = std::min(formats.find(',', from), formats.size());
    const std::string one = formats.substr(from, comma - from);
    const auto isLetter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.'; };
    if (one.empty() || !std::all_of(one.begin(), one.end(), isLetter)) {
      return wrong("--formats takes extensions separated by commas, such as svg,json, not " + quotedText(formats) +
                   ".");
    }
    if (std::find(extensions.begin(), extensions.end(), one) == extensions.end()) extensions.push_back(one);
    from = comma + 1;
  }
  for (const std::string& one : extensions) {
    if (!formatOf("NAME." + one) && !reportFormatOf("NAME." + one))
      return wrong("--formats: there is no format " + quotedText(one) + ". Formats: " + formatWords() + ".");
  }
  return extensions;
}

/// The pages that the words name; folders for outputs of scans are made.
Result<std::vector<BatchPage>> pagesFor(const BatchArguments& arguments) {
  const PageDefaults defaults{arguments.recipe, arguments.settings, arguments.dpi, arguments.firstLine};
  const auto manifests = std::count_if(arguments.inputs.begin(), arguments.inputs.end(), isManifest);
  if (manifests > 0) {
    if (arguments.inputs.size() > 1) return wrong("Name one manifest, or scans and folders, not both.");
    if (!arguments.to.empty()) return wrong("A manifest names its own outputs: omit --to.");
    const auto text = textOf(arguments.inputs.front());
    if (!text) return fail(text.error());
    return readManifest(*text, defaults);
  }
  if (arguments.to.empty()) return wrong("Give an output folder: --to FOLDER.");
  const auto extensions = extensionsOf(arguments.formats);
  if (!extensions) return fail(extensions.error());
  return pagesOf(arguments.inputs, arguments.to, *extensions, defaults);
}

/// Makes the folders for the outputs of scans; a manifest's are there.
Result<void> makeFolders(const BatchArguments& arguments, const std::vector<BatchPage>& pages) {
  if (arguments.to.empty()) return {};
  std::set<fs::path> folders;
  for (const BatchPage& page : pages) folders.insert(fs::path(page.outputs.front()).parent_path());
  for (const fs::path& folder : folders) {
    std::error_code code;
    if (!folder.empty()) fs::create_directories(folder, code);
    if (code)
      return fail(ErrorCode::CannotWrite, "Cannot make the folder " + shownName(folder) + ": " + code.message() + ".");
  }
  return {};
}

/// What is written beside the outputs is written over nothing that is read, nor over an output, nor twice.
Result<void> checkSideFiles(const BatchArguments& arguments, const std::vector<BatchPage>& pages) {
  struct SideFile {
    std::string option, file;
  };
  std::vector<SideFile> sides;
  for (const SideFile& one :
       {SideFile{"--results", arguments.results}, SideFile{"--failures", arguments.failures},
        SideFile{"--sheet", arguments.sheet}, SideFile{"--write-manifest", arguments.writeManifest}}) {
    if (!one.file.empty()) sides.push_back(one);
  }
  if (sides.empty()) return {};
  if (!arguments.sheet.empty() && arguments.sheet != "-") {
    for (const std::string& more : sheetFiles(pages.size(), arguments.sheet)) sides.push_back({"--sheet", more});
  }
  std::map<std::string, std::string> taken = filesOf(pages);
  for (const std::string& input : arguments.inputs) {
    if (isManifest(input) && input != "-") taken.emplace(fileKey(input), "the manifest itself");
  }
  if (!arguments.recipe.empty()) taken.emplace(fileKey(arguments.recipe), "the recipe");
  for (const auto& [option, file] : sides) {
    if (file == "-") {
      if (option == "--write-manifest" || option == "--results") continue;
      return wrong(option + " needs the name of a file: stdout has the lines about the pages.");
    }
    const auto [before, isNew] = taken.emplace(fileKey(file), "the file of " + option);
    if (!isNew)
      return wrong(option + ": the file " + shownText(file) + " is " + before->second + ". Give it another name.");
  }
  return {};
}

/// What is written last is known to be writable before all the work, once the folders are there.
Result<void> checkLastFiles(const BatchArguments& arguments) {
  for (const std::string& file : {arguments.failures, arguments.sheet}) {
    if (file.empty()) continue;
    if (auto checked = checkSaving(file); !checked) return checked;
  }
  return {};
}

BatchSettings settingsOf(const BatchArguments& arguments) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  BatchSettings settings;
  settings.jobs = arguments.jobs > 0 ? arguments.jobs : processors;
  settings.threads = std::max(1, processors / settings.jobs);
  settings.pageTimeoutSeconds = arguments.pageTimeoutSeconds;
  settings.maxFailures = arguments.maxFailures;
  if (arguments.resume || arguments.existing == "skip") {
    settings.existing = Existing::Skip;
  } else {
    settings.existing = arguments.existing == "abort" ? Existing::Abort : Existing::Overwrite;
  }
  return settings;
}

/// With --existing abort nothing is begun where an output is there.
Result<void> checkExisting(const BatchSettings& settings, const std::vector<BatchPage>& pages) {
  if (settings.existing != Existing::Abort) return {};
  for (const BatchPage& page : pages) {
    for (const std::string& output : page.outputs) {
      std::error_code code;
      if (fs::exists(output, code)) {
        return fail(ErrorCode::CannotWrite,
                    shownText(output) + " already exists and --existing abort was given. Nothing was done.");
      }
    }
  }
  return {};
}

std::string manifestOf(const std::vector<BatchPage>& pages) {
  std::string text;
  for (const BatchPage& page : pages) text += manifestLine(page) + "\n";
  return text;
}

std::string failedOf(const std::vector<BatchPage>& pages, const std::map<std::size_t, std::string>& failed) {
  std::string text;
  for (const auto& [index, error] : failed) text += manifestLine(pages[index]) + "\n";
  return text;
}

/// What is left to do when the pages have ended. @return the exit code.
int finish(const BatchArguments& arguments, const std::vector<BatchPage>& pages, const BatchRun& run) {
  if (!arguments.failures.empty()) {
    if (auto saved = saveAtomically(arguments.failures, failedOf(pages, run.failed())); !saved)
      return reportError(saved.error());
  }
  if (!arguments.sheet.empty()) {
    if (auto sheet = writeContactSheet(pages, run.failed(), arguments.sheet); !sheet) return reportError(sheet.error());
  }
  if (!run.whyStopped().empty()) {
    std::cerr << "batten-cli: " << run.whyStopped() << std::endl;
    return run.isResultLost() ? kCannotWrite : kStopped;
  }
  if (run.counts().failed == 0) return kDone;
  std::cerr << "batten-cli: " << failedPages(run.counts().failed, pages.size())
            << "; the lines with \"status\":\"failed\" say why." << std::endl;
  return kPagesFailed;
}

int writeManifest(const std::string& file, const std::vector<BatchPage>& pages) {
  if (file == "-") {
    std::cout << manifestOf(pages);
    return endOutput();
  }
  const auto saved = saveAtomically(file, manifestOf(pages));
  return saved ? kDone : reportError(saved.error());
}

}  // namespace

int runBatch(const BatchArguments& arguments, char* program, const CallHere& callHere) {
  const auto pages = pagesFor(arguments);
  if (!pages) return reportError(pages.error());
  if (auto checked = checkSideFiles(arguments, *pages); !checked) return reportError(checked.error());
  const auto settings = settingsOf(arguments);
  if (auto checked = checkExisting(settings, *pages); !checked) return reportError(checked.error());
  if (auto made = makeFolders(arguments, *pages); !made) return reportError(made.error());
  if (auto checked = checkLastFiles(arguments); !checked) return reportError(checked.error());
  if (!arguments.writeManifest.empty()) return writeManifest(arguments.writeManifest, *pages);
  auto lines = ResultLines::open(arguments.results);
  if (!lines) return reportError(lines.error());
  int count = 1;
  char* words[] = {program, nullptr};
  const QCoreApplication application(count, words);
  BatchRun run(settings, *pages, *lines, callHere);
  run.run();
  return finish(arguments, *pages, run);
}

}  // namespace batten::cli
