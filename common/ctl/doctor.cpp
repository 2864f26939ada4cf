// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor`: what on this PC keeps telehug from working, and what mends it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/config_choice.hpp"
#include "ctl/doctor_checks.hpp"
#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigChoice choice;
  std::string root = "/";
  bool json = false;
};

const char* word(Level level) {
  return level == Level::ok ? "ok" : level == Level::warn ? "warn" : "fail";
}

ExitCode run(const Options& options) {
  const Findings findings = all_checks(gather_facts(options.choice.sides(), options.choice.sources(), options.root));
  nlohmann::json all = nlohmann::json::array();
  ExitCode result = ExitCode::ok;
  for (const Finding& finding : findings) {
    if (finding.level == Level::fail) result = ExitCode::fault;
    if (options.json) {
      all.push_back(
          {{"check", finding.check}, {"level", word(finding.level)}, {"what", finding.what}, {"fix", finding.fix}});
      continue;
    }
    fmt::print("{:<5} {:<13} {}\n", word(finding.level), finding.check, plain_text(finding.what));
    if (!finding.fix.empty()) fmt::print("{:<19} -> {}\n", "", plain_text(finding.fix));
  }
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"findings", all}}.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
  return result;
}

}  // namespace

void add_doctor(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "doctor", "What keeps telehug from working here, and what mends it; ends with 12 if anything does");
  add_config_choice(*command, options->choice);
  command->add_option("--root", options->root, "Look at a system that lies below this folder (default: /)")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "For programs");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
