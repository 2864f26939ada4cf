// SPDX-License-Identifier: Apache-2.0
#include "service/control_client.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/outside_json.hpp"

namespace telehug {
namespace {

// Whatever answers there: a line longer than this isn't a telehug daemon's.
constexpr std::size_t most_line_bytes = 16 << 20;

ConnectFailure failure_of(int problem) {
  switch (problem) {
    case ENOENT:
    case ENOTDIR:
    case ECONNREFUSED:
      return ConnectFailure::absent;
    case EACCES:
    case EPERM:
      return ConnectFailure::permission;
    default:
      return ConnectFailure::other;
  }
}

}  // namespace

std::variant<ControlClient, ConnectFailure> ControlClient::connect(const std::filesystem::path& socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket.native().size() >= sizeof address.sun_path) return ConnectFailure::absent;
  std::memcpy(address.sun_path, socket.c_str(), socket.native().size());
  ControlClient client(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (client.fd_ < 0) return ConnectFailure::other;
  if (::connect(client.fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return failure_of(errno);
  }
  return client;
}

ControlClient::~ControlClient() {
  if (fd_ >= 0) close(fd_);
}

ControlClient::ControlClient(ControlClient&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), received_(std::move(other.received_)) {}

ControlClient& ControlClient::operator=(ControlClient&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(received_, other.received_);
  return *this;
}

bool ControlClient::wait_for(short events, Timestamp deadline) const {
  pollfd descriptor{fd_, events, 0};
  for (;;) {
    const Duration left = std::max(deadline - std::chrono::steady_clock::now(), Duration::zero());
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(left).count();
    const int ready = poll(&descriptor, 1, static_cast<int>(std::min<long>(ms, 1'000'000)));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

bool ControlClient::send(const std::string& text, Timestamp deadline) const {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t size = ::send(fd_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (size >= 0) {
      sent += static_cast<std::size_t>(size);
    } else if (errno != EINTR && (errno != EAGAIN || !wait_for(POLLOUT, deadline))) {
      return false;
    }
  }
  return true;
}

Result<nlohmann::json> ControlClient::ask(const nlohmann::json& request, Duration longest) {
  const Timestamp deadline = std::chrono::steady_clock::now() + longest;
  // A daemon that turns this connection away has perhaps closed it before all was sent; its reason can still be read.
  (void)send(request.dump() + '\n', deadline);
  auto reply = next(deadline - std::chrono::steady_clock::now());
  if (!reply) return reply.error();
  if (!*reply) return Error{"the daemon does not answer in time"};
  return std::move(**reply);
}

Result<std::optional<nlohmann::json>> ControlClient::next(Duration longest) {
  const Timestamp deadline = std::chrono::steady_clock::now() + longest;
  std::array<char, 65536> chunk;
  for (;;) {
    if (const std::size_t end = received_.find('\n'); end != std::string::npos) {
      auto json = parse_outside_json(std::string_view(received_).substr(0, end));
      received_.erase(0, end + 1);
      if (!json.is_object()) return Error{"what answers on the socket is not a telehug daemon"};
      return std::optional(std::move(json));
    }
    if (received_.size() > most_line_bytes) return Error{"what answers on the socket is not a telehug daemon"};
    const ssize_t size = recv(fd_, chunk.data(), chunk.size(), 0);
    if (size > 0) {
      received_.append(chunk.data(), static_cast<std::size_t>(size));
    } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
      return Error{"the daemon has closed the connection"};
    } else if (errno == EAGAIN && !wait_for(POLLIN, deadline)) {
      return std::optional<nlohmann::json>{};
    }
  }
}

}  // namespace telehug
