// SPDX-License-Identifier: Apache-2.0
#include "integration/screen_portal/portal_grabber_fixture.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>

namespace telehug {
namespace {

using testing::HasSubstr;

class PortalConsentTest : public PortalGrabberFixture {};

TEST_F(PortalConsentTest, WaitsForTheUserWithoutHoldingUpAnybody) {
  script.user_hesitates = true;
  portal();
  EXPECT_TRUE(grabber().is_open());
  ASSERT_TRUE(grabs(GrabOutcome::lost, "waits for your consent in the dialogue of the desktop"));
  ASSERT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) { return seen.starts == 1; }));
  EXPECT_EQ(grabber().grab(picture), GrabOutcome::lost);
  portal().answer();
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalConsentTest, AsksForOneMonitorWithoutTheMouse) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  auto asked = portal().seen().select;
  EXPECT_EQ(asked["types"].get<std::uint32_t>(), 1U);
  EXPECT_EQ(asked["cursor_mode"].get<std::uint32_t>(), 1U);
  EXPECT_EQ(asked["persist_mode"].get<std::uint32_t>(), 2U);
  EXPECT_FALSE(asked["multiple"].get<bool>());
  EXPECT_FALSE(asked.contains("restore_token"));
}

TEST_F(PortalConsentTest, DoesNotAskForACursorModeThatTheDesktopDoesNotHave) {
  script.cursor_modes = 2;
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  EXPECT_FALSE(portal().seen().select.contains("cursor_mode"));
}

TEST_F(PortalConsentTest, UnderstandsPortalsThatNameRequestsThemselves) {
  script.chooses_paths = true;
  script.user_hesitates = true;
  portal();
  // Without the agreed path an answer could come before its request is known: that is why it was agreed on. Here each
  // answer comes behind the reply, and in order.
  grabber();
  ASSERT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) { return seen.starts == 1; }));
  ASSERT_TRUE(grabs(GrabOutcome::lost, "waits for your consent"));
  portal().answer();
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalConsentTest, KeepsTheConsentForTheNextStartForItsOwnerOnly) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  EXPECT_EQ(kept_token(), "first-token");
  struct stat file {};
  ASSERT_EQ(::stat(token_file.c_str(), &file), 0);
  EXPECT_EQ(file.st_mode & 0777U, 0600U);
  EXPECT_EQ(grabber().remark(), "");

  portal().rewrite([](FakePortal::Script& now) { now.token = "second-token"; });
  grabber().close();
  ASSERT_TRUE(grabber().open());
  ASSERT_TRUE(shows_in_the_end(drawn({64, 48}, 2)));
  EXPECT_EQ(sent_token(), "first-token");
  EXPECT_EQ(kept_token(), "second-token");
}

TEST_F(PortalConsentTest, DropsAConsentThatIsNoLongerGoodAndAsksAnew) {
  for (const bool as_an_error : {true, false}) {
    folder.write("state/screen-token", "old-token\n");
    script.good_token = "another";
    script.bad_token_is_an_error = as_an_error;
    played.reset();
    opened.reset();
    portal();
    grabber();
    ASSERT_TRUE(shows_in_the_end(drawn({64, 48}, 1)));
    EXPECT_EQ(sent_token(), "");
    EXPECT_EQ(portal().seen().starts, as_an_error ? 1 : 2);
    EXPECT_EQ(kept_token(), "first-token");
  }
}

TEST_F(PortalConsentTest, SendsNoConsentToADesktopThatCantRememberOneAndSaysSo) {
  folder.write("state/screen-token", "old-token\n");
  script.version = 3;
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  const auto asked = portal().seen().select;
  EXPECT_FALSE(asked.contains("restore_token"));
  EXPECT_FALSE(asked.contains("persist_mode"));
  EXPECT_THAT(grabber().remark(), HasSubstr("(version 3) does not remember your consent"));
  EXPECT_FALSE(std::filesystem::exists(token_file));
}

TEST_F(PortalConsentTest, WorksThoughTheConsentCantBeKeptAndSaysSo) {
  folder.write("state", "a file where the folder should be");
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  EXPECT_THAT(grabber().remark(), HasSubstr("can't be kept in"));
}

TEST_F(PortalConsentTest, DoesNotAskAgainAfterANoUntilItIsOpenedAnew) {
  script.user_says = 1;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "was refused"));
  EXPECT_THAT(grabber().last_error(), HasSubstr("asked again in 10 minutes, or at once when telehug is started anew"));
  std::this_thread::sleep_for(5 * retry_after);
  EXPECT_EQ(portal().seen().starts, 1);

  portal().rewrite([](FakePortal::Script& now) { now.user_says = 0; });
  grabber().close();
  EXPECT_EQ(grabber().grab(picture), GrabOutcome::lost);
  ASSERT_TRUE(grabber().open());
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalConsentTest, AsksAgainAWhileAfterANo) {
  script.user_says = 1;
  ask_again_after = 50ms;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "was refused"));
  portal().rewrite([](FakePortal::Script& now) { now.user_says = 0; });
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
  EXPECT_GE(portal().seen().starts, 2);
}

TEST_F(PortalConsentTest, SaysThatTheDialogueWasEnded) {
  script.user_says = 2;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "dialogue was ended"));
  std::this_thread::sleep_for(5 * retry_after);
  EXPECT_EQ(portal().seen().starts, 1) << "one dialogue is enough";
}

TEST_F(PortalConsentTest, TakesNoEndForTheFaultOfAConsentThatWasNotSent) {
  folder.write("state/screen-token", "old-token\n");
  script.version = 3;
  script.user_says = 2;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "dialogue was ended"));
  EXPECT_EQ(portal().seen().starts, 1);
}

TEST_F(PortalConsentTest, ForgetsAConsentThatIsNoLongerGoodThoughTheUserSaysNo) {
  folder.write("state/screen-token", "old-token\n");
  script.good_token = "another";
  script.bad_token_is_an_error = true;
  script.user_says = 1;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "was refused"));
  EXPECT_FALSE(std::filesystem::exists(token_file));
}

TEST_F(PortalConsentTest, ShowsNoSecondDialogueSoonAfterAConsentThatCouldNotBeKept) {
  script.token = "";
  script.connect_to_pipewire = nullptr;
  portal();
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "can't reach PipeWire"));
  EXPECT_THAT(grabber().last_error(), HasSubstr("asked again in 10 minutes"));
  std::this_thread::sleep_for(5 * retry_after);
  EXPECT_EQ(portal().seen().starts, 1);
}

TEST_F(PortalConsentTest, RespectsThatTheUserEndsTheSharing) {
  ask_again_after = 50ms;
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  ASSERT_EQ(kept_token(), "first-token");
  portal().rewrite([](FakePortal::Script& now) { now.user_hesitates = true; });
  portal().end_session();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "was ended at the desktop"));
  ASSERT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) { return seen.starts == 2; }));
  EXPECT_EQ(sent_token(), "") << "the old consent must not be used over the user's head";
  ASSERT_TRUE(grabs(GrabOutcome::lost, "waits for your consent"));
  portal().answer();
  EXPECT_TRUE(shows_in_the_end(drawn({64, 48}, 2)));
}

TEST_F(PortalConsentTest, ClosesTheDialogueWhenItIsClosedInTheMiddleOfIt) {
  script.user_hesitates = true;
  portal();
  grabber();
  ASSERT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) { return seen.starts == 1; }));
  ASSERT_TRUE(grabs(GrabOutcome::lost, "waits for your consent"));
  grabber().close();
  EXPECT_FALSE(grabber().is_open());
  EXPECT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) {
    const auto closed = [&](const char* kind) {
      return std::any_of(seen.closed.begin(), seen.closed.end(), [&](const std::string& path) {
        return path.find(std::string("/") + kind + "/") != std::string::npos;
      });
    };
    return closed("request") && closed("session");
  }));
}

TEST_F(PortalConsentTest, CanBeClosedAtAnyTime) {
  portal();
  for (int i = 0; i < 30; ++i) {
    PortalGrabber other(config(), clock);
    ASSERT_TRUE(other.open());
    ASSERT_TRUE(other.open()) << "it is open already";
    std::this_thread::sleep_for(i * 500us);
    other.grab(picture);
    if (i % 2 == 0) other.close();
  }
}

TEST_F(PortalConsentTest, SaysThatItIsNotOpen) {
  PortalGrabber never_opened(config(), clock);
  EXPECT_EQ(never_opened.grab(picture), GrabOutcome::lost);
  EXPECT_THAT(never_opened.last_error(), HasSubstr("is not open"));
  never_opened.close();
}

}  // namespace
}  // namespace telehug
