// SPDX-License-Identifier: Apache-2.0
//
// What the passive daemon tells people: answers on the local socket, events for those who watch, the log.
#include <fmt/core.h>

#include "common/names.hpp"
#include "daemon/log_touch.hpp"
#include "daemon/metric_table.hpp"
#include "daemon/status_parts.hpp"
#include "jacket_status.hpp"
#include "passive_daemon.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

template <typename Ids>
Json id_list(const Ids& ids) {
  Json list = Json::array();
  for (const std::uint8_t id : ids)
    list.push_back(id);
  return list;
}

Json felt_json(const Felt& felt) {
  return {{"event_sequence", felt.touch_sequence},
          {"contact", felt.contact_id},
          {"phase", name_of(felt.phase)},
          {"box", felt.box},
          {"outcome", name_of(felt.outcome)},
          {"actuators", id_list(felt.actuators)},
          {"received_time_ns", felt.received_time_ns},
          {"driven_time_ns", felt.driven_time_ns}};
}

}  // namespace

void PassiveDaemon::answer_commands() {
  control_->on("status", [this](const Json&) { return status(); });
  control_->on("metrics", [this](const Json&) { return Json{{"openmetrics", open_metrics(status(), metrics_)}}; });
  control_->on("hug", [this](const Json& request) { return order_hug(request); });
  control_->on("jacket", [this](const Json& request) { return describe_jacket(request); });
  control_->on("jacket_trial", [this](const Json& request) { return order_trial(request); });
  stop_.serve(*control_);
  consent_.serve(*control_, [this] { bell_.put(true); });
}

Json PassiveDaemon::problems(const DriveThreadState& now, const std::vector<ConnectionStatus>& connections) const {
  Json list = Json::array();
  add_jacket_problems(list, now.link);
  add_pair_ends(list, connections);
  if (stop_.stopped()) list.push_back(problem_json("stopped here: " + stop_.reason(), "run `telehug resume`"));
  if (const Json problem = stop_.problem(); !problem.is_null()) list.push_back(problem);
  for (const ConnectionStatus& connection : connections)
    if (connection.stopped_by_peer) list.push_back(peer_stop_problem_json(connection));
  add_safety_problems(list, now);
  for (const std::string& pair : left_out_)
    list.push_back(problem_json(pair, "the other pairs work; start telehug-passive again when it is mended"));
  add_absences(list, Side::passive, connections);
  reload_notes_.add_problems(list);
  return list;
}

Json PassiveDaemon::status() const {
  const DriveThreadState now = state();
  const auto connected = connections();
  const bool armed = now.link.state == LinkState::armed;
  const bool refused = !refusal_text(consent_.consent(), wall_time()).empty();
  Json counters = metrics_.counters_json();
  count_connections(counters, connected);
  add_safety_counters(counters, now.safety);
  counters["jacket_reconnects"] = now.link.reconnects;
  counters["jacket_frames_sent"] = now.link.frames_sent;
  counters["jacket_frames_received"] = now.link.frames_received;
  counters["jacket_malformed_frames"] = now.link.malformed_frames;
  counters["jacket_nacks"] = now.link.nacks;

  Json answer = {{"side", "passive"},
                 {"version", version},
                 {"session", session_},
                 {"uptime_s", std::chrono::duration<double>(clock_.now() - started_).count()},
                 {"state", now.stopped             ? "stopped"
                           : !armed                ? "fault"
                           : refused               ? "paused"
                           : !any_alive(connected) ? "waiting"
                                                   : "ok"},
                 {"problems", problems(now, connected)},
                 {"jacket", jacket_json(profile_.name, now.link, now.running)},
                 {"counters", counters},
                 {"latency_ms", metrics_.latencies_json()}};
  add_safety_status(answer, now);
  add_connections(answer, connected);
  add_panel(answer);
  answer["today"] = touches_today_.json(wall_time());
  pages_.add_status(answer);
  if (now.last_felt) {
    answer["last_touch"] = felt_json(*now.last_felt);
    answer["last_touch"]["gesture"] = name_of(now.last_gesture);
  }
  return answer;
}

void PassiveDaemon::tell_watchers() {
  const auto senders = senders_.all();
  GivenAnswer answer;
  while (felt_.pop(answer)) {
    if (answer.felt.phase == Phase::down && answer.felt.outcome == FeltOutcome::driven) touches_today_.add(wall_time());
    const auto of = std::ranges::find(senders, answer.sender, [](const auto& sender) { return sender->number; });
    log_touch(name_of(answer.felt.outcome), answer.felt.phase, answer.felt.contact_id, answer.felt.box,
              of != senders.end() ? (*of)->name() : "");
    if (!control_->has_watchers()) continue;
    Json event = felt_json(answer.felt);
    event["event"] = "felt";
    event["side"] = "passive";
    if (of != senders.end() && (*of)->membership().pair) event["sender"] = (*of)->name();
    control_->broadcast(std::move(event));
  }
  const DriveThreadState now = state();
  const LogFields ready{.stage = "jacket", .message_id = message_id::jacket_ready};
  if (now.link.state == LinkState::armed && !now.link.answers) {
    say_jacket_.say(
        spdlog::level::info,
        fmt::format("jacket on {}: it answers nothing, so whether it is there is not known", now.link.device), ready);
  } else if (now.link.state == LinkState::armed) {
    say_jacket_.say(spdlog::level::info,
                    fmt::format("jacket ready: {}, firmware {}, {} motors", now.link.device, now.link.firmware_version,
                                now.link.motor_count),
                    ready);
  } else if (!now.link.problem.empty()) {  // else it has only begun
    say_jacket_.say(spdlog::level::warn, fmt::format("no jacket answers on {}: {}", now.link.device, now.link.problem),
                    {.stage = "jacket", .message_id = message_id::jacket_absent});
  }
}

}  // namespace telehug
