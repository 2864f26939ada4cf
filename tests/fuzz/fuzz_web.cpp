// SPDX-License-Identifier: Apache-2.0
//
// The pages' server: whatever a program of this PC, or a website in its browser, sends to it. Who has no session gets
// nothing but refusals, and no command reaches the daemon.
#include <fmt/core.h>

#include <array>
#include <cstdlib>

#include "doubles/fake_clock.hpp"
#include "fuzz/bytes.hpp"
#include "fuzz/waits.hpp"
#include "integration/web/raw_browser.hpp"
#include "web/web_server.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr EmbeddedFile files[] = {
    {"index.html", "<p>page"},
    {"texts.en.json", "{}"},
    {"texts.de.json", "{}"},
    {"texts.fr.json", "{}"},
    {"shared/texts.en.json", R"({"door.no_session":"","door.link_used":""})"},
    {"shared/texts.de.json", R"({"door.no_session":"","door.link_used":""})"},
    {"shared/texts.fr.json", R"({"door.no_session":"","door.link_used":""})"},
};
constexpr std::uint16_t port = 8077;

void require(bool holds) {
  if (!holds) std::abort();
}

WebSiteOptions options() {
  return {"telehug-fuzz", {"status"}, {"news"}};
}

// Bytes of a stranger, on the wire.
void say(const std::string& bytes) {
  static const SteadyClock clock;
  static WebServer server(
      {}, options(), WebFiles({files}), [](const Json&, const WebServer::Answered&) { std::abort(); }, clock);
  static const bool started = [] {
    let_waits_go_on();
    server.start();
    return true;
  }();
  require(started);
  RawBrowser browser(server.port());
  browser.send(bytes);
  browser.say_no_more();
  const std::string answer = browser.read_to_the_end();
  require(answer.empty() || answer.starts_with("HTTP/1.1 4"));
}

// A request taken apart, of somebody who may have a session.
void ask(Bytes bytes) {
  FakeClock clock;
  WebSite site(options(), WebFiles({files}));
  const std::string link = site.new_link(clock.now());
  WebRequest enter;
  enter.method = "GET";
  enter.path = "/enter";
  enter.query = std::string_view(link).substr(link.find('?') + 1);
  enter.host = "127.0.0.1:8077";
  const auto opened = std::get<WebAnswer>(site.reply(enter, port, clock.now()).what);
  const std::string set = opened.headers.at(1).second;
  const std::string own_cookie = set.substr(0, set.find(';'));

  const std::uint8_t right = bytes.byte();
  std::array<std::string, 9> parts;
  for (std::string& part : parts)
    part = bytes.text(bytes.byte());
  const std::string body = bytes.rest();
  WebRequest request{parts[0], parts[1], parts[2], parts[3], parts[4], parts[5], parts[6], parts[7], parts[8], body};
  // What could hardly be guessed is given, in part.
  if ((right & 1U) != 0) request.host = enter.host;
  if ((right & 2U) != 0) request.origin = "http://127.0.0.1:8077";
  if ((right & 4U) != 0) request.cookie = own_cookie;
  if ((right & 8U) != 0) request.method = (right & 16U) != 0 ? "POST" : "GET";
  if ((right & 32U) != 0) request.content_type = "application/json";
  if ((right & 64U) != 0) request.path = "/command";
  const WebReply reply = site.reply(request, port, clock.now());

  const auto* answer = std::get_if<WebAnswer>(&reply.what);
  if (request.cookie != own_cookie) require(!reply.known && answer != nullptr && answer->status >= 400);
  if (const auto* command = std::get_if<WebCommand>(&reply.what)) {
    require(reply.known && request.method == "POST" && !request.origin.empty());
    require(command->request.at("command") == "status");
    (void)command->request.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  if (bytes.byte() % 4 == 0) {
    telehug::say(bytes.rest());
  } else {
    telehug::ask(bytes);
  }
  return 0;
}
