// SPDX-License-Identifier: Apache-2.0
#include "passive_pipeline.hpp"

#include <algorithm>

namespace telehug {

PassivePipeline::PassivePipeline(SenderNumber sender, const JacketProfile& profile, SafetyStage& safety,
                                 SenderTurn& turn, Duration drive_duration, const SessionId& session,
                                 const Clock& clock, MetricsRegistry& metrics)
    : sender_(sender),
      safety_(safety),
      turn_(turn),
      session_(session),
      clock_(clock),
      renderer_(profile, drive_duration),
      accepted_(metrics.counter("events_accepted")),
      lost_(metrics.counter("events_lost")),
      doubled_(metrics.counter("events_doubled")),
      overtaken_(metrics.counter("events_overtaken")),
      recovered_(metrics.counter("transitions_recovered")),
      stale_(metrics.counter("events_stale")),
      order_latency_(metrics.latency("order")),
      plan_latency_(metrics.latency("plan")),
      drive_latency_(metrics.latency("drive")) {}

const FeltAnswers& PassivePipeline::process(const TouchEvent& event, Timestamp received) {
  answers_.clear();
  const OrderedTouch* touch = order_.accept(event);
  const bool stale = touch != nullptr && staleness_.is_stale(event, received);
  const Timestamp ordered = clock_.now();
  if (touch != nullptr && touch->new_session) forget_touches(ordered);
  const bool touches = touch != nullptr && !(event.contacts.empty() && touch->transitions.empty());
  const bool its_turn = !stale && turn_.take(sender_, touches, ordered);
  if (touch != nullptr && stale) refuse(FeltOutcome::stale, *touch, received);
  if (touch != nullptr && !stale && !its_turn) {
    forget_touches(ordered);
    refuse(FeltOutcome::another_sender, *touch, received);
  }
  if (touch != nullptr && its_turn) {
    note_gesture(*touch);
    const TouchEvent& allowed = muted_.leave_out(*touch, safety_.permission().muted_boxes);
    const JacketPlan& plan = renderer_.plan(allowed, muted_.fresh(), ordered);
    const Timestamp planned = clock_.now();
    const SafetyVerdict verdict = safety_.apply(sender_, plan.drives, planned);
    answer(plan, verdict, event, received);
    plan_latency_.record(planned - ordered);
    drive_latency_.record(clock_.now() - planned);
  }
  order_latency_.record(ordered - received);
  tell_counters();
  return answers_;
}

void PassivePipeline::tick(Timestamp now) {
  const Drives& drives = renderer_.tick(now);
  if (!drives.empty()) safety_.apply(sender_, drives, now);
}

void PassivePipeline::forget_touches(Timestamp now) {
  renderer_.reset();
  known_.clear();
  safety_.all_off(sender_, now);
}

void PassivePipeline::note_gesture(const OrderedTouch& touch) {
  for (const Transition& transition : touch.transitions)
    last_gesture_ = transition.contact.gesture;
  for (const Contact& contact : touch.event->contacts)
    last_gesture_ = contact.gesture;
}

void PassivePipeline::answer(const JacketPlan& plan, const SafetyVerdict& verdict, const TouchEvent& event,
                             Timestamp received) {
  for (const ContactAnswer& planned : plan.answers) {
    FeltOutcome outcome = planned.outcome;
    if (outcome == FeltOutcome::driven) {
      outcome = verdict.outcome_at({planned.actuators.data(), planned.actuators.size()});
    }
    ContactAnswer given = planned;
    given.actuators.erase(std::remove_if(given.actuators.begin(), given.actuators.end(),
                                         [&verdict](std::uint8_t id) { return verdict.refuses(id); }),
                          given.actuators.end());
    give(given, outcome, event, received);
  }
  for (const Transition& muted : muted_.left_out()) {
    const Contact& contact = muted.contact;
    give({muted.event_sequence, contact.id, contact.phase, contact.box, {}, {}}, FeltOutcome::muted, event, received);
  }
}

void PassivePipeline::give(const ContactAnswer& planned, FeltOutcome outcome, const TouchEvent& event,
                           Timestamp received) {
  if (answers_.size() == answers_.capacity() || !is_news(planned, outcome)) return;
  Felt& felt = answers_.emplace_back();
  felt.session = session_;
  felt.touch_session = event.session;
  felt.touch_sequence = planned.touch_sequence;
  felt.contact_id = planned.contact_id;
  felt.phase = planned.phase;
  felt.box = planned.box;
  felt.outcome = outcome;
  if (outcome == FeltOutcome::driven) felt.actuators = planned.actuators;
  felt.received_time_ns = to_ns(received);
  felt.driven_time_ns = outcome == FeltOutcome::driven ? to_ns(clock_.now()) : 0;
}

void PassivePipeline::refuse(FeltOutcome outcome, const OrderedTouch& touch, Timestamp received) {
  for (const Transition& transition : touch.transitions) {
    if (answers_.size() == answers_.capacity()) return;
    Felt& felt = answers_.emplace_back();
    felt.session = session_;
    felt.touch_session = touch.event->session;
    felt.touch_sequence = transition.event_sequence;
    felt.contact_id = transition.contact.id;
    felt.phase = transition.contact.phase;
    felt.box = transition.contact.box;
    felt.outcome = outcome;
    felt.received_time_ns = to_ns(received);
  }
}

// A contact is answered when it goes down or up, and when it moves to another box or is felt differently.
bool PassivePipeline::is_news(const ContactAnswer& answer, FeltOutcome outcome) {
  const auto known = std::ranges::find(known_, answer.contact_id, &Known::contact);
  const bool remembered = known != known_.end();
  if (answer.phase == Phase::up) {
    if (remembered) known_.erase(known);
    return true;
  }
  if (remembered && answer.phase == Phase::move && known->box == answer.box && known->outcome == outcome) return false;
  if (remembered) {
    *known = {answer.contact_id, answer.box, outcome};
  } else {
    if (known_.size() == known_.capacity()) known_.erase(known_.begin());
    known_.push_back({answer.contact_id, answer.box, outcome});
  }
  return true;
}

// The counters are those of all senders together: what is new is added. (Lost ones become fewer when one comes late;
// unsigned numbers add that up as well.)
void PassivePipeline::tell_counters() {
  const TouchOrderCounters& order = order_.counters();
  accepted_.add(order.accepted - told_order_.accepted);
  lost_.add(order.lost - told_order_.lost);
  doubled_.add(order.duplicates - told_order_.duplicates);
  overtaken_.add(order.overtaken - told_order_.overtaken);
  recovered_.add(order.recovered - told_order_.recovered);
  stale_.add(staleness_.stale_count() - told_stale_);
  told_order_ = order;
  told_stale_ = staleness_.stale_count();
}

}  // namespace telehug
