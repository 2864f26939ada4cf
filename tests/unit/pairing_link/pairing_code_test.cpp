// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/pairing_code.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

namespace telehug {
namespace {

const Endpoint somewhere{{192, 168, 1, 20}, 4711};

TEST(PairingCode, IsReadBackAsItWasWritten) {
  const auto code = make_pairing_code(somewhere);
  const auto text = to_text(code);
  EXPECT_EQ(text.size(), 47U);
  const auto read = parse_pairing_code(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->secret, code.secret);
  EXPECT_EQ(to_text(read->inviter), "192.168.1.20:4711");
}

TEST(PairingCode, IsReadAsPeopleWriteIt) {
  PairingCode code{.secret = {}, .inviter = somewhere};  // zeros, and so many letters O
  code.secret[1] = 0x42;
  auto text = to_text(code);
  std::replace(text.begin(), text.end(), '0', 'o');
  std::replace(text.begin(), text.end(), '1', 'l');
  std::replace(text.begin(), text.end(), '-', ' ');
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto read = parse_pairing_code("  " + text + "\n");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->secret, code.secret);
}

TEST(PairingCode, IsReadAsItsQrCodeHoldsIt) {
  const PairingCode code = make_pairing_code(somewhere);
  std::string text = to_qr_text(code);
  EXPECT_EQ(text, "TELEHUG:PAIR:" + to_text(code));
  for (int pass = 0; pass < 2; ++pass) {
    const auto read = parse_pairing_code(text);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->secret, code.secret);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  }
  EXPECT_FALSE(parse_pairing_code("TELEHUG:PAIR:"));
  EXPECT_FALSE(parse_pairing_code("TELEHUG:PAIR:TELEHUG:PAIR:" + to_text(code)));
}

TEST(PairingCode, TellsATypingErrorInAnyOfItsLetters) {
  const auto text = to_text(PairingCode{.secret = {1, 2, 3}, .inviter = somewhere});
  for (std::size_t place = 0; place < text.size(); ++place) {
    if (text[place] == '-') continue;
    auto wrong = text;
    wrong[place] = wrong[place] == '7' ? '8' : '7';
    EXPECT_FALSE(parse_pairing_code(wrong)) << wrong;
  }
}

TEST(PairingCode, RefusesWhatIsNone) {
  const auto text = to_text(make_pairing_code(somewhere));
  EXPECT_FALSE(parse_pairing_code(""));
  EXPECT_FALSE(parse_pairing_code(text.substr(0, text.size() - 1)));
  EXPECT_FALSE(parse_pairing_code(text + "0"));
  EXPECT_FALSE(parse_pairing_code("U" + text.substr(1)));
  EXPECT_FALSE(parse_pairing_code(std::string(100'000, '-')));
  EXPECT_FALSE(parse_pairing_code(to_text(make_pairing_code({{127, 0, 0, 1}, 0}))));
}

TEST(PairingCode, HasAnotherSecretEachTime) {
  EXPECT_NE(make_pairing_code(somewhere).secret, make_pairing_code(somewhere).secret);
}

}  // namespace
}  // namespace telehug
