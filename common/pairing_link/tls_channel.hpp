// SPDX-License-Identifier: Apache-2.0
//
// Messages between two PCs that know the same secret: TLS 1.3 with that secret as its key (PSK with Diffie-Hellman, so
// that whoever learns the code later can't read what was said). No certificates: who does not know the secret gets no
// further than the handshake. Every wait ends: by its deadline or because the person asks for it.
#pragma once

#include <openssl/ssl.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "common/result.hpp"

namespace telehug {

using Deadline = std::chrono::steady_clock::time_point;

// Closes what it holds.
class OwnedFd {
 public:
  explicit OwnedFd(int fd = -1) noexcept : fd_(fd) {}
  OwnedFd(OwnedFd&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  OwnedFd& operator=(OwnedFd&& other) noexcept;
  ~OwnedFd();
  [[nodiscard]] int get() const noexcept { return fd_; }

 private:
  int fd_;
};

// Until `fd` is ready for `events` (poll(2)); an error when the deadline passes or `stop_fd` (-1: none) is readable.
[[nodiscard]] Status wait_for(int fd, short events, Deadline deadline, int stop_fd);

struct Message {
  char kind = 0;
  std::string text;
};

class TlsChannel {
 public:
  enum class Role { dials, listens };
  using Secret = std::array<std::uint8_t, 16>;

  // `connection`: connected and non-blocking. Throws std::runtime_error if OpenSSL can't be set up.
  TlsChannel(OwnedFd connection, Role role, const Secret& secret, int stop_fd);
  ~TlsChannel();
  TlsChannel(const TlsChannel&) = delete;
  TlsChannel& operator=(const TlsChannel&) = delete;

  static constexpr std::size_t longest_message_bytes = 64 * 1024;

  [[nodiscard]] Status shake_hands(Deadline deadline);
  [[nodiscard]] Status send(const Message& message, Deadline deadline);
  [[nodiscard]] Result<Message> receive(Deadline deadline);

 private:
  [[nodiscard]] Status wait_after(int outcome, Deadline deadline);
  [[nodiscard]] Status read_all(std::span<char> bytes, Deadline deadline);

  struct Free {
    void operator()(SSL* ssl) const { SSL_free(ssl); }
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
    void operator()(SSL_SESSION* session) const { SSL_SESSION_free(session); }
  };
  static int use_session(SSL* ssl, const EVP_MD* digest, const unsigned char** identity, std::size_t* identity_bytes,
                         SSL_SESSION** session);
  static int find_session(SSL* ssl, const unsigned char* identity, std::size_t identity_bytes, SSL_SESSION** session);

  OwnedFd connection_;
  Role role_;
  int stop_fd_;
  bool open_ = false;
  std::unique_ptr<SSL_CTX, Free> context_;
  std::unique_ptr<SSL_SESSION, Free> session_;
  std::unique_ptr<SSL, Free> ssl_;
};

}  // namespace telehug
