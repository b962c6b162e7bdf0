// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/usage_error.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/edit_distance.h"
#include "core/base/shown_text.h"

namespace batten::cli {
namespace {

Error wrongCommand(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
  std::string all, near;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string name = commands[i]->get_name();
    all.append(i == 0 ? "" : i + 1 < commands.size() ? ", " : " and ").append(name);
    const std::size_t changes = editDistance(word, name);
    if (isNearWord(word, changes) && (near.empty() || changes < editDistance(word, near))) near = name;
  }
  if (word.empty()) return {ErrorCode::BadParameter, "Name a command: " + all + ". Try --help.", {}};
  return {
      ErrorCode::BadParameter,
      "There is no command " + word + ". " + (near.empty() ? "There are " + all + "." : "Did you mean " + near + "?"),
      {}};
}

/// Words that a command has no use for; an option is the likelier mistake.
Error wordTooMany(const std::string& command, const std::vector<std::string>& words) {
  const auto option =
      std::find_if(words.begin(), words.end(), [](const std::string& w) { return w.size() > 1 && w.front() == '-'; });
  std::string line;
  if (option == words.end()) {
    line = quotedText(words.front()) + " is an unexpected argument of " + command + ".";
  } else {
    line = command + " has no option " + *option + ".";
    if (command == "suggest" && (*option == "-o" || *option == "--output")) {
      line = "suggest has no option " + *option + ": it prints its advice and writes no file.";
    }
  }
  return {ErrorCode::BadParameter, line + " Run batten-cli " + command + " --help.", {}};
}

}  // namespace

Error usageError(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  const auto parsed = app.get_subcommands();
  if (parsed.empty() && argc > 1 && argv[1][0] == '-') {
    return {ErrorCode::BadParameter, std::string("There is no option ") + argv[1] + ". Run batten-cli --help.", {}};
  }
  if (parsed.empty()) {
    const auto* word = std::find_if(argv + 1, argv + argc, [](const char* w) { return w[0] != '-'; });
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const std::string name = word != argv + argc ? *word : "";
    const bool known =
        std::any_of(commands.begin(), commands.end(), [&](const CLI::App* c) { return c->get_name() == name; });
    if (!known) return wrongCommand(app, name);
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto words = parsed.front()->remaining();
    if (!words.empty()) return wordTooMany(parsed.front()->get_name(), words);
  }
  return {ErrorCode::BadParameter, std::string(error.what()) + ". Run batten-cli --help.", {}};
}

}  // namespace batten::cli
