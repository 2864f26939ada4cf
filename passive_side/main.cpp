// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/program.hpp"
#include "config/load.hpp"
#include "config/places.hpp"
#include "jacket/jacket_overrides.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "link/make_link.hpp"
#include "passive_daemon.hpp"
#include "service/control_socket.hpp"

namespace {

using namespace telehug;

const Program program{
    .name = "telehug-passive",
    .purpose = "Lets the jacket on this PC be touched from the other side, within its limits.",
    .examples =
        {
            {"telehug-passive run", "the daemon, as the configuration says"},
            {"telehug-passive run --set jacket.link=serial:/dev/serial/by-id/usb-FTDI...", "a jacket on a serial port"},
            {"telehug-passive run --set jacket.link=simulated", "without a jacket"},
            {"telehug-passive check-jacket my-jacket.toml", "is this profile right?"},
        },
    .exits = {ExitCode::ok, ExitCode::internal, ExitCode::usage, ExitCode::config, ExitCode::device,
              ExitCode::already_running, ExitCode::network, ExitCode::pair_ended},
    .see_also = {"telehug(1)", "telehug-jacket-sim(1)", "telehug-passive.toml(5)", "telehug(7)", "telehug-daemons(8)"},
};

struct Options {
  std::string file;
  std::vector<std::string> overrides;
};

ExitCode fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "telehug-passive: {}\n", message);
  return code;
}

ExitCode run(const Options& options) {
  Signals signals;
  ConfigSources sources = usual_config_sources();
  if (!options.file.empty()) sources.only_file = options.file;
  sources.overrides = options.overrides;
  const auto config = load_passive_config(sources);
  if (!config) return fail(ExitCode::config, config.error().message);
  set_up_log(config->log.level);
  auto found = memberships(config->peer, Side::passive, wall_time());
  if (!found) return fail(ExitCode::config, found.error().message);
  if (found->members.empty()) return fail(ExitCode::pair_ended, why_none(*found));
  auto profile = load_jacket_profile(jacket_profile_file(config->jacket));
  if (profile && !config->jacket.overrides.empty())
    profile = with_overrides(*std::move(profile), config->jacket.overrides);
  if (!profile) return fail(ExitCode::config, profile.error().message);
  auto link = make_link(config->jacket.link, link_options(*profile, config->jacket.baud));
  if (!link) return fail(ExitCode::device, link.error().message);
  const SteadyClock clock;
  try {
    PassiveDaemon daemon(*config, *std::move(found), *std::move(profile), *std::move(link), clock);
    return daemon.run(signals, ConfigReload<PassiveConfig>([&sources] { return load_passive_config(sources); }));
  } catch (const AlreadyRunning& running) {
    return fail(ExitCode::already_running, running.what());
  } catch (const GroupUnusable& fault) {
    return fail(ExitCode::config, fault.what());
  } catch (const LineMissing& missing) {
    return fail(ExitCode::device, missing.what());
  } catch (const DdsError& error) {
    return fail(ExitCode::network, error.what());
  }
}

// For whoever writes a profile: is it right, and what does it lack?
ExitCode check_jackets(const std::vector<std::string>& files, const std::string& overrides) {
  ExitCode result = ExitCode::ok;
  for (const std::string& file : files) {
    auto profile = load_jacket_profile(installed_jacket_file(file));
    if (profile && !overrides.empty()) profile = with_overrides(*std::move(profile), overrides);
    if (!profile) {
      result = fail(ExitCode::config, profile.error().message);
      continue;
    }
    fmt::print("{}: \"{}\", {} actuators, no fault\n", file, profile->name, profile->actuators.size());
    for (const std::string& note : profile->notes)
      fmt::print("note: {}\n", note);
  }
  return result;
}

void add_run(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Drive the jacket, until SIGTERM (this is the daemon)");
  command->add_option("--config", options->file, "Read only this file")->type_name("FILE");
  command->add_option("--set", options->overrides, "Override one key, as often as you like")
      ->type_name("SECTION.KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([options, &result] { result = run(*options); });
}

void add_check_jacket(CLI::App& app, ExitCode& result) {
  auto files = std::make_shared<std::vector<std::string>>();
  auto overrides = std::make_shared<std::string>();
  CLI::App* check = app.add_subcommand("check-jacket", "Are these jacket profiles right? Lists all their faults");
  check->add_option("files", *files, "Profiles (TOML), or names of installed ones")->required()->type_name("FILE");
  check->add_option("--overrides", *overrides, "The wearer's own limits to them")->type_name("FILE");
  check->callback([files, overrides, &result] { result = check_jackets(*files, *overrides); });
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(argc, argv, program, [](CLI::App& app, ExitCode& result) {
    add_run(app, result);
    add_check_jacket(app, result);
  });
}
