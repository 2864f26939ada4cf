// SPDX-License-Identifier: Apache-2.0
#include "ctl/report/masker.hpp"

#include <gmock/gmock.h>

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
       {"192.168.1.20", "10.77.0.2:7600", "00:1A:7D:DA:71:13", "dev_00_1A_7D_DA_71_13", "fe80::1:2:3",
        "2001:db8:0:0:0:0:0:1", "0123456789abcdef", "ABCDE-12345-FGHJK-67890-ABCDE-12345-FGHJK-67890",
        "TELEHUG:PAIR:ABCDE12345", "http://127.0.0.1:4012/enter?link=s3cr3t", "/home/mia/x", "mia.meier@example.org",
        "/dev/v4l/by-id/usb-Logitech_1A2B3C-video-index0", "MIIEvQIBADANBgkqhkiG9w0BAQEFAASCBKcwggSjAgEAAoIBAQC7"}) {
    const std::string masked = masker.mask(std::string("see ") + secret + " there");
    EXPECT_THAT(masked, HasSubstr("[")) << masked;
    for (const char* part : {"192.168", "10.77", "DA:71", "DA_71", "fe80", "db8", "abcdef", "FGHJK", "E12345", "s3cr3t",
                             "home/mia", "meier", "1A2B3C", "MIIE"})
      EXPECT_THAT(masked, Not(HasSubstr(part)));
  }
}

TEST(Masker, LeavesFiguresTimesAndVersionsAlone) {
  const Masker masker;
  const std::string text = "12:34:56 127.0.0.1 0.0.0.0 6.1.192-2 1280x720 /dev/ttyACM0 0x1234 30.0 2026-11-29T19:20:00";
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

TEST(Masker, CutsLinesThatAreTooLong) {
  const Masker masker;
  EXPECT_THAT(masker.mask(std::string(100'000, 'x')), HasSubstr("[cut]"));
}

}  // namespace
}  // namespace telehug
