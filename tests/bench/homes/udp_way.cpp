// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "bench/homes/event_codec.hpp"
#include "bench/homes/touch_ways.hpp"

namespace telehug {
namespace {

void require(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

class Datagrams {
 public:
  explicit Datagrams(const Meeting& meeting) : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    require(descriptor_ >= 0, "a socket can't be opened");
    receiver_.sin_family = AF_INET;
    receiver_.sin_port = htons(udp_port);
    inet_pton(AF_INET, meeting.address.c_str(), &receiver_.sin_addr);
  }
  ~Datagrams() { close(descriptor_); }
  Datagrams(const Datagrams&) = delete;
  Datagrams& operator=(const Datagrams&) = delete;

  void listen() const { require(bind(descriptor_, receiver(), sizeof receiver_) == 0, "the UDP port can't be used"); }
  // What can't be sent is lost, as on a wire.
  void send(std::span<const std::uint8_t> bytes) const {
    (void)!sendto(descriptor_, bytes.data(), bytes.size(), 0, receiver(), sizeof receiver_);
  }
  [[nodiscard]] std::span<const std::uint8_t> receive() {
    const ssize_t size = recv(descriptor_, buffer_.data(), buffer_.size(), 0);
    return {buffer_.data(), static_cast<std::size_t>(size > 0 ? size : 0)};
  }

 private:
  [[nodiscard]] const sockaddr* receiver() const { return reinterpret_cast<const sockaddr*>(&receiver_); }

  int descriptor_;
  sockaddr_in receiver_{};
  std::array<std::uint8_t, 4096> buffer_{};
};

class UdpSender final : public TouchSender {
 public:
  explicit UdpSender(const Meeting& meeting) : datagrams_(meeting) {}
  void send(const TouchEvent& event) override { datagrams_.send(codec_.encode(event)); }

 private:
  Datagrams datagrams_;
  EventCodec codec_;
};

}  // namespace

std::unique_ptr<TouchSender> udp_sender(const Meeting& meeting) {
  return std::make_unique<UdpSender>(meeting);
}

void receive_udp(const Meeting& meeting, const Receive& receive) {
  Datagrams datagrams(meeting);
  datagrams.listen();
  EventCodec codec;
  for (;;)
    if (const TouchEvent* event = codec.decode(datagrams.receive())) receive(*event);
}

}  // namespace telehug
