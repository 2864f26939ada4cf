// SPDX-License-Identifier: Apache-2.0
//
// `telehug config`: is it right, what counts, and what is not as shipped?
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/config_choice.hpp"
#include "ctl/config_text.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigChoice choice;
  bool json = false;
};

using Text = std::string (*)(const ConfigReport&, Side);

// Faults go to stderr, whatever is asked for: what is shown beside them is not what a daemon would run with.
ExitCode tell(const Options& options, Text text) {
  ExitCode result = ExitCode::ok;
  nlohmann::json all = nlohmann::json::array();
  for (const Side side : options.choice.sides()) {
    const ConfigReport report = inspect_config(options.choice.sources(), side);
    if (!report.faults.empty()) result = ExitCode::config;
    if (options.json) {
      all.push_back(config_json(report, side));
    } else if (text == config_check_text) {
      fmt::print(report.faults.empty() ? stdout : stderr, "{}", config_check_text(report, side));
    } else {
      if (!report.faults.empty()) fmt::print(stderr, "{}", config_check_text(report, side));
      fmt::print("{}", text(report, side));
    }
  }
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"sides", all}}.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
  return result;
}

}  // namespace

void add_config(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* config =
      app.add_subcommand("config", "The configuration: is it right, what counts, what is not as shipped?");
  config->require_subcommand(1);
  const auto add = [&](const char* name, const char* about, Text text) {
    CLI::App* command = config->add_subcommand(name, about);
    add_config_choice(*command, options->choice);
    command->add_option("--set", options->choice.overrides, "Override one key, as often as you like")
        ->type_name("SECTION.KEY=VALUE")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_flag("--json", options->json, "For programs");
    command->callback([options, text, &result] { result = tell(*options, text); });
  };
  add("check", "Tell all faults at once, each with file and line; ends with 3 if there are any", config_check_text);
  add("show", "Every key with the value that counts and where that comes from", config_show_text);
  add("diff", "Only what differs from the defaults", config_diff_text);
}

}  // namespace telehug
