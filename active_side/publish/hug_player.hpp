// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/clock.hpp"
#include "publish/boxed_contact.hpp"

namespace telehug {

// A hug that somebody asks for in so many words, without touching the screen.
struct HugOrder {
  static constexpr Duration longest = 10s;

  Duration duration = 2500ms;
  double strength = 0.7;  // above 0, up to 1
};

// Plays a hug as contacts: arms around both upper arms and flanks, at their places on the standard grid, so that
// neither camera, calibration nor face is needed. It rises and falls gently and ends by itself. Allocates nothing.
class HugPlayer {
 public:
  static constexpr std::size_t contacts_a_hug = 4;
  // Ids of a hug's contacts have this bit; the trackers of fingers count up from 1 and never get there.
  static constexpr std::uint32_t id_bit = 0x8000'0000;

  // A hug that runs already goes on: it ends when the later of the two would, and becomes as strong as the newer one.
  void begin(const HugOrder& order, Timestamp now);

  // Its contacts are gone from now on.
  void break_off() noexcept { stage_ = Stage::over; }

  // The contacts at this time, which rises from call to call: down in the first call, up in the last, none while
  // nobody is hugged. What could not be begun before its end is left out. Valid until the next call.
  const BoxedContacts& play(Timestamp now);

  [[nodiscard]] bool runs() const noexcept { return stage_ != Stage::over; }

 private:
  enum class Stage { over, asked_for, under_way };

  void change_strength(Timestamp now);

  Stage stage_ = Stage::over;
  double wanted_ = 0;
  double strength_ = 0;
  Timestamp end_;
  Timestamp played_;
  std::uint32_t ids_used_ = 0;
  BoxedContacts contacts_;
};

}  // namespace telehug
