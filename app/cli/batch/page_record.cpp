// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/page_record.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include "core/base/content_hash.h"
#include "core/base/json_text.h"
#include "core/base/name_text.h"
#include "core/base/regular_file.h"
#include "core/exchange/save_atomically.h"

namespace batten::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostRecordBytes = std::uint64_t{64} << 20;  // limit of input
constexpr std::uint64_t kReadAtOnce = std::uint64_t{1} << 20;        // [bytes]

const char* wordOf(PageStatus status) {
  switch (status) {
    case PageStatus::Done:
      return "done";
    case PageStatus::Empty:
      return "empty";
    case PageStatus::Unchanged:
      return "unchanged";
    case PageStatus::Failed:
      break;
  }
  return "failed";
}

}  // namespace

std::string resultLine(const BatchPage& page, const PageResult& result) {
  Json outputs = Json::array();
  for (const std::string& output : page.outputs) outputs.push_back(nameText(output));
  Json json{
      {"line", page.line}, {"scan", nameText(page.scan)}, {"outputs", outputs}, {"status", wordOf(result.status)}};
  if (result.exitCode) json["exit"] = *result.exitCode;
  json["seconds"] = result.seconds;
  if (!result.error.empty()) json["error"] = result.error;
  for (const auto& [key, value] : result.figures.items()) json[key] = value;
  if (!result.key.empty()) json["key"] = result.key;
  return jsonLine(json);
}

std::optional<std::string> fileHash(const std::string& name) {
  const auto file = RegularFile::open(name);
  if (!file) return std::nullopt;
  HashBuilder hash;
  std::vector<std::byte> bytes(std::min(kReadAtOnce, file->size()));
  // So many bytes as it had when it was opened: files of the kernel's have none, and yet their end may never come.
  for (std::uint64_t from = 0; from < file->size(); from += kReadAtOnce) {
    const std::span part = std::span(bytes).first(std::min(kReadAtOnce, file->size() - from));
    if (!file->read(part, from)) return std::nullopt;
    hash.bytes(part);
  }
  return hash.finish().hex();
}

std::optional<std::string> pageKey(const BatchPage& page) { return pageKey(page, fileHash(page.scan)); }

std::optional<std::string> pageKey(const BatchPage& page, const std::optional<std::string>& scanHash) {
  HashBuilder key;
  key.text("batten-cli batch").text(BATTEN_VERSION);
  const auto recipeHash = page.recipe.empty() ? std::optional<std::string>("none") : fileHash(page.recipe);
  if (!scanHash || !recipeHash) return std::nullopt;
  key.text(*scanHash).text(*recipeHash);
  key.integer(std::ssize(page.settings));
  for (const std::string& setting : page.settings) key.text(setting);
  key.number(page.dpi.value_or(0.0)).integer(page.page);
  for (const std::string& output : page.outputs) key.text(output);
  return key.finish().hex();
}

std::optional<PageRecord> readRecord(const BatchPage& page) {
  const auto text = readWhole(recordName(page), kMostRecordBytes);
  const auto parsed = text ? parseJson(*text) : Result<Json>(fail(ErrorCode::BadParameter, "there is none"));
  if (!parsed) return std::nullopt;
  const Json& json = *parsed;
  try {
    if (json.at("format") != "batten-batch-page" || json.at("version") != 1) return std::nullopt;
    PageRecord record;
    record.key = json.at("key").get<std::string>();
    record.isEnded = json.at("ended").get<bool>();
    record.isEmpty = json.at("empty").get<bool>();
    record.seconds = json.at("seconds").get<double>();
    record.resultsFrom = json.at("results_from").get<std::uint64_t>();
    record.note = json.at("note").get<std::string>();
    record.outputHashes = json.at("outputs_sha256").get<std::vector<std::string>>();
    record.figures = json.at("figures");
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

Result<void> writeRecord(const BatchPage& page, const PageRecord& record) {
  const Json json{{"format", "batten-batch-page"}, {"version", 1},
                  {"program", BATTEN_VERSION},     {"key", record.key},
                  {"ended", record.isEnded},       {"empty", record.isEmpty},
                  {"seconds", record.seconds},     {"results_from", record.resultsFrom},
                  {"note", record.note},           {"outputs_sha256", record.outputHashes},
                  {"figures", record.figures}};
  return saveAtomically(recordName(page), jsonLine(json) + "\n");
}

bool hasForeignOutput(const BatchPage& page, const PageRecord& record) {
  if (!record.isEnded) return false;
  const auto& own = record.outputHashes;
  return std::any_of(page.outputs.begin(), page.outputs.end(), [&](const std::string& output) {
    const auto hash = fileHash(output);
    return hash && std::find(own.begin(), own.end(), *hash) == own.end();
  });
}

bool isUnchanged(const BatchPage& page, const PageRecord& record, const std::string& key) {
  if (!record.isEnded || record.key != key) return false;
  if (record.isEmpty) return true;
  if (record.outputHashes.size() != page.outputs.size()) return false;
  for (std::size_t i = 0; i < page.outputs.size(); ++i) {
    if (fileHash(page.outputs[i]) != record.outputHashes[i]) return false;
  }
  return true;
}

}  // namespace batten::cli
