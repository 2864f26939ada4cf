// SPDX-License-Identifier: Apache-2.0
#include "gpio/panel.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "doubles/fake_clock.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr JacketSituation ready{.armed = true, .stopped = false, .sender = true, .touched = false, .problem = false};

// A panel on a simulated chip, served by hand at the times of a fake clock.
class APanel : public testing::Test {
 protected:
  APanel() {
    for (const char* line : {"stop", "hug", "power", "led"})
      set(line, false);
    options_.chip = "simulated:" + folder_.path().string();
    options_.stop_button.line = "stop";
    options_.hug_button.line = "hug";
    options_.power.line = "power";
    options_.light.line = "led";
  }
  void set(const char* line, bool high) const { std::ofstream(folder_ / line) << (high ? "1\n" : "0\n"); }
  [[nodiscard]] bool high(const char* line) const {
    std::string level;
    std::ifstream(folder_ / line) >> level;
    return level == "1";
  }
  void lose(const char* line) const { std::filesystem::remove(folder_ / line); }

  void open() {
    auto lines = request_lines(options_);
    ASSERT_TRUE(lines) << lines.error().message;
    panel_.emplace(*std::move(lines), options_,
                   PanelCalls{.hold =
                                  [this](const std::string& reason, const std::string& obstacle) {
                                    stopped_ = true;
                                    obstacle_ = obstacle;
                                    calls_.push_back("hold: " + reason);
                                  },
                              .release =
                                  [this] {
                                    obstacle_.clear();
                                    calls_.emplace_back("release");
                                  },
                              .resume =
                                  [this] {
                                    stopped_ = false;
                                    calls_.emplace_back("resume");
                                  },
                              .stopped = [this] { return stopped_; },
                              .hug = [this] { calls_.emplace_back("hug"); }},
                   clock_);
  }
  // The daemon tells how the jacket is, while this passes.
  void pass(Duration time, const std::optional<JacketSituation>& situation = ready) {
    for (const Timestamp end = clock_.now() + time; clock_.now() < end;) {
      clock_.advance(1ms);
      if (situation) panel_->tell(*situation, clock_.now());
      panel_->serve(clock_.now());
    }
  }

  TemporaryFolder folder_;
  FakeClock clock_;
  PanelOptions options_;
  std::optional<Panel> panel_;
  bool stopped_ = false;
  std::string obstacle_;
  std::vector<std::string> calls_;
};

TEST_F(APanel, StopsForItsButtonAndHoldsThatWhileItIsPressed) {
  open();
  pass(100ms);
  EXPECT_THAT(calls_, IsEmpty());
  set("stop", true);
  pass(30ms);
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button was pressed"));
  EXPECT_THAT(obstacle_, HasSubstr("let go of it"));
  EXPECT_TRUE(panel_->status().stop_pressed);
  set("stop", false);
  pass(30ms);
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button was pressed", "release"));
  EXPECT_TRUE(stopped_);
  EXPECT_FALSE(panel_->status().stop_pressed);
}

TEST_F(APanel, ResumesForItsButton) {
  open();
  stopped_ = true;
  pass(100ms);
  set("stop", true);
  pass(5100ms);
  set("stop", false);
  pass(100ms);
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button was pressed", "release", "resume"));
}

TEST_F(APanel, HasStoppedBeforeAnythingElseIfItsButtonIsPressedAtTheStart) {
  set("stop", true);
  open();
  panel_->serve(clock_.now());
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button was pressed"));
}

TEST_F(APanel, StopsForGoodWhenItsStopButtonIsLost) {
  open();
  pass(100ms);
  ASSERT_TRUE(high("power"));
  lose("stop");
  pass(2ms);
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button is lost"));
  EXPECT_FALSE(high("power"));
  stopped_ = false;  // whatever others do
  pass(1s);
  EXPECT_FALSE(high("power"));
  EXPECT_THAT(calls_, ElementsAre("hold: the emergency stop button is lost")) << "it lets nobody resume";
  EXPECT_THAT(panel_->status().problems, Contains(HasSubstr("the line \"stop\" is lost")));
}

TEST_F(APanel, HugsOnceForEachPressOfItsButton) {
  options_.hug_button.active_low = true;
  set("hug", true);
  open();
  pass(100ms);
  for (int press = 0; press < 2; ++press) {
    set("hug", false);
    pass(100ms);
    set("hug", true);
    pass(100ms);
  }
  EXPECT_THAT(calls_, ElementsAre("hug", "hug"));
}

TEST_F(APanel, DoesNotHugForAButtonThatIsPressedAtTheStart) {
  set("hug", true);
  open();
  pass(100ms);
  EXPECT_THAT(calls_, IsEmpty());
}

TEST_F(APanel, SuppliesTheMotorsWhileSomebodyCanBeFelt) {
  open();
  EXPECT_FALSE(high("power"));
  JacketSituation alone = ready;
  alone.sender = false;
  pass(100ms, alone);
  EXPECT_FALSE(high("power"));
  pass(1ms);
  EXPECT_TRUE(high("power"));
  EXPECT_TRUE(panel_->status().power);
  pass(1ms, alone);
  EXPECT_FALSE(high("power"));
}

TEST_F(APanel, CutsTheSupplyWithAStopWithoutWaitingForTheDriveThread) {
  open();
  pass(100ms);
  stopped_ = true;
  pass(1ms);
  EXPECT_FALSE(high("power"));
}

TEST_F(APanel, CutsTheSupplyInTheRoundInWhichItsButtonStops) {
  open();
  pass(100ms);
  set("stop", true);
  while (calls_.empty())
    pass(1ms);
  EXPECT_FALSE(high("power"));
}

TEST_F(APanel, CutsTheSupplyWhenTheDriveThreadHangs) {
  open();
  pass(100ms);
  pass(Panel::oldest_situation - 1ms, std::nullopt);
  EXPECT_TRUE(high("power"));
  pass(1ms, std::nullopt);
  EXPECT_FALSE(high("power"));
}

TEST_F(APanel, CutsTheSupplyWhenItEnds) {
  open();
  pass(100ms);
  ASSERT_TRUE(high("power"));
  panel_->stop();
  EXPECT_FALSE(high("power"));
  EXPECT_FALSE(high("led"));
}

TEST_F(APanel, StopsWhenItsPowerLineIsLost) {
  open();
  pass(100ms);
  lose("power");
  JacketSituation alone = ready;
  alone.sender = false;
  pass(1ms, alone);
  EXPECT_THAT(calls_, ElementsAre("hold: the power line is lost"));
  EXPECT_THAT(panel_->status().problems, Contains(HasSubstr("the line \"power\" is lost")));
}

TEST_F(APanel, HoldsAStopForALostPowerLineWhateverItsButtonDoes) {
  open();
  pass(100ms);
  lose("power");
  pass(1ms, JacketSituation{});
  set("stop", true);
  pass(100ms);
  set("stop", false);
  pass(100ms);
  EXPECT_FALSE(obstacle_.empty());
}

TEST_F(APanel, GoesOnWithoutItsLightAndItsHugButton) {
  open();
  pass(100ms);
  lose("led");
  lose("hug");
  pass(1s);
  JacketSituation stopped = ready;
  stopped.stopped = true;
  pass(1s, stopped);
  EXPECT_THAT(calls_, IsEmpty());
  EXPECT_THAT(panel_->status().problems,
              ElementsAre(HasSubstr("the hug button does not work"), HasSubstr("the status light does not work")));
}

TEST_F(APanel, ShowsHowTheJacketIs) {
  open();
  pass(1ms);
  for (int ms = 0; ms < 2000; ++ms) {
    pass(1ms);
    EXPECT_TRUE(high("led"));
  }
  JacketSituation stopped = ready;
  stopped.stopped = true;
  int changes = 0;
  bool before = high("led");
  for (int ms = 0; ms < 2000; ++ms) {
    pass(1ms, stopped);
    if (high("led") != before) ++changes;
    before = high("led");
  }
  EXPECT_NEAR(changes, 20, 1);
}

TEST_F(APanel, NeedsNoLines) {
  options_ = {};
  open();
  pass(1s);
  EXPECT_THAT(calls_, IsEmpty());
  EXPECT_THAT(panel_->status().problems, IsEmpty());
}

TEST_F(APanel, IsNotOpenedWithoutTheStopButtonThatIsWanted) {
  lose("stop");
  const auto lines = request_lines(options_);
  ASSERT_FALSE(lines);
  EXPECT_THAT(lines.error().message, HasSubstr("the jacket is not driven without its stop button"));
  EXPECT_THAT(lines.error().message, HasSubstr("has no line \"stop\""));
}

TEST_F(APanel, IsNotOpenedWithoutThePowerLineThatIsWanted) {
  lose("power");
  EXPECT_THAT(request_lines(options_).error().message, HasSubstr("not driven without its power line"));
}

TEST_F(APanel, IsNotOpenedWithoutTheChipOfItsStopButton) {
  options_.chip = "simulated:/nowhere";
  EXPECT_THAT(request_lines(options_).error().message, HasSubstr("there is no GPIO chip \"simulated:/nowhere\""));
}

TEST_F(APanel, IsOpenedWithoutWhatItCanDoWithout) {
  lose("hug");
  lose("led");
  open();
  EXPECT_THAT(panel_->status().problems,
              ElementsAre(HasSubstr("the hug button does not work"), HasSubstr("the status light does not work")));
  options_.chip = "simulated:/nowhere";
  options_.stop_button = options_.power = {};
  open();
  EXPECT_THAT(panel_->status().problems, ElementsAre(HasSubstr("the lines of [gpio] do not work")));
}

// With its own thread and the real clock.
TEST_F(APanel, ServesItselfOnceItIsStarted) {
  auto lines = request_lines(options_);
  ASSERT_TRUE(lines);
  std::mutex mutex;
  std::condition_variable held;
  std::optional<Timestamp> when;
  const SteadyClock clock;
  Panel panel(*std::move(lines), options_,
              {.hold =
                   [&](const std::string&, const std::string&) {
                     const std::lock_guard lock(mutex);
                     when = clock.now();
                     held.notify_one();
                   },
               .release = [] {},
               .resume = [] {},
               .stopped = [] { return false; },
               .hug = [] {}},
              clock);
  panel.start();
  const Timestamp pressed = clock.now();
  set("stop", true);
  std::unique_lock lock(mutex);
  ASSERT_TRUE(held.wait_for(lock, 10s, [&] { return when.has_value(); }));
  RecordProperty("ms_from_press_to_stop", std::to_string(to_ms(*when - pressed)));
  EXPECT_GE(*when - pressed, options_.debounce);
}

}  // namespace
}  // namespace telehug
