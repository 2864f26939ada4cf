// SPDX-License-Identifier: Apache-2.0
//
// Sits on the wire between telehug-passive and the simulated jacket, passes everything on, and notes when which motors
// were asked for.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "common/clock.hpp"
#include "link/frame_codec.hpp"

namespace telehug {

// The last byte of a SET frame was on the wire at `time`; intensity above 0 for the channels it asks for.
struct WrittenSet {
  Timestamp time;
  std::array<std::uint8_t, protocol::motor_count> intensity{};
};

class WireTap {
 public:
  // `daemon_side`: where the link to the pseudo terminal for the daemon is made. `jacket`: the simulator's terminal.
  // Throws std::system_error.
  WireTap(const std::filesystem::path& daemon_side, const std::filesystem::path& jacket);
  ~WireTap();
  WireTap(const WireTap&) = delete;
  WireTap& operator=(const WireTap&) = delete;

  // Those since the last call.
  [[nodiscard]] std::vector<WrittenSet> take();

 private:
  void pass_on();
  void note(std::uint8_t byte, Timestamp time);

  std::filesystem::path link_;
  int daemon_ = -1;
  int slave_ = -1;  // held open, so that the daemon may come and go
  int jacket_ = -1;
  FrameDecoder decoder_;
  std::mutex mutex_;
  std::vector<WrittenSet> written_;  // guarded by mutex_
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace telehug
