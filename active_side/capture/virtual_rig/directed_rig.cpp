// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/directed_rig.hpp"

#include <stdexcept>
#include <utility>

#include "capture/virtual_rig/virtual_rig.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

VirtualRigSettings checked(VirtualRigSettings settings) {
  settings.script = {};
  settings.disturbances.clear();
  if (const Status possible = check_virtual_rig(settings); !possible)
    throw std::invalid_argument(possible.error().message);
  return settings;
}

}  // namespace

bool DirectedRig::Watched::changed() {
  std::error_code none;
  std::optional<std::filesystem::file_time_type> now = std::filesystem::last_write_time(path, none);
  if (none) now.reset();
  const std::uintmax_t size = now ? std::filesystem::file_size(path, none) : 0;
  if (now == seen && size == bytes) return false;
  seen = now;
  bytes = size;
  return true;
}

DirectedRig::DirectedRig(VirtualRigSettings settings, std::filesystem::path folder, const Clock& clock,
                         SleepUntil sleep)
    : settings_(checked(std::move(settings))),
      pace_(settings_.fps, settings_.real_time, clock, std::move(sleep)),
      renderer_(settings_),
      usual_view_(renderer_.view()),
      screen_{.path = folder / "screen.png"},
      hand_{.path = folder / "hand.csv"} {}

Status DirectedRig::open() {
  if (open_) return Done{};
  open_ = true;
  pace_.open();
  return Done{};
}

void DirectedRig::close() {
  open_ = false;
  pace_.close();
}

void DirectedRig::follow_screen() {
  if (!screen_.changed()) return;
  screen_.fault.clear();
  if (!screen_.seen) {
    renderer_.show(usual_view_);
  } else if (const auto picture = read_picture(screen_.path); picture) {
    renderer_.show(*picture);
  } else {
    screen_.fault = picture.error().message;
  }
}

void DirectedRig::follow_hand(double now_s) {
  if (!hand_.changed()) return;
  hand_.fault.clear();
  path_.clear();
  path_begins_s_ = now_s;
  if (!hand_.seen) return;
  if (auto path = read_hand_path(hand_.path, settings_.screen); path) {
    path_ = *std::move(path);
  } else {
    hand_.fault = path.error().message;
  }
}

ReadOutcome DirectedRig::read(Frame& frame, Duration timeout) {
  const Timestamp deadline = pace_.now() + timeout;
  if (!open_) {
    last_error_ = "the virtual rig is closed";
    pace_.wait(deadline);
    return ReadOutcome::lost;
  }
  const auto number = pace_.wait_for_picture(deadline);
  if (!number) return ReadOutcome::timeout;
  const double now_s = static_cast<double>(*number) / settings_.fps;
  follow_screen();
  follow_hand(now_s);
  for (const Watched* file : {&screen_, &hand_}) {
    if (file->fault.empty()) continue;
    last_error_ = file->fault;
    return ReadOutcome::broken;
  }
  renderer_.draw(hands_at(path_, now_s - path_begins_s_), *number, frame.bgr);
  frame.sequence = *number;
  frame.time = pace_.time_of(*number);
  return ReadOutcome::frame;
}

}  // namespace telehug
