// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "common/version.hpp"
#include "config/load.hpp"
#include "config/places.hpp"
#include "jacket/jacket_overrides.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "link/make_link.hpp"
#include "passive_daemon.hpp"
#include "service/control_socket.hpp"

namespace {

using namespace telehug;

constexpr const char* examples = R"(
Examples:
  telehug-passive run --set jacket.link=serial:/dev/serial/by-id/usb-FTDI...
  telehug-passive run --set jacket.link=simulated

Exit codes: 0 ok, 1 fault of telehug, 2 wrong command line, 3 faults in the configuration or the jacket's profile,
  4 the jacket, its stop button or its power line can't be used, 10 another telehug-passive runs, 13 DDS can't be set up,
  15 the pair was revoked or has expired.)";

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
    auto profile = load_jacket_profile(file);
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

ExitCode parse_and_run(int argc, char** argv) {
  ExitCode result = ExitCode::ok;
  CLI::App app("Lets the jacket on this PC be touched from the other side, within its limits.", "telehug-passive");
  app.footer(examples);
  app.set_version_flag("--version", telehug::version);
  app.require_subcommand(1);
  Options options;
  CLI::App* command = app.add_subcommand("run", "Drive the jacket, until SIGTERM (this is the daemon)");
  command->add_option("--config", options.file, "Read only this file")->type_name("FILE");
  command->add_option("--set", options.overrides, "Override one key, as often as you like")
      ->type_name("SECTION.KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([&] { result = run(options); });
  std::vector<std::string> files;
  std::string overrides;
  CLI::App* check = app.add_subcommand("check-jacket", "Are these jacket profiles right? Lists all their faults");
  check->add_option("FILE", files, "Profiles (TOML; deploy/jackets/README.md explains them)")->required();
  check->add_option("--overrides", overrides, "The wearer's own limits to them")->type_name("FILE");
  check->callback([&] { result = check_jackets(files, overrides); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    // --help and --version come this way, too, with code 0.
    result = app.exit(problem) == 0 ? ExitCode::ok : ExitCode::usage;
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return to_int(parse_and_run(argc, argv));
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "telehug-passive: %s\n", problem.what());
    return to_int(ExitCode::internal);
  }
}
