// SPDX-License-Identifier: Apache-2.0
//
// What a request must be like before anything is done about it: values in, a verdict out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace telehug {

// What of a request is looked at; views into it. A header that is not there is empty; one that comes twice is none.
struct WebRequest {
  std::string_view method;
  std::string_view path;   // up to the question mark
  std::string_view query;  // behind it
  std::string_view host;
  std::string_view origin;
  std::string_view cookie;
  std::string_view content_type;
  std::string_view accept_language;
  std::string_view if_none_match;
  std::string_view body;
};

// HTTP's status and a sentence for whoever asked.
struct WebRefusal {
  unsigned status = 0;
  std::string_view why;
};

// Was it meant for this server, and by one of its own pages? Another host name is a foreign name that was made to lead
// here (DNS rebinding); another origin is a foreign page. Nothing if all is well.
[[nodiscard]] std::optional<WebRefusal> refusal_of(const WebRequest& request, std::uint16_t port);

// The value of the cookie `name` in the header Cookie; empty if it is not there, or twice.
[[nodiscard]] std::string_view cookie_value(std::string_view header, std::string_view name);

// The value of `name` in a query; empty if it is not there, or twice. Nothing of ours needs decoding.
[[nodiscard]] std::string_view query_value(std::string_view query, std::string_view name);

// Of the languages "en", "de" ... that there are, the one that a browser's Accept-Language (RFC 9110, 12.5.4) likes
// best; the first if it likes none of them.
[[nodiscard]] std::string_view preferred_language(std::string_view accept_language,
                                                  std::span<const std::string_view> languages);

}  // namespace telehug
