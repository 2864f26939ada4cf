// SPDX-License-Identifier: Apache-2.0
//
// Both ends of a daemon's local socket: whatever a program of this PC sends to it, and whatever `telehug` is told by
// what answers there, with texts of the peer in it.
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "ctl/status_text.hpp"
#include "ctl/watch_text.hpp"
#include "daemon/stop_switch.hpp"
#include "doubles/temporary_folder.hpp"
#include "fuzz/bytes.hpp"
#include "fuzz/waits.hpp"
#include "service/control_server.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

void require(bool holds) {
  if (!holds) std::abort();
}

class Daemon {
 public:
  Daemon() {
    let_waits_go_on();
    spdlog::set_level(spdlog::level::off);
    server_.on("status", [](const Json&) { return Json{{"side", "active"}}; });
    stop_.serve(server_);
    server_.start();
  }

  // Everything it answers until it has closed.
  [[nodiscard]] std::string answers_to(const std::string& request) const {
    const int connection = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = socket_;
    std::memcpy(address.sun_path, path.c_str(), path.size());
    require(::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    require(::send(connection, request.data(), request.size(), MSG_NOSIGNAL) >= 0);
    ::shutdown(connection, SHUT_WR);
    std::string answers;
    std::array<char, 4096> chunk{};
    for (;;) {
      const ssize_t size = ::recv(connection, chunk.data(), chunk.size(), 0);
      if (size <= 0) break;
      answers.append(chunk.data(), static_cast<std::size_t>(size));
    }
    ::close(connection);
    return answers;
  }

 private:
  TemporaryFolder folder_;
  std::string socket_ = folder_ / "active.sock";
  StopSwitch stop_{folder_ / "stop.json"};
  ControlServer server_{{.socket = socket_, .group = {}, .most_clients = 64}};
};

// One object in a line for each line.
void ask(const std::string& request) {
  static const Daemon daemon;
  std::string answers = daemon.answers_to(request);
  require(std::count(answers.begin(), answers.end(), '\n') == std::count(request.begin(), request.end(), '\n'));
  while (!answers.empty()) {
    const std::size_t end = answers.find('\n');
    require(Json::parse(answers.substr(0, end), nullptr, false).is_object());
    answers.erase(0, end + 1);
  }
}

// For a terminal: valid UTF-8 without control characters but line ends, neither of ASCII nor of ISO 8859.
void require_plain(const std::string& text) {
  (void)Json(text).dump();  // throws if it is no UTF-8
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    require((byte >= 0x20 && byte != 0x7F) || byte == '\n');
    require(byte != 0xC2 || static_cast<unsigned char>(text[i + 1]) >= 0xA0);
  }
}

void show(const std::string& line) {
  const auto json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return;
  require_plain(status_text(json));
  const std::string event = watch_text(json);
  require_plain(event);
  require(event.find('\n') == std::string::npos);
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  telehug::Bytes bytes(data, size);
  if (bytes.byte() % 2 == 0) {
    telehug::ask(bytes.rest());
  } else {
    telehug::show(bytes.rest());
  }
  return 0;
}
