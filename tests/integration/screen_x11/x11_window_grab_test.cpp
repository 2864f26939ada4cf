// SPDX-License-Identifier: Apache-2.0
//
// One window of a program, wherever it is and whatever lies above it.
#include "integration/screen_x11/x11_grabber_fixture.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class X11WindowGrabTest : public X11GrabberTest {
 protected:
  // The chat's window at 100,50, 200x150 px, with a mark at its 10,20.
  xcb_window_t open_chat(X11WindowPlan plan = {}) {
    plan.place_px = {100, 50, 200, 150};
    plan.colour = 0x102030;
    plan.title = "Video Chat";
    plan.program = "browser";
    const auto window = client.open(plan);
    client.fill(window, {10, 20, 30, 40}, 0xFF8001);
    return window;
  }
  [[nodiscard]] bool shows_chat() const {
    return shows_only(0xFF8001, {10, 20, 30, 40}) && shows_only(0x102030, {0, 0, 200, 20}) &&
           shows_only(0x102030, {40, 20, 160, 130});
  }
};

TEST_F(X11WindowGrabTest, ShowsTheWindowAndItsPlace) {
  open_chat();
  open({.window = "video chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  ASSERT_EQ(picture.bgr.type(), CV_8UC4);
  ASSERT_EQ(picture.bgr.size(), cv::Size(200, 150));
  EXPECT_EQ(picture.origin_px, cv::Point(100, 50));
  EXPECT_EQ(picture.monitor.width_px, 800);
  EXPECT_EQ(picture.monitor.height_px, 600);
  EXPECT_EQ(picture.in_front, true);
  EXPECT_TRUE(shows_chat());
}

TEST_F(X11WindowGrabTest, FindsItByItsClassAndTakesTheTopmost) {
  open_chat();
  client.open({.place_px = {10, 10, 60, 60}, .title = "Notes", .program = "Editor"});
  const auto upper = client.open({.place_px = {20, 30, 70, 80}, .title = "Mail", .program = "Editor"});
  client.open({.place_px = {20, 30, 5, 5}, .title = "menu", .program = "Editor", .override_redirect = true});
  open({.window = "eDIt"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(70, 80));

  client.unmap(upper);
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(60, 60));
  client.map(upper);
  client.raise(upper);
  settle();
  EXPECT_EQ(picture.bgr.size(), cv::Size(60, 60)) << "the one that was found is kept while it is there";
}

TEST_F(X11WindowGrabTest, PrefersTheTitleInUtf8) {
  const auto window = client.open({.title = "old"});
  const std::string title = "Gespr\u00E4ch";
  xcb_change_property(client.get(), XCB_PROP_MODE_REPLACE, window, client.atom("_NET_WM_NAME"),
                      client.atom("UTF8_STRING"), 8, static_cast<std::uint32_t>(title.size()), title.data());
  client.sync();
  open({.window = "gespr\u00E4CH"});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::changed);
}

TEST_F(X11WindowGrabTest, ShowsItThoughAnotherCoversIt) {
  open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  const auto cover = client.open({.place_px = {0, 0, 800, 600}, .colour = 0x00FF00, .title = "cover"});
  ASSERT_TRUE(goes_behind());
  EXPECT_TRUE(shows_chat());
  client.fill(cover, {0, 0, 800, 600}, 0xFF0000);
  EXPECT_TRUE(stays_unchanged()) << "only the other window was drawn in";
  EXPECT_EQ(picture.in_front, false);
}

TEST_F(X11WindowGrabTest, NoticesWhatIsDrawnInACoveredWindow) {
  const auto window = open_chat();
  client.open({.place_px = {0, 0, 800, 600}, .colour = 0x00FF00, .title = "cover"});
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  client.fill(window, {100, 100, 5, 5}, 0xABCDEF);
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_TRUE(shows_only(0xABCDEF, {100, 100, 5, 5}));
  EXPECT_TRUE(stays_unchanged());
}

TEST_F(X11WindowGrabTest, FollowsIt) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  client.move(window, {300, 250});
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(300, 250));
  EXPECT_TRUE(shows_chat());
}

TEST_F(X11WindowGrabTest, TakesItsNewSize) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  settle();
  client.resize(window, {400, 300});
  client.fill(window, {399, 299, 1, 1}, 0xABCDEF);
  ASSERT_TRUE(grab_until([this] { return picture.bgr.cols == 400 && colour_at(399, 299) == 0xABCDEFU; }));
  EXPECT_EQ(picture.bgr.rows, 300);
  EXPECT_EQ(colour_at(300, 200), 0x102030U);
  client.resize(window, {20, 10});
  ASSERT_TRUE(grab_until([this] { return picture.bgr.size() == cv::Size(20, 10); }));
}

TEST_F(X11WindowGrabTest, CutsItToTheMonitor) {
  const auto window = open_chat();
  open({.window = "chat"});
  client.move(window, {-5, -10});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(0, 0));
  EXPECT_EQ(picture.bgr.size(), cv::Size(195, 140));
  EXPECT_TRUE(shows_only(0xFF8001, {5, 10, 30, 40}));

  client.move(window, {700, 550});
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(700, 550));
  EXPECT_EQ(picture.bgr.size(), cv::Size(100, 50)) << "the grid ends at the monitor's bottom";
  settle();
  client.fill(window, {100, 50, 50, 50}, 0x00FF00);
  EXPECT_TRUE(stays_unchanged()) << "drawn where the monitor doesn't show it";
}

TEST_F(X11WindowGrabTest, IsCutToTheRegion) {
  open_chat();
  open({.window = "chat", .region = cv::Rect(110, 70, 30, 400)});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(110, 70));
  EXPECT_EQ(picture.bgr.size(), cv::Size(30, 130));
  EXPECT_TRUE(shows_only(0xFF8001, {0, 0, 30, 40}));
}

TEST_F(X11WindowGrabTest, LeavesItsBorderOut) {
  open_chat({.border_px = 7});
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(200, 150));
  EXPECT_EQ(picture.origin_px, cv::Point(107, 57));
  EXPECT_TRUE(shows_chat());
}

TEST_F(X11WindowGrabTest, IsLostWhileThereIsNone) {
  open({.window = "Chat"});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), AllOf(HasSubstr("No window"), HasSubstr("Chat")));
  const auto window = open_chat();
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_TRUE(shows_chat());

  client.close(window);
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), HasSubstr("was closed"));
  open_chat();
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_TRUE(shows_chat());
}

TEST_F(X11WindowGrabTest, IsLostWhileItIsMinimised) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  client.unmap(window);
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), HasSubstr("minimised"));
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);
  client.map(window);
  client.fill(window, {10, 20, 30, 40}, 0xFF8001);
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_TRUE(shows_chat());
}

TEST_F(X11WindowGrabTest, IsLostWhileTheWindowManagerSaysThatItIsHidden) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  client.set_values(window, "_NET_WM_STATE", XCB_ATOM_ATOM, {client.atom("_NET_WM_STATE_HIDDEN")});
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), HasSubstr("minimised"));
  client.set_values(window, "_NET_WM_STATE", XCB_ATOM_ATOM, {});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  client.set_values(window, "WM_STATE", client.atom("WM_STATE"), {3, 0});
  ASSERT_EQ(news(), GrabOutcome::lost);
  client.set_values(window, "WM_STATE", client.atom("WM_STATE"), {1, 0});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
}

TEST_F(X11WindowGrabTest, IsLostWhileItLiesElsewhere) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  client.move(window, {800, 50});
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), AllOf(HasSubstr("outside of monitor screen"), HasSubstr("move it")));
  client.move(window, {799, 50});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.bgr.size(), cv::Size(1, 150));
}

TEST_F(X11WindowGrabTest, IsLostWhenItsTitleIsAnothersAndBackWhenItIsNot) {
  const auto window = open_chat();
  open({.window = "video"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  client.set_text(window, XCB_ATOM_WM_NAME, "News");
  ASSERT_EQ(news(), GrabOutcome::lost);
  client.set_text(window, XCB_ATOM_WM_NAME, "Video");
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
}

TEST_F(X11WindowGrabTest, IsNotInFrontOfManySmallWindowsTogether) {
  open_chat();
  open({.window = "chat"});
  ASSERT_TRUE(comes_in_front());
  client.open({.place_px = {100, 50, 8, 150}, .title = "first cover"});
  settle();
  EXPECT_EQ(picture.in_front, true);
  client.open({.place_px = {150, 50, 8, 150}, .title = "second cover"});
  EXPECT_TRUE(goes_behind());
}

TEST_F(X11WindowGrabTest, IsInFrontUnlessMoreThanATwentiethIsHidden) {
  const auto window = open_chat();
  open({.window = "chat"});
  ASSERT_TRUE(comes_in_front());
  const auto cover = client.open({.place_px = {100, 50, 10, 150}, .title = "cover"});
  settle();
  EXPECT_EQ(picture.in_front, true) << "just a twentieth";
  client.resize(cover, {11, 150});
  ASSERT_TRUE(goes_behind());
  client.raise(window);
  ASSERT_TRUE(comes_in_front());
  client.raise(cover);
  ASSERT_TRUE(goes_behind());
  client.unmap(cover);
  ASSERT_TRUE(comes_in_front());
}

TEST_F(X11WindowGrabTest, CountsOnlyThePartThatTheMonitorShows) {
  const auto window = open_chat();
  client.move(window, {700, 550});  // 100x50 px of it are shown
  open({.window = "chat"});
  ASSERT_TRUE(comes_in_front());
  client.open({.place_px = {700, 550, 20, 50}, .title = "cover"});
  ASSERT_TRUE(goes_behind());
}

TEST_F(X11WindowGrabTest, StaysInFrontOfWindowsThatHideNothing) {
  open_chat();
  open({.window = "chat"});
  ASSERT_TRUE(comes_in_front());
  const cv::Rect all(0, 0, 800, 600);
  client.open({.place_px = all, .title = "overlay", .program = "telehug", .override_redirect = true});
  client.open({.place_px = all, .override_redirect = true, .input_only = true});
  client.open({.place_px = all, .title = "withdrawn", .mapped = false});
  const auto glass = client.open({.place_px = all, .title = "glass", .override_redirect = true, .mapped = false});
  client.let_clicks_through(glass);
  client.map(glass);
  settle();
  EXPECT_EQ(picture.in_front, true);
}

// As a window manager does: the window in a frame, and the order of windows in a list.
TEST_F(X11WindowGrabTest, FindsItInAWindowManagersFrame) {
  const auto framed = [this](const cv::Rect& place_px, const std::string& title) {
    const auto frame = client.open({.place_px = place_px, .colour = 0x777777, .title = "", .override_redirect = true});
    const auto window =
        client.open({.place_px = {4, 20, place_px.width - 8, place_px.height - 24}, .title = title, .parent = frame});
    return std::pair(frame, window);
  };
  const auto [chat_frame, chat] = framed({100, 50, 208, 174}, "Chat");
  const auto [mail_frame, mail] = framed({90, 40, 208, 174}, "Mail with Chat in its title");
  client.set_values(client.root(), "_NET_CLIENT_LIST_STACKING", XCB_ATOM_WINDOW, {chat, mail});
  open({.window = "chat"});
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(94, 60)) << "the topmost";

  client.set_text(mail, XCB_ATOM_WM_NAME, "Mail");
  ASSERT_TRUE(grab_until([this] { return picture.origin_px == cv::Point(104, 70); }));
  EXPECT_EQ(picture.bgr.size(), cv::Size(200, 150));
  EXPECT_EQ(picture.in_front, false);
  client.raise(chat_frame);
  client.set_values(client.root(), "_NET_CLIENT_LIST_STACKING", XCB_ATOM_WINDOW, {mail, chat});
  ASSERT_TRUE(comes_in_front());
  client.move(chat_frame, {200, 100});
  ASSERT_EQ(news(), GrabOutcome::changed);
  EXPECT_EQ(picture.origin_px, cv::Point(204, 120));
  client.unmap(chat_frame);
  ASSERT_EQ(news(), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), HasSubstr("minimised"));
  client.map(chat_frame);
  ASSERT_EQ(grabber->grab(picture), GrabOutcome::changed);
}

TEST_F(X11WindowGrabTest, TellsWhatTheWindowShowsThoughTheListOfWindowsIsNonsense) {
  open_chat();
  client.set_values(client.root(), "_NET_CLIENT_LIST_STACKING", XCB_ATOM_WINDOW, {0, 1, 0xFFFFFFFF});
  open({.window = "chat"});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::lost);
  EXPECT_THAT(grabber->last_error(), HasSubstr("No window"));
  client.set_values(client.root(), "_NET_CLIENT_LIST_STACKING", XCB_ATOM_WINDOW, {});
  EXPECT_EQ(grabber->grab(picture), GrabOutcome::changed);
}

}  // namespace
}  // namespace telehug
