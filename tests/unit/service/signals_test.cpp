// SPDX-License-Identifier: Apache-2.0
#include "service/signals.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace telehug {
namespace {

TEST(Signals, BecomeRequests) {
  Signals signals;
  EXPECT_EQ(signals.take(), std::nullopt);
  kill(getpid(), SIGHUP);
  EXPECT_EQ(signals.wait(10s), SignalRequest::reload);
  kill(getpid(), SIGTERM);
  EXPECT_EQ(signals.wait(10s), SignalRequest::stop);
  kill(getpid(), SIGINT);
  EXPECT_EQ(signals.wait(10s), SignalRequest::stop);
  EXPECT_EQ(signals.take(), std::nullopt);
}

TEST(Signals, LetAWriteToAClosedPipeFailInsteadOfEndingTheProcess) {
  const Signals signals;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  EXPECT_EQ(write(ends[1], "x", 1), -1);
  EXPECT_EQ(errno, EPIPE);
  close(ends[1]);
}

TEST(Signals, ThatWereNotReadDoNotEndTheProcessLater) {
  {
    const Signals signals;
    kill(getpid(), SIGTERM);
  }
  SUCCEED();
}

TEST(Signals, AreLetThroughAgainAfterwards) {
  { const Signals signals; }
  sigset_t now;
  pthread_sigmask(SIG_BLOCK, nullptr, &now);
  EXPECT_EQ(sigismember(&now, SIGTERM), 0);
}

}  // namespace
}  // namespace telehug
