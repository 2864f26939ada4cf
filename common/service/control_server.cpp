// SPDX-License-Identifier: Apache-2.0
#include "service/control_server.hpp"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "common/outside_json.hpp"
#include "service/accept_loop.hpp"
#include "service/control_session.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace asio = boost::asio;

namespace {
// Between the threads that broadcast and the server's: enough for what comes while it answers one request.
constexpr std::size_t most_handed_over = 1024;
}  // namespace

class ControlServer::Service final : public ControlSession::Host {
 public:
  explicit Service(ControlServerOptions options)
      : options_(std::move(options)),
        listening_(options_.socket, options_.group),
        acceptor_(io_),
        accept_(acceptor_, [this](ControlSession::Socket socket) { welcome(std::move(socket)); }) {
    const int own = dup(listening_.fd());  // the acceptor closes what it is given
    if (own < 0) throw std::runtime_error("no file descriptor is left for the local socket");
    acceptor_.assign(asio::local::stream_protocol(), own);
  }

  ~Service() override {
    io_.stop();
    if (thread_.joinable()) thread_.join();
    sessions_.clear();
  }

  void start() {
    accept_.next();
    thread_ = std::thread([this] { io_.run(); });
  }

  void broadcast(nlohmann::json event) {
    if (watchers_.load(std::memory_order_relaxed) == 0) return;
    bool wake = false;
    {
      const std::lock_guard lock(mutex_);
      if (handed_over_.size() >= most_handed_over) {
        handed_over_.pop_front();
        ++dropped_events_;
      }
      handed_over_.push_back(std::move(event));
      wake = !std::exchange(waking_, true);
    }
    if (wake) asio::post(io_, [this] { pass_on(); });
  }

  [[nodiscard]] ControlServerStats stats() const noexcept {
    return {clients_, watchers_, requests_, refused_clients_, malformed_requests_, dropped_events_};
  }

  [[nodiscard]] const ControlServerOptions& options() const override { return options_; }

  nlohmann::json answer(const std::string& line, const Caller& caller, ControlSession& session) override {
    ++requests_;
    const auto request = parse_outside_json(line);
    if (!request.is_object() || !request.contains("command") || !request["command"].is_string()) {
      ++malformed_requests_;
      return {{"error", "a request is a line of JSON such as {\"command\":\"status\"}"}};
    }
    const auto& command = request["command"].get_ref<const std::string&>();
    if (command == "watch") {
      if (!session.watching()) ++watchers_;
      session.watch();
      return {{"watching", true}};
    }
    return handled(command, request, caller);
  }

  void ask(nlohmann::json request, std::function<void(nlohmann::json)> answered) {
    asio::post(io_, [this, request = std::move(request), answered = std::move(answered)] {
      ++requests_;
      answered(handled(request.at("command").get<std::string>(), request, {getpid(), getuid(), getgid()}));
    });
  }

  void malformed() override { ++malformed_requests_; }
  void event_dropped() override { ++dropped_events_; }

  void closed(const std::shared_ptr<ControlSession>& session) override {
    if (session->watching()) --watchers_;
    sessions_.erase(session);
    clients_ = sessions_.size();
  }

  std::map<std::string, CallerHandler> handlers_;

 private:
  nlohmann::json handled(const std::string& command, const nlohmann::json& request, const Caller& caller) {
    const auto handler = handlers_.find(command);
    if (handler == handlers_.end()) {
      ++malformed_requests_;
      return {{"error", unknown(command)}};
    }
    try {
      return handler->second(request, caller);
    } catch (const std::exception& problem) {
      spdlog::error("the command \"{}\" of the local socket failed: {}", command, problem.what());
      return {{"error", problem.what()}};
    }
  }

  void welcome(ControlSession::Socket socket) {
    const auto session = std::make_shared<ControlSession>(std::move(socket), *this);
    if (sessions_.size() >= options_.most_clients) {
      ++refused_clients_;
      session->turn_away(fmt::format("too many connections (at most {}); try again later", options_.most_clients));
      return;
    }
    sessions_.insert(session);
    clients_ = sessions_.size();
    session->start();
  }

  void pass_on() {
    std::deque<nlohmann::json> events;
    {
      const std::lock_guard lock(mutex_);
      events.swap(handed_over_);
      waking_ = false;
    }
    // A send can close a session and so take it out of the set.
    const std::vector<std::shared_ptr<ControlSession>> sessions(sessions_.begin(), sessions_.end());
    for (const auto& event : events) {
      const SharedLine line = line_of(event);
      for (const auto& session : sessions) {
        if (session->watching()) session->send_event(line);
      }
    }
  }

  [[nodiscard]] std::string unknown(const std::string& command) const {
    std::string known = "watch";
    for (const auto& [name, handler] : handlers_)
      known += ", " + name;
    return fmt::format("unknown command \"{}\"; known are {}", command.substr(0, 40), known);
  }

  ControlServerOptions options_;
  ControlSocket listening_;
  asio::io_context io_{1};
  asio::local::stream_protocol::acceptor acceptor_;
  AcceptLoop<asio::local::stream_protocol::acceptor> accept_;
  std::set<std::shared_ptr<ControlSession>> sessions_;

  std::mutex mutex_;
  std::deque<nlohmann::json> handed_over_;  // guarded by mutex_
  bool waking_ = false;                     // guarded by mutex_

  std::atomic<std::size_t> clients_{0};
  std::atomic<std::size_t> watchers_{0};
  std::atomic<std::uint64_t> requests_{0};
  std::atomic<std::uint64_t> refused_clients_{0};
  std::atomic<std::uint64_t> malformed_requests_{0};
  std::atomic<std::uint64_t> dropped_events_{0};
  std::thread thread_;
};

ControlServer::ControlServer(ControlServerOptions options) : service_(std::make_unique<Service>(std::move(options))) {}
ControlServer::~ControlServer() = default;

void ControlServer::on(const std::string& command, Handler handler) {
  on(command, CallerHandler([handler = std::move(handler)](const nlohmann::json& request, const Caller&) {
       return handler(request);
     }));
}

void ControlServer::on(const std::string& command, CallerHandler handler) {
  service_->handlers_[command] = std::move(handler);
}

void ControlServer::start() {
  service_->start();
}
void ControlServer::ask(nlohmann::json request, std::function<void(nlohmann::json)> answered) {
  service_->ask(std::move(request), std::move(answered));
}
void ControlServer::broadcast(nlohmann::json event) {
  service_->broadcast(std::move(event));
}
bool ControlServer::has_watchers() const noexcept {
  return service_->stats().watchers > 0;
}
ControlServerStats ControlServer::stats() const noexcept {
  return service_->stats();
}

}  // namespace telehug
