// SPDX-License-Identifier: Apache-2.0
//
// The active daemon's touch thread: from the camera's frame to the event that goes out.
#include <algorithm>
#include <thread>

#include "active_daemon.hpp"

namespace telehug {
namespace {

constexpr Duration longest_wait_for_a_frame = 50ms;  // heartbeats go out between frames
constexpr Duration resting_round = 20ms;
constexpr Duration state_interval = 100ms;

}  // namespace

void ActiveDaemon::touch_loop() {
  while (!ending_) {
    const Timestamp now = clock_.now();
    wearers_.adopt();
    for (const auto& wearer : wearers_.adopted())
      hear(*wearer, now);
    serve_hugs(now);
    adopt_rig();
    adopt_camera();
    if (camera_wanted(now)) {
      take_frame();
    } else {
      rest();
    }
    if (rig_) fingers_.put(rig_->pipeline.contacts(), rig_->pipeline.time());
    tell_state(now);
    notifier_.alive(now);
  }
  camera_->close();
  touches_.hug().break_off();
  publish(touches_.build(clock_.now()), 0);
}

void ActiveDaemon::adopt_rig() {
  auto fresh = new_rig_.try_take();
  if (!fresh) return;
  publish(touches_.build(clock_.now()), 0);  // what the old one's fingers touched is over
  rig_ = *std::move(fresh);
  map_ = {};
}

void ActiveDaemon::adopt_camera() {
  auto fresh = new_camera_.try_take();
  if (!fresh) return;
  camera_->close();
  camera_ = *std::move(fresh);
  camera_lost_ = false;
}

void ActiveDaemon::hear(ConnectedWearer& wearer, Timestamp now) {
  HugInbox& hugs = wearer.connection.beside().hugs();
  if (const auto heard = wearer.connection.serve(now)) hugs.observe(*heard);
  if (const auto hug = hugs.take()) shown_hugs_.push({*hug, wearer.membership().pair ? wearer.name() : "The wearer"});
}

bool ActiveDaemon::anybody_listens(Timestamp now) {
  return std::ranges::any_of(wearers_.adopted(), [now](const auto& wearer) { return wearer->listens(now); });
}

bool ActiveDaemon::camera_wanted(Timestamp now) {
  if (setup_->camera().wanted()) {  // who touches dots touches nobody
    if (rig_) rig_->face->want(false);
    judge_sending(false);
    return false;
  }
  // Switched off by hand, the camera is not needed; covered by another window the chat may be back at once.
  const bool touches_go_out =
      rig_ && anybody_listens(now) && !stop_.stopped() && sending_switch_.mode() != SendingMode::off;
  const bool used_here = rig_ && (local_touch_.on() || fingers_.wanted()) && !stop_.stopped();
  if (!touches_go_out && !used_here) recording_over_ = false;
  if (rig_) rig_->face->want(touches_go_out && !recording_over_);
  // Before it is known where the remote person is, fingers mean nothing to the other side.
  const bool screen_known = touches_go_out && rig_->face->has_looked();
  judge_sending(screen_known);
  return (screen_known || used_here) && !recording_over_;
}

// What touches the screen is meant for a page of this PC.
bool ActiveDaemon::used_by_page() const {
  return fingers_.wanted() || setup_->camera().touched_here();
}

void ActiveDaemon::take_frame() {
  const std::uint64_t before = frame_.sequence;
  if (!camera_->is_open()) {
    frame_.sequence = 0;
    (void)camera_->open();  // read() says why it could not
  }
  camera_->need_rows(rig_->pipeline.rows_needed());
  const ReadOutcome outcome = camera_->read(frame_, longest_wait_for_a_frame);
  rig_->face->update(map_);
  judge_sending((sending_ || withholding_) && !stop_.stopped());  // the read may have taken its time
  if (outcome == ReadOutcome::lost && !camera_lost_) camera_losses_.add();
  // One that was opened again is there with its first picture.
  if (outcome != ReadOutcome::timeout) camera_lost_ = outcome == ReadOutcome::lost;
  switch (outcome) {
    case ReadOutcome::frame:
      camera_latency_.record(clock_.now() - frame_.time);
      if (before != 0 && frame_.sequence > before + 1) frames_missed_.add(frame_.sequence - before - 1);
      publish(rig_->pipeline.process(frame_, map_, sending_), frame_.sequence);
      hold_back();
      return;
    case ReadOutcome::broken:
      frames_broken_.add();
      break;
    case ReadOutcome::timeout:
      break;
    case ReadOutcome::ended:
      recording_over_ = true;
      camera_->close();
      break;
    case ReadOutcome::lost:
      std::this_thread::sleep_for(resting_round);
      break;
  }
  publish(rig_->pipeline.process_nothing(map_, sending_), frame_.sequence);
}

void ActiveDaemon::rest() {
  camera_->close();
  camera_lost_ = false;
  if (rig_) rig_->face->update(map_);
  publish(rig_ ? rig_->pipeline.process_nothing(map_, false) : touches_.build(clock_.now()), frame_.sequence);
  setup_->camera().let_go();
  std::this_thread::sleep_for(resting_round);
}

void ActiveDaemon::judge_sending(bool screen_known) {
  const bool sends = screen_known && sending_switch_.judge(rig_->face->view(), used_by_page()) == SendingVerdict::sends;
  sending_ = sends;
  withholding_ = screen_known && !sends;
}

// What touches the screen while touches don't go out touches nobody until it is lifted: a finger that closes the window
// in front of the chat, a cloth, a stroke on this PC's own programs.
void ActiveDaemon::hold_back() {
  const bool kept_here = sending_switch_.mode() == SendingMode::off || used_by_page();
  if (!withholding_ && !kept_here) return;
  rig_->pipeline.hold_back_contacts();
  for (const ContactState& contact : rig_->pipeline.contacts())
    if (contact.phase == Phase::down) ++own_state_.withheld;
}

// To everybody, also to who has stopped it: the ends of what they felt must reach them. False if it went out to nobody.
bool ActiveDaemon::send(const TouchEvent& event) {
  bool sent = false;
  for (const auto& wearer : wearers_.adopted())
    sent = wearer->connection.write(event) || sent;
  return sent;
}

void ActiveDaemon::publish(const TouchEvent* event, std::uint64_t frame_sequence) {
  if (rig_) local_touch_.put(rig_->pipeline.contacts(), rig_->pipeline.screen(), clock_.now());
  if (event == nullptr) return;
  const Timestamp started = clock_.now();
  if (!send(*event)) {
    publish_failed_.add();
    return;
  }
  const Timestamp published = clock_.now();
  publish_latency_.record(published - started);
  events_published_.add();
  if (!event->contacts.empty()) total_latency_.record(published - from_ns(event->frame_time_ns));
  for (const Contact& contact : event->contacts) {
    const SentTouch sent{event->sequence, event->frame_time_ns, frame_sequence, contact};
    own_state_.last_touch = sent;
    if (contact.phase == Phase::down) touches_published_.add();
    sent_touches_.push(sent);
  }
  // An up of a contact that left the grid stands only among the transitions.
  for (const Transition& transition : event->transitions) {
    const bool known = std::any_of(event->contacts.begin(), event->contacts.end(),
                                   [&](const Contact& contact) { return contact.id == transition.contact.id; });
    if (transition.event_sequence == event->sequence && !known) {
      sent_touches_.push({event->sequence, event->frame_time_ns, frame_sequence, transition.contact});
    }
  }
}

void ActiveDaemon::tell_state(Timestamp now) {
  if (now - told_state_ < state_interval) return;
  const std::unique_lock lock(state_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  told_state_ = now;
  own_state_.camera_open = camera_->is_open() && !camera_lost_;
  own_state_.camera_lost = camera_lost_;
  own_state_.recording_over = recording_over_;
  own_state_.camera_problem = camera_->last_error();
  own_state_.camera_setup = camera_->is_open() ? camera_->setup() : "";
  own_state_.face = rig_ ? rig_->face : nullptr;
  own_state_.detector = rig_ ? rig_->detector : "";
  own_state_.model = rig_ ? rig_->model : "";
  own_state_.screen = rig_ ? std::optional(rig_->pipeline.screen()) : std::nullopt;
  own_state_.calibrated = rig_ ? rig_->calibrated : "";
  own_state_.reach = rig_ ? rig_->reach : nullptr;
  own_state_.knows_background = !rig_ || rig_->pipeline.knows_background();
  for (const auto& wearer : wearers_.adopted())
    wearer->connection.tell_state(now);
  own_state_.picture = rig_ && own_state_.camera_open ? rig_->pipeline.verdict() : FrameVerdict::good;
  if (rig_) own_state_.nobody = rig_->pipeline.nobody_touched();
  own_state_.camera_drift = rig_ ? rig_->pipeline.camera_drift() : DriftState::steady;
  state_ = own_state_;
}

}  // namespace telehug
