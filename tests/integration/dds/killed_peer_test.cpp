// SPDX-License-Identifier: Apache-2.0
//
// Two processes: a peer that is killed and started again.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <mutex>
#include <thread>

#include "dds/participant.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "doubles/inbox.hpp"
#include "doubles/unique_domain.hpp"
#include "peer/heartbeat_exchange.hpp"
#include "peer/peer_monitor.hpp"
#include "peer/session_id.hpp"

namespace telehug {
namespace {

// The active side as a process of its own: its status once, then heartbeats until it is killed. Forked before this
// program has any thread; begins when told to.
class ActiveProcess {
 public:
  explicit ActiveProcess(const DdsSettings& settings) {
    if (pipe(begin_.data()) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    char byte = 0;
    if (read(begin_[0], &byte, 1) != 1) _exit(1);
    live(settings);
  }
  ~ActiveProcess() {
    end();
    close(begin_[0]);
    close(begin_[1]);
  }
  ActiveProcess(const ActiveProcess&) = delete;
  ActiveProcess& operator=(const ActiveProcess&) = delete;

  void begin() const { ASSERT_EQ(write(begin_[1], "b", 1), 1); }
  void end() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  [[noreturn]] static void live(const DdsSettings& settings) {
    const SteadyClock clock;
    DdsParticipant participant(settings);
    Writer<Heartbeat> heartbeats(participant);
    Writer<SideStatus> statuses(participant);
    const SessionId session = new_session_id();
    statuses.write({.session = session, .side = Side::active, .version = "0.1.0", .ready = true, .reason = ""});
    HeartbeatExchange exchange(session, Side::active);
    for (;;) {
      heartbeats.write(exchange.beat(clock.now()));
      std::this_thread::sleep_until(exchange.next_due());
    }
  }

  std::array<int, 2> begin_{};
  pid_t process_ = 0;
};

TEST(APeerThatIsKilled, IsMissedAndKnownAsAnotherSessionWhenItReturns) {
  const UniqueDomain domain;
  const DdsSettings active{.side = Side::active, .domain_id = domain.id(), .partition = domain.partition()};
  ActiveProcess first(active);
  ActiveProcess second(active);

  const SteadyClock clock;
  DdsParticipant participant({.side = Side::passive, .domain_id = domain.id(), .partition = domain.partition()});
  std::mutex mutex;
  // No test of time: a busy machine may hold a heartbeat back for long.
  PeerMonitor monitor(1s);
  const Reader<Heartbeat> heartbeats(participant, [&](const Heartbeat& heartbeat) {
    const std::lock_guard lock(mutex);
    monitor.heard(heartbeat, clock.now());
  });
  Inbox<SideStatus> inbox;
  const Reader<SideStatus> statuses(participant, inbox.callback());
  const auto becomes = [&](bool alive) {
    const Timestamp give_up = clock.now() + 15s;
    for (;;) {
      {
        const std::lock_guard lock(mutex);
        if (monitor.alive(clock.now()) == alive) return true;
      }
      if (clock.now() > give_up) return false;
      std::this_thread::sleep_for(5ms);
    }
  };

  first.begin();
  ASSERT_TRUE(becomes(true));
  ASSERT_TRUE(inbox.wait_for(1)) << "its status";
  const SessionId first_session = inbox.messages().back().session;
  EXPECT_EQ(monitor.session(), first_session);

  first.end();
  ASSERT_TRUE(becomes(false));
  EXPECT_GE(monitor.losses(), 1U);

  second.begin();
  ASSERT_TRUE(becomes(true));
  ASSERT_TRUE(inbox.wait_for(2));
  const std::lock_guard lock(mutex);
  EXPECT_NE(monitor.session(), first_session);
  EXPECT_EQ(monitor.session(), inbox.messages().back().session);
}

}  // namespace
}  // namespace telehug
