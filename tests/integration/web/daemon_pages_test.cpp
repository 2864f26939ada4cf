// SPDX-License-Identifier: Apache-2.0
#include "web/daemon_pages.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "doubles/temporary_folder.hpp"
#include "integration/web/served_page.hpp"
#include "service/control_client.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr EmbeddedFile page[] = {
    {"index.html", "<p>page"}, {"texts.en.json", "{}"}, {"texts.de.json", "{}"}, {"texts.fr.json", "{}"}};

TEST(TheDaemonsPages, EndWhileTheyAndTheLocalSocketAreAskedWithoutPause) {
  const SteadyClock clock;
  const TemporaryFolder folder;
  const auto socket = folder / "control.sock";
  for (int time = 0; time < 20; ++time) {
    auto control = std::make_unique<ControlServer>(ControlServerOptions{.socket = socket, .group = {}});
    DaemonPages pages({}, {.side = Side::passive, .commands = {"status"}, .topics = {"news"}, .files = page}, *control,
                      clock);
    control->on("status", [&pages](const Json&) {
      Json status;
      pages.add_status(status);
      return status;
    });
    control->start();
    pages.start();
    auto attempt = ControlClient::connect(socket);
    auto& client = std::get<ControlClient>(attempt);
    const std::string url = client.ask({{"command", "open"}}).value().at("url");
    const std::string host = url.substr(7, url.find('/', 7) - 7);
    const auto port = static_cast<std::uint16_t>(std::stoi(host.substr(host.find(':') + 1)));
    RawBrowser entering(port);
    entering.send("GET " + url.substr(url.find('/', 7)) + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
    const std::string answer = entering.read_answer();
    const auto begin = answer.find("telehug-passive=");
    const std::string order = fmt::format(
        "POST /command HTTP/1.1\r\nHost: {0}\r\nOrigin: http://{0}\r\nContent-Type: application/json\r\n"
        "Cookie: {1}\r\nContent-Length: 20\r\n\r\n{{\"command\":\"status\"}}",
        host, answer.substr(begin, answer.find(';', begin) - begin));
    RawBrowser asking(port);
    std::thread by_page([&] {
      while (asking.send(order) && asking.read_answer().starts_with("HTTP/1.1 200 ")) {
      }
    });
    std::thread by_socket([&client] {
      while (client.ask({{"command", "open"}})) {
      }
    });
    EXPECT_TRUE(eventually([&] { return control->stats().requests > 10; }));
    pages.stop();
    control.reset();
    by_page.join();
    by_socket.join();
  }
}

}  // namespace
}  // namespace telehug
