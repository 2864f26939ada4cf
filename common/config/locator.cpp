// SPDX-License-Identifier: Apache-2.0
#include "config/locator.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "common/rfcomm_peer.hpp"

namespace telehug {
namespace {

// Of a list with commas, without blanks around its words. Empty: no word.
std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> words;
  if (list.empty()) return words;
  for (std::size_t from = 0; from <= list.size();) {
    const std::size_t comma = std::min(list.find(',', from), list.size());
    std::string word(list.substr(from, comma - from));
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    words.push_back(std::move(word));
    from = comma + 1;
  }
  return words;
}

// What follows "scheme:" if the text begins so and anything follows.
std::optional<std::string> after(std::string_view scheme, std::string_view text) {
  if (!text.starts_with(scheme) || text.size() == scheme.size()) return std::nullopt;
  return std::string(text.substr(scheme.size()));
}

bool is_ipv4(const std::string& text) {
  in_addr parsed{};
  return inet_pton(AF_INET, text.c_str(), &parsed) == 1;
}

bool is_port(const std::string& text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc() && end == text.data() + text.size() && port >= 1 && port <= 65'535;
}

}  // namespace

Result<CameraSource> parse_camera_source(std::string_view text) {
  if (text == "webcam") return CameraSource{CameraSourceKind::webcam, {}};
  const auto question = text.find('?');
  const bool directed = question != std::string_view::npos && question + 1 < text.size();
  const std::string_view rig = directed ? text.substr(0, question) : text;
  if (rig == "virtual") return CameraSource{CameraSourceKind::virtual_rig, {}};
  if (const auto seed = after("virtual:", rig);
      seed && seed->size() <= 9 && seed->find_first_not_of("0123456789") == std::string::npos) {
    return CameraSource{CameraSourceKind::virtual_rig, {}};
  }
  if (auto folder = after("replay:", text)) return CameraSource{CameraSourceKind::recording, *folder};
  return Error{
      fmt::format("\"{}\" is not a camera source: it is \"webcam\", \"replay:DIR\", \"virtual\" or \"virtual:SEED\", "
                  "both also with ?DIR",
                  text)};
}

Result<ScreenSource> parse_screen_source(std::string_view text) {
  if (text == "auto") return ScreenSource{ScreenSourceKind::automatic, {}};
  if (text == "x11") return ScreenSource{ScreenSourceKind::x11, {}};
  if (text == "portal") return ScreenSource{ScreenSourceKind::portal, {}};
  if (text == "picture") return ScreenSource{ScreenSourceKind::picture, {}};
  if (auto device = after("camera:", text)) return ScreenSource{ScreenSourceKind::camera, *device};
  if (auto folder = after("replay:", text)) return ScreenSource{ScreenSourceKind::recording, *folder};
  return Error{
      fmt::format("\"{}\" is not a source of the screen's picture: it is \"auto\", \"x11\", \"portal\", \"picture\", "
                  "\"camera:DEVICE\" or \"replay:DIR\"",
                  text)};
}

Result<std::optional<ScreenRegion>> parse_screen_region(std::string_view text) {
  if (text.empty()) return std::optional<ScreenRegion>();
  const Error wrong{
      fmt::format("\"{}\" is not a part of the screen: it is \"X,Y,WIDTH,HEIGHT\" in px, X and Y from 0 "
                  "on, WIDTH and HEIGHT above 0, none above 32768",
                  text)};
  constexpr int most_px = 32'768;
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) {
      if (at == end || *at != ',') return wrong;
      ++at;
    }
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc() || numbers[i] < (i < 2 ? 0 : 1) || numbers[i] > most_px) return wrong;
    at = next;
  }
  if (at != end) return wrong;
  return std::optional(ScreenRegion{numbers[0], numbers[1], numbers[2], numbers[3]});
}

Result<std::vector<std::string>> parse_pairs(std::string_view text) {
  auto ids = split(text);
  for (const std::string& id : ids) {
    const bool is_id = id.size() == 16 && id.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!is_id && !(id == "all" && ids.size() == 1)) {
      return Error{fmt::format("\"{}\" is neither the id of a pair (`telehug pair list`) nor \"all\"", id)};
    }
  }
  return ids;
}

Result<std::vector<std::string>> parse_addresses(std::string_view text) {
  auto addresses = split(text);
  for (const std::string& address : addresses) {
    const std::size_t colon = std::min(address.find(':'), address.size());
    if (!is_ipv4(address.substr(0, colon)) || (colon < address.size() && !is_port(address.substr(colon + 1)))) {
      return Error{fmt::format(
          "\"{}\" is not an IPv4 address, nor one with a port behind a colon; several have commas between them",
          address)};
    }
  }
  return addresses;
}

Result<std::string> parse_address(std::string_view text) {
  std::string address(text);
  if (address.empty() || is_ipv4(address)) return address;
  return Error{fmt::format("\"{}\" is not an IPv4 address such as 198.51.100.7", text)};
}

Result<JacketLinkChoice> parse_jacket_link(std::string_view text) {
  if (text == "simulated") return JacketLinkChoice{JacketLinkKind::simulated, {}};
  if (auto path = after("serial:", text)) return JacketLinkChoice{JacketLinkKind::serial, *path};
  if (auto path = after("record:", text)) return JacketLinkChoice{JacketLinkKind::recorded, *path};
  if (auto device = after("rfcomm:", text); device && parse_rfcomm_peer(*device)) {
    return JacketLinkChoice{JacketLinkKind::bluetooth, *device};
  }
  return Error{
      fmt::format("\"{}\" is not a jacket link: it is \"serial:PATH\", \"rfcomm:ADDRESS\" (such as 00:11:22:33:44:55, "
                  "with a channel 00:11:22:33:44:55/1), \"simulated\" or \"record:FILE\"",
                  text)};
}

Result<std::optional<JacketLinkChoice>> parse_optional_jacket_link(std::string_view text) {
  if (text.empty()) return std::optional<JacketLinkChoice>();
  auto link = parse_jacket_link(text);
  if (!link) return link.error();
  return std::optional(*std::move(link));
}

}  // namespace telehug
