// SPDX-License-Identifier: Apache-2.0
#include "touch/contact_tracker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace telehug {
namespace {

double squared(double value) {
  return value * value;
}

double seconds_between(Timestamp from, Timestamp to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

const ContactStates& ContactTracker::update(const FingerObservations& fingers, Timestamp frame_time, Scene scene) {
  forget_ended();

  AssignmentCosts costs{};
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    for (std::size_t f = 0; f < fingers.size(); ++f)
      costs[t][f] = cost(tracks_[t], fingers[f].screen, seconds_between(tracks_[t].seen_at, frame_time));
  }
  const Assignment assignment = assign(costs, tracks_.size(), fingers.size(), squared(options_.gate_mm));
  Taken taken{};
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (assignment[t] == unassigned) {
      miss(tracks_[t], frame_time, scene);
    } else {
      taken[assignment[t]] = true;
      follow(tracks_[t], fingers[assignment[t]], frame_time, scene);
    }
  }
  for (std::size_t f = 0; f < fingers.size() && tracks_.size() < max_contacts && scene == Scene::steady; ++f) {
    if (!taken[f]) begin(fingers[f], frame_time);
  }
  steady_frame_ = scene == Scene::steady ? std::optional(frame_time) : std::nullopt;
  collect();
  return states_;
}

const ContactStates& ContactTracker::pass(Timestamp now) {
  forget_ended();
  for (Track& track : tracks_) {
    const bool ends = now - track.seen_at >= options_.up_after_no_picture;
    if (ends) track.missed_frames = options_.up_after_missed_frames;
    if (!track.contact) continue;
    track.contact->phase = ends ? Phase::up : Phase::move;
    track.contact->speed_mm_s = 0;
    if (ends) track.contact->frame_time = now;
  }
  collect();
  return states_;
}

void ContactTracker::collect() {
  states_.clear();
  hovering_.clear();
  for (const Track& track : tracks_) {
    if (track.contact) states_.push_back(*track.contact);
    if (!track.contact && track.missed_frames == 0)
      hovering_.push_back({track.seen, track.filter.touching(), track.in_air_since});
  }
  std::ranges::sort(states_, {}, &ContactState::id);
}

// A finger whose contact ended may still be there, in the air.
void ContactTracker::forget_ended() {
  for (Track& track : tracks_) {
    if (!track.contact || track.contact->phase != Phase::up) continue;
    track.in_air_since = track.contact->frame_time;
    track.contact.reset();
  }
  const auto lost = [&](const Track& track) {
    const int most = options_.every_finger_touches ? 1 : options_.up_after_missed_frames;
    return !track.contact && track.missed_frames >= most;
  };
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), lost), tracks_.end());
}

// How far, squared, a point is from where the track's finger would be if it went on as before; in the air it may also
// have landed where it was.
double ContactTracker::cost(const Track& track, const ScreenPoint& point, double seconds) const {
  if (options_.every_finger_touches)
    return squared(point.x_mm - track.contact->screen.x_mm) + squared(point.y_mm - track.contact->screen.y_mm);
  const double foot_x = track.seen.x_mm - options_.camera.foot.x_mm;
  const double foot_y = track.seen.y_mm - options_.camera.foot.y_mm;
  const double r = std::max(1.0, std::hypot(foot_x, foot_y));
  const auto apart = [&](double x_mm, double y_mm) {
    const double radial = (x_mm * foot_x + y_mm * foot_y) / r;
    const double across = (x_mm * foot_y - y_mm * foot_x) / r;
    return squared(radial / 3) + squared(across);
  };
  const double dx = point.x_mm - track.seen.x_mm;
  const double dy = point.y_mm - track.seen.y_mm;
  const double going_on = apart(dx - track.x_mm_s * seconds, dy - track.y_mm_s * seconds);
  if (track.contact) return going_on;
  return std::min(going_on, apart(dx, dy));
}

void ContactTracker::follow(Track& track, const FingerObservation& finger, Timestamp frame_time, Scene scene) {
  const double seconds = seconds_between(track.seen_at, frame_time);
  if (seconds > 0) {
    track.x_mm_s = (finger.screen.x_mm - track.seen.x_mm) / seconds;
    track.y_mm_s = (finger.screen.y_mm - track.seen.y_mm) / seconds;
  }
  track.seen = finger.screen;
  track.seen_at = frame_time;
  track.missed_frames = 0;
  if (scene == Scene::disturbed) {
    track.filter.skip(finger);
  } else {
    track.filter.update(finger, seconds, known_width_);
  }
  const bool decides = scene == Scene::steady && !options_.every_finger_touches;
  if (!track.contact) {
    if (decides && track.filter.touching() > options_.down_above) touch_down(track, frame_time);
    return;
  }
  ContactState& contact = *track.contact;
  if (decides && track.filter.touching() < options_.up_below) {
    contact.phase = Phase::up;
    contact.speed_mm_s = 0;
    contact.frame_time = frame_time;
    return;
  }
  const ScreenPoint place =
      options_.every_finger_touches ? finger.screen : track.smoothing.update(finger.screen, seconds);
  const double path_mm = std::hypot(place.x_mm - contact.screen.x_mm, place.y_mm - contact.screen.y_mm);
  if (seconds > 0) contact.speed_mm_s = path_mm / seconds;
  contact.phase = Phase::move;
  contact.screen = place;
  if (!options_.every_finger_touches) contact.touching = track.filter.touching();
  contact.frame_time = frame_time;
  learn_width(track);
}

void ContactTracker::miss(Track& track, Timestamp frame_time, Scene scene) {
  ++track.missed_frames;
  if (!track.contact) return;
  const Duration unseen = frame_time - track.seen_at;
  bool ends = track.missed_frames >= options_.up_after_missed_frames || unseen >= options_.up_after;
  if (!options_.every_finger_touches) {
    const double seconds = std::max(1e-3, seconds_between(track.seen_at, frame_time));
    track.contact->touching = track.filter.touching_unseen(track.missed_frames, seconds);
    const bool waits = track.missed_frames == 1 && track.filter.touching() > options_.wait_above;
    ends = ends || (!waits && track.contact->touching < options_.up_below);
  }
  if (scene == Scene::disturbed) ends = unseen >= options_.up_after_disturbed;
  track.contact->phase = ends ? Phase::up : Phase::move;
  track.contact->speed_mm_s = 0;
  if (ends) track.contact->frame_time = frame_time;
}

void ContactTracker::begin(const FingerObservation& finger, Timestamp frame_time) {
  const auto unseen = steady_frame_ ? std::optional(seconds_between(*steady_frame_, frame_time)) : std::nullopt;
  tracks_.push_back({{options_.camera, options_.filter, known_width_, finger, unseen},
                     ContactSmoothing(options_.smoothing),
                     finger.screen,
                     frame_time,
                     frame_time,
                     0,
                     0,
                     0,
                     std::nullopt,
                     0});
  Track& track = tracks_.back();
  if (options_.every_finger_touches || track.filter.touching() > options_.down_above) touch_down(track, frame_time);
}

void ContactTracker::touch_down(Track& track, Timestamp frame_time) {
  track.smoothing.reset();
  track.contact = ContactState{next_id_, Phase::down, track.smoothing.update(track.seen, 0), 0, frame_time};
  track.widths_learned = 0;
  if (++next_id_ == 0) next_id_ = 1;
}

// A contact that has lasted tells how wide the fingers of these people are, each at most as much as a few frames.
void ContactTracker::learn_width(Track& track) {
  constexpr int lasts_frames = 4;
  constexpr int most_frames = 12;
  constexpr double gain = 0.08;
  if (options_.every_finger_touches || track.filter.touching() < 0.95 || !track.filter.width()) return;
  ++track.widths_learned;
  if (track.widths_learned < lasts_frames || track.widths_learned > most_frames) return;
  known_width_.log_mm += gain * (*track.filter.width() - known_width_.log_mm);
  known_width_.sd += gain * (options_.filter.known_width - known_width_.sd);
}

}  // namespace telehug
