// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <utility>

namespace telehug {

// Welcomes one connection after the other, on the thread that runs the acceptor's context, until the acceptor is closed
// or the context ends. Outlives neither.
template <typename Acceptor>
class AcceptLoop {
 public:
  using Socket = typename Acceptor::protocol_type::socket;

  AcceptLoop(Acceptor& acceptor, std::function<void(Socket)> welcome)
      : acceptor_(acceptor), again_(acceptor.get_executor()), welcome_(std::move(welcome)) {}

  void next() {
    acceptor_.async_accept([this](const boost::system::error_code& problem, Socket socket) {
      if (problem == boost::asio::error::operation_aborted) return;
      if (problem) {
        // Most likely no descriptors are left; trying again at once would only spin.
        again_.expires_after(std::chrono::milliseconds(100));
        again_.async_wait([this](const boost::system::error_code& stopped) {
          if (!stopped) next();
        });
        return;
      }
      welcome_(std::move(socket));
      next();
    });
  }

 private:
  Acceptor& acceptor_;
  boost::asio::steady_timer again_;
  std::function<void(Socket)> welcome_;
};

}  // namespace telehug
