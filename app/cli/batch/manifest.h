// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace batten::cli {

/// One drawing of an archive: what one call of `batten-cli trace` is told. Names of files as the call would take them:
/// relative ones from the folder in which the program runs.
struct BatchPage {
  std::string scan;
  std::vector<std::string> outputs;   ///< At least one, .svg or .json.
  std::string recipe;                 ///< Empty: none.
  std::vector<std::string> settings;  ///< "stage.parameter=value"
  std::optional<double> dpi;
  int page = 1;  ///< Of the scan's file, from 1.
  int line = 0;  ///< In the manifest, counted from 1.
};

/// What all pages have in common where they say nothing else.
struct PageDefaults {
  std::string recipe;
  std::vector<std::string> settings;  ///< A page's own come after them and so win.
  std::optional<double> dpi;
};

/// Reads a manifest: one JSON object a line, {"scan": NAME, "outputs": [NAME…], "recipe": NAME, "set": {NAME: VALUE…}
/// or
/// ["NAME=VALUE"…], "dpi": NUMBER, "page": NUMBER}; the first two are needed. Blank lines are passed over.
/// @return BadParameter that names the line: no JSON, an unknown key, a wrong type, an output of two pages, an output
/// that is a scan or a recipe of the manifest.
Result<std::vector<BatchPage>> readManifest(std::string_view text, const PageDefaults&);

/// The line of a manifest that reads back as this page, without a line break.
std::string manifestLine(const BatchPage&);

/// Pages of scans: each of `inputs` is a scan, a folder (searched with all that lies in it) or a pattern with * and ?
/// in its last part. Outputs go to `folder`, a searched folder's own subfolders within it, under the scan's name with
/// the extensions given; where two scans differ by their extension only, it stays in the name. A recipe that lies
/// beside a scan (NAME.recipe.json) is used. In the order of names.
/// @return BadParameter if an input is not there or holds no scan.
Result<std::vector<BatchPage>> pagesOf(const std::vector<std::string>& inputs, const std::string& folder,
                                       const std::vector<std::string>& extensions, const PageDefaults&);

/// The words of the call of this program that traces the page, "trace" first.
std::vector<std::string> traceWords(const BatchPage&, int threads);

}  // namespace batten::cli
