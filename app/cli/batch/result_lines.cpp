// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/result_lines.h"

#include <cstdio>
#include <string_view>

#include "core/base/json_text.h"
#include "core/base/shown_text.h"
#include "core/exchange/save_atomically.h"

namespace batten::cli {
namespace {

constexpr std::size_t kNearBytes = std::size_t{16} << 10;  // where a line is looked for first; a line takes about one
constexpr std::size_t kResultsAtOnce = std::size_t{4} << 20;  // [bytes] of a file of results that is read whole

// as this program writes them
constexpr std::string_view kKeyMark = "\"key\":\"", kFailedMark = "\"status\":\"failed\"";

/// The key of a page that the line calls done or empty; empty: it calls none so. Our own lines are not parsed: quotes
/// within a text of JSON have a backslash before them, so the marks are found nowhere else.
std::string keyToldBy(std::string_view line) {
  const auto mark = line.rfind(kKeyMark);
  if (mark != std::string_view::npos) {
    if (line.find(kFailedMark) != std::string_view::npos) return {};
    const std::string_view rest = line.substr(mark + kKeyMark.size());
    return std::string(rest.substr(0, rest.find('"')));
  }
  if (line.find("\"key\"") == std::string_view::npos) return {};
  const auto json = parseJson(line);  // somebody has written it anew, with blanks
  if (!json || !json->is_object() || !json->contains("key") || !(*json)["key"].is_string()) return {};
  return json->contains("status") && (*json)["status"] != "failed" ? (*json)["key"].get<std::string>() : std::string();
}

}  // namespace

Result<ResultLines> ResultLines::open(const std::string& file) {
  ResultLines lines;
  if (file.empty() || file == "-") {
    std::setvbuf(stdout, nullptr, _IONBF, 0);  // a line longer than a buffer would be handed over in parts
    return lines;
  }
  lines.name_ = file;
  auto opened = SharedLines::open(file);
  if (!opened) {
    return fail(
        ErrorCode::CannotWrite,
        "Cannot write " + shownText(file) + ". Check that its folder exists and may be written; a pipe needs a reader.",
        opened.error().message());
  }
  lines.file_ = std::move(*opened);
  return lines;
}

bool ResultLines::isTold(const std::string& key, std::uint64_t from) {
  if (!file_ || key.empty()) return false;
  if (known_.contains(key)) return true;
  if (readTo_ == 0) {
    const auto near = file_->read(from, kNearBytes);
    const std::string_view text = near ? std::string_view(*near) : std::string_view();
    if (const auto at = text.find(key); at != std::string_view::npos) {
      const auto begin = text.rfind('\n', at), end = text.find('\n', at);
      const std::size_t first = begin == std::string_view::npos ? 0 : begin + 1;
      if (end != std::string_view::npos && keyToldBy(text.substr(first, end - first)) == key) return true;
    }
  }
  readOn();
  return known_.contains(key);
}

/// Takes the lines over that were added since it was read last; one that is not whole yet is left for the next time.
void ResultLines::readOn() {
  while (true) {
    const auto block = file_->read(readTo_, kResultsAtOnce);
    if (!block) return;
    std::string_view text = *block;
    const auto end = text.rfind('\n');
    if (end == std::string_view::npos) return;
    text = text.substr(0, end + 1);
    readTo_ += text.size();
    while (!text.empty()) {
      const auto next = text.find('\n');
      if (std::string key = keyToldBy(text.substr(0, next)); !key.empty()) known_.insert(std::move(key));
      text.remove_prefix(next + 1);
    }
    if (block->size() < kResultsAtOnce) return;
  }
}

Result<void> ResultLines::write(const BatchPage& page, const PageResult& result) {
  const std::string line = resultLine(page, result) + "\n";
  if (file_) {
    const auto error = file_->add(line);
    if (!error) return {};
    return fail(ErrorCode::CannotWrite, "Cannot write " + shownText(name_) + ": " + whyNotWritten(error),
                error.message());
  }
  if (std::fwrite(line.data(), 1, line.size(), stdout) == line.size() && std::fflush(stdout) == 0) return {};
  return fail(ErrorCode::CannotWrite, "Cannot write the result to stdout. Redirect it to a disk with free space.");
}

}  // namespace batten::cli
