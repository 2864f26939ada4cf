// SPDX-License-Identifier: Apache-2.0
#include "setup/setup_state.hpp"

namespace telehug {

SetupPage page_of(SetupStep step) noexcept {
  switch (step) {
    case SetupStep::bright:
    case SetupStep::confirm_border:
      return SetupPage::triangle;
    case SetupStep::background:
      return SetupPage::black;
    case SetupStep::marks:
      return SetupPage::marks;
    case SetupStep::dots:
      return SetupPage::dot;
    case SetupStep::solving:
    case SetupStep::solved:
    case SetupStep::saved:
    case SetupStep::cancelled:
      break;
  }
  return SetupPage::none;
}

const char* name_of(SetupStep step) noexcept {
  switch (step) {
    case SetupStep::bright:
      return "bright";
    case SetupStep::confirm_border:
      return "confirm_border";
    case SetupStep::background:
      return "background";
    case SetupStep::marks:
      return "marks";
    case SetupStep::dots:
      return "dots";
    case SetupStep::solving:
      return "solving";
    case SetupStep::solved:
      return "solved";
    case SetupStep::saved:
      return "saved";
    case SetupStep::cancelled:
      break;
  }
  return "cancelled";
}

const char* name_of(SetupPage page) noexcept {
  switch (page) {
    case SetupPage::triangle:
      return "triangle";
    case SetupPage::black:
      return "black";
    case SetupPage::marks:
      return "marks";
    case SetupPage::dot:
      return "dot";
    case SetupPage::none:
      break;
  }
  return "none";
}

namespace {

struct AdviceText {
  const char* name;
  const char* text;
};

AdviceText text(SetupAdvice advice) noexcept {
  switch (advice) {
    case SetupAdvice::no_picture:
      return {"no_picture", "The camera delivers no pictures: plug it in, and close other programs that use it."};
    case SetupAdvice::too_dark:
      return {"too_dark", "The picture is too dark: switch on a light, or turn the screen's brightness up."};
    case SetupAdvice::no_border:
      return {"no_border",
              "The screen's bottom edge is not seen: turn the camera until it looks down along the screen."};
    case SetupAdvice::no_triangle:
      return {"no_triangle",
              "The triangle is not seen: show it on the whole of the screen that the camera looks along."};
    case SetupAdvice::turn_towards_screen:
      return {"turn_towards_screen", "Turn the camera a little towards the screen."};
    case SetupAdvice::turn_towards_user:
      return {"turn_towards_user", "Turn the camera a little away from the screen, towards yourself."};
    case SetupAdvice::turn_level:
      return {"turn_level", "The camera is askew: turn it until the screen's edge is level in its picture."};
    case SetupAdvice::hold_still:
      return {"hold_still", "Something moves: take your hands away, and don't touch the camera."};
    case SetupAdvice::page_not_seen:
      return {"page_not_seen", "This page is not seen yet: show it on the whole of the screen."};
    case SetupAdvice::hands_away:
      return {"hands_away", "Take your hands, and all that does not stay there, away from the screen and before it."};
    case SetupAdvice::confirm:
      return {"confirm", "Is the line the bottom edge of the screen?"};
    case SetupAdvice::touch_dot:
      return {"touch_dot", "Lay a finger on the dot, from below, the other fingers folded away."};
    case SetupAdvice::finger_moves:
      return {"finger_moves", "Let the finger rest on the dot."};
    case SetupAdvice::finger_beside_dot:
      return {"finger_beside_dot", "The finger is beside the dot."};
    case SetupAdvice::finger_hovers:
      return {"finger_hovers", "Touch the screen."};
    case SetupAdvice::hold_finger:
      return {"hold_finger", "Right: keep the finger there."};
    case SetupAdvice::next_dot:
      return {"next_dot", "Taken: go to the next dot."};
    case SetupAdvice::repeat_dots:
      return {"repeat_dots", "Some touches were not seen, or do not fit the others: touch these dots again."};
    case SetupAdvice::not_good_enough:
      return {"not_good_enough", "The calibration is not good enough to be saved."};
    case SetupAdvice::good:
      return {"good", "The calibration is good."};
    case SetupAdvice::idle:
      return {"idle", "Nothing has happened for a long time: begin again."};
    case SetupAdvice::none:
      break;
  }
  return {"none", ""};
}

}  // namespace

const char* name_of(SetupAdvice advice) noexcept {
  return text(advice).name;
}

const char* text_of(SetupAdvice advice) noexcept {
  return text(advice).text;
}

SetupAdvice advice_of(CameraTurn turn) noexcept {
  switch (turn) {
    case CameraTurn::towards_screen:
      return SetupAdvice::turn_towards_screen;
    case CameraTurn::towards_user:
      return SetupAdvice::turn_towards_user;
    case CameraTurn::level:
      return SetupAdvice::turn_level;
    case CameraTurn::none:
      break;
  }
  return SetupAdvice::none;
}

}  // namespace telehug
