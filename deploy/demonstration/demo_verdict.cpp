// SPDX-License-Identifier: Apache-2.0
#include "demo_verdict.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace telehug {
namespace {

// From the camera's frame to the motor, and from the last command to silence, on a busy PC.
constexpr std::int64_t latest_start_ns = 500'000'000;
constexpr std::int64_t latest_end_ns = 800'000'000;
constexpr double tail_s = 0.15;  // a contact is held this long when its finger is lost for a frame or two

double distance_fh(const Actuator& actuator, int box) {
  const BodyPoint middle{((box - 1) % standard_columns - (standard_columns - 1) / 2.0) * standard_box_side_fh,
                         ((box - 1) / standard_columns + 0.5) * standard_box_side_fh};
  return std::hypot(actuator.place.x_fh - middle.x_fh, actuator.place.y_fh - middle.y_fh);
}

// Those that may take part in a touch of the box: that serve it, or, where touches are felt at their places, that lie
// about it: two boxes' sides away at the most, or any, where none is so near.
std::vector<int> actuators_of(int box, const JacketProfile& profile) {
  constexpr double farthest_fh = 2 * standard_box_side_fh;
  double nearest_fh = farthest_fh;
  for (const Actuator& actuator : profile.actuators)
    nearest_fh = std::min(nearest_fh, distance_fh(actuator, box));
  const bool anything_near = nearest_fh < farthest_fh;
  std::vector<int> ids;
  for (const Actuator& actuator : profile.actuators) {
    const bool serves = std::ranges::find(actuator.boxes, box) != actuator.boxes.end();
    const bool lies_near = !anything_near || distance_fh(actuator, box) <= farthest_fh;
    if (profile.rendering == Rendering::boxes ? serves : lies_near) ids.push_back(actuator.id);
  }
  std::ranges::sort(ids);
  return ids;
}

// All that serve a box must be driven; of those about a place some.
bool as_wanted(const std::vector<int>& driven, const std::vector<int>& wanted, const JacketProfile& profile) {
  if (wanted.empty()) return true;
  if (profile.rendering == Rendering::boxes) return driven == wanted;
  return !driven.empty() && std::ranges::includes(wanted, driven);
}

int channel_of(int id, const JacketProfile& profile) {
  const auto found = std::ranges::find(profile.actuators, id, &Actuator::id);
  return found == profile.actuators.end() ? -1 : found->channel;
}

struct Span {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

// When each channel may run: while a box that it serves is touched.
std::map<int, std::vector<Span>> allowed_spans(const DemoRecord& record, const JacketProfile& profile) {
  std::map<int, std::vector<Span>> spans;
  for (const PublishedTouch& touch : record.published) {
    if (touch.phase == "up") continue;
    for (const int id : actuators_of(touch.box, profile)) {
      spans[channel_of(id, profile)].push_back({touch.frame_time_ns, touch.frame_time_ns + latest_end_ns});
    }
  }
  return spans;
}

bool ran_within(const std::vector<PinChange>& pins, int channel, const Span& span) {
  constexpr std::int64_t off = -1;
  std::int64_t started_ns = off;
  for (const PinChange& change : pins) {
    if (change.channel != channel) continue;
    if (change.on) {
      started_ns = change.time_ns;
    } else if (started_ns != off) {
      if (started_ns <= span.end_ns && change.time_ns >= span.begin_ns) return true;
      started_ns = off;
    }
  }
  return started_ns != off && started_ns <= span.end_ns;
}

void check_answers(const DemoRecord& record, const JacketProfile& profile, std::vector<std::string>& faults) {
  for (const PublishedTouch& touch : record.published) {
    if (touch.phase != "down" || touch.frame_time_ns > record.judged_until_ns) continue;
    const auto answered = std::ranges::find_if(record.felt, [&](const FeltAnswer& answer) {
      return answer.contact == touch.contact && answer.phase == "down";
    });
    const std::vector<int> wanted = actuators_of(touch.box, profile);
    if (answered == record.felt.end()) {
      faults.push_back(fmt::format("contact {} on box {} was published and never answered", touch.contact, touch.box));
    } else if (answered->outcome != "driven") {
      faults.push_back(
          fmt::format("contact {} on box {} was not felt: {}", touch.contact, touch.box, answered->outcome));
    } else if (!as_wanted(answered->actuators, wanted, profile)) {
      faults.push_back(fmt::format("box {} was felt at actuators {} instead of {}", touch.box,
                                   fmt::join(answered->actuators, ","), fmt::join(wanted, ",")));
    }
  }
}

void check_pins(const DemoRecord& record, const JacketProfile& profile, std::vector<std::string>& faults) {
  for (const PublishedTouch& touch : record.published) {
    if (touch.phase != "down" || touch.frame_time_ns > record.judged_until_ns) continue;
    const Span span{touch.frame_time_ns, touch.frame_time_ns + latest_start_ns};
    std::vector<int> still;
    const std::vector<int> wanted = actuators_of(touch.box, profile);
    for (const int id : wanted)
      if (!ran_within(record.pins, channel_of(id, profile), span)) still.push_back(id);
    const bool some_ran = still.size() < wanted.size();
    if (still.empty() || (some_ran && profile.rendering == Rendering::places)) continue;
    for (const int id : still) {
      faults.push_back(
          fmt::format("contact {} on box {}: the pin of motor {} did not move", touch.contact, touch.box, id));
    }
  }
  const auto allowed = allowed_spans(record, profile);
  std::set<int> running;
  for (const PinChange& change : record.pins) {
    change.on ? (void)running.insert(change.channel) : (void)running.erase(change.channel);
    const auto spans = allowed.find(change.channel);
    const bool may = spans != allowed.end() && std::ranges::any_of(spans->second, [&](const Span& span) {
                       return change.time_ns >= span.begin_ns && change.time_ns <= span.end_ns;
                     });
    if (!may)
      faults.push_back(fmt::format("the pin of channel {} moved although no box of it was touched", change.channel));
  }
  for (const int channel : running)
    faults.push_back(fmt::format("the pin of channel {} was still on in the end", channel));
}

}  // namespace

std::vector<std::string> faults(const DemoRecord& record, const JacketProfile& profile) {
  std::vector<std::string> found;
  if (record.published.empty()) found.emplace_back("no touch was published");
  if (record.dropped_events > 0)
    found.push_back(fmt::format("{} events were not heard of here", record.dropped_events));
  check_answers(record, profile, found);
  check_pins(record, profile, found);
  return found;
}

TruthComparison compare_with_truth(const DemoRecord& record, const TruthOfFrame& truth, double fps) {
  TruthComparison comparison;
  const auto tail_frames = static_cast<std::uint64_t>(std::ceil(tail_s * fps));
  for (const PublishedTouch& touch : record.published) {
    if (touch.phase == "up" || touch.frame == 0) continue;
    const auto point = truth(touch.frame);
    if (!point) {
      bool near_a_touch = false;
      for (std::uint64_t frame = touch.frame - std::min(tail_frames, touch.frame); frame <= touch.frame + tail_frames;
           ++frame) {
        near_a_touch = near_a_touch || truth(frame).has_value();
      }
      comparison.without_touch += near_a_touch ? 0 : 1;
      continue;
    }
    const double horizontal = std::abs(touch.screen.x_mm - point->x_mm);
    const double vertical = std::abs(touch.screen.y_mm - point->y_mm);
    comparison.mean_horizontal_mm += horizontal;
    comparison.mean_vertical_mm += vertical;
    comparison.worst_mm = std::max({comparison.worst_mm, horizontal, vertical});
    ++comparison.frames;
  }
  if (comparison.frames > 0) {
    comparison.mean_horizontal_mm /= comparison.frames;
    comparison.mean_vertical_mm /= comparison.frames;
  }
  return comparison;
}

}  // namespace telehug
