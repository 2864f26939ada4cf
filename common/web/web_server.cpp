// SPDX-License-Identifier: Apache-2.0
#include "web/web_server.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "service/accept_loop.hpp"
#include "web/live_topics.hpp"
#include "web/web_connection.hpp"

namespace telehug {
namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

std::vector<std::string> list_of(const std::set<std::string>& names) {
  return {names.begin(), names.end()};
}

// How many follow each topic; its keys never change.
using Followers = std::map<std::string, std::atomic<std::size_t>>;

Followers nobody_yet(const std::set<std::string>& topics) {
  Followers followers;
  for (const std::string& topic : topics)
    followers[topic] = 0;
  return followers;
}

}  // namespace

class WebServer::Service final : public WebConnection::Host, public std::enable_shared_from_this<WebServer::Service> {
 public:
  Service(const WebServerOptions& options, WebSiteOptions site, WebFiles files, Ask ask, const Clock& clock)
      : options_(options),
        live_(list_of(site.topics)),
        followers_(nobody_yet(site.topics)),
        site_(std::move(site), std::move(files)),
        ask_(std::move(ask)),
        clock_(clock),
        acceptor_(io_),
        accept_(acceptor_, [this](tcp::socket socket) { welcome(std::move(socket)); }) {
    try {
      acceptor_.open(tcp::v4());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind({asio::ip::address_v4::loopback(), options_.port});
      acceptor_.listen();
      port_ = acceptor_.local_endpoint().port();
    } catch (const boost::system::system_error& problem) {
      throw std::runtime_error(
          fmt::format("the pages can't be served on port {}: {}", options_.port, problem.code().message()));
    }
  }

  // The connections are let go of while what they refer to is still there.
  void stop() {
    io_.stop();
    if (thread_.joinable()) thread_.join();
    const auto connections = std::exchange(connections_, {});
    for (const auto& connection : connections)
      connection->close();
  }

  void start() {
    accept_.next();
    thread_ = std::thread([this] { io_.run(); });
  }

  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  [[nodiscard]] std::string new_link() {
    return fmt::format("http://127.0.0.1:{}{}", port_, site_.new_link(clock_.now()));
  }

  void tell(const std::string& topic, const nlohmann::json& news) {
    live_.tell(topic, news.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    if (waking_.exchange(true)) return;
    asio::post(io_, [this] {
      waking_ = false;
      // Writing can close a connection and so take it out of the set.
      const auto connections = connections_;
      for (const auto& connection : connections)
        connection->tell_news();
    });
  }

  [[nodiscard]] bool has_followers() const noexcept { return streams_ > 0; }
  [[nodiscard]] bool has_followers(const std::string& topic) const { return followers_.at(topic) > 0; }
  [[nodiscard]] WebServerStats stats() const noexcept {
    return {open_, streams_, requests_, refused_requests_, refused_connections_};
  }

  // --- WebConnection::Host ---

  [[nodiscard]] const WebServerOptions& options() const override { return options_; }
  [[nodiscard]] const LiveTopics& live() const override { return live_; }

  [[nodiscard]] WebReply reply(const WebRequest& request) override { return site_.reply(request, port_, clock_.now()); }

  void ask(nlohmann::json request, const std::shared_ptr<WebConnection>& connection) override {
    ask_(std::move(request), [service = weak_from_this(), asking = std::weak_ptr(connection)](nlohmann::json said) {
      const auto self = service.lock();
      if (!self) return;
      asio::post(self->io_, [asking, said = std::move(said)] {
        if (const auto there = asking.lock()) there->answer_command(said);
      });
    });
  }

  [[nodiscard]] bool takes_stream(const WebStream& stream) override {
    if (streams_ >= options_.most_streams) return false;
    ++streams_;
    for (const std::string& topic : stream.topics)
      ++followers_.at(topic);
    return true;
  }

  void answered(unsigned status) override {
    ++requests_;
    if (status >= 400) ++refused_requests_;
  }

  void closed(const std::shared_ptr<WebConnection>& connection) override {
    if (connection->streaming()) --streams_;
    for (const auto& [topic, version] : connection->followed())
      --followers_.at(topic);
    connections_.erase(connection);
    open_ = connections_.size();
  }

 private:
  void welcome(tcp::socket socket) {
    if (connections_.size() >= options_.most_connections) {
      ++refused_connections_;
      const auto stranger = longest_stranger();
      if (!stranger) return;  // its socket is closed with it
      stranger->close();
    }
    const auto connection = std::make_shared<WebConnection>(std::move(socket), *this, ++accepted_);
    connections_.insert(connection);
    open_ = connections_.size();
    connection->start();
  }

  [[nodiscard]] std::shared_ptr<WebConnection> longest_stranger() const {
    std::shared_ptr<WebConnection> longest;
    for (const auto& connection : connections_)
      if (!connection->known() && (!longest || connection->number() < longest->number())) longest = connection;
    return longest;
  }

  const WebServerOptions options_;
  LiveTopics live_;
  Followers followers_;
  WebSite site_;
  const Ask ask_;
  const Clock& clock_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  AcceptLoop<tcp::acceptor> accept_;
  std::uint16_t port_ = 0;
  std::set<std::shared_ptr<WebConnection>> connections_;
  std::uint64_t accepted_ = 0;

  std::atomic<bool> waking_{false};
  std::atomic<std::size_t> open_{0};
  std::atomic<std::size_t> streams_{0};
  std::atomic<std::uint64_t> requests_{0};
  std::atomic<std::uint64_t> refused_requests_{0};
  std::atomic<std::uint64_t> refused_connections_{0};
  std::thread thread_;
};

WebServer::WebServer(const WebServerOptions& options, WebSiteOptions site, WebFiles files, Ask ask, const Clock& clock)
    : service_(std::make_shared<Service>(options, std::move(site), std::move(files), std::move(ask), clock)) {}

WebServer::~WebServer() {
  stop();
}

void WebServer::stop() {
  service_->stop();
}
void WebServer::start() {
  service_->start();
}
std::uint16_t WebServer::port() const noexcept {
  return service_->port();
}
std::string WebServer::new_link() {
  return service_->new_link();
}
void WebServer::tell(const std::string& topic, const nlohmann::json& news) {
  service_->tell(topic, news);
}
bool WebServer::has_followers() const noexcept {
  return service_->has_followers();
}
bool WebServer::has_followers(const std::string& topic) const {
  return service_->has_followers(topic);
}
WebServerStats WebServer::stats() const noexcept {
  return service_->stats();
}

}  // namespace telehug
