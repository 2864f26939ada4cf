// SPDX-License-Identifier: Apache-2.0
#include "screen/recorded_screen_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pictures/picture_file.hpp"

namespace telehug {

RecordedScreenGrabber::RecordedScreenGrabber(std::filesystem::path recording, const Clock& clock)
    : recording_(std::move(recording)), clock_(clock) {}

Status RecordedScreenGrabber::open() {
  if (open_) return Done{};
  auto pictures = read_recorded_screen(recording_);
  if (!pictures) return pictures.error();
  pictures_ = std::move(*pictures);
  opened_ = clock_.now();
  shown_.reset();
  last_error_.clear();
  open_ = true;
  return Done{};
}

void RecordedScreenGrabber::close() {
  open_ = false;
  pictures_.clear();
  shown_.reset();
}

std::size_t RecordedScreenGrabber::due(Timestamp now) const {
  const Duration replayed = now - opened_;
  const auto next = std::find_if(pictures_.begin() + 1, pictures_.end(),
                                 [&](const RecordedScreenPicture& picture) { return picture.shown_after > replayed; });
  return static_cast<std::size_t>(next - pictures_.begin()) - 1;
}

GrabOutcome RecordedScreenGrabber::grab(ScreenPicture& picture) {
  picture.time = clock_.now();
  picture.in_front.reset();
  if (!open_) return lose(fmt::format("{} is not open.", name()));
  const std::size_t index = due(picture.time);
  if (shown_ == index) return GrabOutcome::unchanged;

  const RecordedScreenPicture& recorded = pictures_[index];
  auto read = read_picture(recorded.file);
  if (!read) return lose(read.error().message);
  const ImageSize monitor = recorded.monitor.value_or(ImageSize{.width_px = read->cols, .height_px = read->rows});
  const cv::Rect whole(0, 0, monitor.width_px, monitor.height_px);
  const cv::Rect place(recorded.origin_px, read->size());
  if ((place & whole) != place) {
    return lose(fmt::format(
        "The picture {} ({}x{} px at {},{}) reaches past its monitor of {}x{} px; correct "
        "screen_times.csv.",
        recorded.file.string(), place.width, place.height, place.x, place.y, monitor.width_px, monitor.height_px));
  }
  picture.bgr = std::move(*read);
  picture.origin_px = recorded.origin_px;
  picture.monitor = monitor;
  shown_ = index;
  return GrabOutcome::changed;
}

GrabOutcome RecordedScreenGrabber::lose(std::string why) {
  last_error_ = std::move(why);
  return GrabOutcome::lost;
}

std::string RecordedScreenGrabber::name() const {
  return fmt::format("recorded screen {}", recording_.string());
}

}  // namespace telehug
