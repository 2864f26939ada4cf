// SPDX-License-Identifier: Apache-2.0
//
// What the other end of a pairing connection sends: any bytes before TLS stands or, from who knows the code, within it.
// Only a conversation of the right messages in the right order may end in a pair.
#include <fcntl.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "fuzz/bytes.hpp"
#include "fuzz/waits.hpp"
#include "pairing_link/pairing_dialogue.hpp"

namespace telehug {
namespace {

constexpr TlsChannel::Secret secret{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
constexpr auto long_enough = std::chrono::seconds(20);

struct Sockets {
  OwnedFd ours;
  OwnedFd theirs;
};

Sockets connected() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) throw std::runtime_error("no sockets");
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);  // as TlsChannel wants it
  return {OwnedFd(ends[0]), OwnedFd(ends[1])};
}

// The other end's TLS, which is not bound to telehug's messages.
class Stranger {
 public:
  Stranger(OwnedFd socket, bool dials) : socket_(std::move(socket)), ssl_(SSL_new(context().get()), &SSL_free) {
    SSL_set_fd(ssl_.get(), socket_.get());
    if ((dials ? SSL_connect(ssl_.get()) : SSL_accept(ssl_.get())) != 1) std::abort();
  }
  // Says all of it and hears everything, so that neither end waits for the other.
  void talk(const std::string& bytes) {
    if (!bytes.empty()) SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size()));
    ::shutdown(socket_.get(), SHUT_WR);
    std::array<char, 4096> heard{};
    while (SSL_read(ssl_.get(), heard.data(), heard.size()) > 0) {
    }
  }

 private:
  using Context = std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>;
  static const Context& context() {
    static const Context made = [] {
      Context context(SSL_CTX_new(TLS_method()), &SSL_CTX_free);
      SSL_CTX_set_ciphersuites(context.get(), "TLS_AES_128_GCM_SHA256");
      SSL_CTX_set_num_tickets(context.get(), 0);
      SSL_CTX_set_psk_client_callback(context.get(),
                                      [](SSL*, const char*, char* identity, unsigned, unsigned char* psk, unsigned) {
                                        std::strcpy(identity, "telehug pairing");
                                        std::memcpy(psk, secret.data(), secret.size());
                                        return static_cast<unsigned>(secret.size());
                                      });
      SSL_CTX_set_psk_server_callback(context.get(), [](SSL*, const char*, unsigned char* psk, unsigned) {
        std::memcpy(psk, secret.data(), secret.size());
        return static_cast<unsigned>(secret.size());
      });
      return context;
    }();
    return made;
  }

  OwnedFd socket_;
  std::unique_ptr<SSL, decltype(&SSL_free)> ssl_;
};

// The messages at the beginning of the bytes, as the format is documented: length (4 bytes), kind, text.
std::vector<Message> messages_in(std::string bytes) {
  std::vector<Message> found;
  while (bytes.size() >= 4) {
    std::size_t size = 0;
    for (int i = 0; i < 4; ++i)
      size = size << 8U | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
    if (size == 0 || size > bytes.size() - 4) break;
    found.push_back({bytes[4], bytes.substr(5, size - 1)});
    bytes.erase(0, 4 + size);
  }
  return found;
}

bool is_a_pairing(const std::vector<Message>& said, Side side) {
  if (said.size() < 2 || said[0].kind != 's') return false;
  if (side == Side::active) return said[0].text == "passive" && said[1].kind == 'g';
  return said[0].text == "active" && said[1].kind == 'r' && said.size() >= 3 && said[2].kind == 'c';
}

void within_tls(Side side, bool we_dial, const std::string& bytes) {
  Sockets sockets = connected();
  std::thread other(
      [&, theirs = std::move(sockets.theirs)]() mutable { Stranger(std::move(theirs), !we_dial).talk(bytes); });
  std::optional<std::string> given;
  const auto hear = [&](const std::string& text) { given = text; };
  const Offer offer{.side = side,
                    .make_request = [] { return Result<std::string>("request"); },
                    .accept =
                        [&](const std::string& grant) {
                          hear(grant);
                          return Status(Done{});
                        },
                    .grant_for =
                        [&](const std::string& request) {
                          hear(request);
                          return Result<std::string>("grant");
                        }};
  {
    const auto role = we_dial ? TlsChannel::Role::dials : TlsChannel::Role::listens;
    TlsChannel channel(std::move(sockets.ours), role, secret, -1);
    if (!channel.shake_hands(std::chrono::steady_clock::now() + long_enough)) std::abort();
    const Status paired = talk(channel, offer, long_enough);
    const auto said = messages_in(bytes);
    if (paired.ok() != is_a_pairing(said, side)) std::abort();
    if (paired && given != said[1].text) std::abort();
    if (!paired && paired.error().message.empty()) std::abort();
  }
  other.join();
}

// Nobody who does not know the code gets past the handshake.
void before_tls(bool we_dial, const std::string& bytes) {
  Sockets sockets = connected();
  if (::send(sockets.theirs.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) std::abort();
  ::shutdown(sockets.theirs.get(), SHUT_WR);
  const auto role = we_dial ? TlsChannel::Role::dials : TlsChannel::Role::listens;
  TlsChannel channel(std::move(sockets.ours), role, secret, -1);
  if (channel.shake_hands(std::chrono::steady_clock::now() + long_enough)) std::abort();
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace telehug;
  static const bool prepared = [] {
    let_waits_go_on();
    return std::signal(SIGPIPE, SIG_IGN) != SIG_ERR;  // as TlsChannel asks
  }();
  if (!prepared) return 0;
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  const bool we_dial = (how & 1U) != 0;
  if ((how & 4U) != 0) {
    before_tls(we_dial, bytes.rest());
  } else {
    within_tls((how & 2U) != 0 ? Side::active : Side::passive, we_dial, bytes.rest());
  }
  return 0;
}
