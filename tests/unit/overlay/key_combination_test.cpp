// SPDX-License-Identifier: Apache-2.0
#include "overlay/key_combination.hpp"

#include <gmock/gmock.h>

#include <string>

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(std::string_view text) {
  const auto parsed = parse_key_combination(text);
  return parsed ? "accepted" : parsed.error().message;
}

TEST(AKeyCombination, IsModifiersAndAKey) {
  EXPECT_EQ(*parse_key_combination("Ctrl+Alt+H"), (KeyCombination{.ctrl = true, .alt = true, .keysym = 'h'}));
  EXPECT_EQ(*parse_key_combination(" super + SHIFT+7 "), (KeyCombination{.shift = true, .super = true, .keysym = '7'}));
  EXPECT_EQ(*parse_key_combination("ctrl+space"), (KeyCombination{.ctrl = true, .keysym = ' '}));
  EXPECT_EQ(*parse_key_combination("Alt+PageDown"), (KeyCombination{.alt = true, .keysym = 0xFF56}));
}

TEST(AKeyCombination, MayBeAKeyAloneIfThatIsNotForTyping) {
  EXPECT_EQ(*parse_key_combination("F1"), KeyCombination{.keysym = 0xFFBE});
  EXPECT_EQ(*parse_key_combination("Shift+f24"), (KeyCombination{.shift = true, .keysym = 0xFFD5}));
  EXPECT_EQ(*parse_key_combination("Pause"), KeyCombination{.keysym = 0xFF13});
  for (const char* text : {"H", "Shift+H", "5", "Space", "Delete", "Shift+Home"}) {
    EXPECT_THAT(refusal(text), AllOf(HasSubstr(text), HasSubstr("needs Ctrl, Alt or Super"))) << text;
  }
}

TEST(AKeyCombination, IsRefusedWithAReason) {
  EXPECT_THAT(refusal(""), HasSubstr("has no key"));
  EXPECT_THAT(refusal("Ctrl+Alt"), HasSubstr("has no key"));
  EXPECT_THAT(refusal("Ctrl+"), HasSubstr("has no key"));
  EXPECT_THAT(refusal("Ctrl+Ctrl+H"), HasSubstr("ctrl twice"));
  EXPECT_THAT(refusal("Control+H"), AllOf(HasSubstr("\"control\""), HasSubstr("Ctrl, Alt, Shift or Super")));
  EXPECT_THAT(refusal("Ctrl++H"), HasSubstr("\"\" where"));
  EXPECT_THAT(refusal("H+Ctrl"), HasSubstr("\"h\" where"));
  for (const char* key : {"F0", "F25", "Fx", "F1x", "hh", "-", "\xC3\xA4"}) {
    EXPECT_THAT(refusal(std::string("Ctrl+") + key), HasSubstr("unknown key")) << key;
  }
  EXPECT_THAT(refusal("Ctrl"), HasSubstr("write one like Ctrl+Alt+H"));
}

}  // namespace
}  // namespace telehug
