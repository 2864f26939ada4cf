// SPDX-License-Identifier: Apache-2.0
#include "notify/desktop_notifier.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <thread>

#include "doubles/fake_clock.hpp"
#include "doubles/fake_notifications.hpp"
#include "doubles/private_bus.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class ANotification : public testing::Test {
 protected:
  // As housekeeping does, until it is so.
  bool serve_until(const std::function<bool()>& condition) {
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < give_up) {
      notifier.serve();
      if (condition()) return true;
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }
  bool is_seen(const FakeNotifications& desktop, std::size_t count) {
    return serve_until([&] { return desktop.seen().size() >= count; });
  }
  bool fails() {
    return serve_until([&] { return !notifier.problem().empty(); });
  }

  FakeClock clock;
  PrivateBus bus;
  DesktopNotifier notifier{clock, bus.address()};
};

TEST_F(ANotification, IsShownWithASound) {
  const FakeNotifications desktop(bus.address(), {});
  notifier.show({"A hug", "Mia hugs you."});
  ASSERT_TRUE(is_seen(desktop, 1));
  const FakeNotifications::Seen seen = desktop.seen().front();
  EXPECT_EQ(seen.app, "telehug");
  EXPECT_EQ(seen.title, "A hug");
  EXPECT_EQ(seen.body, "Mia hugs you.");
  EXPECT_EQ(seen.replaces, 0U);
  EXPECT_EQ(seen.hints.at("sound-name").get<std::string>(), "message-new-instant");
  EXPECT_EQ(seen.hints.at("category").get<std::string>(), "im.received");
  EXPECT_THAT(notifier.problem(), IsEmpty());
}

TEST_F(ANotification, TakesThePlaceOfTheOneBefore) {
  const FakeNotifications desktop(bus.address(), {});
  notifier.show({"A hug", "one"});
  ASSERT_TRUE(is_seen(desktop, 1));
  notifier.show({"A hug", "two"});
  ASSERT_TRUE(is_seen(desktop, 2));
  EXPECT_EQ(desktop.seen()[1].replaces, desktop.seen()[0].id);
}

TEST_F(ANotification, IsReadAsItIsWrittenWhetherTheDesktopKnowsMarkupOrNot) {
  {
    const FakeNotifications desktop(bus.address(), {});
    notifier.show({"A hug", "<Mum> & Dad"});
    ASSERT_TRUE(is_seen(desktop, 1));
    EXPECT_EQ(desktop.seen()[0].body, "&lt;Mum&gt; &amp; Dad");
  }
  const FakeNotifications plain(bus.address(), {.capabilities = {"body"}});
  DesktopNotifier another(clock, bus.address());
  another.show({"A hug", "<Mum> & Dad"});
  const auto give_up = std::chrono::steady_clock::now() + 10s;
  while (plain.seen().empty() && std::chrono::steady_clock::now() < give_up)
    another.serve();
  ASSERT_EQ(plain.seen().size(), 1U);
  EXPECT_EQ(plain.seen()[0].body, "<Mum> & Dad");
}

TEST_F(ANotification, FailsWithASentenceWhereNothingShowsItAndIsShownLaterWhereSomethingDoes) {
  notifier.show({"A hug", "one"});
  ASSERT_TRUE(fails());
  EXPECT_THAT(notifier.problem(), HasSubstr("Nothing on this desktop shows notifications"));
  const FakeNotifications desktop(bus.address(), {});
  notifier.show({"A hug", "two"});
  EXPECT_THAT(notifier.problem(), IsEmpty());
  ASSERT_TRUE(is_seen(desktop, 1));
  EXPECT_EQ(desktop.seen()[0].body, "two");
}

TEST_F(ANotification, ThatIsRefusedIsToldWithTheReason) {
  const FakeNotifications desktop(bus.address(), {.refuses = true});
  notifier.show({"A hug", "one"});
  ASSERT_TRUE(fails());
  EXPECT_THAT(notifier.problem(), HasSubstr("org.example.Refused"));
}

TEST_F(ANotification, OfADesktopThatHangsIsGivenUpWithoutWaitingForIt) {
  const FakeNotifications desktop(bus.address(), {.answers = false});
  notifier.show({"A hug", "one"});
  ASSERT_TRUE(is_seen(desktop, 1));
  EXPECT_THAT(notifier.problem(), IsEmpty());
  clock.advance(5s);
  notifier.serve();
  EXPECT_THAT(notifier.problem(), HasSubstr("does not answer"));
}

TEST_F(ANotification, FailsWithASentenceOnceTheBusHasGone) {
  auto first = std::make_unique<PrivateBus>();
  DesktopNotifier loose(clock, first->address());
  {
    const FakeNotifications desktop(first->address(), {});
    loose.show({"A hug", "one"});
    const auto give_up = std::chrono::steady_clock::now() + 10s;
    while (desktop.seen().empty() && std::chrono::steady_clock::now() < give_up)
      loose.serve();
    ASSERT_EQ(desktop.seen().size(), 1U);
  }
  first.reset();
  loose.serve();
  EXPECT_THAT(loose.problem(), IsEmpty()) << "there was nothing to show";
  loose.show({"A hug", "two"});
  loose.serve();
  EXPECT_THAT(loose.problem(), HasSubstr("session bus"));
}

TEST(WithoutASessionBus, ANotificationFailsWithASentence) {
  const FakeClock clock;
  DesktopNotifier notifier(clock, "unix:path=/nowhere/at/all");
  notifier.show({"A hug", "one"});
  notifier.serve();
  EXPECT_THAT(notifier.problem(), HasSubstr("There is no session bus to show a notification"));
  EXPECT_THAT(notifier.problem(), HasSubstr("graphical session"));
}

}  // namespace
}  // namespace telehug
