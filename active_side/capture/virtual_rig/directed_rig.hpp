// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "capture/frame_source.hpp"
#include "capture/virtual_rig/hand_path.hpp"
#include "capture/virtual_rig/rig_pace.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

// A virtual rig that another program directs by two files in a folder, which are read again whenever they have been
// replaced (written beside and renamed):
//   screen.png   what the screen shows, stretched over it; without it what the settings say
//   hand.csv     what the hand does from the picture on in which it was noticed (hand_path.hpp); without it nobody is
//                there
// A file that can't be read is told in last_error(), and the pictures are `broken` until it is mended or gone.
class DirectedRig final : public FrameSource {
 public:
  // `settings`: of these, script and disturbances count for nothing. Throws std::invalid_argument with what
  // check_virtual_rig() says. `clock` must outlive the rig.
  DirectedRig(VirtualRigSettings settings, std::filesystem::path folder, const Clock& clock,
              SleepUntil sleep = sleep_until_steady);

  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return open_; }
  ReadOutcome read(Frame& frame, Duration timeout) override;
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] std::string name() const override { return "virtual"; }
  [[nodiscard]] ImageSize size() const override { return settings_.image; }

 private:
  // A file, and which one it was when it was looked at last.
  struct Watched {
    std::filesystem::path path;
    std::optional<std::filesystem::file_time_type> seen = std::nullopt;
    std::uintmax_t bytes = 0;
    std::string fault = {};
    // Whether it is another one now.
    bool changed();
  };

  void follow_screen();
  void follow_hand(double now_s);

  VirtualRigSettings settings_;
  RigPace pace_;
  RigRenderer renderer_;
  std::shared_ptr<RigView> usual_view_;
  Watched screen_;
  Watched hand_;
  HandPath path_;
  double path_begins_s_ = 0;
  bool open_ = false;
  std::string last_error_;
};

}  // namespace telehug
