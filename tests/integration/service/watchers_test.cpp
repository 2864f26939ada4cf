// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <thread>

#include "doubles/temporary_folder.hpp"
#include "integration/service/raw_connection.hpp"
#include "service/control_server.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

class Watchers : public testing::Test {
 protected:
  Watchers() { options_.socket = folder_.path() / "test.sock"; }

  ControlServer& serve() {
    server_.emplace(options_);
    server_->on("status", [](const Json&) -> Json { return {{"side", "active"}}; });
    server_->start();
    return *server_;
  }

  static void watch(RawConnection& connection) {
    connection.send("{\"command\":\"watch\"}\n");
    EXPECT_EQ(connection.line(), "{\"watching\":true}");
  }

  TemporaryFolder folder_;
  ControlServerOptions options_;
  std::optional<ControlServer> server_;
};

TEST_F(Watchers, AreToldEveryEventInOrder) {
  ControlServer& server = serve();
  RawConnection one(options_.socket);
  RawConnection two(options_.socket);
  watch(one);
  watch(two);
  for (int i = 0; i < 100; ++i)
    server.broadcast({{"event", "touch"}, {"n", i}});
  for (int i = 0; i < 100; ++i) {
    const std::string expected = "{\"event\":\"touch\",\"n\":" + std::to_string(i) + "}";
    ASSERT_EQ(one.line(), expected);
    ASSERT_EQ(two.line(), expected);
  }
  EXPECT_EQ(server.stats().watchers, 2U);
  EXPECT_TRUE(server.has_watchers());
}

TEST_F(Watchers, MayAskInBetween) {
  ControlServer& server = serve();
  RawConnection connection(options_.socket);
  watch(connection);
  connection.send("{\"command\":\"status\"}\n");
  EXPECT_EQ(connection.line(), "{\"side\":\"active\"}");
  server.broadcast({{"event", "touch"}});
  EXPECT_EQ(connection.line(), "{\"event\":\"touch\"}");
}

TEST_F(Watchers, AreNotEndedForBeingSilent) {
  options_.idle_timeout = 30ms;
  ControlServer& server = serve();
  RawConnection watcher(options_.socket);
  watch(watcher);
  RawConnection silent(options_.socket);
  EXPECT_TRUE(silent.closed());  // by then the watcher's time would be over, too
  server.broadcast({{"event", "touch"}});
  EXPECT_EQ(watcher.line(), "{\"event\":\"touch\"}");
}

TEST_F(Watchers, ThatDoNotReadNeitherHoldUpTheSenderNorFillTheMemory) {
  ControlServer& server = serve();
  RawConnection slow(options_.socket);
  RawConnection quick(options_.socket);
  watch(slow);
  watch(quick);
  const std::string padding(1000, 'p');
  static constexpr int events = 20'000;  // 20 MB: far beyond what the kernel buffers
  std::thread reader([&quick] {
    int last = -1;
    while (last < events - 1) {
      const Json event = Json::parse(quick.line().value_or("{}"), nullptr, false);
      if (!event.is_object()) break;
      if (event.value("event", "") == "dropped") continue;
      const int n = event.value("n", events);
      EXPECT_GT(n, last);
      last = n;
    }
    EXPECT_EQ(last, events - 1);
  });
  for (int i = 0; i < events; ++i)
    server.broadcast({{"event", "touch"}, {"n", i}, {"padding", padding}});
  reader.join();
  EXPECT_GT(server.stats().dropped_events, 10'000U);

  // The slow one now reads: what the kernel held, how many it missed, and the newest.
  int told_dropped = 0;
  int last = -1;
  int read = 0;
  while (last < events - 1) {
    const Json event = Json::parse(slow.line().value_or("{}"), nullptr, false);
    ASSERT_TRUE(event.is_object());
    if (event["event"] == "dropped") {
      told_dropped += event["count"].get<int>();
    } else {
      last = event["n"].get<int>();
      ++read;
    }
  }
  EXPECT_GT(told_dropped, 0);
  EXPECT_LT(read, 5'000);
}

TEST_F(Watchers, ThatStayStuckAreEnded) {
  options_.write_timeout = 50ms;
  ControlServer& server = serve();
  RawConnection stuck(options_.socket);
  watch(stuck);
  const std::string padding(100'000, 'p');
  for (int i = 0; i < 100; ++i)
    server.broadcast({{"padding", padding}});
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (server.stats().watchers > 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(1ms);
  EXPECT_EQ(server.stats().watchers, 0U);
}

TEST_F(Watchers, CanBeToldByManyThreadsAtOnce) {
  options_.most_waiting_events = 100'000;
  ControlServer& server = serve();
  RawConnection watcher(options_.socket);
  watch(watcher);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&server] {
      for (int i = 0; i < 200; ++i)
        server.broadcast({{"event", "touch"}});
    });
  }
  for (int i = 0; i < 800; ++i)
    ASSERT_EQ(watcher.line(), "{\"event\":\"touch\"}");
  for (auto& thread : threads)
    thread.join();
}

TEST_F(Watchers, AreNotNeededForABroadcast) {
  ControlServer& server = serve();
  EXPECT_FALSE(server.has_watchers());
  for (int i = 0; i < 10'000; ++i)
    server.broadcast({{"event", "touch"}});
  EXPECT_EQ(server.stats().dropped_events, 0U);
}

}  // namespace
}  // namespace telehug
