// SPDX-License-Identifier: Apache-2.0
#include "touch/contact_tracker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace telehug {
namespace {

double distance_mm(const ScreenPoint& a, const ScreenPoint& b) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm);
}

}  // namespace

const ContactStates& ContactTracker::update(const ScreenPoints& points, Timestamp frame_time, bool may_begin) {
  const auto ended = [](const Track& track) { return track.state.phase == Phase::up; };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), ended), tracks_.end());
  Taken point_taken{};
  Taken track_taken{};
  match(points, frame_time, point_taken, track_taken);
  end_or_hold(frame_time, track_taken);
  if (may_begin) begin(points, frame_time, point_taken);
  states_.clear();
  for (const Track& track : tracks_)
    states_.push_back(track.state);
  return states_;
}

// The nearest pair of a contact and a point first, until none is left within the gate.
void ContactTracker::match(const ScreenPoints& points, Timestamp frame_time, Taken& point_taken, Taken& track_taken) {
  while (true) {
    double nearest_mm = options_.gate_mm;
    std::size_t nearest_track = tracks_.size();
    std::size_t nearest_point = 0;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      for (std::size_t p = 0; p < points.size(); ++p) {
        if (track_taken[t] || point_taken[p]) continue;
        const double apart_mm = distance_mm(tracks_[t].state.screen, points[p]);
        if (apart_mm > nearest_mm || (apart_mm == nearest_mm && nearest_track < tracks_.size())) continue;
        nearest_mm = apart_mm;
        nearest_track = t;
        nearest_point = p;
      }
    }
    if (nearest_track == tracks_.size()) return;
    track_taken[nearest_track] = true;
    point_taken[nearest_point] = true;
    Track& track = tracks_[nearest_track];
    const double seconds = std::chrono::duration<double>(frame_time - track.state.frame_time).count();
    if (seconds > 0) track.state.speed_mm_s = nearest_mm / seconds;
    track.state.phase = Phase::move;
    track.state.screen = points[nearest_point];
    track.state.frame_time = frame_time;
    track.missed_frames = 0;
  }
}

void ContactTracker::end_or_hold(Timestamp frame_time, const Taken& track_taken) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (track_taken[t]) continue;
    Track& track = tracks_[t];
    ++track.missed_frames;
    const bool ends = track.missed_frames >= options_.up_after_missed_frames ||
                      frame_time - track.state.frame_time >= options_.up_after;
    track.state.phase = ends ? Phase::up : Phase::move;
    track.state.speed_mm_s = 0;
    if (ends) track.state.frame_time = frame_time;
  }
}

void ContactTracker::begin(const ScreenPoints& points, Timestamp frame_time, const Taken& point_taken) {
  for (std::size_t p = 0; p < points.size() && tracks_.size() < max_contacts; ++p) {
    if (point_taken[p]) continue;
    tracks_.push_back({{next_id_, Phase::down, points[p], 0, frame_time}, 0});
    if (++next_id_ == 0) next_id_ = 1;
  }
}

}  // namespace telehug
