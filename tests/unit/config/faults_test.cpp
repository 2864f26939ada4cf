// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "config/load.hpp"
#include "doubles/temporary_folder.hpp"

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

class ConfigFaults : public testing::Test {
 protected:
  std::string active_faults(const std::string& content) {
    ConfigSources sources;
    sources.only_file = folder_.write("c.toml", content);
    const auto config = load_active_config(sources);
    return config ? "" : config.error().message;
  }
  std::string passive_faults(const std::string& content) {
    ConfigSources sources;
    sources.only_file = folder_.write("c.toml", content);
    const auto config = load_passive_config(sources);
    return config ? "" : config.error().message;
  }
  TemporaryFolder folder_;
};

TEST_F(ConfigFaults, AreAllToldAtOnceWithTheirLines) {
  const std::string text = active_faults(
      "[camera]\n"
      "fps = 500\n"
      "width_px = \"wide\"\n"
      "colour = true\n"
      "source = \"tape\"\n"
      "\n"
      "[kitchen]\n"
      "sink = 1\n"
      "[touch]\n"
      "detector = \"best\"\n"
      "[rig]\n"
      "screen_width_mm = 520\n");
  EXPECT_THAT(text, HasSubstr("c.toml:2: camera.fps is 500; it must be within 1 .. 240 frames/s"));
  EXPECT_THAT(text, HasSubstr("c.toml:3: camera.width_px must be a whole number"));
  EXPECT_THAT(text, HasSubstr("c.toml:4: there is no key camera.colour"));
  EXPECT_THAT(text, HasSubstr("c.toml:5: camera.source: \"tape\" is not a camera source"));
  EXPECT_THAT(text, HasSubstr("c.toml:7: there is no section [kitchen]"));
  EXPECT_THAT(text, HasSubstr("c.toml:10: touch.detector is \"best\"; it must be one of default | thesis"));
  EXPECT_THAT(text, HasSubstr("c.toml:12: rig.screen_width_mm and rig.screen_height_mm must both be given"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
}

TEST_F(ConfigFaults, TellOfLinesThatCannotBe) {
  const std::string text = passive_faults(
      "[gpio]\n"
      "chip = \"simulated:\"\n"
      "stop_button_line = \"GPIO 17\"\n"
      "hug_button_line = \"../power\"\n"
      "power_line = \"a_name_that_is_longer_than_31_bytes\"\n"
      "button_pull = \"left\"\n"
      "debounce_ms = 26\n");
  EXPECT_THAT(text, HasSubstr("c.toml:2: gpio.chip: a GPIO chip is its path, name or label"));
  for (const char* line :
       {"c.toml:3: gpio.stop_button_line", "c.toml:4: gpio.hug_button_line", "c.toml:5: gpio.power_line"})
    EXPECT_THAT(text, HasSubstr(std::string(line) + ": a line is its number on the chip or its name"));
  EXPECT_THAT(text, HasSubstr("c.toml:6: gpio.button_pull is \"left\"; it must be one of up | down | none"));
  EXPECT_THAT(text, HasSubstr("c.toml:7: gpio.debounce_ms is 26; it must be within 1 .. 25 ms"));
}

TEST_F(ConfigFaults, TellOfALineWithoutItsChip) {
  EXPECT_THAT(passive_faults("[gpio]\nstop_button_line = \"17\"\n"),
              HasSubstr("c.toml:2: gpio.stop_button_line is given, but gpio.chip is not: name the chip that has it"));
  EXPECT_EQ(passive_faults("[gpio]\nchip = \"gpiochip0\"\nstop_button_line = \"17\"\n"), "");
}

TEST_F(ConfigFaults, TellOfALineThatIsToDoTwoThings) {
  EXPECT_THAT(passive_faults("[gpio]\nchip = \"gpiochip0\"\nstop_button_line = \"17\"\nled_line = \"17\"\n"),
              HasSubstr("gpio.stop_button_line and gpio.led_line are both \"17\": a line does one thing"));
}

TEST_F(ConfigFaults, TellOfAStopButtonThatResumesTooEasily) {
  EXPECT_THAT(passive_faults("[gpio]\nstop_button_resume_s = 1\n"),
              HasSubstr("must be at least 2 s long, or never (0)"));
  EXPECT_EQ(passive_faults("[gpio]\nstop_button_resume_s = 0\n"), "");
}

TEST_F(ConfigFaults, TellOfAPowerLineThatFlickersOtherwiseThanAnyDoes) {
  EXPECT_THAT(active_faults("[camera]\npower_line_hz = 55\n"),
              HasSubstr("c.toml:2: camera.power_line_hz must be 0, 50"));
  EXPECT_EQ(active_faults("[camera]\npower_line_hz = 50\n"), "");
}

TEST_F(ConfigFaults, OfSyntaxDoNotHideTheOthers) {
  const std::string text = active_faults(
      "[camera]\n"
      "fps = = 30\n"
      "width_px = 1280 px\n"
      "height_px = 1\n");
  EXPECT_THAT(text, HasSubstr("c.toml:2: not valid TOML"));
  EXPECT_THAT(text, HasSubstr("c.toml:3: not valid TOML"));
  EXPECT_THAT(text, HasSubstr("c.toml:4: camera.height_px is 1"));
}

TEST_F(ConfigFaults, OfSyntaxInASectionsHeadDoNotPutItsKeysIntoAnother) {
  const std::string text = active_faults("[camera]\nfps = 30\n[touch\ndetector = \"thesis\"\n");
  EXPECT_THAT(text, HasSubstr("c.toml:3: not valid TOML"));
  EXPECT_THAT(text, Not(HasSubstr("camera.detector")));
}

TEST_F(ConfigFaults, IncludeAKeyThatIsGivenTwice) {
  EXPECT_THAT(active_faults("[camera]\nfps = 30\nfps = 60\n"), HasSubstr("c.toml:3: not valid TOML"));
}

TEST_F(ConfigFaults, IncludeASectionThatIsWrittenAsAKey) {
  EXPECT_THAT(active_faults("camera = 5\n"), HasSubstr("c.toml:1: camera is a section"));
}

TEST_F(ConfigFaults, IncludeNumbersThatAreNone) {
  EXPECT_THAT(active_faults("[body_map]\nrate_hz = nan\n"), HasSubstr("c.toml:2: body_map.rate_hz is nan"));
  EXPECT_THAT(active_faults("[camera]\nfps = 9223372036854775807\n"), HasSubstr("c.toml:2: camera.fps is 9.2"));
}

TEST_F(ConfigFaults, IncludeAPartitionThatMatchesOtherPairs) {
  EXPECT_THAT(active_faults("[peer]\npartition = \"*\"\n"), HasSubstr("c.toml:2: peer.partition: a partition has"));
}

TEST_F(ConfigFaults, IncludeAPeersAddressThatIsNone) {
  EXPECT_THAT(active_faults("[peer]\nloopback_only = false\naddresses = \"192.0.2.7,\"\n"),
              HasSubstr("c.toml:3: peer.addresses: \"\" is not an IPv4 address"));
  EXPECT_THAT(active_faults("[peer]\nloopback_only = false\naddresses = \"grandma\"\n"),
              HasSubstr("c.toml:3: peer.addresses: \"grandma\" is not an IPv4 address"));
}

TEST_F(ConfigFaults, IncludeAPeersAddressWhileOnlyLoopbackIsAllowed) {
  EXPECT_THAT(active_faults("[peer]\nloopback_only = true\naddresses = \"192.0.2.7\"\n"),
              HasSubstr("c.toml:3: peer.addresses are of the network"));
}

TEST_F(ConfigFaults, IncludeAPublicAddressThatIsNoneOrHasNoPort) {
  EXPECT_THAT(active_faults("[peer]\npublic_address = \"home\"\npublic_port = 7600\n"),
              HasSubstr("c.toml:2: peer.public_address: \"home\" is not an IPv4 address"));
  EXPECT_THAT(active_faults("[peer]\npublic_address = \"198.51.100.7\"\n"),
              HasSubstr("c.toml:2: peer.public_address and peer.public_port belong together"));
  EXPECT_THAT(active_faults("[peer]\npublic_port = 7600\n"),
              HasSubstr("c.toml:2: peer.public_address and peer.public_port belong together"));
  EXPECT_THAT(active_faults("[peer]\npublic_address = \"198.51.100.7\"\npublic_port = 65535\n"),
              HasSubstr("c.toml:3: peer.public_port is 65535; it must be within 0 .. 65534"));
}

TEST_F(ConfigFaults, IncludeAPublicAddressWhileOnlyLoopbackIsAllowed) {
  EXPECT_THAT(active_faults("[peer]\nloopback_only = true\npublic_address = \"198.51.100.7\"\npublic_port = 7600\n"),
              HasSubstr("c.toml:3: peer.public_address is of the network"));
}

// What the configuration lets pass must not be refused later by DDS or by the safety stage.
TEST_F(ConfigFaults, IncludeWhatTheDaemonsWouldRefuse) {
  EXPECT_THAT(active_faults("[peer]\ndomain = 101\n"), HasSubstr("c.toml:2: peer.domain is 101"));
  ConfigSources sources;
  sources.only_file = folder_.write("p.toml", "[safety]\nheartbeat_timeout_ms = 251\n");
  const auto config = load_passive_config(sources);
  ASSERT_FALSE(config);
  EXPECT_THAT(config.error().message, HasSubstr("safety.heartbeat_timeout_ms is 251; it must be within 150 .. 250 ms"));
}

TEST_F(ConfigFaults, IncludeAHeldFaceThatWouldBeRefused) {
  EXPECT_THAT(active_faults("[body_map]\nhold_ms = 4000\n"),
              HasSubstr("c.toml:2: body_map.hold_ms (4000) must not exceed body_map.max_age_ms (3000)"));
}

TEST_F(ConfigFaults, OfFilesAndFlagsComeTogether) {
  ConfigSources sources;
  sources.only_file = folder_.write("p.toml", "[jacket]\nbaud = 12345\nlink = \"serial:\"\n");
  sources.overrides = {"safety.drive_ms=251", "safety.drive_ms", "safety.sofa=1", "peer.loopback_only=maybe"};
  const auto config = load_passive_config(sources);
  ASSERT_FALSE(config);
  const std::string& text = config.error().message;
  EXPECT_THAT(text, HasSubstr("p.toml:2: jacket.baud is 12345"));
  EXPECT_THAT(text, HasSubstr("p.toml:3: jacket.link: \"serial:\" is not a jacket link"));
  EXPECT_THAT(text, HasSubstr("--set safety.drive_ms=251: safety.drive_ms is 251; it must be within 50 .. 250 ms"));
  EXPECT_THAT(text, HasSubstr("--set safety.drive_ms: must have the form SECTION.KEY=VALUE"));
  EXPECT_THAT(text, HasSubstr("--set safety.sofa=1: there is no key safety.sofa"));
  EXPECT_THAT(text, HasSubstr("--set peer.loopback_only=maybe: peer.loopback_only must be true or false"));
}

TEST_F(ConfigFaults, IncludeAFileThatIsMissingOrAFolder) {
  ConfigSources sources;
  sources.only_file = folder_.path() / "nowhere.toml";
  const auto missing = load_active_config(sources);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("nowhere.toml: can't be read: No such file"));

  sources.only_file = folder_.path();
  const auto folder = load_active_config(sources);
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("can't be read: Is a directory"));
}

TEST_F(ConfigFaults, IncludeAFileThatIsMuchTooLarge) {
  EXPECT_THAT(active_faults(std::string(2 << 20, '#')), HasSubstr("larger than 1 MiB"));
}

}  // namespace
}  // namespace telehug
