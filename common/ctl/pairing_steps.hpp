// SPDX-License-Identifier: Apache-2.0
//
// What the subcommands of `telehug pair` do, once the command line is read. Results go to stdout, problems to stderr.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/messages.hpp"
#include "service/exit_code.hpp"

namespace telehug {

struct PairingWish {
  Side side = Side::active;
  std::filesystem::path folder;
  std::string name;     // how the other person sees this one
  std::string address;  // empty: the one of the default route
  std::uint16_t port = 0;
  std::string wireguard;       // where the other PC can dial this one, as given; empty: it can't
  std::filesystem::path file;  // empty: stdin or stdout
  std::string word;            // the code of accept, the id of revoke, the name or id of renew
  bool json = false;
  bool qr = false;               // invite: the code as a QR code as well
  std::filesystem::path qr_svg;  // invite: a picture of it; empty: none
};

ExitCode pair_invite(const PairingWish& wish);
ExitCode pair_accept(const PairingWish& wish);
ExitCode pair_list(const PairingWish& wish);
ExitCode pair_revoke(const PairingWish& wish);

// Without a connection: request on the parent's PC, grant on the wearer's, finish on the parent's. Later renew on the
// wearer's and, unless the link does it, finish on the parent's again.
ExitCode pair_request(const PairingWish& wish);
ExitCode pair_grant(const PairingWish& wish);
ExitCode pair_finish(const PairingWish& wish);
ExitCode pair_renew(const PairingWish& wish);

}  // namespace telehug
