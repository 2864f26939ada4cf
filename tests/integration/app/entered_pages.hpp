// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "integration/app/running_pair.hpp"
#include "integration/web/raw_browser.hpp"
#include "service/control_socket.hpp"

namespace telehug {

// A daemon's pages, entered as a person does it: by the command.
class EnteredPages {
 public:
  EnteredPages(const RunningPair& pair, Side side) : port_(pair.status(side).at("web").at("port")) {
    const std::string start = "http://" + host();
    const std::string opened = pair.telehug("open", side, {"--print"}).text;
    if (!opened.starts_with(start + "/enter?link=")) throw std::runtime_error("that is no link: " + opened);
    const std::string path = opened.substr(start.size(), opened.find('\n') - start.size());
    const std::string answer = ask("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    const auto begin = answer.find("telehug-" + side_name(side) + "=");
    if (answer.find("Location: /\r\n") == std::string::npos || begin == std::string::npos)
      throw std::runtime_error("the link leads nowhere: " + answer);
    cookie_ = "Cookie: " + answer.substr(begin, answer.find(';', begin) - begin) + "\r\n";
  }

  [[nodiscard]] std::string get(const std::string& path) const {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + cookie_ + "\r\n";
  }
  [[nodiscard]] std::string ask(const std::string& request) const {
    RawBrowser browser(port_);
    browser.send(request);
    return browser.read_answer();
  }
  [[nodiscard]] nlohmann::json order(const nlohmann::json& request) const {
    const std::string body = request.dump();
    const std::string answer =
        ask("POST /command HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: http://" + host() +
            "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + cookie_ +
            "\r\n" + body);
    return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  }
  // A page that follows these.
  [[nodiscard]] RawBrowser follow(const std::string& topics) const {
    RawBrowser page(port_);
    page.send(get("/live?topics=" + topics));
    return page;
  }
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }

 private:
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(port_); }

  std::uint16_t port_;
  std::string cookie_;
};

}  // namespace telehug
