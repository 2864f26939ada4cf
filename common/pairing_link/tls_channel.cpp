// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/tls_channel.hpp"

#include <openssl/err.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace telehug {

namespace {

constexpr std::string_view psk_identity = "telehug pairing";
constexpr const char* suite = "TLS_AES_128_GCM_SHA256";
constexpr std::array<unsigned char, 2> suite_number = {0x13, 0x01};
constexpr std::size_t length_bytes = 4;

void require(bool worked) {
  if (!worked) throw std::runtime_error("OpenSSL can't be set up for pairing: is its configuration damaged?");
}

}  // namespace

OwnedFd& OwnedFd::operator=(OwnedFd&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

OwnedFd::~OwnedFd() {
  if (fd_ >= 0) ::close(fd_);
}

Status wait_for(int fd, short events, Deadline deadline, int stop_fd) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    if (left <= 0) return Error{"the other PC did not answer in time"};
    std::array<pollfd, 2> waited{pollfd{fd, events, 0}, pollfd{stop_fd, POLLIN, 0}};
    const int ready = ::poll(waited.data(), waited.size(), static_cast<int>(std::min<decltype(left)>(left, 60'000)));
    if (ready < 0 && errno != EINTR) return Error{"the connection can't be waited for"};
    if (ready <= 0) continue;
    if (waited[1].revents != 0) return Error{"stopped before the pairing was finished"};
    return Done{};
  }
}

TlsChannel::TlsChannel(OwnedFd connection, Role role, const Secret& secret, int stop_fd)
    : connection_(std::move(connection)),
      role_(role),
      stop_fd_(stop_fd),
      context_(SSL_CTX_new(TLS_method())),
      session_(SSL_SESSION_new()) {
  require(context_ && session_);
  SSL_CTX* context = context_.get();
  require(SSL_CTX_set_min_proto_version(context, TLS1_3_VERSION) == 1);
  require(SSL_CTX_set_ciphersuites(context, suite) == 1);
  // No tickets and no cache: nothing of a pairing can be resumed. A dialer believes no certificate, whoever signed it.
  require(SSL_CTX_set_num_tickets(context, 0) == 1);
  SSL_CTX_set_session_cache_mode(context, SSL_SESS_CACHE_OFF);
  if (role == Role::dials) SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_psk_use_session_callback(context, &TlsChannel::use_session);
  SSL_CTX_set_psk_find_session_callback(context, &TlsChannel::find_session);

  ssl_.reset(SSL_new(context));
  require(ssl_ != nullptr);
  const SSL_CIPHER* cipher = SSL_CIPHER_find(ssl_.get(), suite_number.data());
  require(cipher != nullptr && SSL_SESSION_set_cipher(session_.get(), cipher) == 1);
  require(SSL_SESSION_set1_master_key(session_.get(), secret.data(), secret.size()) == 1);
  require(SSL_SESSION_set_protocol_version(session_.get(), TLS1_3_VERSION) == 1);
  SSL_set_app_data(ssl_.get(), this);
  require(SSL_set_fd(ssl_.get(), connection_.get()) == 1);
}

TlsChannel::~TlsChannel() {
  if (open_) SSL_shutdown(ssl_.get());
}

int TlsChannel::use_session(SSL* ssl, const EVP_MD* digest, const unsigned char** identity, std::size_t* identity_bytes,
                            SSL_SESSION** session) {
  auto* self = static_cast<TlsChannel*>(SSL_get_app_data(ssl));
  *session = nullptr;
  if (digest != nullptr && digest != SSL_CIPHER_get_handshake_digest(SSL_SESSION_get0_cipher(self->session_.get())))
    return 1;
  SSL_SESSION_up_ref(self->session_.get());
  *session = self->session_.get();
  *identity = reinterpret_cast<const unsigned char*>(psk_identity.data());
  *identity_bytes = psk_identity.size();
  return 1;
}

int TlsChannel::find_session(SSL* ssl, const unsigned char* identity, std::size_t identity_bytes,
                             SSL_SESSION** session) {
  auto* self = static_cast<TlsChannel*>(SSL_get_app_data(ssl));
  *session = nullptr;
  if (!std::equal(identity, identity + identity_bytes, psk_identity.begin(), psk_identity.end())) return 1;
  SSL_SESSION_up_ref(self->session_.get());
  *session = self->session_.get();
  return 1;
}

Status TlsChannel::wait_after(int outcome, Deadline deadline) {
  const int problem = SSL_get_error(ssl_.get(), outcome);
  if (problem == SSL_ERROR_WANT_READ) return wait_for(connection_.get(), POLLIN, deadline, stop_fd_);
  if (problem == SSL_ERROR_WANT_WRITE) return wait_for(connection_.get(), POLLOUT, deadline, stop_fd_);
  open_ = false;  // after any other error OpenSSL forbids SSL_shutdown
  return Error{"the connection to the other PC broke off"};
}

Status TlsChannel::shake_hands(Deadline deadline) {
  while (true) {
    ERR_clear_error();
    const int outcome = role_ == Role::dials ? SSL_connect(ssl_.get()) : SSL_accept(ssl_.get());
    if (outcome == 1) break;
    const int problem = SSL_get_error(ssl_.get(), outcome);
    if (problem == SSL_ERROR_SSL)
      return Error{
          "the other PC does not know this pairing code: check that it is the newest one, or ask for a new one"};
    auto waited = wait_after(outcome, deadline);
    if (!waited) return waited.error();
  }
  if (SSL_session_reused(ssl_.get()) != 1) return Error{"the other PC did not prove that it knows the pairing code"};
  open_ = true;
  return Done{};
}

Status TlsChannel::send(const Message& message, Deadline deadline) {
  const std::size_t size = message.text.size() + 1;
  if (size > longest_message_bytes) return Error{"a message of the pairing is too long to be sent"};
  std::string bytes;
  for (std::size_t i = 0; i < length_bytes; ++i)
    bytes += static_cast<char>(size >> (8 * (length_bytes - 1 - i)) & 0xffU);
  bytes += message.kind;
  bytes += message.text;
  while (true) {
    ERR_clear_error();
    const int outcome = SSL_write(ssl_.get(), bytes.data(), static_cast<int>(bytes.size()));
    if (outcome > 0) return Done{};  // without SSL_MODE_ENABLE_PARTIAL_WRITE that means all of it
    auto waited = wait_after(outcome, deadline);
    if (!waited) return waited.error();
  }
}

Status TlsChannel::read_all(std::span<char> bytes, Deadline deadline) {
  while (!bytes.empty()) {
    ERR_clear_error();
    const int outcome = SSL_read(ssl_.get(), bytes.data(), static_cast<int>(bytes.size()));
    if (outcome > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(outcome));
      continue;
    }
    auto waited = wait_after(outcome, deadline);
    if (!waited) return waited.error();
  }
  return Done{};
}

Result<Message> TlsChannel::receive(Deadline deadline) {
  std::array<char, length_bytes> length{};
  if (auto read = read_all(length, deadline); !read) return read.error();
  std::size_t size = 0;
  for (const char byte : length)
    size = size << 8U | static_cast<unsigned char>(byte);
  if (size == 0 || size > longest_message_bytes)
    return Error{"the other PC sent a message that is too long for a pairing"};
  std::string content(size, '\0');
  if (auto read = read_all(content, deadline); !read) return read.error();
  return Message{.kind = content.front(), .text = content.substr(1)};
}

}  // namespace telehug
