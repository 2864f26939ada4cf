// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active record --screen`: the one command that writes pictures of the remote person to disk.
#include <gmock/gmock.h>

#include "doubles/fake_clock.hpp"
#include "integration/app/running_pair.hpp"
#include "screen/recorded_screen_grabber.hpp"
#include "service/exit_code.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RecordScreen : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> command(std::vector<std::string> options) const {
    const std::string program = TELEHUG_BIN "/telehug-active";
    const std::string camera = "replay:" TELEHUG_FIXTURES "/rig2";
    std::vector<std::string> words{program, "record", recording.string(), "--config", "/dev/null", "--source", camera};
    for (const char* key : {"rig.screen_width_mm=380", "rig.screen_height_mm=300", "rig.screen_width_px=1280",
                            "rig.screen_height_px=1024"}) {
      options.insert(options.end(), {"--set", key});
    }
    options.insert(options.end(), {"--set", "rig.calibration_file=" + (pair.folder / "none.toml").string()});
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }

  RunningPair pair;
  std::filesystem::path recording = pair.folder / "recording";
  std::string picture = "body_map.picture=" TELEHUG_FIXTURES "/chat/01_full.jpg";
};

TEST_F(RecordScreen, SaysThatItWritesThePersonAndWritesWhatCanBeReplayed) {
  const Outcome outcome = pair.run(command({"--screen", "--set", picture}));
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok)) << outcome.text;
  EXPECT_THAT(outcome.text,
              AllOf(HasSubstr("the person in it, are written to " + (recording / "screen").string()),
                    HasSubstr("only you can read them"), HasSubstr("1 pictures of the screen\n14 pictures")));
  EXPECT_TRUE(std::filesystem::exists(recording / "sequence/00014.jpg"));

  const FakeClock clock;
  RecordedScreenGrabber replay(recording, clock);
  const Status opened = replay.open();
  ASSERT_TRUE(opened) << opened.error().message;
  ScreenPicture seen;
  EXPECT_EQ(replay.grab(seen), GrabOutcome::changed);
  EXPECT_EQ(seen.monitor.width_px, 1280);
}

TEST_F(RecordScreen, WritesNothingOfTheScreenUnlessItIsAskedTo) {
  const Outcome outcome = pair.run(command({"--set", picture}));
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok)) << outcome.text;
  EXPECT_THAT(outcome.text, Not(HasSubstr("person")));
  EXPECT_FALSE(std::filesystem::exists(recording / "screen"));
  EXPECT_FALSE(std::filesystem::exists(recording / "screen_times.csv"));
}

TEST_F(RecordScreen, CanBeRepeatedOnceTheScreenIsThere) {
  const std::string missing = (pair.folder / "chat.jpg").string();
  const auto words = command({"--screen", "--set", "body_map.picture=" + missing});
  const Outcome refused = pair.run(words);
  EXPECT_EQ(refused.code, to_int(ExitCode::device));
  EXPECT_THAT(refused.text, HasSubstr(missing));
  std::filesystem::copy_file(TELEHUG_FIXTURES "/chat/01_full.jpg", missing);
  const Outcome outcome = pair.run(words);
  EXPECT_EQ(outcome.code, to_int(ExitCode::ok)) << outcome.text;
}

TEST_F(RecordScreen, AsksWhichScreenIsMeant) {
  const Outcome outcome = pair.run(command({"--screen"}));
  EXPECT_EQ(outcome.code, to_int(ExitCode::config));
  EXPECT_THAT(outcome.text, HasSubstr("body_map.picture"));
}

TEST_F(RecordScreen, RefusesTheScreenOfAVirtualRig) {
  auto words = command({"--screen", "--set", picture});
  words[6] = "virtual";
  const Outcome outcome = pair.run(words);
  EXPECT_EQ(outcome.code, to_int(ExitCode::config));
  EXPECT_THAT(outcome.text, HasSubstr("leave out --screen"));
  EXPECT_FALSE(std::filesystem::exists(recording));
}

}  // namespace
}  // namespace telehug
