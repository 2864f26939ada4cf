// SPDX-License-Identifier: Apache-2.0
#include "capture/recording.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace telehug {
namespace fs = std::filesystem;

Recording::Recording(RecordingSettings settings, const Clock& clock, SleepUntil sleep)
    : settings_(std::move(settings)), clock_(clock), sleep_(std::move(sleep)) {}

Status Recording::open() {
  if (open_) return Done{};
  wanted_ = true;
  retry_.tried(clock_.now());
  if (Status loaded = load(); !loaded) {
    last_error_ = loaded.error().message;
    return loaded;
  }
  open_ = true;
  start_ = clock_.now();
  next_ = 0;
  return Done{};
}

void Recording::close() {
  first_sequence_ += next_;
  next_ = 0;
  open_ = false;
  wanted_ = false;
}

std::string Recording::name() const {
  return fmt::format("recording {}", settings_.folder.string());
}

Status Recording::load() {
  std::vector<Timestamp> times;
  std::error_code ignored;
  if (fs::exists(settings_.folder / "rig.toml", ignored) || !settings_.part.empty()) {
    Result<RigDirectory> rig = open_rig_directory(settings_.folder);
    if (!rig) return rig.error();
    const RigPart* part = rig->part(settings_.part.empty() ? "sequence" : settings_.part);
    if (part == nullptr && settings_.part.empty()) part = rig->part("frames");
    if (part == nullptr) {
      return Error{fmt::format("{} has no part called '{}'; a recording's parts are frames, hard and sequence",
                               settings_.folder.string(), settings_.part)};
    }
    frames_ = part->frames;
    times = part->times;
  } else {
    frames_ = pictures_in(settings_.folder);
    std::vector<std::string> faults;
    const fs::path csv = settings_.folder / "times.csv";
    if (fs::exists(csv, ignored)) times = read_times(csv, frames_, faults);
    if (!faults.empty()) return Error{fmt::format("{}", fmt::join(faults, "\n"))};
  }
  if (frames_.empty()) {
    return Error{fmt::format("{}: there is no .jpg or .png picture to replay", settings_.folder.string())};
  }

  cv::Mat first;
  if (Status read = reader_.read(frames_.front().picture, first); !read) return read;
  size_ = {first.cols, first.rows};

  period_ = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1.0 / settings_.fps));
  offsets_.clear();
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    offsets_.push_back(times.empty() ? period_ * static_cast<Duration::rep>(i) : times[i] - times.front());
  }
  if (offsets_.size() > 1) period_ = offsets_.back() / static_cast<Duration::rep>(offsets_.size() - 1);
  return Done{};
}

Timestamp Recording::due(std::size_t index) const {
  const Duration round = offsets_.back() + period_;
  return start_ + round * static_cast<Duration::rep>(index / frames_.size()) + offsets_[index % frames_.size()];
}

ReadOutcome Recording::read(Frame& frame, Duration timeout) {
  const Timestamp deadline = clock_.now() + timeout;
  if (!open_) return try_again(deadline);
  if (!settings_.loop && next_ >= frames_.size()) return ReadOutcome::ended;
  if (settings_.real_time) {
    if (!wait_until(due(next_), deadline, clock_, sleep_)) return ReadOutcome::timeout;
    const Timestamp now = clock_.now();
    while ((settings_.loop || next_ + 1 < frames_.size()) && due(next_ + 1) <= now)
      ++next_;
  }
  const std::size_t index = next_++;
  const RigFrame& picture = frames_[index % frames_.size()];
  frame_name_ = picture.name;
  if (const Status read = reader_.read(picture.picture, frame.bgr, rows_); !read) {
    last_error_ = read.error().message;
    return ReadOutcome::broken;
  }
  frame.rows = rows_;
  frame.sequence = first_sequence_ + index;
  frame.time = due(index);
  return ReadOutcome::frame;
}

ReadOutcome Recording::try_again(Timestamp deadline) {
  if (!wanted_) {
    last_error_ = name() + " is closed";
    wait_until(deadline, deadline, clock_, sleep_);
    return ReadOutcome::lost;
  }
  if (wait_until(retry_.next(clock_.now()), deadline, clock_, sleep_) && open()) return ReadOutcome::timeout;
  return ReadOutcome::lost;
}

}  // namespace telehug
