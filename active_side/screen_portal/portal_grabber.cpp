// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/portal_grabber.hpp"

#include <fmt/format.h>

#include <utility>

#include "screen_portal/screen_share.hpp"

namespace telehug {

PortalGrabber::PortalGrabber(PortalGrabberConfig config, const Clock& clock)
    : config_(std::move(config)), clock_(clock) {}

PortalGrabber::~PortalGrabber() = default;

Status PortalGrabber::open() {
  if (share_) return Done{};
  try {
    share_ = std::make_unique<ScreenShare>(ScreenShareConfig{.token_file = config_.token_file,
                                                             .bus_address = config_.bus_address,
                                                             .retry_after = config_.retry_after,
                                                             .ask_again_after = config_.ask_again_after},
                                           clock_);
  } catch (const std::exception& problem) {
    return Error{fmt::format("The desktop can't be asked for its screen ({}); close other programs.", problem.what())};
  }
  last_error_.clear();
  return Done{};
}

void PortalGrabber::close() {
  share_.reset();
  shown_.release();
  was_lost_ = true;
}

GrabOutcome PortalGrabber::grab(ScreenPicture& picture) {
  picture.time = clock_.now();
  if (!share_) return lose(fmt::format("The {} is not open.", name()));
  ScreenShareState state = share_->state();
  if (!state.flowing) return lose(std::move(state.trouble));

  std::string why;
  const auto taken = share_->frames().take(why, [&](const cv::Mat& found, PixelOrder order) {
    monitor_ = {.width_px = found.cols, .height_px = found.rows};
    const cv::Rect_<std::int64_t> whole(0, 0, found.cols, found.rows);
    // In 64 bits: the corner of a region from a config file may lie beyond what an int holds.
    seen_ = cv::Rect(config_.region ? cv::Rect_<std::int64_t>(*config_.region) & whole : whole);
    if (!seen_.empty()) copy_frame(found(seen_), order, shown_);
  });
  switch (taken) {
    case FrameSlot::Taken::unchanged:
      if (was_lost_) return show(picture);
      picture.in_front.reset();
      return GrabOutcome::unchanged;
    case FrameSlot::Taken::frame:
      return show(picture);
    case FrameSlot::Taken::spoiled:
      return lose(fmt::format("The picture that the desktop sends of its screen can't be used: {}.", why));
    case FrameSlot::Taken::nothing:
      break;
  }
  return lose("The desktop shares its screen, but no picture of it has come yet.");
}

GrabOutcome PortalGrabber::show(ScreenPicture& picture) {
  if (seen_.empty()) {
    const cv::Rect region = config_.region.value_or(cv::Rect());
    return lose(
        fmt::format("The region of {}x{} px at {},{} lies outside of the monitor ({}x{} px); correct the region.",
                    region.width, region.height, region.x, region.y, monitor_.width_px, monitor_.height_px));
  }
  picture.bgr = shown_;
  picture.origin_px = seen_.tl();
  picture.monitor = monitor_;
  picture.in_front.reset();
  was_lost_ = false;
  return GrabOutcome::changed;
}

GrabOutcome PortalGrabber::lose(std::string why) {
  was_lost_ = true;
  last_error_ = std::move(why);
  return GrabOutcome::lost;
}

std::string PortalGrabber::remark() const {
  return share_ ? share_->state().remark : std::string{};
}

}  // namespace telehug
