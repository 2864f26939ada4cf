// SPDX-License-Identifier: Apache-2.0
//
// One connection to the local socket. Only ControlServer uses it; everything runs in the server's thread.
#pragma once

#include <array>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "service/control_server.hpp"

namespace telehug {

using SharedLine = std::shared_ptr<const std::string>;  // with its line break

// A JSON value as a line. Bytes that aren't UTF-8 (from a device, say) are replaced rather than fatal.
[[nodiscard]] SharedLine line_of(const nlohmann::json& json);

class ControlSession : public std::enable_shared_from_this<ControlSession> {
 public:
  using Socket = boost::asio::local::stream_protocol::socket;

  // What a session asks of its server.
  class Host {
   public:
    virtual ~Host() = default;
    [[nodiscard]] virtual const ControlServerOptions& options() const = 0;
    [[nodiscard]] virtual nlohmann::json answer(const std::string& line, const Caller& caller,
                                                ControlSession& session) = 0;
    virtual void malformed() = 0;
    virtual void event_dropped() = 0;
    virtual void closed(const std::shared_ptr<ControlSession>& session) = 0;
  };

  ControlSession(Socket socket, Host& host);

  void start() { read(); }
  // Says why and closes.
  void turn_away(const std::string& why);
  void send_event(const SharedLine& line);
  void close();

  void watch() { watching_ = true; }
  [[nodiscard]] bool watching() const noexcept { return watching_; }

 private:
  void read();
  void received(const boost::system::error_code& problem, std::size_t size);
  bool take_line(std::string& line);
  void reply(const nlohmann::json& json);
  void write_next();
  void written(const boost::system::error_code& problem);
  void arm(boost::asio::steady_timer& timer, Duration after);

  Socket socket_;
  Host& host_;
  Caller caller_;
  boost::asio::steady_timer read_timer_;
  boost::asio::steady_timer write_timer_;
  std::array<char, 4096> chunk_{};
  std::string received_;  // at most one request and a chunk
  bool in_request_ = false;

  SharedLine reply_;               // waiting to be written; ahead of events
  std::deque<SharedLine> events_;  // waiting to be written, oldest first
  std::uint64_t dropped_ = 0;      // since the watcher was last told
  SharedLine writing_;
  bool writing_reply_ = false;
  bool watching_ = false;
  bool closing_ = false;  // after what is being written
  bool closed_ = false;
};

}  // namespace telehug
