// SPDX-License-Identifier: Apache-2.0
//
// `telehug jacket`: the wearer looks at the jacket on this PC and tries it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include "ctl/command.hpp"
#include "ctl/daemons.hpp"
#include "ctl/jacket_flash.hpp"
#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

struct Options {
  DaemonChoice daemons{.side = "passive", .socket = {}};
  bool json = false;
  std::string svg_file;
  unsigned id = 0;
  double strength = 0.7;
  double seconds = 0.8;
};

// A daemon that answered, or how that failed.
struct Wearer {
  std::optional<Daemon> daemon;
  ExitCode failure = ExitCode::ok;
};

Wearer find_wearer(const DaemonChoice& choice) {
  Daemons daemons = find_daemons(choice);
  if (daemons.found.empty()) return {std::nullopt, complain_of_unreachable(daemons)};
  return {std::move(daemons.found.front()), ExitCode::ok};
}

// Empty, and the failure told, if there is no good answer.
std::optional<Json> ask(Wearer& wearer, const Json& request) {
  if (!wearer.daemon) return std::nullopt;
  auto reply = wearer.daemon->client.ask(request);
  if (!reply) {
    wearer.failure = complain(*wearer.daemon, ExitCode::bad_answer, reply.error().message);
  } else if (reply->contains("error")) {
    wearer.failure = complain(*wearer.daemon, ExitCode::refused, text_of((*reply)["error"]));
  } else {
    return std::move(reply).value();
  }
  return std::nullopt;
}

void print_jacket(const Json& jacket) {
  fmt::print("{} on {}{}\n", plain_text(text_of(jacket.at("name"))), plain_text(text_of(jacket.at("device"))),
             jacket.at("answers").get<bool>() ? "" : ", which does not answer");
  for (const char* side : {"front", "back"}) {
    const auto of_side = [&](const Json& actuator) { return actuator.at("side") == side; };
    const Json& actuators = jacket.at("actuators");
    if (std::none_of(actuators.begin(), actuators.end(), of_side)) continue;
    fmt::print("\n{}, as the other side sees it\n", side);
    for (const Json& line : jacket.at("picture").at(side))
      fmt::print("  {}\n", plain_text(text_of(line)));
  }
  fmt::print("\n  id  kind    at most  name\n");
  for (const Json& actuator : jacket.at("actuators")) {
    fmt::print("{:>4}  {:<6}  {:>6.0f}%  {}{}\n", actuator.at("id").get<int>(), text_of(actuator.at("kind")),
               100 * actuator.at("max_strength").get<double>(), plain_text(text_of(actuator.at("name"))),
               actuator.at("enabled").get<bool>() ? "" : " (switched off)");
  }
}

ExitCode list(const Options& options) {
  Wearer wearer = find_wearer(options.daemons);
  auto jacket = ask(wearer, {{"command", "jacket"}, {"svg", !options.svg_file.empty()}});
  if (!jacket) return wearer.failure;
  if (!options.svg_file.empty()) {
    std::ofstream file(options.svg_file);
    file << text_of(jacket->at("svg"));
    file.close();
    if (!file) {
      fmt::print(stderr, "telehug: {} can't be written: is the place right, and the disk not full?\n",
                 options.svg_file);
      return ExitCode::internal;
    }
    jacket->erase("svg");
  }
  if (options.json) {
    fmt::print("{}\n", jacket->dump(1));
  } else {
    print_jacket(*jacket);
  }
  return ExitCode::ok;
}

// Runs one actuator and waits until that is over.
ExitCode try_one(Wearer& wearer, const Options& options, unsigned id) {
  const auto ordered = ask(
      wearer, {{"command", "jacket_trial"}, {"id", id}, {"strength", options.strength}, {"seconds", options.seconds}});
  if (!ordered) return wearer.failure;
  std::this_thread::sleep_for(std::chrono::duration<double>(options.seconds));
  // The daemon tells what became of it a little later.
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto jacket = ask(wearer, {{"command", "jacket"}});
    if (!jacket) return wearer.failure;
    const Json trial = jacket->value("trial", Json::object());
    if (trial.value("number", std::uint64_t{0}) == ordered->at("trial").get<std::uint64_t>()) {
      const std::string outcome = trial.at("outcome").get<std::string>();
      if (outcome == "driven") return ExitCode::ok;
      return complain(*wearer.daemon, ExitCode::refused, fmt::format("actuator {} was not driven: {}", id, outcome));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return complain(*wearer.daemon, ExitCode::bad_answer, "the daemon does not tell what became of it");
}

ExitCode test(const Options& options) {
  Wearer wearer = find_wearer(options.daemons);
  if (!wearer.daemon) return wearer.failure;
  const ExitCode result = try_one(wearer, options, options.id);
  if (result == ExitCode::ok) fmt::print("actuator {} was driven\n", options.id);
  return result;
}

// One after the other, with its name: who wears the jacket feels whether it is the one.
ExitCode identify(const Options& options) {
  Wearer wearer = find_wearer(options.daemons);
  const auto jacket = ask(wearer, {{"command", "jacket"}});
  if (!jacket) return wearer.failure;
  for (const Json& actuator : jacket->at("actuators")) {
    if (!actuator.at("enabled").get<bool>() || actuator.at("kind") != "motor") continue;
    fmt::print("{:>4}  {}\n", actuator.at("id").get<int>(), plain_text(text_of(actuator.at("name"))));
    (void)std::fflush(stdout);
    if (const ExitCode result = try_one(wearer, options, actuator.at("id").get<unsigned>()); result != ExitCode::ok)
      return result;
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
  }
  return ExitCode::ok;
}

void add_strength_and_seconds(CLI::App& command, Options& options) {
  command.add_option("--strength", options.strength, "0 to 1 of what the jacket may do (default: 0.7)")
      ->check(CLI::Range(0.01, 1.0));
  command.add_option("--seconds", options.seconds, "For how long (default: 0.8)")->check(CLI::Range(0.1, 5.0));
}

}  // namespace

void add_jacket(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* jacket = app.add_subcommand("jacket", "The jacket on this PC: what it has, and whether that works");
  jacket->require_subcommand(1);

  CLI::App* lister = jacket->add_subcommand("list", "Its actuators, and where they sit on the body");
  lister->add_flag("--json", options->json, "For programs");
  lister->add_option("--out", options->svg_file, "Also draw the body picture into this SVG file")->type_name("FILE");
  lister->callback([options, &result] { result = list(*options); });

  CLI::App* tester = jacket->add_subcommand("test", "Run one actuator for a moment, within all limits");
  tester->add_option("ID", options->id, "Which one; `telehug jacket list` tells")
      ->required()
      ->check(CLI::Range(1, 255));
  add_strength_and_seconds(*tester, *options);
  tester->callback([options, &result] { result = test(*options); });

  CLI::App* walker = jacket->add_subcommand("identify", "Run the motors one after the other, telling their names");
  add_strength_and_seconds(*walker, *options);
  walker->callback([options, &result] { result = identify(*options); });

  for (CLI::App* command : {lister, tester, walker})
    add_socket_option(*command, options->daemons);
  add_jacket_flash(*jacket, result);
}

}  // namespace telehug
