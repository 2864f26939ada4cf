// SPDX-License-Identifier: Apache-2.0
#include "ctl/fuses.hpp"

#include <gmock/gmock.h>

namespace telehug {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr Fuses right{0xFF, 0xDB, 0xFC};

TEST(Fuses, AreRightWithCrystalBrownOutAt43AndNoBootloader) {
  EXPECT_THAT(faults_of(right), IsEmpty());
  EXPECT_THAT(mending_of(right), IsEmpty());
  EXPECT_THAT(faults_of({0xF7, 0xD9, 0xFC}), IsEmpty()) << "a full swing crystal, another size of the boot section";
}

TEST(Fuses, MayHaveAnythingInTheBitsThatDoNotExist) {
  for (const std::uint8_t extended : std::initializer_list<std::uint8_t>{0x04, 0xFC, 0xF4})
    EXPECT_THAT(faults_of({0xFF, 0xDB, extended}), IsEmpty());
}

// As a Duemilanove and an Uno leave the factory.
TEST(Fuses, OfTheFactoryStartInTheBootloaderAndBrownOutTooLow) {
  EXPECT_THAT(faults_of({0xFF, 0xDA, 0xFD}), ElementsAre(HasSubstr("BOOTRST"), HasSubstr("brown-out")));
  EXPECT_THAT(mending_of({0xFF, 0xDA, 0xFD}), ElementsAre("-U", "hfuse:w:0xDB:m", "-U", "efuse:w:0xFC:m"));
  EXPECT_THAT(mending_of({0xFF, 0xDE, 0x05}), ElementsAre("-U", "hfuse:w:0xDF:m", "-U", "efuse:w:0xFC:m"));
}

// As a bare chip leaves the factory: 8 MHz from inside, divided by 8, no brown-out.
TEST(Fuses, OfABareChipHaveTheWrongClock) {
  EXPECT_THAT(faults_of({0x62, 0xD9, 0xFF}),
              ElementsAre(HasSubstr("CKDIV8"), HasSubstr("brown-out"), HasSubstr("CKSEL")));
  EXPECT_THAT(mending_of({0x62, 0xD9, 0xFF}), ElementsAre("-U", "lfuse:w:0xFF:m", "-U", "efuse:w:0xFC:m"));
}

TEST(Fuses, HaveTheirFaultsToldEachAlone) {
  EXPECT_THAT(faults_of({0x7F, 0xDB, 0xFC}), ElementsAre(HasSubstr("CKDIV8")));
  EXPECT_THAT(faults_of({0xBF, 0xDB, 0xFC}), ElementsAre(HasSubstr("CKOUT")));
  EXPECT_THAT(faults_of({0xFF, 0xCB, 0xFC}), ElementsAre(HasSubstr("WDTON")));
  EXPECT_THAT(faults_of({0xFF, 0xDA, 0xFC}), ElementsAre(HasSubstr("BOOTRST")));
  EXPECT_THAT(faults_of({0xFF, 0xDB, 0xFF}), ElementsAre(HasSubstr("BODLEVEL")));
}

TEST(Fuses, WithEveryOtherClockThanACrystalOf16MhzAreWrong) {
  for (unsigned cksel = 0; cksel < 16; ++cksel) {
    const bool crystal = cksel == 0xE || cksel == 0xF || cksel == 0x6 || cksel == 0x7;
    const auto low = static_cast<std::uint8_t>(0xF0U | cksel);
    EXPECT_THAT(faults_of({low, 0xDB, 0xFC}), SizeIs(crystal ? 0 : 1)) << "CKSEL " << cksel;
  }
}

TEST(Fuses, AreRightOnceMendedAndKeepTheirOtherBits) {
  for (unsigned low = 0; low < 256; ++low)
    for (unsigned high = 0; high < 256; ++high) {
      const Fuses before{static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high), 0xFF};
      Fuses after = before;
      for (const std::string& word : mending_of(before)) {
        if (word == "-U") continue;
        const auto value = static_cast<std::uint8_t>(std::stoul(word.substr(8, 4), nullptr, 16));
        (word[0] == 'l' ? after.low : word[0] == 'h' ? after.high : after.extended) = value;
      }
      ASSERT_THAT(faults_of(after), IsEmpty()) << low << " " << high;
      ASSERT_EQ(after.high & 0xEE, before.high & 0xEE);
      if ((before.low & 0x06U) == 0x06U) {
        ASSERT_EQ(after.low & 0x3F, before.low & 0x3F);
      }
    }
}

}  // namespace
}  // namespace telehug
