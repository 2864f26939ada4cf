// SPDX-License-Identifier: Apache-2.0
//
// A wire between telehug-passive and the simulated jacket that can be listened to, disturbed, and unplugged.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "common/clock.hpp"

namespace telehug {

class WireBetween {
 public:
  enum class Way { to_jacket, to_daemon };
  // What becomes of bytes that came at `time`; on the wire's own thread.
  using Pass = std::function<std::vector<std::uint8_t>(Way way, std::span<const std::uint8_t> bytes, Timestamp time)>;

  // `daemon_side`: where the link to the pseudo terminal for the daemon is made. `jacket`: the simulator's terminal.
  // Throws std::system_error.
  WireBetween(std::filesystem::path daemon_side, const std::filesystem::path& jacket, Pass pass = unchanged);
  ~WireBetween();
  WireBetween(const WireBetween&) = delete;
  WireBetween& operator=(const WireBetween&) = delete;

  void set_pass(Pass pass);
  // The daemon's terminal is gone; the next one has another name, and the link leads to it.
  void unplug();
  void plug_in();

  [[nodiscard]] static std::vector<std::uint8_t> unchanged(Way way, std::span<const std::uint8_t> bytes,
                                                           Timestamp time);

 private:
  void carry();
  void carry_from(Way way);

  const std::filesystem::path link_;
  int jacket_ = -1;
  std::mutex mutex_;  // guards what follows
  int daemon_ = -1;   // master
  int slave_ = -1;    // held open, so that the daemon may come and go
  int spare_ = -1;    // slave of the one before: its name is not given to the next
  Pass pass_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace telehug
