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
#include "files/folder_owner.hpp"
#include "files/private_file.hpp"
#include "network/ways_in.hpp"
#include "pairing/pairing.hpp"
#include "pairing/wireguard.hpp"
#include "pairing_link/pairing_exchange.hpp"
#include "pairing_link/qr_code.hpp"
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

void print_renewed(std::FILE* to, const Pair& pair, bool is_news, bool json) {
  if (json) return fmt::print(to, "{}\n", nlohmann::json{{"pair", as_json(pair)}, {"renewed", is_news}}.dump());
  fmt::print(to, "The pair with {} (id {}) is {} until {:%Y-%m-%d}.\n", plain_text(pair.name), pair.id,
             is_news ? "renewed and valid" : "valid already", fmt::gmtime(pair.expires.time_since_epoch().count()));
  if (pair.side == Side::passive)
    fmt::print(to,
               "The other PC gets this by itself when both are connected, or take the text there: `telehug pair "
               "finish`.\n");
}

// By its id or the other person's name.
Result<Pair> pair_called(const PairStore& store, const std::string& word) {
  std::vector<Pair> found;
  std::string ids;
  for (Pair& pair : store.list()) {
    if (pair.id != word && pair.name != word) continue;
    ids += (ids.empty() ? "" : ", ") + pair.id;
    found.push_back(std::move(pair));
  }
  if (found.empty()) return Error{fmt::format("no pair {}: `telehug pair list` shows the pairs", word)};
  if (found.size() > 1) return Error{fmt::format("several pairs are called {}: say which by its id: {}", word, ids)};
  return found.front();
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
  const AsCaller caller;
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

// What is for the other PC: into the file, or to stdout.
ExitCode hand_over(const std::string& text, const std::filesystem::path& file) {
  if (file.empty()) {
    fmt::print("{}\n", text);
    return ExitCode::ok;
  }
  const AsCaller caller;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text << '\n' << std::flush;
  return out ? ExitCode::ok : fail(ExitCode::refused, fmt::format("{} can't be written", file.string()));
}

ExitCode take_renewal(PairStore& store, const std::string& text, bool json) {
  const auto renewal = parse_renewal(text);
  if (!renewal) return fail(ExitCode::refused, renewal.error().message);
  const auto installed = store.install(*renewal, wall_time());
  if (!installed) return fail(ExitCode::refused, installed.error().message);
  const bool is_news = installed->has_value();
  print_renewed(stdout, is_news ? **installed : store.find(renewal->pair).value(), is_news, json);
  return ExitCode::ok;
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
  const QrCode qr = make_qr_code(to_qr_text(invitation->code()));
  if (!wish.qr_svg.empty()) {
    const std::string svg = to_svg(qr);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(svg.data());
    const AsCaller caller;
    if (const Status written = write_private_file(wish.qr_svg, {bytes, svg.size()}); !written)
      return fail(ExitCode::refused, written.error().message);
  }
  if (wish.json) {
    fmt::print("{}\n", nlohmann::json{{"code", code}, {"address", where}}.dump());
  } else {
    if (wish.qr) fmt::print("{}", to_terminal(qr));
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
  return hand_over(*request, wish.file);
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
  const auto text = read_text(wish.file);
  if (!text) return fail(ExitCode::refused, text.error().message);
  PairStore store(wish.folder, wish.side);
  if (is_renewal(*text)) return take_renewal(store, *text, wish.json);
  const auto pair = store.accept(*text, wall_time());
  if (!pair) return fail(ExitCode::refused, pair.error().message);
  print_pair(stdout, *pair, wish.json);
  return ExitCode::ok;
}

ExitCode pair_renew(const PairingWish& wish) {
  PairStore store(wish.folder, wish.side);
  const auto pair = pair_called(store, wish.word);
  if (!pair) return fail(ExitCode::refused, pair.error().message);
  const auto renewal = store.renew(*pair, wall_time());
  if (!renewal) return fail(ExitCode::refused, renewal.error().message);
  // Stdout is the text for the other PC and nothing else.
  print_renewed(stderr, present(*pair), true, wish.json);
  return hand_over(to_text(*renewal), wish.file);
}

}  // namespace telehug
