// SPDX-License-Identifier: Apache-2.0
#include "pairing/armour.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <vector>

#include "common/outside_json.hpp"

namespace telehug {
namespace {

constexpr std::size_t line_length = 64;

std::string begin_line(const std::string& kind) {
  return fmt::format("-----BEGIN TELEHUG {}-----", kind);
}

std::string end_line(const std::string& kind) {
  return fmt::format("-----END TELEHUG {}-----", kind);
}

}  // namespace

std::string armour(const std::string& kind, const nlohmann::json& content) {
  const std::string bytes = content.dump();
  std::vector<unsigned char> base64(4 * ((bytes.size() + 2) / 3) + 1);
  const int length = EVP_EncodeBlock(base64.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                                     static_cast<int>(bytes.size()));
  const std::string all(base64.begin(), base64.begin() + length);
  std::string text = begin_line(kind) + "\n";
  for (std::size_t at = 0; at < all.size(); at += line_length)
    text += all.substr(at, line_length) + "\n";
  return text + end_line(kind) + "\n";
}

Result<nlohmann::json> unarmour(const std::string& kind, const std::string& text) {
  const auto broken = [&kind](const char* why) {
    return Error{fmt::format("this is no telehug {}: {}; copy it whole, from {} to {}", kind, why, begin_line(kind),
                             end_line(kind))};
  };
  if (text.size() > max_armoured_size) return broken("it is too long");
  const std::size_t begin = text.find(begin_line(kind));
  if (begin == std::string::npos) return broken("its first line is missing");
  const std::size_t from = begin + begin_line(kind).size();
  const std::size_t end = text.find(end_line(kind), from);
  if (end == std::string::npos) return broken("its last line is missing");
  std::string base64;
  for (const char c : text.substr(from, end - from)) {
    const bool of_base64 =
        (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/' || c == '=';
    // Mail programs put a > before each line of an answer.
    if (!of_base64 && std::string_view(" \t\r\n>").find(c) == std::string_view::npos) {
      return broken("there is something else within it");
    }
    if (of_base64) base64 += c;
  }
  if (base64.empty() || base64.size() % 4 != 0) return broken("something of it is missing");
  std::vector<unsigned char> bytes(base64.size() / 4 * 3);
  const int length = EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(base64.data()),
                                     static_cast<int>(base64.size()));
  if (length < 0) return broken("it was damaged");
  const auto padding = std::count(base64.end() - 2, base64.end(), '=');
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()),
                                 static_cast<std::size_t>(length - padding));
  auto json = parse_outside_json(content);
  if (!json.is_object() || json.value("version", nlohmann::json()) != 1)
    return broken("it was damaged, or is of a newer telehug");
  return json;
}

bool holds(const std::string& kind, const std::string& text) {
  return text.find(begin_line(kind)) != std::string::npos;
}

std::string text_in(const nlohmann::json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace telehug
