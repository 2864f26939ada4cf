// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "config/places.hpp"
#include "ctl/command.hpp"
#include "ctl/plain_text.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

constexpr const char* about_pairing = R"(
Two PCs become a pair by two texts, each copied through any chat window or carried on a USB stick:
  parent's PC:   telehug pair request --name Grandma          and send what it prints to the wearer
  wearer's PC:   telehug pair grant --name Mia < request.txt  and send what it prints back
  parent's PC:   telehug pair finish < grant.txt
Both PCs then show the same eight words. Read them to each other: if they differ, somebody sits in between; revoke.
As the user that the daemons run as; start the daemons again afterwards.)";

struct Options {
  std::string name;
  std::string file;
  std::string id;
  std::string folder;
  bool json = false;
};

WallTime now() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

ExitCode fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "telehug: {}\n", message);
  return code;
}

PairStore store(const Options& options, Side side) {
  PeerConfig config;
  config.pairs_folder = options.folder;
  return {pairs_folder(config, side), side};
}

// A little more than any telehug text has: what is longer is refused where it is read.
Result<std::string> text_from(const std::string& file) {
  constexpr std::size_t longest = 128 * 1024;
  std::ifstream opened;
  if (!file.empty()) {
    opened.open(file, std::ios::binary);
    if (!opened) return Error{fmt::format("{} can't be read", file)};
  }
  std::istream& in = file.empty() ? std::cin : opened;
  std::string text(longest, '\0');
  in.read(text.data(), static_cast<std::streamsize>(longest));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

// On the error stream: the output of `grant` is a text to be sent.
void tell_phrase(const Pair& pair) {
  fmt::print(stderr,
             "Paired with {} until {} (pair {}).\n"
             "Compare these words with the other side, by voice: {}\n"
             "If theirs differ, somebody sits between the two PCs: `telehug pair revoke {}`\n",
             plain_text(pair.name), date(pair.expires), pair.id, pair.phrase, pair.id);
}

ExitCode request(const Options& options) {
  const auto text = store(options, Side::active).request(options.name);
  if (!text) return fail(ExitCode::refused, text.error().message);
  fmt::print("{}", *text);
  return ExitCode::ok;
}

ExitCode grant(const Options& options) {
  const auto asked = text_from(options.file);
  if (!asked) return fail(ExitCode::usage, asked.error().message);
  const auto granted = store(options, Side::passive).grant(*asked, options.name, now());
  if (!granted) return fail(ExitCode::refused, granted.error().message);
  fmt::print("{}", granted->grant);
  tell_phrase(granted->pair);
  return ExitCode::ok;
}

ExitCode finish(const Options& options) {
  const auto text = text_from(options.file);
  if (!text) return fail(ExitCode::usage, text.error().message);
  const auto pair = store(options, Side::active).accept(*text, now());
  if (!pair) return fail(ExitCode::refused, pair.error().message);
  tell_phrase(*pair);
  return ExitCode::ok;
}

// What this PC touches, and who touches here.
ExitCode list(const Options& options) {
  nlohmann::json all = nlohmann::json::array();
  std::string text;
  for (const Side side : {Side::active, Side::passive}) {
    const PairStore pairs = store(options, side);
    for (const Pair& pair : pairs.list()) {
      const auto faults = pairs.preflight(pair, now());
      all.push_back({{"id", pair.id},
                     {"name", pair.name},
                     {"side", side == Side::active ? "active" : "passive"},
                     {"phrase", pair.phrase},
                     {"expires", date(pair.expires)},
                     {"usable", faults.empty()}});
      text += fmt::format("{}  {} {}, until {}: {}\n", pair.id, side == Side::active ? "touches" : "is touched by",
                          plain_text(pair.name), date(pair.expires), pair.phrase);
      for (const PairingFault& fault : faults)
        text += fmt::format("  {}: {}\n  -> {}\n", fault.file.string(), fault.what, fault.to_do);
    }
  }
  if (options.json) {
    fmt::print("{}\n", all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}", text.empty() ? "no pair yet: `telehug pair --help` says how to make one\n" : text);
  }
  return ExitCode::ok;
}

ExitCode revoke(const Options& options) {
  const bool revoked =
      store(options, Side::active).revoke(options.id) || store(options, Side::passive).revoke(options.id);
  if (!revoked) return fail(ExitCode::refused, fmt::format("there is no pair {}; see `telehug pair list`", options.id));
  fmt::print("The pair {} is gone from this PC; a daemon that was using it ends.\n", options.id);
  return ExitCode::ok;
}

}  // namespace

void add_pair(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* pair = app.add_subcommand("pair", "Make, list and revoke pairs of two PCs");
  pair->footer(about_pairing);
  pair->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, ExitCode (*command)(const Options&)) {
    CLI::App* added = pair->add_subcommand(name, help);
    added->add_option("--folder", options->folder, "Where the pairs are kept (as peer.pairs_folder)")->type_name("DIR");
    added->callback([options, command, &result] { result = command(*options); });
    return added;
  };
  const auto text_option = [&](CLI::App* command) {
    command->add_option("--file", options->file, "Read the text from there instead of the input")->type_name("FILE");
  };
  const auto name_option = [&](CLI::App* command, const char* help) {
    command->add_option("--name", options->name, help)->required()->type_name("NAME");
  };
  name_option(add("request", "Parent's PC: ask to touch; prints the text for the wearer", request),
              "Your name, as the wearer sees it");
  CLI::App* granting = add("grant", "Wearer's PC: allow who asked to touch; prints the answer", grant);
  name_option(granting, "The wearer's name, as the parent sees it");
  text_option(granting);
  text_option(add("finish", "Parent's PC: take the wearer's answer", finish));
  add("list", "Who touches, and is touched, from this PC", list)
      ->add_flag("--json", options->json, "For programs: an array");
  add("revoke", "End a pair, at once", revoke)->add_option("ID", options->id, "The pair, by its id")->required();
}

}  // namespace telehug
