// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/pairing_exchange.hpp"

#include <fmt/core.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace telehug {

namespace {

std::string reason(int number) {
  return std::generic_category().message(number);
}

sockaddr_in as_socket_address(const Endpoint& endpoint) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(endpoint.port);
  static_assert(sizeof(address.sin_addr) == sizeof(endpoint.address));
  std::memcpy(&address.sin_addr, endpoint.address.data(), endpoint.address.size());
  return address;
}

OwnedFd make_socket() {
  OwnedFd made(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (made.get() < 0) throw std::runtime_error("no TCP socket for pairing: " + reason(errno));
  return made;
}

OwnedFd listen_at(const Endpoint& at) {
  OwnedFd listener = make_socket();
  const sockaddr_in address = as_socket_address(at);
  if (::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::listen(listener.get(), 4) != 0)
    throw std::runtime_error(
        fmt::format("can't listen at {}: {}; is it an address of this PC?", to_text(at), reason(errno)));
  return listener;
}

Endpoint with_real_port(Endpoint at, const OwnedFd& listener) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  if (::getsockname(listener.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("the port of the pairing can't be found out: " + reason(errno));
  at.port = ntohs(address.sin_port);
  return at;
}

Deadline after(std::chrono::milliseconds time) {
  return std::chrono::steady_clock::now() + time;
}

Result<OwnedFd> dial(const Endpoint& to, Deadline deadline, int stop_fd) {
  OwnedFd connection = make_socket();
  const sockaddr_in address = as_socket_address(to);
  int problem = 0;
  if (::connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) problem = errno;
  if (problem == EINPROGRESS) {
    if (auto waited = wait_for(connection.get(), POLLOUT, deadline, stop_fd); !waited) return waited.error();
    socklen_t size = sizeof(problem);
    if (::getsockopt(connection.get(), SOL_SOCKET, SO_ERROR, &problem, &size) != 0) problem = errno;
  }
  if (problem != 0)
    return Error{
        fmt::format("nobody waits at {} ({}): the code is used up, or a firewall or router is in between; ask "
                    "for a new code",
                    to_text(to), reason(problem))};
  return connection;
}

}  // namespace

Invitation::Invitation(const Endpoint& at, const ExchangeLimits& limits)
    : limits_(limits),
      listener_(listen_at(at)),
      end_(after(limits.invitation)),
      code_(make_pairing_code(with_real_port(at, listener_))) {}

Status Invitation::pair(const Offer& offer, int stop_fd) {
  // Whatever comes of it, the invitation is over afterwards.
  OwnedFd listener(std::move(listener_));
  if (listener.get() < 0) return Error{"this invitation was used already: make a new one"};
  for (int wrong = 0; wrong < limits_.wrong_handshakes;) {
    if (auto waited = wait_for(listener.get(), POLLIN, end_, stop_fd); !waited) {
      if (std::chrono::steady_clock::now() >= end_)
        return Error{"nobody came before the pairing code ended: make a new one"};
      return waited;
    }
    OwnedFd connection(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (connection.get() < 0) continue;  // who knocked has gone again
    TlsChannel channel(std::move(connection), TlsChannel::Role::listens, code_.secret, stop_fd);
    if (channel.shake_hands(std::min(end_, after(limits_.handshake)))) {
      listener = OwnedFd();
      return talk(channel, offer, limits_.idle);
    }
    ++wrong;
  }
  return Error{fmt::format("{} times somebody came without knowing the pairing code, so it has ended: make a new one",
                           limits_.wrong_handshakes)};
}

Status accept_invitation(const PairingCode& code, const Offer& offer, const ExchangeLimits& limits, int stop_fd) {
  const Deadline deadline = after(limits.handshake);
  auto connection = dial(code.inviter, deadline, stop_fd);
  if (!connection) return connection.error();
  TlsChannel channel(std::move(*connection), TlsChannel::Role::dials, code.secret, stop_fd);
  if (auto agreed = channel.shake_hands(deadline); !agreed) return agreed;
  return talk(channel, offer, limits.idle);
}

}  // namespace telehug
