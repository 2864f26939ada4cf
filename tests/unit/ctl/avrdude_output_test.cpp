// SPDX-License-Identifier: Apache-2.0
//
// The texts are what avrdude 7.1 of Debian 12 printed, to the harmless note of a port without a reset line.
#include "ctl/avrdude_output.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using ::testing::HasSubstr;

std::string asked(const std::string& hardware, const std::string& firmware) {
  return R"(
avrdude: Version 7.1
         Copyright the AVRDUDE authors;
         see https://github.com/avrdudes/avrdude/blob/main/AUTHORS

         System wide configuration file is /etc/avrdude.conf
         User configuration file is /root/.avrduderc
         User configuration file does not exist or is not a regular file, skipping

avrdude: setting number of retry attempts to 1
         Using Port                    : /dev/pts/0
         Using Programmer              : arduino
         Overriding Baud Rate          : 115200
avrdude ser_set_dtr_rts() OS error: ioctl("TIOCMGET"): Inappropriate ioctl for device
         AVR Part                      : ATmega328P
         Programmer Type : Arduino
         Description     : Arduino for bootloader using STK500 v1 protocol
         Hardware Version: )" +
         hardware + "\n         Firmware Version: " + firmware + R"(

avrdude: AVR device initialized and ready to accept instructions
avrdude: device signature = 0x1e950f (probably m328p)

avrdude done.  Thank you.

)";
}

constexpr const char* not_in_sync = R"(avrdude OS error: ioctl("TIOCMGET"): Inappropriate ioctl for device
avrdude stk500_recv() error: programmer is not responding
avrdude stk500_getsync() warning: attempt 1 of 1: not in sync: resp=0x00
avrdude main() error: unable to open programmer arduino on port /dev/pts/0

avrdude done.  Thank you.

)";

constexpr const char* written = R"(
avrdude: AVR device initialized and ready to accept instructions
avrdude: device signature = 0x1e950f (probably m328p)
avrdude: reading input file telehug-jacket.hex for flash
         with 2860 bytes in 1 section within [0, 0xb2b]
         using 23 pages and 84 pad bytes
avrdude: writing 2860 bytes flash ...

Writing | ################################################## | 100% 0.44s

avrdude: 2860 bytes of flash written
avrdude: verifying flash memory against telehug-jacket.hex

Reading | ################################################## | 100% 0.54s

)";

TEST(AvrdudeOutput, NamesTheBootloader) {
  const auto optiboot = bootloader_in(asked("3", "4.4"));
  ASSERT_TRUE(optiboot);
  EXPECT_EQ(optiboot->hardware, 3);
  EXPECT_EQ(optiboot->major, 4);
  EXPECT_EQ(optiboot->minor, 4);
  const auto stock = bootloader_in(asked("2", "1.16"));
  ASSERT_TRUE(stock);
  EXPECT_EQ(stock->hardware, 2);
  EXPECT_EQ(stock->major, 1);
  EXPECT_EQ(stock->minor, 16);
}

TEST(AvrdudeOutput, NamesNoBootloaderIfNoneAnsweredOrItsVersionIsUnreadable) {
  EXPECT_FALSE(bootloader_in(""));
  EXPECT_FALSE(bootloader_in(not_in_sync));
  EXPECT_FALSE(bootloader_in(asked("", "4.4")));
  EXPECT_FALSE(bootloader_in(asked("3", "4")));
  EXPECT_FALSE(bootloader_in(asked("3", "4.")));
  EXPECT_FALSE(bootloader_in(asked("3", ".4")));
  EXPECT_FALSE(bootloader_in(asked("3", "-4.4")));
  EXPECT_FALSE(bootloader_in(asked("3", "99999999999.4")));
}

TEST(AvrdudeOutput, TakesOptibootSinceVersion4AloneForGood) {
  for (const BootloaderVersion good : {BootloaderVersion{3, 4, 4}, {3, 5, 0}, {3, 8, 3}})
    EXPECT_TRUE(is_good_optiboot(good)) << good.major << '.' << good.minor;
  for (const BootloaderVersion bad :
       {BootloaderVersion{2, 1, 16}, {2, 1, 18}, {3, 3, 3}, {2, 4, 4}, {0, 0, 0}, {15, 2, 10}})
    EXPECT_FALSE(is_good_optiboot(bad)) << bad.major << '.' << bad.minor;
}

TEST(AvrdudeOutput, TellsTheFuses) {
  const auto fuses = fuses_in("0xff\n0xda\n0x5\n");
  ASSERT_TRUE(fuses);
  EXPECT_EQ(fuses->low, 0xFF);
  EXPECT_EQ(fuses->high, 0xDA);
  EXPECT_EQ(fuses->extended, 0x05);
  EXPECT_TRUE(
      fuses_in("\navrdude: device signature = 0x1e950f\n0xff\navrdude: reading hfuse memory ...\n0xda\n0xfd\n"));
}

TEST(AvrdudeOutput, TellsNoFusesUnlessThereAreThree) {
  for (const char* text : {"", "0xff\n0xda\n", "0xff\n0xda\n0xfd\n0xfd\n", "0xff\n0xda\n0x\n", "0xff\n0xda\n0xfdd\n",
                           "0xff\n0xda\n0xfg\n", "0xff\n0xda\nfd\n", "0xff\n0xda\n0x-1\n"})
    EXPECT_FALSE(fuses_in(text)) << text;
}

TEST(AvrdudeOutput, CountsBytesOnlyWhenTheyAreCompared) {
  EXPECT_EQ(verified_bytes_in(std::string(written) + "avrdude: 2860 bytes of flash verified\n\navrdude done.\n"), 2860);
  EXPECT_FALSE(verified_bytes_in(written));
  EXPECT_FALSE(verified_bytes_in("avrdude: 1 byte of hfuse verified\n"));
}

struct Failing {
  std::string output;
  std::string line;
  std::string advice;
};

TEST(AvrdudeOutput, TellsTheLineThatMattersAndWhatToDo) {
  const std::vector<Failing> cases{
      {not_in_sync, "attempt 1 of 1: not in sync", "Bluetooth module"},
      {R"(avrdude: device signature = 0x1e9406 (probably m168)
avrdude error: expected signature for ATmega328P is 1E 95 0F
        double check chip or use -F to override this check
)",
       "avrdude error: expected signature for ATmega328P is 1E 95 0F", "no other chip"},
      {std::string(written) + R"(avrdude warning: verification mismatch
        device 0xff != input 0x0c at addr 0x0000 (error)
avrdude error: verification mismatch
)",
       "verification mismatch", "worn out"},
      {R"(avrdude OS error: cannot open port /dev/ttyNONE: No such file or directory
avrdude error: unable to open programmer arduino on port /dev/ttyNONE
)",
       "cannot open port /dev/ttyNONE", "plug the board in"},
      {R"(avrdude OS error: cannot open port /dev/ttyUSB0: Permission denied
avrdude error: unable to open programmer arduino on port /dev/ttyUSB0
)",
       "Permission denied", "dialout"},
      {R"(avrdude error: cannot find USB device with vid=0x16c0 pid=0x5dc vendor='www.fischl.de' product='USBasp'
avrdude error: unable to open programmer usbasp on port usb
)",
       "cannot find USB device", "udev"},
      {"avrdude error: unable to open programmer avrispmkII on port usb\n", "avrispmkII", "plug the programmer in"},
      {"\navrdude error: cannot find programmer id nonsense\n\nValid programmers are:\n", "nonsense", "lists"},
      {"avrdude error: initialization failed, rc=-1\n        - double check the connections and try again\n",
       "initialization failed", "power"},
      {"avrdude: writing\navrdude error: something new\n", "something new", "manual"},
      {"something without the word\n", "something without the word", "manual"},
      {"", "says nothing", "-v"},
  };
  for (const Failing& failing : cases) {
    const AvrdudeFailure failure = failure_in(failing.output);
    EXPECT_THAT(failure.line, HasSubstr(failing.line));
    EXPECT_THAT(failure.advice, HasSubstr(failing.advice)) << failing.output;
  }
}

TEST(AvrdudeOutput, IsToldWithoutControlCharacters) {
  EXPECT_EQ(failure_in("avrdude error: \x1B[2Jbad").line, "avrdude error: ?[2Jbad");
}

}  // namespace
}  // namespace telehug
