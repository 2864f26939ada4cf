// SPDX-License-Identifier: Apache-2.0
#include "web/request_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace telehug {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Calls `use` with each part between separators.
template <typename Use>
void for_each_part(std::string_view text, char separator, Use use) {
  while (!text.empty()) {
    const auto end = text.find(separator);
    use(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

std::string_view only_value(std::string_view text, char separator, std::string_view name) {
  std::string_view value;
  int count = 0;
  for_each_part(text, separator, [&](std::string_view part) {
    if (!part.starts_with(name) || part.size() <= name.size() || part[name.size()] != '=') return;
    value = part.substr(name.size() + 1);
    ++count;
  });
  return count == 1 ? value : std::string_view();
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

// "q=0.7"; 1 without, 0 if it is none.
double quality(std::string_view parameters) {
  double quality = 1;
  for_each_part(parameters, ';', [&quality](std::string_view parameter) {
    if (parameter.size() < 2 || lower(parameter[0]) != 'q' || parameter[1] != '=') return;
    const char* end = parameter.data() + parameter.size();
    const auto [read, problem] = std::from_chars(parameter.data() + 2, end, quality, std::chars_format::fixed);
    if (problem != std::errc() || read != end || !std::isfinite(quality)) quality = 0;
  });
  return std::clamp(quality, 0.0, 1.0);
}

// How much (0..1) a header likes a language; 0: not at all.
double liking(std::string_view accept_language, std::string_view language) {
  double most = 0;
  for_each_part(accept_language, ',', [&](std::string_view range) {
    const auto end = range.find(';');
    const std::string_view tag = trimmed(range.substr(0, end));
    if (!same_word(tag.substr(0, tag.find('-')), language)) return;
    most = std::max(most, quality(end == std::string_view::npos ? "" : range.substr(end + 1)));
  });
  return most;
}

bool is_json(std::string_view content_type) {
  return same_word(trimmed(content_type.substr(0, content_type.find(';'))), "application/json");
}

}  // namespace

std::optional<WebRefusal> refusal_of(const WebRequest& request, std::uint16_t port) {
  const std::string number = fmt::format("127.0.0.1:{}", port);
  const std::string name = fmt::format("localhost:{}", port);
  if (request.host != number && request.host != name)
    return WebRefusal{421, "this server answers to its own name only: open the page by `telehug open`"};
  const bool own = request.origin == fmt::format("http://{}", request.host);
  if (!request.origin.empty() && !own) return WebRefusal{403, "another page may not ask this server"};
  if (request.method == "GET") return std::nullopt;
  if (request.method != "POST") return WebRefusal{405, "only GET and POST are answered"};
  if (!own) return WebRefusal{403, "the request does not say which page it comes from"};
  if (!is_json(request.content_type)) return WebRefusal{415, "what is sent must be application/json"};
  return std::nullopt;
}

std::string_view cookie_value(std::string_view header, std::string_view name) {
  return only_value(header, ';', name);
}

std::string_view query_value(std::string_view query, std::string_view name) {
  return only_value(query, '&', name);
}

std::string_view preferred_language(std::string_view accept_language, std::span<const std::string_view> languages) {
  std::string_view best = languages.front();
  double most = 0;
  for (const std::string_view language : languages) {
    const double liked = liking(accept_language, language);
    if (liked <= most) continue;
    most = liked;
    best = language;
  }
  return best;
}

}  // namespace telehug
