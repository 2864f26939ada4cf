// SPDX-License-Identifier: Apache-2.0
#include "screen/picture_grabber.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "pictures/picture_file.hpp"
#include "screen/picture_files.hpp"
#include "screen/watched_part.hpp"

namespace telehug {
namespace fs = std::filesystem;

PictureGrabber::PictureGrabber(PictureGrabberConfig config, const Clock& clock)
    : config_(std::move(config)), clock_(clock) {}

Status PictureGrabber::open() {
  if (open_) {
    return Done{};
  }
  if (!(config_.rate_hz > 0) || !std::isfinite(config_.rate_hz)) {
    return Error{fmt::format("The rate of the pictures is {} a second; it must be above 0.", config_.rate_hz)};
  }
  auto files = list_pictures(config_.path);
  if (!files) {
    return files.error();
  }
  files_ = std::move(*files);
  opened_ = clock_.now();
  shown_.reset();
  last_error_.clear();
  open_ = true;
  return Done{};
}

void PictureGrabber::close() {
  open_ = false;
  files_.clear();
  shown_.reset();
}

const fs::path& PictureGrabber::due(Timestamp now) const {
  const double shown_s = std::max(0.0, std::chrono::duration<double>(now - opened_).count());
  const double index = std::fmod(std::floor(shown_s * config_.rate_hz), static_cast<double>(files_.size()));
  return files_[static_cast<std::size_t>(index)];
}

GrabOutcome PictureGrabber::lose(std::string why) {
  shown_.reset();
  last_error_ = std::move(why);
  return GrabOutcome::lost;
}

GrabOutcome PictureGrabber::grab(ScreenPicture& picture) {
  picture.time = clock_.now();
  if (!open_) {
    return lose(fmt::format("{} is not open.", name()));
  }
  // Stamped before it is read: a file that is written meanwhile is noticed at the next grab.
  std::error_code error;
  Stamp stamp{due(picture.time), {}, 0};
  stamp.bytes = fs::file_size(stamp.path, error);
  if (!error) {
    stamp.modified = fs::last_write_time(stamp.path, error);
  }
  if (error) {
    return lose(fmt::format("The picture {} can't be read ({}); put it back or choose another.", stamp.path.string(),
                            error.message()));
  }
  if (shown_ == stamp) {
    return GrabOutcome::unchanged;
  }

  auto read = read_picture(stamp.path);
  if (!read) {
    return lose(read.error().message);
  }
  const auto part = watched_part(config_.view, read->size(), fmt::format("the picture {}", stamp.path.string()));
  if (!part) {
    return lose(part.error().message);
  }
  picture.bgr = (*read)(*part);
  picture.origin_px = part->tl();
  picture.monitor = {.width_px = read->cols, .height_px = read->rows};
  picture.in_front.reset();
  shown_ = std::move(stamp);
  return GrabOutcome::changed;
}

std::string PictureGrabber::name() const {
  return fmt::format("picture {}", config_.path.string());
}

}  // namespace telehug
