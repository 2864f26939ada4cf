// SPDX-License-Identifier: Apache-2.0
#include "pairing/wireguard.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "common/outside_json.hpp"
#include "pairing/openssl_handles.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr std::size_t key_bytes = 32;
constexpr std::size_t key_letters = 44;  // in Base64
constexpr std::size_t longest_host = 253;
constexpr std::string_view listens = "ListenPort = ";

using KeyBytes = std::array<unsigned char, key_bytes>;

std::string base64(const KeyBytes& key) {
  std::array<unsigned char, key_letters + 1> text{};
  EVP_EncodeBlock(text.data(), key.data(), static_cast<int>(key.size()));
  return {text.begin(), text.begin() + key_letters};
}

bool is_key(const std::string& text) {
  if (text.size() != key_letters || text.back() != '=' || text[key_letters - 2] == '=') return false;
  std::array<unsigned char, key_letters> bytes{};  // the last one is padding
  return EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(text.data()), key_letters) ==
         static_cast<int>(key_bytes) + 1;
}

std::string text_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

bool is_port(std::string_view text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port >= 1 && port <= 65'535;
}

bool is_ipv6(const std::string& text) {
  in6_addr parsed{};
  return inet_pton(AF_INET6, text.c_str(), &parsed) == 1;
}

// A name or an IPv4 address.
bool is_host(std::string_view text) {
  const auto of_a_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
  };
  return !text.empty() && text.size() <= longest_host && text.front() != '-' && text.front() != '.' &&
         std::all_of(text.begin(), text.end(), of_a_name);
}

// 10.64.0.0 to 10.255.255.255 in blocks of four, away from where most home networks are.
std::string address_of(const std::string& id, Side side) {
  std::uint32_t number = 0;
  std::from_chars(id.data(), id.data() + 8, number, 16);
  constexpr std::uint32_t second_numbers = 256 - 64;
  return fmt::format("10.{}.{}.{}", 64 + (number >> 16U) % second_numbers, (number >> 8U) & 0xFFU,
                     (number & 0xFCU) + (side == Side::passive ? 1 : 2));
}

Side other(Side side) {
  return side == Side::active ? Side::passive : Side::active;
}

std::string port_of(const std::string& endpoint) {
  return endpoint.substr(endpoint.rfind(':') + 1);
}

}  // namespace

Result<std::string> parse_tunnel_endpoint(const std::string& text) {
  if (is_ipv6(text)) return fmt::format("[{}]:{}", text, usual_tunnel_port);
  const std::size_t bracket = text.find(']');
  const bool bracketed = text.starts_with('[') && bracket != std::string::npos;
  const std::size_t host_end = bracketed ? bracket + 1 : std::min(text.find(':'), text.size());
  const std::string host = text.substr(0, host_end);
  const bool good_host = bracketed ? is_ipv6(text.substr(1, bracket - 1)) : is_host(host);
  const std::string rest = text.substr(host_end);
  if (good_host && rest.empty()) return fmt::format("{}:{}", host, usual_tunnel_port);
  if (good_host && rest.front() == ':' && is_port(rest.substr(1))) return text;
  return Error{
      fmt::format("\"{}\" is not where a PC can be dialled: it is a name, an IPv4 or an IPv6 address, with a "
                  "UDP port behind it if wanted, such as home.example.org:51820 or [2001:db8::7]:51820",
                  text)};
}

TunnelEnd make_tunnel_end(const std::string& reachable_at) {
  std::string endpoint;
  if (!reachable_at.empty()) {
    const auto parsed = parse_tunnel_endpoint(reachable_at);
    if (!parsed) throw std::runtime_error(parsed.error().message);
    endpoint = *parsed;
  }
  const KeyHandle key(EVP_PKEY_Q_keygen(nullptr, nullptr, "X25519"));
  KeyBytes secret{};
  KeyBytes open{};
  std::size_t secret_size = secret.size();
  std::size_t open_size = open.size();
  if (!key || EVP_PKEY_get_raw_private_key(key.get(), secret.data(), &secret_size) != 1 ||
      EVP_PKEY_get_raw_public_key(key.get(), open.data(), &open_size) != 1) {
    throw std::runtime_error("OpenSSL could not make a key for WireGuard");
  }
  TunnelEnd end{base64(secret), {base64(open), endpoint}};
  OPENSSL_cleanse(secret.data(), secret.size());
  return end;
}

std::string to_text(const TunnelEnd& end) {
  return Json{{"secret_key", end.secret_key}, {"offer", to_json(end.offer)}}.dump();
}

std::optional<TunnelEnd> read_tunnel_end(const std::string& text) {
  const Json json = parse_outside_json(text);
  if (!json.is_object() || !json.contains("offer") || !json["offer"].is_object()) return std::nullopt;
  return TunnelEnd{text_in(json, "secret_key"),
                   {text_in(json["offer"], "public_key"), text_in(json["offer"], "endpoint")}};
}

Json to_json(const TunnelOffer& offer) {
  return {{"public_key", offer.public_key}, {"endpoint", offer.endpoint}};
}

Result<std::optional<TunnelOffer>> tunnel_offer_in(const Json& text) {
  const auto found = text.find("wireguard");
  if (found == text.end()) return std::optional<TunnelOffer>();
  const Error damaged{"its part about WireGuard is damaged: ask for it again"};
  if (!found->is_object()) return damaged;
  TunnelOffer offer{text_in(*found, "public_key"), text_in(*found, "endpoint")};
  if (!is_key(offer.public_key)) return damaged;
  if (!offer.endpoint.empty()) {
    const auto endpoint = parse_tunnel_endpoint(offer.endpoint);
    if (!endpoint) return damaged;
    offer.endpoint = *endpoint;
  }
  return std::optional(std::move(offer));
}

std::string wireguard_conf(const std::string& id, Side side, const TunnelEnd& own, const TunnelOffer& theirs) {
  std::string text = fmt::format(
      "# The tunnel of telehug's pair {}, for wg-quick(8); docs/between-homes.md says how to use it.\n"
      "[Interface]\nPrivateKey = {}\nAddress = {}/32\n",
      id, own.secret_key, address_of(id, side));
  if (!own.offer.endpoint.empty()) text += fmt::format("{}{}\n", listens, port_of(own.offer.endpoint));
  text += fmt::format("\n[Peer]\nPublicKey = {}\nAllowedIPs = {}/32\n", theirs.public_key, address_of(id, other(side)));
  // Whoever dials keeps its router's way back open.
  if (!theirs.endpoint.empty()) text += fmt::format("Endpoint = {}\nPersistentKeepalive = 25\n", theirs.endpoint);
  return text;
}

std::optional<PairTunnel> tunnel_of(const Pair& pair) {
  const auto file = wireguard_file_in(pair.files.private_key.parent_path());
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return std::nullopt;
  // Network interfaces have names of at most 15 letters.
  PairTunnel tunnel{file, "telehug-" + pair.id.substr(0, 7), address_of(pair.id, pair.side),
                    address_of(pair.id, other(pair.side)), ""};
  const std::string conf = read_secret(file);
  if (const std::size_t at = conf.find(listens); at != std::string::npos) {
    const std::size_t from = at + listens.size();
    tunnel.listen_port = conf.substr(from, conf.find('\n', from) - from);
  }
  return tunnel;
}

}  // namespace telehug
