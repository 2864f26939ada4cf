// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <memory>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "jacket/jacket_profile.hpp"
#include "muted_touches.hpp"
#include "rendering/jacket_renderer.hpp"
#include "safety/safety_stage.hpp"
#include "service/metrics.hpp"
#include "subscribe/sender_turn.hpp"
#include "subscribe/staleness.hpp"
#include "subscribe/touch_order.hpp"

namespace telehug {

using FeltAnswers = boost::container::static_vector<Felt, max_contacts + max_transitions>;

// From a touch event of one sender to the bytes for the jacket: every stage of the passive side but the two wires. One
// thread uses it, and those of the other senders.
class PassivePipeline {
 public:
  // `profile`, `safety`, `turn`, `clock`, `metrics` outlive it; all senders share them.
  PassivePipeline(SenderNumber sender, const JacketProfile& profile, SafetyStage& safety, SenderTurn& turn,
                  Duration drive_duration, const SessionId& session, const Clock& clock, MetricsRegistry& metrics);

  // An event that came at `received`, not after the clock's present time. Returns what to answer the sender: one for
  // each contact that went down or up or is felt differently than at the event before. Valid until the next call.
  const FeltAnswers& process(const TouchEvent& event, Timestamp received);

  // Goes on with what the last event told, between two of them. Call it every 10 ms, before the safety stage's own.
  void tick(Timestamp now);

  // A stamp of the sender that carries no touch: keeps the estimate of the way's delay fresh.
  void observe(const Heartbeat& heartbeat, Timestamp now) {
    staleness_.observe(heartbeat.session, heartbeat.sent_time_ns, now);
  }

  // What has touched so far is off and forgotten; the next event takes up what still may be felt.
  void forget_touches(Timestamp now);

  // What the newest contact of the last event that could be felt is, or was.
  [[nodiscard]] Gesture last_gesture() const noexcept { return last_gesture_; }

 private:
  void note_gesture(const OrderedTouch& touch);
  void answer(const JacketPlan& plan, const SafetyVerdict& verdict, const TouchEvent& event, Timestamp received);
  void refuse(FeltOutcome outcome, const OrderedTouch& touch, Timestamp received);
  void give(const ContactAnswer& planned, FeltOutcome outcome, const TouchEvent& event, Timestamp received);
  [[nodiscard]] bool is_news(const ContactAnswer& answer, FeltOutcome outcome);
  void tell_counters();

  const SenderNumber sender_;
  SafetyStage& safety_;
  SenderTurn& turn_;
  SessionId session_;
  const Clock& clock_;
  TouchOrder order_;
  Staleness staleness_;
  MutedTouches muted_;
  JacketRenderer renderer_;
  FeltAnswers answers_;
  Gesture last_gesture_ = Gesture::none;

  struct Known {
    std::uint32_t contact = 0;
    std::uint16_t box = 0;
    FeltOutcome outcome = FeltOutcome::driven;
  };
  boost::container::static_vector<Known, max_contacts> known_;
  TouchOrderCounters told_order_;
  std::uint64_t told_stale_ = 0;

  Counter& accepted_;
  Counter& lost_;
  Counter& doubled_;
  Counter& overtaken_;
  Counter& recovered_;
  Counter& stale_;
  LatencyHistogram& order_latency_;
  LatencyHistogram& plan_latency_;
  LatencyHistogram& drive_latency_;
};

}  // namespace telehug
