// SPDX-License-Identifier: Apache-2.0
//
// A video chat in a window of a real X server, both daemons, the simulated jacket: touches go out only while they are
// meant for the person in that window, and whatever happens to the screen is told and mended by itself.
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "doubles/x11_typist.hpp"
#include "doubles/xvfb.hpp"
#include "integration/app/chat_window.hpp"
#include "integration/app/running_pair.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

const cv::Rect screen_px(0, 0, 1920, 1080);

// For the README: TELEHUG_SCREENSHOT=docs/overlay.png test_app_chat_on_screen
void save_screenshot(X11Client& onlooker) {
  const char* const file = std::getenv("TELEHUG_SCREENSHOT");
  if (file == nullptr) return;
  const cv::Mat1i colours = onlooker.screenshot(screen_px);
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(colours.size(), CV_8UC4, colours.data), bgr, cv::COLOR_BGRA2BGR);
  cv::resize(bgr, bgr, screen_px.size() / 2, 0, 0, cv::INTER_AREA);
  const Status written = write_png(file, bgr);
  EXPECT_TRUE(written) << written.error().message;
}

class ChatOnScreen : public testing::Test {
 protected:
  ChatOnScreen() {
    setenv("DISPLAY", xvfb.display().c_str(), 1);
    pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
    // Taps, over and over: who touches while touches don't go out must lift the finger first.
    pair.camera = "replay:" TELEHUG_FIXTURES "/rig2?sequence";
    pair.active_settings.emplace_back("body_map.source=x11");
  }

  void pin_the_chat() { pair.active_settings.emplace_back("body_map.window=video chat"); }
  void start_all() {
    pair.start_jacket();
    pair.start_passive();
    pair.start_active();
  }
  [[nodiscard]] bool becomes_felt() const {
    return eventually([&] { return pair.felt(); });
  }
  // Nothing is felt any more, though somebody goes on touching.
  [[nodiscard]] bool is_withheld_because(const std::string& why) const {
    return eventually([&] {
      const auto status = pair.status(Side::active);
      return !pair.felt() && status.is_object() && status.at("sending").value("why", "") == why;
    });
  }
  [[nodiscard]] Outcome send(const std::string& mode) const {
    return pair.run({TELEHUG_BIN "/telehug", "send", mode, "--socket", pair.socket(Side::active).string()});
  }

  Xvfb xvfb{"1920x1080x24"};
  RunningPair pair;
};

TEST_F(ChatOnScreen, IsFeltOnlyWhileThePinnedWindowIsInFront) {
  X11Client others(xvfb.display());
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();

  X11WindowPlan letter;
  letter.place_px = {100, 100, 900, 800};
  const xcb_window_t covering = others.open(letter);
  EXPECT_TRUE(is_withheld_because("another window covers the pinned one")) << pair.logs();
  EXPECT_TRUE(pair.camera_open()) << "the chat may be back at once";

  others.close(covering);
  EXPECT_TRUE(becomes_felt()) << pair.logs();
}

TEST_F(ChatOnScreen, IsNotFeltFromAScreenWithoutAPinnedWindowUntilSendingIsSwitchedOn) {
  const ChatWindow chat(xvfb.display(), screen_px);
  start_all();
  ASSERT_TRUE(eventually([&] { return pair.counter(Side::active, "touches_withheld") > 0; })) << pair.logs();
  EXPECT_TRUE(is_withheld_because("no window is pinned"));
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "touches don't go out"); })) << pair.logs();
  EXPECT_EQ(pair.counter(Side::passive, "events_received"), 0U);

  EXPECT_EQ(send("on").code, 0);
  EXPECT_TRUE(becomes_felt()) << pair.logs();

  EXPECT_EQ(send("off").code, 0);
  EXPECT_TRUE(is_withheld_because("switched off"));
  EXPECT_TRUE(eventually([&] { return !pair.camera_open(); })) << "nobody needs it";

  EXPECT_EQ(send("on").code, 0);
  EXPECT_TRUE(becomes_felt()) << pair.logs();
}

TEST_F(ChatOnScreen, IsLookedForInTheRegionOnly) {
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  pair.active_settings.emplace_back("body_map.region=0,0,480,1080");
  start_all();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "No face"); })) << pair.logs();
  EXPECT_EQ(pair.counter(Side::active, "events_published"), 0U);
}

TEST_F(ChatOnScreen, IsFeltAgainWhenTheWindowIsBack) {
  X11Client others(xvfb.display());
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();

  others.unmap(chat.window());
  EXPECT_TRUE(eventually([&] { return !pair.felt() && pair.complains(Side::active, "video chat"); })) << pair.logs();
  others.map(chat.window());
  EXPECT_TRUE(becomes_felt()) << pair.logs();
}

TEST_F(ChatOnScreen, IsFeltAgainWhenTheXServerIsBack) {
  auto chat = std::make_unique<ChatWindow>(xvfb.display(), screen_px);
  pin_the_chat();
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();

  chat.reset();
  xvfb.stop();
  EXPECT_TRUE(eventually([&] { return !pair.felt() && pair.complains(Side::active, xvfb.display()); })) << pair.logs();
  xvfb.start();
  chat = std::make_unique<ChatWindow>(xvfb.display(), screen_px);
  EXPECT_TRUE(becomes_felt()) << pair.logs();
}

TEST_F(ChatOnScreen, IsToldWhenThereIsNoDisplay) {
  unsetenv("DISPLAY");
  start_all();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "DISPLAY"); })) << pair.logs();
  EXPECT_EQ(pair.counter(Side::active, "events_published"), 0U);
}

TEST_F(ChatOnScreen, OutlinesTheTouchedBoxOnceItIsFeltAndIsNoWindowInFrontItself) {
  X11Client onlooker(xvfb.display());
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  pair.active_settings.emplace_back("overlay.show=true");
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();
  constexpr int green = 0x43A047;
  const auto outlined_px = [&] { return cv::countNonZero(onlooker.screenshot(screen_px) == green); };
  // The chat is as large as the screen: boxes are over a hundred px wide, the felt line is six.
  EXPECT_TRUE(eventually([&] { return outlined_px() > 1000; })) << pair.logs();
  EXPECT_TRUE(pair.felt()) << "the outline does not count as a window in front of the chat";
  save_screenshot(onlooker);

  EXPECT_EQ(send("off").code, 0);
  EXPECT_TRUE(eventually([&] { return outlined_px() == 0; })) << pair.logs();
}

TEST_F(ChatOnScreen, OutlinesThePersonForAMomentWhenTheyHugBack) {
  X11Client onlooker(xvfb.display());
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  pair.active_settings.insert(pair.active_settings.end(), {"overlay.show=true", "hug.notify=false"});
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();
  constexpr int pink = 0xEC407A;
  const auto outlined_px = [&] { return cv::countNonZero(onlooker.screenshot(screen_px) == pink); };
  ASSERT_EQ(outlined_px(), 0);
  ASSERT_TRUE(eventually([&] { return pair.telehug("hug", Side::passive).code == 0; })) << pair.logs();
  EXPECT_TRUE(eventually([&] { return outlined_px() > 1000; }, 2s)) << pair.logs();
  EXPECT_TRUE(eventually([&] { return outlined_px() == 0; })) << pair.logs();
}

TEST_F(ChatOnScreen, IsSwitchedOffAndOnByTheHotkey) {
  X11Typist typist(xvfb.display());
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  pair.active_settings.emplace_back("sending.hotkey=Ctrl+Alt+h");
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_withheld_because("switched off"));
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(becomes_felt()) << pair.logs();
}

TEST_F(ChatOnScreen, IsToldThatTheHotkeyMeansNothing) {
  pair.active_settings.emplace_back("sending.hotkey=Hyper+H");
  start_all();
  EXPECT_TRUE(eventually([&] { return pair.complains(Side::active, "Hyper"); })) << pair.logs();
}

TEST_F(ChatOnScreen, RefusesOrdersThatMeanNothingAndChangesNothing) {
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.status(Side::active).is_object(); })) << pair.logs();
  const auto is_refused = [&](const nlohmann::json& request) {
    auto client = ControlClient::connect(pair.socket(Side::active));
    const auto answer = std::get<ControlClient>(client).ask(request);
    return answer && answer->contains("error");
  };
  for (const nlohmann::json& nothing : std::vector<nlohmann::json>{{{"command", "send"}},
                                                                   {{"command", "send"}, {"mode", 1}},
                                                                   {{"command", "send"}, {"mode", "ON"}},
                                                                   {{"command", "face"}},
                                                                   {{"command", "face"}, {"order", nullptr}},
                                                                   {{"command", "face"}, {"order", "previous"}},
                                                                   {{"command", "face"}, {"order", "next"}}}) {
    EXPECT_TRUE(is_refused(nothing)) << nothing;
  }
  EXPECT_EQ(pair.status(Side::active).at("sending").at("name"), "auto");
}

TEST_F(ChatOnScreen, FollowsTheFaceThatAPersonChooses) {
  const ChatWindow chat(xvfb.display(), screen_px);
  pin_the_chat();
  start_all();
  ASSERT_TRUE(becomes_felt()) << pair.logs();
  const auto order = [&](const char* what) {
    return pair.run({TELEHUG_BIN "/telehug", "face", what, "--socket", pair.socket(Side::active).string()});
  };
  const Outcome next = order("next");
  EXPECT_NE(next.code, 0);
  EXPECT_NE(next.text.find("no other face is seen"), std::string::npos) << next.text;
  EXPECT_EQ(order("pin").code, 0);
  EXPECT_TRUE(eventually([&] { return pair.status(Side::active).at("face").at("pinned") == true; })) << pair.logs();
  EXPECT_EQ(order("unpin").code, 0);
  EXPECT_TRUE(eventually([&] { return pair.status(Side::active).at("face").at("pinned") == false; })) << pair.logs();
}

}  // namespace
}  // namespace telehug
