// SPDX-License-Identifier: Apache-2.0
#include "ctl/pairing_steps.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include "ctl/own_address.hpp"
#include "ctl/plain_text.hpp"
#include "network/ways_in.hpp"
#include "pairing/pairing.hpp"
#include "pairing/wireguard.hpp"
#include "pairing_link/pairing_exchange.hpp"
#include "service/control_socket.hpp"
#include "service/signals.hpp"

namespace telehug {

namespace {

constexpr std::size_t longest_text = 64 * 1024;

ExitCode fail(ExitCode code, const std::string& sentence) {
  fmt::print(stderr, "telehug: {}\n", plain_text(sentence));
  return code;
}

nlohmann::json as_json(const Pair& pair) {
  nlohmann::json json{
      {"id", pair.id},
      {"name", pair.name},
      {"side", side_name(pair.side)},
      {"phrase", pair.phrase},
      {"expires", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(pair.expires.time_since_epoch().count()))}};
  if (const auto tunnel = tunnel_of(pair)) {
    json["tunnel"] = {{"file", tunnel->file.string()},
                      {"interface", tunnel->interface},
                      {"address", tunnel->own_address},
                      {"peer_address", tunnel->peer_address}};
  }
  return json;
}

void print_tunnel(std::FILE* to, const PairTunnel& tunnel) {
  fmt::print(to,
             "\nTheir WireGuard tunnel is begun on each PC by (`apt install wireguard-tools` before):\n"
             "  sudo install -m 600 {0} /etc/wireguard/{1}.conf\n"
             "  sudo systemctl enable --now wg-quick@{1}\n"
             "telehug then finds the other PC in it by itself, at {2}.\n",
             tunnel.file.string(), tunnel.interface, tunnel.peer_address);
  if (tunnel.listen_port.empty()) return;
  fmt::print(to, "The other PC dials this one. {}\n", advice(ways_in(lasting_addresses()), tunnel.listen_port));
}

void print_end_of_tunnel(const PairTunnel& tunnel) {
  fmt::print(
      "Its tunnel, if it was begun, is ended by:\n"
      "  sudo systemctl disable --now wg-quick@{0}\n  sudo shred -u /etc/wireguard/{0}.conf\n",
      tunnel.interface);
}

void print_pair(std::FILE* to, const Pair& pair, bool json) {
  if (json) return fmt::print(to, "{}\n", nlohmann::json{{"pair", as_json(pair)}}.dump());
  fmt::print(
      to,
      "Paired with {} (id {}).\nPhrase: {}\nRead the phrase to each other: if both PCs show the same words, nobody "
      "sits in between; if not, take it back with `telehug pair revoke {}`.\n",
      plain_text(pair.name), pair.id, pair.phrase, pair.id);
  if (const auto tunnel = tunnel_of(pair)) return print_tunnel(to, *tunnel);
  fmt::print(to, "If the other PC is in another home, the two need a tunnel: pair them again with --wireguard. {}\n",
             advice(ways_in(lasting_addresses()), usual_tunnel_port));
}

// A pair that can't be read can still be revoked.
std::optional<PairTunnel> tunnel_of_pair(const PairStore& store, const std::string& id) {
  try {
    for (const Pair& pair : store.list())
      if (pair.id == id) return tunnel_of(pair);
    return std::nullopt;
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

// A pairing by connection, as this PC's store does it.
class Pairing {
 public:
  explicit Pairing(const PairingWish& wish) : wish_(wish), store_(wish.folder, wish.side) {}

  Offer offer() {
    return {.side = wish_.side,
            .make_request = [this] { return store_.request(wish_.name, wish_.wireguard); },
            .accept = [this](const std::string& grant) -> Status {
              auto pair = store_.accept(grant, wall_time());
              if (!pair) return pair.error();
              pair_ = *pair;
              return Done{};
            },
            .grant_for = [this](const std::string& request) -> Result<std::string> {
              auto granted = store_.grant(request, wish_.name, wall_time(), wish_.wireguard);
              if (!granted) return granted.error();
              pair_ = granted->pair;
              return granted->grant;
            }};
  }

  ExitCode finish(const Status& outcome) {
    if (outcome && pair_) {
      print_pair(stdout, *pair_, wish_.json);
      return ExitCode::ok;
    }
    // Half a pair is none: the other PC has not confirmed that it can use it.
    if (pair_) store_.revoke(pair_->id);
    return fail(ExitCode::refused, outcome ? "the pairing gave no pair" : outcome.error().message);
  }

 private:
  const PairingWish& wish_;
  PairStore store_;
  std::optional<Pair> pair_;
};

Result<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream opened;
  if (!file.empty()) opened.open(file, std::ios::binary);
  std::istream& from = file.empty() ? std::cin : opened;
  if (!from) return Error{fmt::format("{} can't be read", file.string())};
  std::string text(longest_text + 1, '\0');
  from.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(from.gcount()));
  if (text.size() > longest_text) return Error{"this is too long for a text of a pairing"};
  return text;
}

}  // namespace

ExitCode pair_invite(const PairingWish& wish) {
  Signals signals;
  Pairing pairing(wish);
  const auto at = own_endpoint(wish.address, wish.port);
  if (!at) return fail(ExitCode::network, at.error().message);
  std::optional<Invitation> invitation;
  try {
    invitation.emplace(*at);
  } catch (const std::runtime_error& problem) {
    return fail(ExitCode::network, problem.what());
  }
  const std::string code = to_text(invitation->code());
  const std::string where = to_text(invitation->code().inviter);
  if (wish.json) {
    fmt::print("{}\n", nlohmann::json{{"code", code}, {"address", where}}.dump());
  } else {
    fmt::print(
        "{}\nTell it to the other person only, who types `telehug pair accept CODE`. It is good for 10 minutes and "
        "one pairing, while this program waits at {}.\n",
        code, where);
  }
  (void)std::fflush(stdout);
  return pairing.finish(invitation->pair(pairing.offer(), signals.fd()));
}

ExitCode pair_accept(const PairingWish& wish) {
  Signals signals;
  const auto code = parse_pairing_code(wish.word);
  if (!code) return fail(ExitCode::usage, code.error().message);
  Pairing pairing(wish);
  return pairing.finish(accept_invitation(*code, pairing.offer(), {}, signals.fd()));
}

ExitCode pair_list(const PairingWish& wish) {
  const PairStore store(wish.folder, wish.side);
  auto pairs = nlohmann::json::array();
  for (const Pair& pair : store.list()) {
    auto& json = pairs.emplace_back(as_json(pair));
    json["faults"] = nlohmann::json::array();
    for (const PairingFault& fault : store.preflight(pair, wall_time()))
      json["faults"].push_back({{"file", fault.file.string()}, {"what", fault.what}, {"do", fault.to_do}});
  }
  if (wish.json) {
    fmt::print("{}\n", nlohmann::json{{"pairs", pairs}}.dump());
    return ExitCode::ok;
  }
  if (pairs.empty()) fmt::print("no pairs in {}\n", wish.folder.string());
  for (const auto& pair : pairs) {
    fmt::print("{}  {}  until {}  {}\n", text_of(pair["id"]), text_of(pair["name"]), text_of(pair["expires"]),
               text_of(pair["phrase"]));
    if (pair.contains("tunnel"))
      fmt::print("  tunnel {}: this PC is {}, the other {}; {}\n", text_of(pair["tunnel"]["interface"]),
                 text_of(pair["tunnel"]["address"]), text_of(pair["tunnel"]["peer_address"]),
                 text_of(pair["tunnel"]["file"]));
    for (const auto& fault : pair["faults"])
      fmt::print("  {}: {}\n  -> {}\n", text_of(fault["file"]), text_of(fault["what"]), text_of(fault["do"]));
  }
  return ExitCode::ok;
}

ExitCode pair_revoke(const PairingWish& wish) {
  PairStore store(wish.folder, wish.side);
  const auto tunnel = tunnel_of_pair(store, wish.word);
  if (!store.revoke(wish.word))
    return fail(ExitCode::refused, fmt::format("no pair {}: `telehug pair list` shows the pairs", wish.word));
  fmt::print("revoked {}\n", wish.word);
  if (tunnel) print_end_of_tunnel(*tunnel);
  return ExitCode::ok;
}

ExitCode pair_request(const PairingWish& wish) {
  if (wish.side != Side::active) return fail(ExitCode::usage, "a request is made on the parent's PC (--side active)");
  PairStore store(wish.folder, wish.side);
  const auto request = store.request(wish.name, wish.wireguard);
  if (!request) return fail(ExitCode::refused, request.error().message);
  if (wish.file.empty()) {
    fmt::print("{}\n", *request);
    return ExitCode::ok;
  }
  std::ofstream out(wish.file, std::ios::binary | std::ios::trunc);
  out << *request << '\n' << std::flush;
  return out ? ExitCode::ok : fail(ExitCode::refused, fmt::format("{} can't be written", wish.file.string()));
}

ExitCode pair_grant(const PairingWish& wish) {
  if (wish.side != Side::passive) return fail(ExitCode::usage, "a grant is made on the wearer's PC (--side passive)");
  const auto request = read_text(wish.file);
  if (!request) return fail(ExitCode::refused, request.error().message);
  PairStore store(wish.folder, wish.side);
  const auto granted = store.grant(*request, wish.name, wall_time(), wish.wireguard);
  if (!granted) return fail(ExitCode::refused, granted.error().message);
  fmt::print("{}\n", granted->grant);
  // Stdout is the text for the other PC and nothing else.
  print_pair(stderr, granted->pair, wish.json);
  return ExitCode::ok;
}

ExitCode pair_finish(const PairingWish& wish) {
  if (wish.side != Side::active)
    return fail(ExitCode::usage, "a pairing is finished on the parent's PC (--side active)");
  const auto grant = read_text(wish.file);
  if (!grant) return fail(ExitCode::refused, grant.error().message);
  PairStore store(wish.folder, wish.side);
  const auto pair = store.accept(*grant, wall_time());
  if (!pair) return fail(ExitCode::refused, pair.error().message);
  print_pair(stdout, *pair, wish.json);
  return ExitCode::ok;
}

}  // namespace telehug
