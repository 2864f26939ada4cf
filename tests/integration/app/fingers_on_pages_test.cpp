// SPDX-License-Identifier: Apache-2.0
//
// A page of the parent's PC that is used with the fingers, beside a wearer whom they would touch.
#include <gmock/gmock.h>

#include "integration/app/entered_pages.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;

// The camera sees this picture from now on.
void show(const RunningPair& pair, const char* picture) {
  std::filesystem::create_symlink(std::string(TELEHUG_FIXTURES "/rig2/") + picture, pair.folder / "next");
  std::filesystem::rename(pair.folder / "next", pair.folder / "held" / "1.jpg");
}

class APageUsedWithTheFingers : public testing::Test {
 protected:
  APageUsedWithTheFingers() { pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2"); }

  void start_active() {
    pair.start_active();
    ASSERT_TRUE(eventually([this] { return pair.status(Side::active).is_object(); })) << pair.logs();
  }
  // What a page is told, up to a frame in which a finger does this.
  static std::string until(RawBrowser& page, const std::string& phase) {
    return page.read_until("\"phase\":\"" + phase + "\"");
  }
  [[nodiscard]] bool frames_pass(int count) const {
    const std::uint64_t end = pair.counter(Side::active, "frames") + static_cast<std::uint64_t>(count);
    return eventually([&] { return pair.counter(Side::active, "frames") >= end; });
  }
  [[nodiscard]] nlohmann::json sending() const { return pair.status(Side::active).at("sending"); }

  RunningPair pair;
};

TEST_F(APageUsedWithTheFingers, IsToldOfThemThoughNobodyIsConnected) {
  start_active();
  EXPECT_FALSE(pair.camera_open());
  const EnteredPages pages(pair, Side::active);
  {
    RawBrowser page = pages.follow("fingers");
    EXPECT_THAT(until(page, "down"), HasSubstr("event: fingers\ndata: {\"frames\":[{\"contacts\":["));
    EXPECT_THAT(until(page, "move"), HasSubstr("\"x_mm\":"));
    EXPECT_TRUE(eventually([this] { return pair.camera_open(); })) << pair.logs();
    EXPECT_EQ(pair.status(Side::active).at("camera").at("why"), "this PC uses the touches");
    const nlohmann::json screen = pair.status(Side::active).at("touch_screen");
    EXPECT_GT(screen.at("width_mm"), 100);
    EXPECT_GT(screen.at("height_mm"), 100);
    EXPECT_GT(screen.at("width_px"), 100);
    EXPECT_GT(screen.at("height_px"), 100);
    EXPECT_FALSE(screen.at("calibrated").get<std::string>().empty());
    EXPECT_GE(screen.at("reach_mm").size(), 8U) << "where the camera sees touches on it";
    for (const auto& corner : screen.at("reach_mm")) {
      EXPECT_GE(corner.at(0), 0);
      EXPECT_LE(corner.at(0), screen.at("width_mm"));
      EXPECT_LE(corner.at(1), screen.at("height_mm"));
    }
    EXPECT_EQ(pair.status(Side::active).at("camera").at("problems"), nlohmann::json::array());
  }
  EXPECT_TRUE(eventually([this] { return !pair.camera_open(); })) << "and nobody looks when it is left";
}

TEST_F(APageUsedWithTheFingers, KeepsThemFromTheWearerUntilItIsLeftAndTheyAreLifted) {
  pair.start_jacket();
  pair.start_passive();
  start_active();
  ASSERT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  const EnteredPages pages(pair, Side::active);
  {
    RawBrowser page = pages.follow("fingers");
    EXPECT_FALSE(until(page, "move").empty());
    ASSERT_TRUE(eventually([this] { return !pair.felt(); })) << "what touched is taken back";
    EXPECT_EQ(sending(), nlohmann::json({{"name", "auto"}, {"on", false}, {"why", "a page uses the fingers"}}));
    show(pair, "background.jpg");
    EXPECT_FALSE(until(page, "up").empty());
    const std::uint64_t before = pair.counter(Side::active, "touches_published");
    show(pair, "sequence/012.jpg");
    EXPECT_FALSE(until(page, "down").empty());
    ASSERT_TRUE(frames_pass(60));
    EXPECT_FALSE(pair.felt());
    EXPECT_EQ(pair.counter(Side::active, "touches_published"), before);
  }
  // The page has died: its connection is gone, nothing was said.
  EXPECT_TRUE(eventually([this] {
    return sending() == nlohmann::json({{"name", "auto"}, {"on", true}});
  })) << pair.logs();
  ASSERT_TRUE(frames_pass(60));
  EXPECT_FALSE(pair.felt()) << "the finger was meant for the page";
  show(pair, "background.jpg");
  ASSERT_TRUE(frames_pass(30));
  show(pair, "sequence/012.jpg");
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
}

TEST_F(APageUsedWithTheFingers, KeepsThemFromTheWearerWhileItSetsUpAndUntilTheyAreLifted) {
  pair.start_jacket();
  pair.start_passive();
  start_active();
  ASSERT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
  const EnteredPages pages(pair, Side::active);
  RawBrowser page = pages.follow("setup");
  ASSERT_EQ(pages.order({{"command", "setup"}, {"order", "start"}}).value("error", ""), "");
  EXPECT_FALSE(page.read_until("\"stage\":\"running\"").empty());
  ASSERT_TRUE(eventually([this] { return !pair.felt(); })) << "what touched is taken back";
  EXPECT_EQ(sending(), nlohmann::json({{"name", "auto"}, {"on", false}, {"why", "a page uses the fingers"}}));
  // It is broken off while the finger lies there.
  const std::uint64_t before = pair.counter(Side::active, "touches_published");
  ASSERT_EQ(pages.order({{"command", "setup"}, {"order", "cancel"}}).value("error", ""), "");
  EXPECT_TRUE(eventually([this] {
    return sending() == nlohmann::json({{"name", "auto"}, {"on", true}});
  })) << pair.logs();
  ASSERT_TRUE(frames_pass(60));
  EXPECT_FALSE(pair.felt()) << "the finger was meant for the set-up";
  EXPECT_EQ(pair.counter(Side::active, "touches_published"), before);
  show(pair, "background.jpg");
  ASSERT_TRUE(frames_pass(30));
  show(pair, "sequence/012.jpg");
  EXPECT_TRUE(eventually([this] { return pair.felt(); })) << pair.logs();
}

TEST_F(APageUsedWithTheFingers, SetsUpOnlyWhileNeitherSideHasStopped) {
  pair.start_passive();
  start_active();
  const EnteredPages pages(pair, Side::active);
  RawBrowser page = pages.follow("setup");
  const auto started = [&] { return pages.order({{"command", "setup"}, {"order", "start"}}).value("error", ""); };
  for (const Side side : {Side::active, Side::passive}) {
    ASSERT_TRUE(eventually([&] { return started().empty(); })) << pair.logs();
    EXPECT_FALSE(page.read_until("\"stage\":\"running\"").empty());
    EXPECT_EQ(pair.telehug("stop", side).code, 0);
    EXPECT_FALSE(page.read_until("\"why\":\"stopped\"").empty()) << pair.logs();
    EXPECT_THAT(started(), testing::HasSubstr("resume first"));
    EXPECT_EQ(pair.telehug("resume", side).code, 0);
  }
}

TEST_F(APageUsedWithTheFingers, HasNoneWhileEverythingIsStopped) {
  start_active();
  const EnteredPages pages(pair, Side::active);
  RawBrowser page = pages.follow("fingers");
  EXPECT_FALSE(until(page, "move").empty());
  EXPECT_EQ(pair.telehug("stop", Side::active).code, 0);
  EXPECT_FALSE(until(page, "up").empty());
  EXPECT_TRUE(eventually([this] { return !pair.camera_open(); })) << pair.logs();
}

}  // namespace
}  // namespace telehug
