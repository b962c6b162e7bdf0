// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
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
  std::vector<std::string> outputs;   ///< At least one.
  std::string recipe;                 ///< Empty: none.
  std::vector<std::string> settings;  ///< "stage.parameter=value"
  std::optional<double> dpi;
  int page = 1;              ///< Of the scan's file, from 1.
  bool isPageNamed = false;  ///< By the manifest, or as one of all; else it is the first one, for want of a number.
  int line = 0;              ///< In the manifest, counted from 1.
};

/// What all pages have in common where they say nothing else.
struct PageDefaults {
  std::string recipe;
  std::vector<std::string> settings;  ///< A page's own come after them and so win.
  std::optional<double> dpi;
  int firstLine = 1;  ///< The number of the manifest's first line, where it is a part of another.
};

/// Reads a manifest: one JSON object a line, {"scan": NAME, "outputs": [NAME…], "recipe": NAME, "set": {NAME: VALUE…}
/// or ["NAME=VALUE"…], "dpi": NUMBER, "page": NUMBER or "all"}; the first two are needed. "all" stands for every page
/// of the scan, with -p1, -p2 … behind the names of the outputs. Names are bytes (see name_text.h). Blank lines are
/// passed over.
/// @return BadParameter that names the line: no JSON, an unknown key, a wrong type, an output of two pages, an output
/// that is a scan, a recipe or a record of the manifest, be it by way of links.
Result<std::vector<BatchPage>> readManifest(std::string_view text, const PageDefaults&);

/// What lies beside the page's first output: its record, and a lock while a call works on the page.
std::string recordName(const BatchPage&);
std::string lockName(const BatchPage&);

/// The line of a manifest that reads back as this page, without a line break.
std::string manifestLine(const BatchPage&);

/// What the pages read and write ("the scan of line 3" …), by fileKey: so that nothing else is written there.
std::map<std::string, std::string> filesOf(const std::vector<BatchPage>&);

/// Pages of scans: each of `inputs` is a scan, a folder (searched with all that lies in it) or a pattern with * and ?
/// in any part of it, and ** for any folders. Outputs go to `folder`, a searched folder's own subfolders within it,
/// under the scan's name with the extensions given; where two scans differ by their extension only, it stays in the
/// name. Of a TIFF or PDF of several pages each is a page, with -p1, -p2 … in the names. A recipe that lies beside a
/// scan (NAME.recipe.json) is used. In the order of names.
/// @return BadParameter if an input is not there or holds no scan.
Result<std::vector<BatchPage>> pagesOf(const std::vector<std::string>& inputs, const std::string& folder,
                                       const std::vector<std::string>& extensions, const PageDefaults&);

/// The words of the call of this program that traces the page, "trace" first.
std::vector<std::string> traceWords(const BatchPage&, int threads);

}  // namespace batten::cli
