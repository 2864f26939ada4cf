// SPDX-License-Identifier: Apache-2.0
#include "integration/screen_portal/portal_grabber_fixture.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using testing::HasSubstr;

class PortalTroubleTest : public PortalGrabberFixture {};

using Answer = std::function<void(sdbus::Signal&)>;

Answer words(std::uint32_t code, const PortalWords& said) {
  return [code, said](sdbus::Signal& signal) { signal << code << said; };
}

PortalNodes nodes(std::size_t count, const PortalWords& about) {
  PortalNodes result;
  for (std::size_t i = 0; i < count; ++i)
    result.emplace_back(static_cast<std::uint32_t>(i), about);
  return result;
}

TEST_F(PortalTroubleTest, SurvivesAPortalThatAnswersNonsense) {
  using sdbus::Variant;
  const std::vector<Answer> nonsense{
      [](sdbus::Signal&) {},
      [](sdbus::Signal& signal) { signal << std::uint32_t{0}; },
      [](sdbus::Signal& signal) { signal << std::string("yes"); },
      [](sdbus::Signal& signal) { signal << PortalWords{} << std::uint32_t{0}; },
      words(0, {}),
      words(7, {}),
      words(0, {{"session_handle", Variant(42)}, {"streams", Variant("all")}, {"restore_token", Variant(1.5)}}),
      words(0, {{"session_handle", Variant("")}, {"streams", Variant(nodes(0, {}))}}),
      words(0, {{"session_handle", Variant("no path")}, {"streams", Variant(nodes(2, {}))}}),
      words(0, {{"session_handle", Variant("/of/somebody/else")},
                {"streams", Variant(nodes(1, {{"source_type", Variant(std::uint32_t{2})}}))}}),
      words(0, {{"session_handle", Variant(sdbus::ObjectPath("/of/another/type"))},
                {"streams", Variant(std::vector<std::uint32_t>{1, 2})}}),
      words(0, {{"streams", Variant(nodes(1, {{"source_type", Variant("monitor")}}))},
                {"restore_token", Variant(std::string(100'000, 'x'))}}),
      words(0, {{"streams", Variant(nodes(1, {}))}, {"restore_token", Variant("with a\nline and \x01")}}),
      words(0, {{"streams", Variant(nodes(1000, {{"size", Variant(sdbus::make_struct(-1, 1 << 30))}}))}}),
  };
  for (std::size_t i = 0; i < nonsense.size(); ++i) {
    for (auto answered :
         {&FakePortal::Script::answer_create, &FakePortal::Script::answer_select, &FakePortal::Script::answer_start}) {
      FakePortal::Script odd = script;
      odd.node = 123'456;  // where nothing is
      odd.*answered = nonsense[i];
      opened.reset();
      played.reset();
      played = std::make_unique<FakePortal>(bus.address(), odd);
      ASSERT_TRUE(grabs(GrabOutcome::lost)) << "answer " << i;
      ASSERT_TRUE(played->has_seen([&](const FakePortal::Seen& seen) {
        return answered == &FakePortal::Script::answer_start    ? seen.starts > 0
               : answered == &FakePortal::Script::answer_select ? !seen.select.empty()
                                                                : true;
      }));
      EXPECT_NE(grabber().grab(picture), GrabOutcome::changed) << "answer " << i;
    }
  }
}

TEST_F(PortalTroubleTest, RefusesToGuessWhichOfTwoMonitorsIsMeant) {
  script.answer_start = words(0, {{"streams", sdbus::Variant(nodes(2, {}))}});
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "shares several monitors"));
}

TEST_F(PortalTroubleTest, RefusesAWindowWhosePlaceIsNotKnown) {
  script.answer_start =
      words(0, {{"streams", sdbus::Variant(nodes(1, {{"source_type", sdbus::Variant(std::uint32_t{2})}}))}});
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "shares a window"));
}

TEST_F(PortalTroubleTest, SaysThatNoMonitorIsShared) {
  script.answer_start = words(0, {});
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "shares no monitor"));
}

TEST_F(PortalTroubleTest, IsNotFooledByAnotherProgramOnTheBus) {
  script.user_hesitates = true;
  portal();
  grabber();
  ASSERT_TRUE(portal().has_seen([](const FakePortal::Seen& seen) { return seen.starts == 1; }));
  ASSERT_TRUE(grabs(GrabOutcome::lost, "waits for your consent"));
  // The caller's requests are named after it; the third one is open.
  auto stranger = sdbus::createSessionBusConnectionWithAddress(bus.address());
  auto object = sdbus::createObject(*stranger, portal().waiting_request());
  object->finishRegistration();
  sdbus::Signal refusal = object->createSignal("org.freedesktop.portal.Request", "Response");
  refusal << std::uint32_t{1} << PortalWords{};
  object->emitSignal(refusal);
  portal().answer();
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalTroubleTest, SaysThatThereIsNoPortalAndFindsItLater) {
  grabber();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "There is no desktop portal"));
  EXPECT_THAT(grabber().last_error(), HasSubstr("install xdg-desktop-portal"));
  portal();
  EXPECT_TRUE(shows(drawn({64, 48}, 1)));
}

TEST_F(PortalTroubleTest, SaysThatThePortalCantShareScreens) {
  script.can_share_screens = false;
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "portal can't share screens"));
}

TEST_F(PortalTroubleTest, SaysThatThePortalCantShareMonitors) {
  script.source_types = 2;
  portal();
  grabber();
  EXPECT_TRUE(grabs(GrabOutcome::lost, "can't share a monitor"));
}

TEST_F(PortalTroubleTest, SaysThatThereIsNoSessionBus) {
  for (const std::string address : {"unix:path=/nowhere/bus", "no address", "unix:path="}) {
    PortalGrabberConfig nowhere = config();
    nowhere.bus_address = address;
    opened = std::make_unique<PortalGrabber>(nowhere, clock);
    ASSERT_TRUE(opened->open());
    EXPECT_TRUE(grabs(GrabOutcome::lost, "There is no session bus")) << address;
  }
}

TEST_F(PortalTroubleTest, FindsThePortalAgainThatHasGone) {
  portal();
  grabber();
  ASSERT_TRUE(shows(drawn({64, 48}, 1)));
  played.reset();
  ASSERT_TRUE(grabs(GrabOutcome::lost, "portal"));
  portal();
  EXPECT_TRUE(shows_in_the_end(drawn({64, 48}, 2)));
  EXPECT_EQ(sent_token(), "first-token");
}

}  // namespace
}  // namespace telehug
