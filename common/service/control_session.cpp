// SPDX-License-Identifier: Apache-2.0
#include "service/control_session.hpp"

#include <sys/socket.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <utility>

namespace telehug {
namespace asio = boost::asio;

SharedLine line_of(const nlohmann::json& json) {
  return std::make_shared<const std::string>(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                                             '\n');
}

ControlSession::ControlSession(Socket socket, Host& host)
    : socket_(std::move(socket)),
      host_(host),
      read_timer_(socket_.get_executor()),
      write_timer_(socket_.get_executor()) {
  ucred credentials{};
  socklen_t size = sizeof credentials;
  if (getsockopt(socket_.native_handle(), SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0) {
    caller_ = {credentials.pid, credentials.uid, credentials.gid};
  }
}

void ControlSession::turn_away(const std::string& why) {
  closing_ = true;
  reply({{"error", why}});
}

void ControlSession::close() {
  if (std::exchange(closed_, true)) return;
  boost::system::error_code ignored;
  (void)socket_.close(ignored);
  read_timer_.cancel();
  write_timer_.cancel();
  host_.closed(shared_from_this());
}

void ControlSession::arm(asio::steady_timer& timer, Duration after) {
  timer.expires_after(after);
  timer.async_wait([self = shared_from_this()](const boost::system::error_code& problem) {
    if (!problem) self->close();
  });
}

void ControlSession::read() {
  std::string line;
  if (take_line(line)) {
    in_request_ = false;
    read_timer_.cancel();
    reply(host_.answer(line, caller_, *this));
    return;  // the next request is read when the reply has left
  }
  if (received_.size() > host_.options().most_request_bytes) {
    host_.malformed();
    turn_away("the request is too long");
    return;
  }
  if (received_.empty()) {
    if (watching_) {
      read_timer_.cancel();
    } else {
      arm(read_timer_, host_.options().idle_timeout);
    }
  } else if (!std::exchange(in_request_, true)) {
    // Once a request: a client that sends byte by byte does not gain time.
    arm(read_timer_, host_.options().half_request_timeout);
  }
  socket_.async_read_some(asio::buffer(chunk_), [self = shared_from_this()](const auto& problem, std::size_t size) {
    self->received(problem, size);
  });
}

void ControlSession::received(const boost::system::error_code& problem, std::size_t size) {
  if (closed_) return;
  if (problem) {
    close();
    return;
  }
  received_.append(chunk_.data(), size);
  read();
}

bool ControlSession::take_line(std::string& line) {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos || end > host_.options().most_request_bytes) return false;
  line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return true;
}

void ControlSession::reply(const nlohmann::json& json) {
  reply_ = line_of(json);
  write_next();
}

void ControlSession::send_event(const SharedLine& line) {
  if (closing_) return;
  if (events_.size() >= host_.options().most_waiting_events) {
    events_.pop_front();
    ++dropped_;
    host_.event_dropped();
  }
  events_.push_back(line);
  write_next();
}

void ControlSession::write_next() {
  if (writing_ || closed_) return;
  writing_reply_ = reply_ != nullptr;
  if (writing_reply_) {
    writing_ = std::exchange(reply_, nullptr);
  } else if (dropped_ > 0) {
    writing_ = line_of({{"event", "dropped"}, {"count", std::exchange(dropped_, 0)}});
  } else if (!events_.empty()) {
    writing_ = std::move(events_.front());
    events_.pop_front();
  } else {
    return;
  }
  arm(write_timer_, host_.options().write_timeout);
  asio::async_write(socket_, asio::buffer(*writing_),
                    [self = shared_from_this()](const auto& problem, std::size_t) { self->written(problem); });
}

void ControlSession::written(const boost::system::error_code& problem) {
  write_timer_.cancel();
  writing_ = nullptr;
  if (closed_) return;
  if (problem || (closing_ && writing_reply_)) {
    close();
    return;
  }
  if (std::exchange(writing_reply_, false)) read();
  write_next();
}

}  // namespace telehug
