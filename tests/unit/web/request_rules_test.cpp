// SPDX-License-Identifier: Apache-2.0
#include "web/request_rules.hpp"

#include <gtest/gtest.h>

#include <array>

namespace telehug {
namespace {

constexpr std::uint16_t port = 8077;

WebRequest get() {
  WebRequest request;
  request.method = "GET";
  request.path = "/";
  request.host = "127.0.0.1:8077";
  return request;
}

WebRequest post() {
  WebRequest request = get();
  request.method = "POST";
  request.origin = "http://127.0.0.1:8077";
  request.content_type = "application/json";
  return request;
}

unsigned status_of(const WebRequest& request) {
  const auto refused = refusal_of(request, port);
  return refused ? refused->status : 200;
}

TEST(TheRequestRules, LetAPageOfThisServerAsk) {
  EXPECT_EQ(status_of(get()), 200U);
  EXPECT_EQ(status_of(post()), 200U);
  WebRequest request = post();
  request.host = "localhost:8077";
  request.origin = "http://localhost:8077";
  request.content_type = "Application/JSON; charset=utf-8";
  EXPECT_EQ(status_of(request), 200U);
}

TEST(TheRequestRules, RefuseEveryOtherHost) {
  for (const char* host : {"", "evil.example", "evil.example:8077", "127.0.0.1", "127.0.0.1:80", "127.0.0.1:80770",
                           "127.0.0.1:8077.evil.example", "127.0.0.2:8077", "LOCALHOST:8077", "localhost",
                           "127.0.0.1:8077 ", "[::1]:8077"}) {
    WebRequest request = get();
    request.host = host;
    EXPECT_EQ(status_of(request), 421U) << host;
  }
}

TEST(TheRequestRules, RefuseEveryOtherOrigin) {
  for (const char* origin :
       {"null", "http://evil.example", "https://127.0.0.1:8077", "http://127.0.0.1", "http://127.0.0.1:8078",
        "http://localhost:8077", "http://127.0.0.1:8077/", "http://127.0.0.1:8077.evil.example"}) {
    for (WebRequest request : {get(), post()}) {
      request.origin = origin;
      EXPECT_EQ(status_of(request), 403U) << request.method << origin;
    }
  }
}

TEST(TheRequestRules, WantToKnowWhereAPostComesFrom) {
  WebRequest request = post();
  request.origin = "";
  EXPECT_EQ(status_of(request), 403U);
}

TEST(TheRequestRules, TakeNothingButJsonSoThatNoFormOfAnotherPageCanSendIt) {
  for (const char* type : {"", "text/plain", "application/x-www-form-urlencoded", "multipart/form-data",
                           "text/plain; application/json", "application/jsonp"}) {
    WebRequest request = post();
    request.content_type = type;
    EXPECT_EQ(status_of(request), 415U) << type;
  }
}

TEST(TheRequestRules, KnowNoOtherMethods) {
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "get", ""}) {
    WebRequest request = post();
    request.method = method;
    EXPECT_EQ(status_of(request), 405U) << method;
  }
}

TEST(ACookie, IsReadByItsName) {
  EXPECT_EQ(cookie_value("telehug-passive=ab12", "telehug-passive"), "ab12");
  EXPECT_EQ(cookie_value("a=1; telehug-passive=ab12;b=2", "telehug-passive"), "ab12");
  EXPECT_EQ(cookie_value("a=1", "telehug-passive"), "");
  EXPECT_EQ(cookie_value("telehug-passive", "telehug-passive"), "");
  EXPECT_EQ(cookie_value("x-telehug-passive=1; telehug-passive2=2", "telehug-passive"), "");
}

TEST(ACookie, ThatIsThereTwiceIsNone) {
  EXPECT_EQ(cookie_value("s=1; s=2", "s"), "");
}

TEST(AQuery, IsReadByName) {
  EXPECT_EQ(query_value("link=ab&lang=de", "link"), "ab");
  EXPECT_EQ(query_value("link=ab&lang=de", "lang"), "de");
  EXPECT_EQ(query_value("link=a&link=b", "link"), "");
  EXPECT_EQ(query_value("", "link"), "");
}

TEST(TheLanguage, IsTheOneThatTheBrowserLikesBest) {
  constexpr std::array<std::string_view, 3> languages{"en", "de", "fr"};
  const auto chosen = [&](std::string_view header) { return preferred_language(header, languages); };
  EXPECT_EQ(chosen("de"), "de");
  EXPECT_EQ(chosen("de-CH,de;q=0.9,en;q=0.8"), "de");
  EXPECT_EQ(chosen("en;q=0.5, FR-ca;q=0.7"), "fr");
  EXPECT_EQ(chosen("it, de;q=0.3"), "de");
  EXPECT_EQ(chosen("it"), "en");
  EXPECT_EQ(chosen(""), "en");
  EXPECT_EQ(chosen("*"), "en");
  EXPECT_EQ(chosen("de;q=0"), "en");
  EXPECT_EQ(chosen("de;q=nan,fr;q=1e9,en;q=0.1"), "en") << "what is no number is no liking";
}

}  // namespace
}  // namespace telehug
