// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "app/cli/batch/manifest.h"
#include "core/base/result.h"

namespace batten::cli {

/// An overview of all pages as HTML for the browser, read from the disk without a server: a small picture of each scan
/// with its curves over it, its figures, and links to its outputs. It is made from the records beside the outputs, so
/// it is the same however the pages were run; a page counts as done only while scan, recipe and outputs are as the
/// record has them. The small pictures lie beside it, in NAME_files; those of scans that have not changed are kept from
/// an earlier sheet. More than 500 pages go on in NAME_files, with links.
/// @param errors of the pages that failed, by their index.
/// @return CannotWrite if the sheet or its pictures cannot be written.
Result<void> writeContactSheet(const std::vector<BatchPage>& pages, const std::map<std::size_t, std::string>& errors,
                               const std::string& file);

/// The further files of a sheet of so many pages.
std::vector<std::string> sheetFiles(std::size_t pages, const std::string& file);

}  // namespace batten::cli
