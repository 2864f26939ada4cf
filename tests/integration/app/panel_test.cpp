// SPDX-License-Identifier: Apache-2.0
//
// The jacket's own buttons, power line and light, on a simulated chip, with the daemons as they are used.
#include <fcntl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "integration/app/running_pair.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class ThePanel : public testing::Test {
 protected:
  ThePanel() {
    std::filesystem::create_directory(chip_);
    for (const char* line : {"stop", "hug", "power", "led"})
      set(line, "0");
    set("hug", "1");  // open
    pair.passive_settings = {"gpio.chip=simulated:" + chip_.string(),
                             "gpio.stop_button_line=stop",
                             "gpio.stop_button_resume_s=2",
                             "gpio.hug_button_line=hug",
                             "gpio.power_line=power",
                             "gpio.led_line=led"};
  }
  // Within the file that there is: a line that is written anew would be another one.
  void set(const char* line, const char* level) const {
    std::ofstream(chip_ / line, std::ios::in | std::ios::out | std::ios::app).close();
    std::ofstream(chip_ / line, std::ios::in | std::ios::out) << level;
  }
  [[nodiscard]] bool high(const char* line) const { return content_of(chip_ / line).starts_with('1'); }
  [[nodiscard]] bool owned(const char* line) const {
    const int file = open((chip_ / line).c_str(), O_RDONLY | O_CLOEXEC);
    const bool owned = flock(file, LOCK_EX | LOCK_NB) != 0;
    close(file);
    return owned;
  }
  [[nodiscard]] bool stopped(Side side) const {
    const Json answer = pair.status(side);
    return answer.is_object() && answer.at("state") == "stopped";
  }
  [[nodiscard]] std::string stop_button() const {
    const Json answer = pair.status(Side::passive);
    return answer.is_object() ? answer.at("panel").at("stop_button").get<std::string>() : "no answer";
  }
  // Lets go, and waits until that counts.
  [[nodiscard]] bool let_go() const {
    set("stop", "0");
    return eventually([&] { return stop_button() == "released"; });
  }
  // How often the light goes on within 2 s.
  [[nodiscard]] int flashes() const {
    int flashes = 0;
    bool before = high("led");
    const auto end = std::chrono::steady_clock::now() + 2s;
    while (std::chrono::steady_clock::now() < end) {
      const bool now = high("led");
      if (now && !before) ++flashes;
      before = now;
      std::this_thread::sleep_for(5ms);
    }
    return flashes;
  }

  RunningPair pair;
  const std::filesystem::path chip_ = pair.folder / "chip";
};

TEST_F(ThePanel, SilencesTheJacketAtThePressOfItsStopButton) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  std::vector<double> took_ms;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
    const auto ms = pair.ms_to_silence([&] { set("stop", "1"); });
    ASSERT_TRUE(ms) << pair.logs();
    took_ms.push_back(*ms);
    EXPECT_TRUE(pair.complains(Side::passive, "the emergency stop button was pressed")) << pair.logs();
    ASSERT_TRUE(let_go()) << pair.logs();
    ASSERT_EQ(pair.telehug("resume", Side::passive).code, 0);
  }
  std::ranges::sort(took_ms);
  fmt::print("from the press of the stop button to the last pin: {:.1f} to {:.1f} ms\n", took_ms.front(),
             took_ms.back());
  // What a busy PC adds must not fail the test; that it can't be faster than its debouncing shows that it was measured.
  EXPECT_GE(took_ms[2], 9);
  EXPECT_LT(took_ms.front(), 50);
  EXPECT_LT(took_ms.back(), 200);
}

TEST_F(ThePanel, HoldsTheStopWhileTheButtonIsPressedAndKeepsItThereafter) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  set("stop", "1");
  ASSERT_TRUE(eventually([&] { return stopped(Side::passive) && stopped(Side::active) && !pair.felt(); }))
      << pair.logs();
  EXPECT_EQ(stop_button(), "pressed");
  const Outcome refused = pair.telehug("resume", Side::passive);
  EXPECT_EQ(refused.code, to_int(ExitCode::refused)) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("the emergency stop button is pressed"));
  EXPECT_TRUE(stopped(Side::passive));

  const auto changes = pair.pins().size();
  ASSERT_TRUE(let_go()) << pair.logs();
  EXPECT_TRUE(stopped(Side::passive));
  EXPECT_EQ(pair.pins().size(), changes) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", Side::passive).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(ThePanel, KeepsTheStopOfItsButtonOverAKillOfTheDaemon) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  set("stop", "1");
  ASSERT_TRUE(eventually([&] { return stopped(Side::passive) && !pair.felt(); })) << pair.logs();
  ASSERT_TRUE(let_go()) << pair.logs();
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(pair.stop_file(Side::passive)); })) << pair.logs();
  const auto changes = pair.pins().size();
  pair.passive->kill_now();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return stopped(Side::passive) && stop_button() == "released"; })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "the emergency stop button was pressed")) << pair.logs();
  EXPECT_EQ(pair.pins().size(), changes) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", Side::passive).code, 0);
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(ThePanel, ResumesWhenTheButtonIsHeldOnceMore) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  set("stop", "1");
  ASSERT_TRUE(eventually([&] { return stop_button() == "pressed"; })) << pair.logs();
  ASSERT_TRUE(let_go()) << pair.logs();
  set("stop", "1");
  std::this_thread::sleep_for(2100ms);  // how long it is held
  EXPECT_TRUE(stopped(Side::passive)) << pair.logs();
  EXPECT_FALSE(pair.felt());
  ASSERT_TRUE(let_go()) << pair.logs();
  EXPECT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
}

TEST_F(ThePanel, SilencesTheJacketWhenTheStopButtonIsTornOff) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  ASSERT_TRUE(pair.ms_to_silence([&] { std::filesystem::remove(chip_ / "stop"); })) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "the emergency stop button is lost")) << pair.logs();
  EXPECT_EQ(pair.telehug("resume", Side::passive).code, to_int(ExitCode::refused));
  EXPECT_FALSE(high("power"));
}

TEST_F(ThePanel, KeepsTheJacketStillWhenTheButtonIsPressedAtTheStart) {
  set("stop", "1");
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return stopped(Side::passive); })) << pair.logs();
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return stopped(Side::active); })) << pair.logs();
  EXPECT_TRUE(pair.pins().empty()) << pair.logs();
  EXPECT_FALSE(high("power"));
}

TEST_F(ThePanel, SuppliesTheMotorsOnlyWhileSomebodyCanBeFelt) {
  set("power", "1");
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
  EXPECT_TRUE(owned("power"));
  EXPECT_FALSE(high("power"));
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_TRUE(high("power"));
  set("stop", "1");
  EXPECT_TRUE(eventually([&] { return !high("power"); }, 1s)) << pair.logs();
  ASSERT_TRUE(let_go());
  ASSERT_EQ(pair.telehug("resume", Side::passive).code, 0);
  ASSERT_TRUE(eventually([&] { return high("power"); })) << pair.logs();
  pair.active->kill_now();
  EXPECT_TRUE(eventually([&] { return !high("power"); })) << pair.logs();
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return high("power"); })) << pair.logs();
  kill(pair.jacket->pid(), SIGSTOP);
  EXPECT_TRUE(eventually([&] { return !high("power"); })) << pair.logs();
  kill(pair.jacket->pid(), SIGCONT);
  ASSERT_TRUE(eventually([&] { return high("power"); })) << pair.logs();
  EXPECT_EQ(pair.passive->end(), 0) << pair.logs();
  EXPECT_FALSE(high("power"));
  EXPECT_FALSE(owned("power"));
}

TEST_F(ThePanel, LeavesTheSupplyToItsResistorWhenTheDaemonIsKilled) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  ASSERT_TRUE(eventually([&] { return high("power"); })) << pair.logs();
  pair.passive->kill_now();
  EXPECT_FALSE(owned("power"));
}

TEST_F(ThePanel, ShowsHowTheJacketIs) {
  pair.start_jacket();
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return pair.jacket_state() == "armed"; })) << pair.logs();
  EXPECT_NEAR(flashes(), 1, 1) << "waiting";
  pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
  pair.start_active();
  ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
  EXPECT_NEAR(flashes(), 4, 1) << "touched";
  set("stop", "1");
  ASSERT_TRUE(eventually([&] { return stopped(Side::passive); })) << pair.logs();
  EXPECT_NEAR(flashes(), 10, 3) << "stopped";
  EXPECT_EQ(pair.passive->end(), 0);
  EXPECT_FALSE(high("led"));
}

TEST_F(ThePanel, HugsBackForItsHugButton) {
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  const auto hugs = [&] { return pair.counter(Side::passive, "hugs_sent"); };
  // The drive thread feels a touch before housekeeping knows of the peer.
  ASSERT_TRUE(eventually([&] { return pair.status(Side::passive)["peer"].value("connected", false); })) << pair.logs();
  set("hug", "0");
  EXPECT_TRUE(eventually([&] { return hugs() == 1; })) << pair.logs();
  EXPECT_TRUE(eventually([&] {
    const Json active = pair.status(Side::active);
    return active.is_object() && active.contains("last_hug");
  })) << pair.logs();
  set("hug", "1");
}

TEST_F(ThePanel, IsNeededForTheDaemonToStartWhereItHasAStopButton) {
  std::filesystem::remove(chip_ / "stop");
  const Outcome outcome = pair.run(pair.passive_command());
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, HasSubstr("the jacket is not driven without its stop button"));
  EXPECT_THAT(outcome.text, HasSubstr("has no line \"stop\""));
}

TEST_F(ThePanel, KeepsTheDaemonFromStartingWhileAnotherProgramOwnsItsStopButton) {
  const int file = open((chip_ / "stop").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  const Outcome outcome = pair.run(pair.passive_command());
  close(file);
  EXPECT_EQ(outcome.code, to_int(ExitCode::device));
  EXPECT_THAT(outcome.text, HasSubstr("another program owns the line \"stop\""));
}

TEST_F(ThePanel, DoesNotHideThatAnotherDaemonRuns) {
  pair.start_passive();
  ASSERT_TRUE(eventually([&] { return stop_button() == "released"; })) << pair.logs();
  EXPECT_EQ(pair.run(pair.passive_command()).code, to_int(ExitCode::already_running));
  EXPECT_EQ(stop_button(), "released");
}

TEST_F(ThePanel, WorksWithoutItsLight) {
  std::filesystem::remove(chip_ / "led");
  ASSERT_TRUE(pair.start_all()) << pair.logs();
  EXPECT_TRUE(pair.complains(Side::passive, "the status light does not work")) << pair.logs();
}

}  // namespace
}  // namespace telehug
