// SPDX-License-Identifier: Apache-2.0
#include "screen/frame_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "capture/frame_source.hpp"
#include "screen/watched_part.hpp"

namespace telehug {
namespace {

// The rows that a region needs, so that a source need not decode the others.
RowRange rows_of(const std::optional<cv::Rect>& region) {
  if (!region) return {};
  const std::int64_t end = std::int64_t{region->y} + region->height;
  return {std::max(0, region->y), static_cast<int>(std::min<std::int64_t>(end, std::numeric_limits<int>::max()))};
}

// Ends at the first row that differs: as good as free while the chat's video moves.
bool equal(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const std::size_t row_bytes = static_cast<std::size_t>(a.cols) * a.elemSize();
  for (int row = 0; row < a.rows; ++row) {
    if (std::memcmp(a.ptr(row), b.ptr(row), row_bytes) != 0) return false;
  }
  return true;
}

}  // namespace

FrameGrabber::FrameGrabber(std::unique_ptr<FrameSource> source, const FrameGrabberConfig& config, const Clock& clock)
    : source_(std::move(source)), config_(config), clock_(clock) {
  source_->need_rows(rows_of(config_.region));
}

FrameGrabber::~FrameGrabber() = default;

Status FrameGrabber::open() {
  if (open_) return Done{};
  if (Status opened = source_->open(); !opened) {
    source_->close();  // else it would go on looking for its device by itself
    return opened;
  }
  open_ = true;
  heard_ = clock_.now();
  last_error_.clear();
  return Done{};
}

void FrameGrabber::close() {
  source_->close();
  open_ = has_shown_ = false;
  incoming_ = shown_ = {};
}

GrabOutcome FrameGrabber::grab(ScreenPicture& picture) {
  picture.time = clock_.now();
  picture.in_front.reset();
  if (!open_) return lose(fmt::format("{} is not open.", name()));
  switch (source_->read(incoming_, Duration::zero())) {
    case ReadOutcome::frame:
      heard_ = picture.time;
      return show_newest(picture);
    case ReadOutcome::timeout:
      return nothing_new(picture.time, fmt::format("{} has delivered no picture yet.", source_->name()));
    case ReadOutcome::broken:
      return nothing_new(picture.time, source_->last_error());
    case ReadOutcome::lost:
      heard_ = picture.time;
      return lose(source_->last_error());
    case ReadOutcome::ended:
      break;
  }
  return lose(fmt::format("The recording is over ({}); choose another or open it again.", source_->name()));
}

GrabOutcome FrameGrabber::show_newest(ScreenPicture& picture) {
  const cv::Mat& bgr = incoming_.bgr;
  const auto part = watched_part(config_.region, bgr.size(), fmt::format("the picture of {}", source_->name()));
  if (!part) return lose(part.error().message);
  if (has_shown_ && shown_.bgr.size() == bgr.size() && equal(bgr(*part), shown_.bgr(part_))) {
    return GrabOutcome::unchanged;
  }
  std::swap(incoming_, shown_);  // what was lent out before is read into next
  part_ = *part;
  has_shown_ = true;
  picture.bgr = shown_.bgr(part_);
  picture.origin_px = part_.tl();
  picture.monitor = {.width_px = shown_.bgr.cols, .height_px = shown_.bgr.rows};
  return GrabOutcome::changed;
}

GrabOutcome FrameGrabber::nothing_new(Timestamp now, const std::string& why) {
  if (config_.live && now - heard_ > longest_silence) {
    return lose(fmt::format("{} has delivered no picture for {:.0f} s; check its cable and what feeds it.",
                            source_->name(), to_ms(now - heard_) / 1000));
  }
  return has_shown_ ? GrabOutcome::unchanged : lose(why);
}

GrabOutcome FrameGrabber::lose(std::string why) {
  has_shown_ = false;
  last_error_ = std::move(why);
  return GrabOutcome::lost;
}

std::string FrameGrabber::name() const {
  return fmt::format("screen through {}", source_->name());
}

}  // namespace telehug
