// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/options_command.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/exit_codes.h"

namespace batten::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What stands in place of an option's value: the name it was given, without the range that a check adds to it.
std::string valueOf(const CLI::Option& option) {
  if (option.get_type_size_max() == 0) return {};
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

Json optionJson(const CLI::Option& option) {
  Json names = Json::array();
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return {{"names", names},
          {"value", valueOf(option)},
          {"help", option.get_description()},
          {"repeated", option.get_items_expected_max() > 1},
          {"required", option.get_required()}};
}

Json commandJson(const CLI::App& command, const std::string& name) {
  Json options = Json::array();
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) options.push_back(optionJson(*option));
  }
  return {{"name", name}, {"help", command.get_description()}, {"footer", command.get_footer()}, {"options", options}};
}

}  // namespace

int runOptions(const CLI::App& app) {
  Json commands = Json::array({commandJson(app, "")});
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); })) {
    commands.push_back(commandJson(*command, command->get_name()));
  }
  std::cout << commands.dump(1) << '\n';
  return endOutput();
}

}  // namespace batten::cli
