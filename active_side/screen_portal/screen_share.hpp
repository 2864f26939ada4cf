// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "common/clock.hpp"
#include "screen_portal/frame_slot.hpp"
#include "screen_portal/pipewire_stream.hpp"
#include "screen_portal/portal_session.hpp"

namespace telehug {

struct ScreenShareConfig {
  std::filesystem::path token_file;
  std::string bus_address;
  Duration retry_after = 5s;
  Duration ask_again_after = 10min;
};

struct ScreenShareState {
  bool flowing = false;  // is the newest frame what the screen shows?
  std::string trouble;   // a sentence; empty while flowing
  std::string remark;    // a sentence about what the user should know though it works; empty: nothing
};

// Keeps a monitor shared: asks the portal, takes the frames into a slot, and begins anew when either was lost. A thread
// of its own does it from the beginning to the end of this object, and waits for nothing but new messages.
class ScreenShare {
 public:
  ScreenShare(ScreenShareConfig config, const Clock& clock);  // `clock` outlives it and may be asked by any thread
  ~ScreenShare();
  ScreenShare(const ScreenShare&) = delete;
  ScreenShare& operator=(const ScreenShare&) = delete;

  [[nodiscard]] ScreenShareState state() const;  // waits for nothing
  [[nodiscard]] FrameSlot& frames() { return frames_; }

 private:
  void run();
  void begin();
  void serve();
  void serve_stream();
  void keep_token();
  void give_up(PortalFailure failure);
  void wait();
  void say(bool flowing, std::string trouble);

  const ScreenShareConfig config_;
  const Clock& clock_;
  FrameSlot frames_;

  // Of the thread.
  std::unique_ptr<PortalSession> session_;
  std::unique_ptr<PipeWireStream> stream_;
  Timestamp next_try_;
  bool use_token_ = true;
  bool has_consent_ = false;      // of the session
  bool consent_is_kept_ = false;  // would the next session need no answer of the user?

  mutable std::mutex mutex_;
  ScreenShareState state_;

  std::atomic<bool> ending_ = false;
  int wake_fd_ = -1;
  std::thread thread_;
};

}  // namespace telehug
