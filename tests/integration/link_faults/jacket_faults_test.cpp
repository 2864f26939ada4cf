// SPDX-License-Identifier: Apache-2.0
//
// What can happen to the wire, the microcontroller and the daemon while a finger rests on the picture: real daemons,
// the real firmware, and a pseudo terminal between them that fails on command. The same in virtual time, to the cycle:
// test_firmware. Prints a table; limits are those of the issue's, twice, on a PC that may be busy.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <random>

#include "doubles/wire_between.hpp"
#include "integration/app/running_pair.hpp"
#include "integration/link_faults/fault_table.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "wire/serial_port.hpp"

namespace telehug {
namespace {

using Way = WireBetween::Way;

constexpr double longest_off_ms = 600;
constexpr double longest_back_s = 6;

class JacketFaults : public testing::Test {
 protected:
  static void SetUpTestSuite() { rows.clear(); }
  static void TearDownTestSuite() {
    if (!rows.empty()) fmt::print("\n{}\n", table_text(rows));
  }
  void SetUp() override {
    pair.start_jacket();
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(pair.folder / "jacket"); }));
    wire = std::make_unique<WireBetween>(pair.folder / "wire", pair.folder / "jacket");
    pair.jacket_link = "serial:" + (pair.folder / "wire").string();
    pair.start_passive();
    pair.calibrate("replay:" TELEHUG_FIXTURES "/rig2");
    pair.start_active();
    ASSERT_TRUE(eventually([&] { return pair.felt(); })) << pair.logs();
    channels = pair.running();
  }

  // Does this to the chain while the finger is felt, mends it after `lasts`, and waits for the return.
  void suffer(const char* fault, Duration lasts, const std::function<void()>& blow, const std::function<void()>& mend,
              double off_ms = longest_off_ms) {
    const Timestamp blown = SteadyClock().now();
    blow();
    std::this_thread::sleep_for(lasts);
    const Timestamp mended = SteadyClock().now();
    FaultRow row{fault};
    const auto silent = FeltTimes(pair.pins()).silent_since(mended);
    ASSERT_TRUE(silent) << fault << ": a motor ran on" << pair.logs();
    row.off_after_ms = std::max(0.0, to_ms(*silent - blown));
    mend();
    ASSERT_TRUE(eventually([&] { return FeltTimes(pair.pins()).felt_from(mended).has_value(); }))
        << fault << ": not felt again" << pair.logs();
    row.back_after_s = to_ms(*FeltTimes(pair.pins()).felt_from(mended) - mended) / 1000;
    rows.push_back(row);
    EXPECT_LE(*row.off_after_ms, off_ms) << fault << pair.logs();
    EXPECT_LE(*row.back_after_s, longest_back_s) << fault << pair.logs();
    expect_no_other_motor();
  }

  // The finger goes on being felt, most of the time.
  void endure(const char* fault, Duration lasts, WireBetween::Pass pass, double least_share) {
    wire->set_pass(std::move(pass));
    const Timestamp from = SteadyClock().now();
    std::this_thread::sleep_for(lasts);
    const Timestamp to = SteadyClock().now();
    wire->set_pass(WireBetween::unchanged);
    const FeltTimes felt(pair.pins());
    FaultRow row{fault};
    row.felt_percent = 100 * felt.share(from, to);
    row.longest_gap_ms = to_ms(felt.longest_gap(from, to));
    ASSERT_TRUE(eventually([&] { return FeltTimes(pair.pins()).felt_from(to).has_value(); })) << pair.logs();
    row.back_after_s = to_ms(*FeltTimes(pair.pins()).felt_from(to) - to) / 1000;
    rows.push_back(row);
    EXPECT_GE(*row.felt_percent, least_share) << fault << pair.logs();
    EXPECT_LE(*row.back_after_s, longest_back_s) << fault;
    expect_no_other_motor();
  }

  void expect_no_other_motor() const {
    for (const PinChange& change : pair.pins())
      EXPECT_TRUE(channels.contains(change.channel)) << "channel " << change.channel << pair.logs();
  }

  inline static std::vector<FaultRow> rows;
  RunningPair pair;
  std::unique_ptr<WireBetween> wire;
  std::set<int> channels;  // of the box under the finger
};

TEST_F(JacketFaults, APlugPulledInTheMiddleOfAFrameAndPutInUnderAnotherName) {
  suffer(
      "unplugged in the middle of a frame, back under another name", 1s,
      [&] {
        std::atomic<bool> cut = false;
        wire->set_pass([&cut](Way way, std::span<const std::uint8_t> bytes, Timestamp) {
          if (way == Way::to_daemon || bytes.size() < 4 || cut) return std::vector<std::uint8_t>{};
          cut = true;
          return std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + 3);
        });
        ASSERT_TRUE(eventually([&] { return cut.load(); }));
        wire->unplug();
        wire->set_pass(WireBetween::unchanged);
      },
      [&] { wire->plug_in(); });
}

TEST_F(JacketFaults, NothingArrivesAtTheJacket) {
  suffer(
      "the jacket hears nothing for 2 s (keepalive lost)", 2s,
      [&] {
        wire->set_pass([](Way way, std::span<const std::uint8_t> bytes, Timestamp time) {
          return way == Way::to_jacket ? std::vector<std::uint8_t>{} : WireBetween::unchanged(way, bytes, time);
        });
      },
      [&] { wire->set_pass(WireBetween::unchanged); });
}

// The jacket still hears a daemon that lives, whose sender lives: it obeys until the daemon has missed its answers for
// a second (JacketSession::silence_max).
TEST_F(JacketFaults, NothingArrivesAtTheDaemon) {
  suffer(
      "the daemon hears nothing for 3 s", 3s,
      [&] {
        wire->set_pass([](Way way, std::span<const std::uint8_t> bytes, Timestamp time) {
          return way == Way::to_daemon ? std::vector<std::uint8_t>{} : WireBetween::unchanged(way, bytes, time);
        });
      },
      [&] { wire->set_pass(WireBetween::unchanged); }, 1000 + longest_off_ms);
}

TEST_F(JacketFaults, AByteInAHundredIsWrongBothWays) {
  auto random = std::make_shared<std::mt19937>(7);
  const auto garble = [random](Way, std::span<const std::uint8_t> bytes, Timestamp) {
    std::vector<std::uint8_t> passed(bytes.begin(), bytes.end());
    for (std::uint8_t& byte : passed)
      if ((*random)() % 100 == 0) byte ^= static_cast<std::uint8_t>(1U << ((*random)() % 8));
    return passed;
  };
  const bool long_run = getenv("TELEHUG_LONG_TESTS") != nullptr;
  endure(long_run ? "1 % of all bytes wrong, both ways, 60 s" : "1 % of all bytes wrong, both ways, 10 s",
         long_run ? Duration(60s) : Duration(10s), garble, 90);
}

TEST_F(JacketFaults, PiecesComeTwiceAreLostAndOvertakeEachOther) {
  auto random = std::make_shared<std::mt19937>(8);
  auto held = std::make_shared<std::vector<std::uint8_t>>();
  endure(
      "pieces doubled, lost and overtaking, both ways, 10 s", 10s,
      [random, held](Way way, std::span<const std::uint8_t> bytes, Timestamp time) {
        auto passed = WireBetween::unchanged(way, bytes, time);
        if (way == Way::to_daemon) return passed;
        switch ((*random)() % 10) {
          case 0:
            passed.insert(passed.end(), bytes.begin(), bytes.end());
            break;
          case 1:
            passed.clear();
            break;
          case 2:
            std::swap(*held, passed);
            break;
          default:
            passed.insert(passed.end(), held->begin(), held->end());
            held->clear();
            break;
        }
        return passed;
      },
      90);
}

TEST_F(JacketFaults, TheDaemonIsKilled) {
  suffer(
      "SIGKILL of telehug-passive", 1s, [&] { pair.passive->kill_now(); }, [&] { pair.start_passive(); });
}

TEST_F(JacketFaults, TheDaemonIsStopped) {
  const bool long_run = getenv("TELEHUG_LONG_TESTS") != nullptr;
  suffer(
      long_run ? "SIGSTOP of telehug-passive for 10 s" : "SIGSTOP of telehug-passive for 2 s",
      long_run ? Duration(10s) : Duration(2s), [&] { kill(pair.passive->pid(), SIGSTOP); },
      [&] { kill(pair.passive->pid(), SIGCONT); });
}

TEST_F(JacketFaults, TheJacketIsPoweredOffAndOn) {
  suffer(
      "the jacket's power is cut for 1 s", 1s,
      [&] {
        pair.jacket.reset();
        wire.reset();
      },
      [&] {
        // Its log begins anew.
        pair.start_jacket();
        ASSERT_TRUE(eventually([&] { return std::filesystem::exists(pair.folder / "jacket"); }));
        wire = std::make_unique<WireBetween>(pair.folder / "wire", pair.folder / "jacket");
      });
}

TEST_F(JacketFaults, AnotherProgramOpensThePortAndIsTold) {
  SerialOpener opener(pair.folder / "wire", default_baud);
  const auto other = opener.open(SteadyClock().now());
  ASSERT_TRUE(other && !*other);
  EXPECT_NE(other->error().message.find("close the program that uses it"), std::string::npos) << other->error().message;
  EXPECT_TRUE(pair.felt());
}

}  // namespace
}  // namespace telehug
