// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <memory>

#include "ctl/command.hpp"
#include "ctl/pair_place.hpp"
#include "ctl/pair_side.hpp"
#include "ctl/pairing_steps.hpp"
#include "files/folder_owner.hpp"
#include "pairing/wireguard.hpp"

namespace telehug {

namespace {

constexpr const char* ways = R"(
On one network: `invite` prints a code; tell it to the other person, who gives it to `accept`. Both print a phrase to
compare.

Between two homes (one of the PCs can be dialled at a forwarded UDP port or an IPv6 address):
  telehug pair invite --wireguard home.example.org:51820
                                              with a WireGuard tunnel, for which both PCs then have a file

Where the PCs can't reach each other directly, by chat or USB stick:
  telehug pair request > request.txt          on the parent's PC
  telehug pair grant < request.txt > grant.txt    on the wearer's PC
  telehug pair finish < grant.txt             on the parent's PC

A pair is valid for a year and is renewed by itself while both PCs are connected. By hand:
  telehug pair renew Mum > renewal.txt        on the wearer's PC
  telehug pair finish < renewal.txt           on the parent's PC)";

struct Given {
  PairingWish wish;
  std::string side;
};

std::string name_of_this_pc() {
  std::array<char, 65> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "telehug";
}

class PairCommands {
 public:
  PairCommands(CLI::App& pair, ExitCode& result) : pair_(pair), result_(result) {}

  // of: whose PC the command is for anyway, if it is one's only.
  CLI::App* add(const char* name, const char* about, ExitCode (*step)(const PairingWish&), const std::string& of = "") {
    CLI::App* command = pair_.add_subcommand(name, about);
    command
        ->add_option("--side", given_->side, "What this PC is: active (parent's), passive (wearer's); default: found")
        ->check(CLI::IsMember({"active", "passive"}));
    command->add_option("--folder", given_->wish.folder, "Where the pairs are kept (default: where the daemon looks)")
        ->type_name("DIR");
    command->callback([given = given_, step, of, called = std::string(name), &result = result_] {
      const auto side = side_of_this_pc(given->side.empty() ? of : given->side);
      if (!side) {
        (void)std::fprintf(stderr, "telehug: %s\n", side.error().message.c_str());
        result = ExitCode::usage;
        return;
      }
      PairingWish wish = given->wish;
      wish.side = *side;
      if (wish.folder.empty()) {
        const auto place = place_of_pairs(*side, usual_config_sources(), called + " ...", ::geteuid());
        if (!place) {
          (void)std::fprintf(stderr, "telehug: %s\n", place.error().message.c_str());
          result = ExitCode::permission;
          return;
        }
        wish.folder = *place;
      }
      if (wish.name.empty()) wish.name = name_of_this_pc();
      if (!wish.wireguard.empty()) {
        const auto endpoint = parse_tunnel_endpoint(wish.wireguard);
        if (!endpoint) {
          (void)std::fprintf(stderr, "telehug: --wireguard: %s\n", endpoint.error().message.c_str());
          result = ExitCode::usage;
          return;
        }
        wish.wireguard = *endpoint;
      }
      const AsOwnerOf owner(wish.folder);
      result = step(wish);
    });
    return command;
  }
  void name(CLI::App* command) {
    command->add_option("--name", given_->wish.name, "How the other person sees you (default: this PC's name)");
  }
  void json(CLI::App* command) { command->add_flag("--json", given_->wish.json, "For programs"); }
  void file(CLI::App* command, const char* about) {
    command->add_option("--file", given_->wish.file, about)->type_name("FILE");
  }
  void word(CLI::App* command, const char* name, const char* about) {
    command->add_option(name, given_->wish.word, about)->required();
  }
  void qr(CLI::App* command) {
    command->add_flag("--qr", given_->wish.qr, "Print it as a QR code, too, for a camera (37 columns, 19 lines)");
    command->add_option("--qr-svg", given_->wish.qr_svg, "Write the QR code as an SVG picture that only you can read")
        ->type_name("FILE");
  }
  void address(CLI::App* command) {
    command->add_option("--address", given_->wish.address,
                        "This PC's IPv4 address as the other reaches it (default: of the default route)");
    command->add_option("--port", given_->wish.port, "TCP port to wait at (default 0: any free one)");
  }

  void wireguard(CLI::App* command) {
    command->add_option("--wireguard", given_->wish.wireguard,
                        "Make a tunnel in which the other PC dials this one at HOST[:PORT] (UDP, default 51820)");
  }

 private:
  CLI::App& pair_;
  ExitCode& result_;
  std::shared_ptr<Given> given_ = std::make_shared<Given>();
};

}  // namespace

void add_pair(CLI::App& app, ExitCode& result) {
  CLI::App* pair = app.add_subcommand("pair", "Make a parent's PC and a wearer's PC known to each other");
  pair->require_subcommand(1);
  PairCommands commands(*pair, result);

  CLI::App* invite = commands.add("invite", "Print a code and wait for the other PC", pair_invite);
  CLI::App* accept = commands.add("accept", "Dial the PC that printed the code", pair_accept);
  CLI::App* list = commands.add("list", "The pairs of this PC", pair_list);
  CLI::App* revoke = commands.add("revoke", "Forget a pair; its secrets are overwritten", pair_revoke);
  CLI::App* request =
      commands.add("request", "Parent's PC: print a request for the wearer's PC", pair_request, "active");
  CLI::App* grant = commands.add("grant", "Wearer's PC: read a request, print the grant", pair_grant, "passive");
  CLI::App* finish = commands.add("finish", "Parent's PC: read the grant or the renewal", pair_finish, "active");
  CLI::App* renew = commands.add("renew", "Wearer's PC: make a pair valid for another year", pair_renew);
  commands.address(invite);
  commands.qr(invite);
  commands.word(accept, "code", "As the other PC printed it, or the text of its QR code; dashes and case don't matter");
  commands.word(revoke, "id", "As list shows it");
  commands.word(renew, "pair", "The other person's name or the pair's id, as list shows them");
  for (CLI::App* command : {invite, accept, request, grant})
    commands.name(command);
  for (CLI::App* command : {invite, accept, request, grant})
    commands.wireguard(command);
  for (CLI::App* command : {invite, accept, list, grant, finish, renew})
    commands.json(command);
  commands.file(request, "Where to write the request (default: stdout)");
  commands.file(grant, "Where to read the request (default: stdin)");
  commands.file(finish, "Where to read the grant or the renewal (default: stdin)");
  commands.file(renew, "Where to write the renewal (default: stdout)");
  pair->footer(ways);  // after its commands, which would take it over
}

}  // namespace telehug
