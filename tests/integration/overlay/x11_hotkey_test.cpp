// SPDX-License-Identifier: Apache-2.0
#include "overlay/x11_hotkey.hpp"

#include <gmock/gmock.h>
#include <unistd.h>
#include <xcb/xcb_keysyms.h>
#include <xcb/xtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "doubles/fake_clock.hpp"
#include "doubles/x11_client.hpp"
#include "doubles/xvfb.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr xcb_keysym_t ctrl = 0xFFE3;
constexpr xcb_keysym_t alt = 0xFFE9;
constexpr xcb_keysym_t caps_lock = 0xFFE5;
constexpr xcb_keysym_t num_lock = 0xFF7F;

// Somebody at the keyboard.
class Typist {
 public:
  explicit Typist(const std::string& display) : client_(display) {}

  [[nodiscard]] xcb_keycode_t code(xcb_keysym_t sign) {
    xcb_key_symbols_t* symbols = xcb_key_symbols_alloc(client_.get());
    const XcbOwned<xcb_keycode_t> codes(xcb_key_symbols_get_keycode(symbols, sign));
    const xcb_keycode_t first = codes ? *codes : 0;
    xcb_key_symbols_free(symbols);
    EXPECT_NE(first, 0) << "no key for " << sign;
    return first;
  }
  void press(xcb_keycode_t code) { fake(XCB_KEY_PRESS, code); }
  void release(xcb_keycode_t code) { fake(XCB_KEY_RELEASE, code); }

  // Presses keys one after the other and releases them in the opposite order.
  void type(const std::vector<xcb_keysym_t>& signs) {
    for (const xcb_keysym_t sign : signs)
      press(code(sign));
    for (auto sign = signs.rbegin(); sign != signs.rend(); ++sign)
      release(code(*sign));
  }

  void put(xcb_keysym_t sign, xcb_keycode_t code) {
    const std::vector<xcb_keysym_t> signs{sign, sign};
    xcb_change_keyboard_mapping(client_.get(), 1, code, 2, signs.data());
    client_.sync();
  }
  void sync() { client_.sync(); }

 private:
  void fake(std::uint8_t what, xcb_keycode_t code) {
    // After 2 ms: nobody releases a key and presses it again within the same one, only repeating keys do that.
    xcb_test_fake_input(client_.get(), what, code, 2, XCB_NONE, 0, 0, 0);
    client_.sync();
  }

  X11Client client_;
};

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
  Typist typist{server.display()};
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
  Typist there(mortal.display());
  clock.advance(1s);
  EXPECT_FALSE(other.pressed());
  EXPECT_EQ(other.last_error(), "");
  there.type({0xFFC6});
  EXPECT_TRUE(is_pressed_soon(other));
}

}  // namespace
}  // namespace telehug
