// SPDX-License-Identifier: Apache-2.0
#include "wire/rfcomm_opener.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace telehug {
namespace {

constexpr std::uint8_t usual_channel = 1;

// Of a socket that has come to a decision: 0 or an errno.
int decision(int socket) {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

RfcommOpener::RfcommOpener(const RfcommPeer& peer, RfcommSockets& sockets, std::string bus_address)
    : peer_(peer), sockets_(sockets), device_(address_text(peer)), progress_("connecting by Bluetooth") {
  if (!peer_.channel) bluez_ = std::make_unique<BluezProfile>(peer_, std::move(bus_address));
}

RfcommOpener::~RfcommOpener() {
  if (socket_ >= 0) close(socket_);
}

std::optional<Result<Wire>> RfcommOpener::open(Timestamp now) {
  if (socket_ >= 0) return go_on(now);
  return peer_.channel ? connect(*peer_.channel, now) : look_up(now);
}

std::optional<Result<Wire>> RfcommOpener::look_up(Timestamp now) {
  if (!asked_) bluez_->connect();
  asked_ = true;
  auto answer = bluez_->take();
  if (!answer) return std::nullopt;
  asked_ = false;
  if (answer->there_is_no_bluez) return connect(usual_channel, now);
  return std::move(answer->wire);
}

std::optional<Result<Wire>> RfcommOpener::connect(std::uint8_t channel, Timestamp now) {
  channel_ = channel;
  const int opened = sockets_.open();
  if (opened < 0) return fail(-opened);
  socket_ = opened;
  const int code = sockets_.connect(socket_, rfcomm_address(peer_, channel));
  if (code == 0) return hand_over();
  if (code != -EINPROGRESS) return fail(-code);
  give_up_at_ = now + patience;
  return std::nullopt;
}

std::optional<Result<Wire>> RfcommOpener::go_on(Timestamp now) {
  pollfd waited{socket_, POLLOUT, 0};
  if (poll(&waited, 1, 0) == 1) {
    const int error = decision(socket_);
    if (error != 0) return fail(error);
    return hand_over();
  }
  if (now >= give_up_at_) return fail(ETIMEDOUT);
  return std::nullopt;
}

Error RfcommOpener::fail(int error) {
  if (socket_ >= 0) close(std::exchange(socket_, -1));
  return Error{rfcomm_trouble(peer_, channel_, error)};
}

Wire RfcommOpener::hand_over() {
  return Wire(std::exchange(socket_, -1));
}

}  // namespace telehug
