// SPDX-License-Identifier: Apache-2.0
#include "ctl/report/masker.hpp"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace telehug {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Masker, TakesHiddenTextsOutWhereverTheyStandByThemselves) {
  Masker masker;
  masker.hide("Mia", "name");
  masker.hide("Mia Meier", "name");
  EXPECT_EQ(masker.mask("paired with Mia Meier; Mia's PC, \"Mia\", not Miami"),
            "paired with [name]; [name]'s PC, \"[name]\", not Miami");
}

TEST(Masker, DoesNotHideWhatEveryPcHas) {
  Masker masker;
  masker.hide("root", "user");
  masker.hide("x", "user");
  masker.hide("", "user");
  EXPECT_EQ(masker.mask("root runs x"), "root runs x");
}

TEST(Masker, KnowsSecretsByTheirLooks) {
  const Masker masker;
  for (const char* secret :
       {"192.168.1.20", "10.77.0.2:7600", "00:1A:7D:DA:71:13", "dev_00_1A_7D_DA_71_13", "fe80::1:2:3", "fe80::1%eth0",
        "fd00::1", "fdab::a", "2001:db8::7", "2001:db8:0:0:0:0:0:1", "0123456789abcdef",
        "ABCDE-12345-FGHJK-67890-ABCDE-12345-FGHJK-67890", "TELEHUG:PAIR:ABCDE12345",
        "http://127.0.0.1:4012/enter?link=s3cr3t", "/home/mia/x", "mia.meier@example.org",
        "/dev/v4l/by-id/usb-Logitech_1A2B3C-video-index0", "MIIEvQIBADANBgkqhkiG9w0BAQEFAASCBKcwggSjAgEAAoIBAQC7"}) {
    const std::string masked = masker.mask(std::string("see ") + secret + " there");
    EXPECT_THAT(masked, HasSubstr("[")) << masked;
    for (const char* part : {"192.168", "10.77", "DA:71", "DA_71", "fe80", "fd00", "fdab", "db8", "abcdef", "FGHJK",
                             "E12345", "s3cr3t", "home/mia", "meier", "1A2B3C", "MIIE"})
      EXPECT_THAT(masked, Not(HasSubstr(part)));
  }
}

TEST(Masker, LeavesFiguresTimesAndVersionsAlone) {
  const Masker masker;
  const std::string text =
      "12:34:56 12:30:45.123+00:00 a::b bad::face e2e::run std::bad_alloc dds::a ::1 127.0.0.1 0.0.0.0 6.1.192-2 "
      "1280x720 /dev/ttyACM0 0x1234 30.0 2026-11-29T19:20:00";
  EXPECT_EQ(masker.mask(text), text);
}

TEST(Masker, TakesOutOfFreeTextWhatPeopleWrote) {
  const Masker masker;
  EXPECT_EQ(masker.mask_free_text("the window \"Video chat with Mia\" is not there"),
            "the window \"[text]\" is not there");
  EXPECT_EQ(masker.mask_free_text("stopped: dinner at Mia's\nresumed\n"), "stopped: [text]\nresumed\n");
  EXPECT_EQ(masker.mask_free_text("the pair with Kim Lee is renewed until 2027"),
            "the pair with [name] is renewed until 2027");
  EXPECT_EQ(masker.mask_free_text("info: Kim Lee hugs you"), "info: [name] hugs you");
}

// Their timestamps tell enough, so that neither what begins nor what ends is told.
TEST(Masker, TakesOutWhenTheWearerWantsToBeLeftAlone) {
  const Masker masker;
  EXPECT_EQ(
      masker.mask_free_text("2026-11-29T20:31:00+0000 telehug-passive[7]: quiet hours until 07:00: nothing is felt\n"
                            "2026-11-29T20:31:00+0000 telehug-passive[7]: touches may be felt"),
      "2026-11-29T20:31:00+0000 telehug-passive[7]: [text]\n2026-11-29T20:31:00+0000 telehug-passive[7]: [text]");
  EXPECT_EQ(masker.mask_free_text("12:00:01.123 info    paused until 15:30: nothing is felt"),
            "12:00:01.123 info    [text]");
  EXPECT_EQ(masker.mask_free_text("paused until further notice: nothing is felt"), "[text]");
  EXPECT_EQ(masker.mask_free_text("info: quiet hours: 20:31-07:02"), "info: quiet hours: [text]");
}

TEST(Masker, TakesOutWhatWasTouched) {
  EXPECT_EQ(Masker().mask_free_text("telehug-active[7]: touch 3 begins in box 17, Mia: felt\n"
                                    "telehug-active[7]: touch 3 ends in box 18: sent"),
            "telehug-active[7]: touch 3 begins in box [text]\ntelehug-active[7]: touch 3 ends in box [text]");
}

// Of pairs that are over nothing but the log knows the name.
TEST(Masker, TakesNamesOutOfWhatDaemonsSayOfAPeer) {
  const Masker masker;
  const std::string front = "2026-11-29T12:00:01+0000 telehug-active[7]: ";
  for (const std::string name : {"Mia", "Ann Mary van Lee", "Mia (is home) until 9"}) {
    for (const auto& [said, masked] : std::vector<std::pair<std::string, std::string>>{
             {name + " is connected", "[name] is connected"},
             {name + ": no peer is connected; somebody at 10.0.0.7 tried",
              "[name]: no peer is connected; somebody at [address] tried"},
             {name + " hugs you", "[name] hugs you"},
             {"paired with " + name + " until 2027-11-28; only on this PC",
              "paired with [name] until 2027-11-28; only on this PC"},
             {"the pair with " + name + " (0123456789abcdef) can't be used:",
              "the pair with [name] ([id]) can't be used:"},
             {"the pair with " + name + " (0123456789abcdef) is valid until 2027",
              "the pair with [name] ([id]) is valid until 2027"},
             {"the pair with " + name + " is renewed until 2027; the other PC gets that when it is connected",
              "the pair with [name] is renewed until 2027; the other PC gets that when it is connected"},
             {"the pair with " + name + " was revoked on this PC", "the pair with [name] was revoked on this PC"},
             {"the pair with " + name + " has expired on 2027-01-01: renew it",
              "the pair with [name] has expired on 2027-01-01: renew it"},
             {"the pair with " + name + " ends on 2027-01-01", "the pair with [name] ends on 2027-01-01"},
             {"the pair with " + name + " is in a sentence to come", "the pair with [name]"}}) {
      EXPECT_EQ(masker.mask_free_text(front + said), front + masked);
      EXPECT_EQ(masker.mask_free_text(said), masked);
    }
  }
}

TEST(Masker, LeavesSentencesThatNameNobodyAlone) {
  const Masker masker;
  for (const char* text :
       {"ok    peer          telehug-active: the other PC is connected", "-> look whether the other side is connected",
        "telehug-active[7]: no peer is connected; this PC has no pair, so one on another PC is not heard",
        "telehug-passive[7]: another program is connected with the jacket; close it"})
    EXPECT_EQ(masker.mask_free_text(text), text);
}

TEST(Masker, CutsLinesThatAreTooLong) {
  const Masker masker;
  EXPECT_THAT(masker.mask(std::string(100'000, 'x')), HasSubstr("[cut]"));
}

}  // namespace
}  // namespace telehug
