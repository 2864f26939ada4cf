// SPDX-License-Identifier: Apache-2.0
#include "publish/hug_player.hpp"

#include <algorithm>
#include <array>

namespace telehug {
namespace {

constexpr GridShape standard_grid{.columns = 5, .rows = 4};
constexpr double box_side_fh = 0.5;
// Right and left upper arm, right and left flank.
constexpr std::array<std::uint16_t, HugPlayer::contacts_a_hug> boxes{6, 10, 12, 14};

// From nothing to full strength. A vibration that begins at once startles.
constexpr double rise_a_second = 1 / 0.6;
// Where it begins and ends: already felt.
constexpr double least = 0.15;

BodyPoint middle_of(std::uint16_t box) {
  const int column = (box - 1) % standard_grid.columns;
  const int row = (box - 1) / standard_grid.columns;
  return {.x_fh = (column + 0.5 - standard_grid.columns / 2.0) * box_side_fh, .y_fh = (row + 0.5) * box_side_fh};
}

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

void HugPlayer::begin(const HugOrder& order, Timestamp now) {
  const Timestamp end = now + std::min(order.duration, HugOrder::longest);
  end_ = runs() ? std::max(end_, end) : end;
  wanted_ = order.strength;
  if (runs()) return;
  stage_ = Stage::asked_for;
  strength_ = std::min(least, wanted_);
  contacts_.clear();
  for (const std::uint16_t box : boxes) {
    const std::uint32_t id = id_bit | (++ids_used_ & ~id_bit);
    contacts_.push_back({.id = id,
                         .phase = Phase::down,
                         .screen = {},
                         .speed_mm_s = 0,
                         .grid = standard_grid,
                         .box = box,
                         .body = middle_of(box),
                         .strength = strength_,
                         .gesture = Gesture::hug});
  }
}

const BoxedContacts& HugPlayer::play(Timestamp now) {
  const bool ends = now >= end_;
  if (stage_ == Stage::asked_for && ends) stage_ = Stage::over;
  if (stage_ == Stage::over) {
    contacts_.clear();
    return contacts_;
  }
  if (stage_ == Stage::under_way) change_strength(now);
  for (BoxedContact& contact : contacts_) {
    contact.phase = ends ? Phase::up : stage_ == Stage::asked_for ? Phase::down : Phase::move;
    contact.strength = strength_;
  }
  stage_ = ends ? Stage::over : Stage::under_way;
  played_ = now;
  return contacts_;
}

void HugPlayer::change_strength(Timestamp now) {
  const double low = std::min(least, wanted_);
  const double time_to_fall_s = (strength_ - low) / rise_a_second;
  const double aim = seconds(end_ - now) <= time_to_fall_s ? low : wanted_;
  const double step = rise_a_second * seconds(now - played_);
  strength_ = std::clamp(aim, strength_ - step, strength_ + step);
}

}  // namespace telehug
