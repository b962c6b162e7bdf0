// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/result_lines.h"

#include <fstream>

namespace batten::cli {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1}
                                     << 20;  // [bytes] One write each; pages with longer notes there are not

}  // namespace

Result<ResultLines> ResultLines::open(const std::string& file) {
  ResultLines lines;
  lines.name_ = file;
  bool isTorn = false;
  if (!file.empty()) {
    std::ifstream in(file, std::ios::binary);
    for (std::string line; std::getline(in, line); isTorn = in.eof()) {
      const auto json = nlohmann::json::parse(line, nullptr, false);
      if (!json.is_object() || !json.contains("key") || !json["key"].is_string()) continue;
      if (json.contains("status") && json["status"] != "failed") lines.known_.insert(json["key"].get<std::string>());
    }
    lines.file_.reset(std::fopen(file.c_str(), "ab"));
  } else {
    lines.file_.reset(stdout);
  }
  if (!lines.file_) {
    return fail(ErrorCode::CannotWrite, "Cannot write " + file + ". Check that its folder exists and may be written.");
  }
  std::setvbuf(lines.file_.get(), nullptr, _IOFBF, kLongestLine);
  if (isTorn) std::fputc('\n', lines.file_.get());  // a line cut off by a full disk; the next goes below it
  return lines;
}

Result<void> ResultLines::write(const BatchPage& page, const PageResult& result) {
  if (!name_.empty() && result.status == PageStatus::Unchanged && known_.contains(result.key)) return {};
  const std::string line = resultLine(page, result) + "\n";
  const bool isWritten =
      std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() && std::fflush(file_.get()) == 0;
  if (isWritten) return {};
  return fail(ErrorCode::CannotWrite, name_.empty()
                                          ? "The result cannot be written to stdout. Send it where there is room."
                                          : "Cannot write " + name_ + ": the disk may be full. Make room.");
}

}  // namespace batten::cli
