// SPDX-License-Identifier: Apache-2.0
//
// `telehug doctor`: what on this PC keeps telehug from working, and what mends it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/config_choice.hpp"
#include "ctl/doctor/doctor_text.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigChoice choice;
  std::string root = "/";
  bool bootloader = false;
  bool json = false;
};

ExitCode run(const Options& options) {
  DoctorWishes wishes;
  if (!options.choice.side.empty()) wishes.sides = options.choice.sides();
  wishes.sources = options.choice.sources();
  wishes.system = options.choice.system;
  wishes.root = options.root;
  wishes.ask_bootloader = options.bootloader;
  const Findings findings = all_checks(gather_facts(wishes));
  fmt::print("{}", options.json
                       ? doctor_json(findings).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
                       : doctor_text(findings));
  return anything_fails(findings) ? ExitCode::fault : ExitCode::ok;
}

}  // namespace

void add_doctor(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "doctor", "What keeps telehug from working here, and what mends it; ends with 12 if anything does");
  add_config_choice(*command, options->choice);
  command->add_flag("--bootloader", options->bootloader,
                    "Also ask the jacket's bootloader, which resets the jacket: take it off first");
  command->add_option("--root", options->root, "Look at a system that lies below this folder (default: /)")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "For programs");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
