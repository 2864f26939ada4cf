// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "screen/screen_grabber.hpp"

namespace telehug {

class ScreenShare;
struct ScreenShareState;

struct PortalGrabberConfig {
  std::filesystem::path token_file;  // where the restore token is kept, so that the user is asked once
  std::optional<cv::Rect> region;    // the part to look at, px of the monitor; none: all
  std::string bus_address;           // of D-Bus; empty: the session bus
  Duration retry_after = 5s;         // when what is missing (bus, portal, PipeWire) is looked for again
  Duration ask_again_after = 10min;  // when the user, who said no or ended the sharing, is asked again
};

// Takes the picture of one monitor of a Wayland desktop from org.freedesktop.portal.ScreenCast and PipeWire. The user
// consents in a dialogue of the desktop and chooses the monitor there; while it is open grab() says `lost`. Portals
// from version 4 on remember the answer. After a no, or when the user ends the sharing at the desktop, the dialogue
// comes again after close() and open() or after `ask_again_after`, never by the remembered answer alone.
//
// The monitor's pixels are those that the desktop sends: on scaled desktops the real ones. A picture is copied only
// when it is grabbed.
class PortalGrabber final : public ScreenGrabber {
 public:
  PortalGrabber(PortalGrabberConfig config, const Clock& clock);  // `clock` outlives it; other threads ask it too
  ~PortalGrabber() override;
  PortalGrabber(const PortalGrabber&) = delete;
  PortalGrabber& operator=(const PortalGrabber&) = delete;

  // Only starts to ask; what goes wrong is told by grab().
  Status open() override;
  void close() override;
  [[nodiscard]] bool is_open() const override { return share_ != nullptr; }
  GrabOutcome grab(ScreenPicture& picture) override;
  [[nodiscard]] bool is_live() const override { return true; }
  [[nodiscard]] std::string name() const override { return "screen shared by the desktop"; }
  [[nodiscard]] std::string last_error() const override { return last_error_; }

  // One sentence that the user should know though all works: that the consent can't be remembered. Empty: nothing.
  [[nodiscard]] std::string remark() const override;

 private:
  GrabOutcome lose(std::string why);
  GrabOutcome show(ScreenPicture& picture);

  PortalGrabberConfig config_;
  const Clock& clock_;
  std::unique_ptr<ScreenShare> share_;
  cv::Mat shown_;  // what the last grab handed out; used again by the next
  ImageSize monitor_;
  cv::Rect seen_;         // what is looked at of it; empty: the region lies outside
  bool was_lost_ = true;  // then the next grab can't say `unchanged`
  std::string last_error_;
};

}  // namespace telehug
