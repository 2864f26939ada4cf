// SPDX-License-Identifier: Apache-2.0
//
// The wearer looks at the jacket and tries it.
#include "common/names.hpp"
#include "jacket/body_picture.hpp"
#include "jacket/body_svg.hpp"
#include "passive_daemon.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

Json actuator_json(const Actuator& actuator, const std::vector<std::uint8_t>& running) {
  return {{"id", actuator.id},
          {"name", actuator.name},
          {"kind", actuator.kind == ActuatorKind::motor ? "motor" : "heater"},
          {"channel", actuator.channel},
          {"side", actuator.side == BodySide::front ? "front" : "back"},
          {"x_fh", actuator.place.x_fh},
          {"y_fh", actuator.place.y_fh},
          {"max_strength", actuator.max_strength},
          {"enabled", actuator.enabled},
          {"running", std::ranges::find(running, actuator.id) != running.end()}};
}

}  // namespace

Json PassiveDaemon::describe_jacket(const Json& request) const {
  const DriveThreadState now = state();
  Json actuators = Json::array();
  for (const Actuator& actuator : profile_.actuators)
    actuators.push_back(actuator_json(actuator, now.running));
  Json answer = {{"side", "passive"},
                 {"name", profile_.name},
                 {"device", now.link.device},
                 {"answers", now.link.state == LinkState::armed},
                 {"actuators", std::move(actuators)},
                 {"picture",
                  {{"front", body_picture(profile_, now.running, BodySide::front)},
                   {"back", body_picture(profile_, now.running, BodySide::back)}}}};
  if (now.trial) answer["trial"] = {{"number", now.trial->number}, {"outcome", name_of(now.trial->outcome)}};
  if (request.value("svg", false)) answer["svg"] = body_svg(profile_, now.running);
  return answer;
}

Json PassiveDaemon::order_trial(const Json& request) {
  const auto wanted = read_trial_request(request, profile_);
  if (!wanted) return {{"error", wanted.error().message}};
  const DriveThreadState now = state();
  if (now.stopped) return {{"error", "everything is stopped (" + now.stop_reason + "): `telehug resume` first"}};
  if (now.link.state != LinkState::armed)
    return {{"error", "no jacket answers on " + now.link.device + ": " + now.link.problem}};
  const std::uint64_t number = ++trials_ordered_;
  trial_request_.put({number, *wanted});
  bell_.put(true);
  return {{"side", "passive"}, {"trial", number}};
}

// Drive thread. The wearer asks as one more sender, whom this thread itself vouches for.
void PassiveDaemon::follow_trial(Timestamp now) {
  if (const auto ordered = trial_request_.try_take()) {
    trial_.begin(ordered->request, now);
    own_state_.trial = TrialOutcome{ordered->number, FeltOutcome::driven};
  }
  const auto drive = trial_.drive(now, std::chrono::milliseconds(config_.safety.drive_ms));
  if (!drive) return;
  safety_.on_heartbeat(wearers_number, now);
  const SafetyVerdict verdict = safety_.apply(wearers_number, Drives{*drive}, now);
  if (verdict.outcome == FeltOutcome::driven) return;
  own_state_.trial->outcome = verdict.outcome;
  trial_.end();
}

}  // namespace telehug
