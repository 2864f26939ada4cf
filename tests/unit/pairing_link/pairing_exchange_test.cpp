// SPDX-License-Identifier: Apache-2.0
//
// Real TLS over loopback, the inviter in a thread of its own.
#include "pairing_link/pairing_exchange.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <openssl/ssl.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <future>
#include <memory>

namespace telehug {
namespace {

using namespace std::chrono_literals;

class PairingExchange : public testing::Test {
 protected:
  PairingExchange() { ::signal(SIGPIPE, SIG_IGN); }

  Offer parent() {
    return {.side = Side::active,
            .make_request = [] { return Result<std::string>("a request"); },
            .accept =
                [this](const std::string& grant) {
                  accepted = grant;
                  return Status(Done{});
                },
            .grant_for = {}};
  }
  static Offer wearer() {
    return {.side = Side::passive, .make_request = {}, .accept = {}, .grant_for = [](const std::string& request) {
              return Result<std::string>("granted: " + request);
            }};
  }
  static std::future<Status> start(Invitation& invitation, const Offer& offer, int stop_fd = -1) {
    return std::async(std::launch::async, [&invitation, offer, stop_fd] { return invitation.pair(offer, stop_fd); });
  }
  static Status dial(const PairingCode& code, const Offer& offer) { return accept_invitation(code, offer, {}, -1); }

  // A program that is none of ours, connected to the inviter.
  static OwnedFd stranger(const PairingCode& code) {
    OwnedFd made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(code.inviter.port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(made.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    return made;
  }
  static bool says(const Status& status, const std::string& words) {
    return !status && status.error().message.find(words) != std::string::npos;
  }

  const Endpoint here{{127, 0, 0, 1}, 0};
  std::string accepted;
};

TEST_F(PairingExchange, PairsTwoSidesWhicheverOfThemInvites) {
  Invitation by_wearer(here);
  auto wearers = start(by_wearer, wearer());
  const auto parents = dial(by_wearer.code(), parent());
  EXPECT_TRUE(parents) << parents.error().message;
  EXPECT_TRUE(wearers.get());
  EXPECT_EQ(accepted, "granted: a request");

  accepted.clear();
  Invitation by_parent(here);
  auto inviting = start(by_parent, parent());
  EXPECT_TRUE(dial(by_parent.code(), wearer()));
  EXPECT_TRUE(inviting.get());
  EXPECT_EQ(accepted, "granted: a request");
}

TEST_F(PairingExchange, RefusesAWrongCodeAndStillTakesTheRightOne) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  auto wrong = invitation.code();
  wrong.secret[0] ^= 1;
  EXPECT_TRUE(says(dial(wrong, parent()), "does not know this pairing code"));
  EXPECT_TRUE(accepted.empty());
  EXPECT_TRUE(dial(invitation.code(), parent()));
  EXPECT_TRUE(inviter.get());
}

TEST_F(PairingExchange, EndsAfterFiveWrongCodes) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  auto wrong = invitation.code();
  wrong.secret[0] ^= 1;
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(dial(wrong, parent()));
  EXPECT_TRUE(says(inviter.get(), "5 times"));
  EXPECT_TRUE(says(dial(invitation.code(), parent()), "nobody waits"));
}

TEST_F(PairingExchange, TakesACodeOnlyOnce) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  EXPECT_TRUE(dial(invitation.code(), parent()));
  EXPECT_TRUE(inviter.get());
  EXPECT_TRUE(says(dial(invitation.code(), parent()), "nobody waits"));
  EXPECT_TRUE(says(invitation.pair(wearer(), -1), "used already"));
}

TEST_F(PairingExchange, EndsWhenNobodyComesInTime) {
  Invitation invitation(here, {.invitation = 1ms});
  EXPECT_TRUE(says(invitation.pair(wearer(), -1), "nobody came"));
  EXPECT_TRUE(says(dial(invitation.code(), parent()), "nobody waits"));
}

TEST_F(PairingExchange, GivesUpOnWhoSaysNothing) {
  Invitation invitation(here, {.handshake = 20ms, .wrong_handshakes = 1});
  const auto silent = stranger(invitation.code());
  EXPECT_TRUE(says(invitation.pair(wearer(), -1), "1 times"));
}

TEST_F(PairingExchange, IsNotDisturbedByGarbage) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  {
    const auto talker = stranger(invitation.code());
    const std::string garbage = "GET / HTTP/1.1\r\n\r\n";
    EXPECT_EQ(::send(talker.get(), garbage.data(), garbage.size(), MSG_NOSIGNAL), static_cast<ssize_t>(garbage.size()));
  }
  EXPECT_TRUE(dial(invitation.code(), parent()));
  EXPECT_TRUE(inviter.get());
}

TEST_F(PairingExchange, GivesUpOnWhoKnowsTheCodeAndSaysNoMore) {
  Invitation invitation(here, {.idle = 20ms});
  auto inviter = start(invitation, wearer());
  TlsChannel silent(stranger(invitation.code()), TlsChannel::Role::dials, invitation.code().secret, -1);
  ASSERT_TRUE(silent.shake_hands(std::chrono::steady_clock::now() + 5s));
  EXPECT_TRUE(says(inviter.get(), "in time"));
}

TEST_F(PairingExchange, RefusesAMessageThatIsTooLong) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  auto offer = parent();
  offer.make_request = [] { return Result<std::string>(std::string(TlsChannel::longest_message_bytes, 'x')); };
  EXPECT_TRUE(says(dial(invitation.code(), offer), "too long"));
  EXPECT_FALSE(inviter.get());
}

// Who knows the code and has another program: it announces two gigabytes.
TEST_F(PairingExchange, ReadsNoMessageThatIsAnnouncedTooLong) {
  Invitation invitation(here);
  auto inviter = start(invitation, wearer());
  const auto connection = stranger(invitation.code());
  static TlsChannel::Secret secret;
  secret = invitation.code().secret;
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  SSL_CTX_set_ciphersuites(context.get(), "TLS_AES_128_GCM_SHA256");
  SSL_CTX_set_psk_client_callback(context.get(),
                                  [](SSL*, const char*, char* identity, unsigned, unsigned char* psk, unsigned) {
                                    std::strcpy(identity, "telehug pairing");
                                    std::memcpy(psk, secret.data(), secret.size());
                                    return static_cast<unsigned>(secret.size());
                                  });
  const std::unique_ptr<SSL, decltype(&SSL_free)> ssl(SSL_new(context.get()), &SSL_free);
  SSL_set_fd(ssl.get(), connection.get());
  ASSERT_EQ(SSL_connect(ssl.get()), 1);
  ASSERT_EQ(SSL_write(ssl.get(), "\x7F\xFF\xFF\xFF", 4), 4);
  EXPECT_TRUE(says(inviter.get(), "too long"));
}

TEST_F(PairingExchange, SaysThatEqualSidesAreNoPair) {
  Invitation invitation(here);
  auto inviter = start(invitation, parent());
  EXPECT_TRUE(says(dial(invitation.code(), parent()), "both PCs are a parent's"));
  EXPECT_TRUE(says(inviter.get(), "both PCs are a parent's"));
}

TEST_F(PairingExchange, TellsTheOtherPcWhyItFailed) {
  Invitation invitation(here);
  auto offer = wearer();
  offer.grant_for = [](const std::string&) { return Result<std::string>(Error{"the disk is full"}); };
  auto inviter = start(invitation, offer);
  EXPECT_TRUE(says(dial(invitation.code(), parent()), "the disk is full"));
  EXPECT_TRUE(says(inviter.get(), "the disk is full"));
}

TEST_F(PairingExchange, EndsWhenThePersonAsksForIt) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const OwnedFd stop(ends[0]);
  const OwnedFd asker(ends[1]);
  Invitation invitation(here);
  auto inviter = start(invitation, wearer(), stop.get());
  ASSERT_EQ(::write(asker.get(), "x", 1), 1);
  EXPECT_TRUE(says(inviter.get(), "stopped"));
}

}  // namespace
}  // namespace telehug
