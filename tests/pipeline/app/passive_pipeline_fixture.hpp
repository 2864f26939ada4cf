// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <optional>
#include <vector>

#include "doubles/example_messages.hpp"
#include "doubles/fake_clock.hpp"
#include "doubles/fake_jacket_link.hpp"
#include "passive_pipeline.hpp"
#include "safety/safety_stage.hpp"
#include "unit/jacket/jacket_builders.hpp"

namespace telehug {

// The pipeline with a jacket of three motors (box 1; box 2; boxes 2 and 3) and a sender whose heartbeat has just come.
class PassivePipelineTest : public testing::Test {
 protected:
  PassivePipelineTest() {
    safety.tick(clock.now());
    beat();
  }

  // The sender's heartbeat, without any delay.
  void beat() {
    Heartbeat heartbeat = example_heartbeat();
    heartbeat.sent_time_ns = to_ns(clock.now());
    safety.on_heartbeat(0, clock.now());
    pipeline.observe(heartbeat, clock.now());
  }

  // The sender's next event, with this contact if any; its way takes `delay`.
  const FeltAnswers& touch(std::optional<Contact> contact, Duration delay = {}) {
    event = event_of(event.sequence + 1, {});
    event.session = session;
    event.sent_time_ns = to_ns(clock.now());
    if (contact) {
      event.contacts.push_back(*contact);
      if (contact->phase != Phase::move) event.transitions.push_back(transition_of(event.sequence, *contact));
    }
    clock.advance(delay);
    if (delay > Duration{}) safety.on_heartbeat(0, clock.now());
    return pipeline.process(event, clock.now());
  }
  const FeltAnswers& touch(int box, Phase phase = Phase::down) { return touch(contact_in(box, 1, phase)); }
  void pass(Duration time) {
    clock.advance(time);
    pipeline.tick(clock.now());
    safety.tick(clock.now());
  }
  [[nodiscard]] std::vector<int> running() const { return jacket.running(clock.now()); }
  std::uint64_t counter(const char* name) { return metrics.counter(name).value(); }

  FakeClock clock;
  FakeJacket jacket;
  MetricsRegistry metrics;
  JacketProfile profile = profile_of({motor(1, {}, {1}), motor(2, {}, {2}), motor(3, {}, {2, 3})});
  SafetyStage safety{std::make_unique<FakeJacketLink>(jacket), profile, SafetyLimits{}};
  SenderTurn turn{false};
  PassivePipeline pipeline{0, profile, safety, turn, 200ms, other_session, clock, metrics};
  SessionId session = example_session;
  TouchEvent event;
};

// Takes everything and remembers nothing.
class ForgetfulLink final : public JacketLink {
 public:
  void poll(Timestamp) override {}
  bool send(const MotorCommands& commands, Timestamp) override {
    sent_ += commands.size();
    return true;
  }
  bool heat(const HeaterCommands&, Timestamp) override { return false; }
  void stop_all(Timestamp) override {}
  [[nodiscard]] const LinkStatus& status() const override { return status_; }
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  LinkStatus status_{.state = LinkState::armed, .device = "forgetful", .problem = {}, .motor_count = 16};
  std::size_t sent_ = 0;
};

}  // namespace telehug
