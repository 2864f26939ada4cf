// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_hotkey.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "doubles/fake_clock.hpp"
#include "doubles/x11_typist.hpp"
#include "doubles/xvfb.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class X11HotkeyTest : public testing::Test {
 protected:
  void open(X11Hotkey& key) {
    const Status opened = key.open();
    ASSERT_TRUE(opened) << opened.error().message;
  }
  static bool is_pressed_soon(X11Hotkey& key) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    do {
      if (key.pressed()) return true;
      std::this_thread::sleep_for(1ms);
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }
  // The server has answered many times since: its news would have come.
  bool stays_quiet() {
    for (int i = 0; i < 20; ++i) {
      typist.sync();
      if (hotkey.pressed()) return false;
    }
    return true;
  }

  Xvfb server;
  X11Typist typist{server.display()};
  FakeClock clock;
  X11Hotkey hotkey{{.display = server.display(), .keys = "Ctrl+Alt+H"}, clock};
};

TEST_F(X11HotkeyTest, IsToldOncePerPress) {
  EXPECT_FALSE(hotkey.pressed()) << "not open";
  open(hotkey);
  EXPECT_TRUE(stays_quiet());
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  EXPECT_TRUE(stays_quiet());
  typist.type({ctrl, alt, 'h'});
  typist.type({alt, ctrl, 'h'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  EXPECT_TRUE(is_pressed_soon(hotkey));
  EXPECT_TRUE(stays_quiet());
  EXPECT_EQ(hotkey.last_error(), "");
}

TEST_F(X11HotkeyTest, IsNoOtherCombination) {
  open(hotkey);
  typist.type({'h'});
  typist.type({ctrl, 'h'});
  typist.type({alt, 'h'});
  typist.type({ctrl, alt, 'j'});
  EXPECT_TRUE(stays_quiet());
}

TEST_F(X11HotkeyTest, CountsNoOtherKeyThatIsPressedMeanwhile) {
  open(hotkey);
  typist.type({ctrl, alt, 'h', 'j'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  EXPECT_TRUE(stays_quiet());
}

TEST_F(X11HotkeyTest, WorksWithCapsLockAndNumLock) {
  open(hotkey);
  typist.type({caps_lock});
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  typist.type({num_lock});
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  typist.type({caps_lock});
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_pressed_soon(hotkey));
  EXPECT_TRUE(stays_quiet());
}

TEST_F(X11HotkeyTest, IsToldOnceHoweverLongItIsHeld) {
  open(hotkey);
  for (const xcb_keysym_t sign : {ctrl, alt, xcb_keysym_t{'h'}})
    typist.press(typist.code(sign));
  ASSERT_TRUE(is_pressed_soon(hotkey));
  // Keys begin to repeat after 0.66 s.
  const auto end = std::chrono::steady_clock::now() + 1200ms;
  while (std::chrono::steady_clock::now() < end) {
    ASSERT_FALSE(hotkey.pressed());
    std::this_thread::sleep_for(5ms);
  }
}

TEST_F(X11HotkeyTest, IsRefusedWhenAnotherProgramHasIt) {
  open(hotkey);
  X11Hotkey second({.display = server.display(), .keys = "Ctrl+Alt+H"}, clock);
  const Status refused = second.open();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("Another program has taken Ctrl+Alt+H"), HasSubstr("choose")));
  EXPECT_FALSE(second.is_open());
  X11Hotkey other({.display = server.display(), .keys = "Ctrl+Alt+J"}, clock);
  EXPECT_TRUE(other.open());

  hotkey.close();
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (!second.open() && std::chrono::steady_clock::now() < end) {
  }
  ASSERT_TRUE(second.is_open());
  typist.type({ctrl, alt, 'h'});
  EXPECT_TRUE(is_pressed_soon(second));
  EXPECT_FALSE(other.pressed());
  EXPECT_FALSE(hotkey.pressed());
}

TEST_F(X11HotkeyTest, FollowsTheKeyboardsLayout) {
  const xcb_keycode_t h = typist.code('h');
  const xcb_keycode_t j = typist.code('j');
  open(hotkey);
  typist.put('j', h);
  typist.put('h', j);
  const auto end = std::chrono::steady_clock::now() + 20s;
  bool told = false;
  while (!told && std::chrono::steady_clock::now() < end) {  // until the news of the layout has come
    typist.type({ctrl, alt, 'h'});
    told = hotkey.pressed();
  }
  EXPECT_TRUE(told);
  while (!stays_quiet()) {
  }
  typist.type({ctrl, alt, 'j'});
  EXPECT_TRUE(stays_quiet());
}

TEST_F(X11HotkeyTest, SaysThatTheKeyboardLacksTheKey) {
  typist.put('j', typist.code('h'));
  const Status refused = hotkey.open();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("no key for Ctrl+Alt+H"), HasSubstr("choose")));
}

TEST_F(X11HotkeyTest, SaysThatItIsNoCombination) {
  X11Hotkey wrong({.display = server.display(), .keys = "Ctrl+Alt"}, clock);
  const Status refused = wrong.open();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("has no key"));
}

TEST_F(X11HotkeyTest, ComesBackWithItsServer) {
  // A number that no other server takes meanwhile.
  Xvfb mortal("320x200x24", {":" + std::to_string(100 + getpid() % 50000)});
  X11Hotkey other({.display = mortal.display(), .keys = "F9"}, clock);
  open(other);
  mortal.stop();
  EXPECT_FALSE(other.pressed());
  EXPECT_THAT(other.last_error(), AllOf(HasSubstr(mortal.display()), HasSubstr("gone")));
  clock.advance(1s);
  EXPECT_FALSE(other.pressed());
  EXPECT_THAT(other.last_error(), HasSubstr("can't be reached"));
  mortal.start();
  X11Typist there(mortal.display());
  clock.advance(1s);
  EXPECT_FALSE(other.pressed());
  EXPECT_EQ(other.last_error(), "");
  there.type({0xFFC6});
  EXPECT_TRUE(is_pressed_soon(other));
}

}  // namespace
}  // namespace telehug
