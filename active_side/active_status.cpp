// SPDX-License-Identifier: Apache-2.0
//
// What the active daemon tells people: answers on the local socket, events for those who watch, the log.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "active_daemon.hpp"
#include "body_map_json.hpp"
#include "common/names.hpp"
#include "daemon/log_touch.hpp"
#include "daemon/metric_table.hpp"
#include "daemon/status_parts.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

Json touch_json(const SentTouch& touch) {
  const Contact& contact = touch.contact;
  return {{"event_sequence", touch.event_sequence},
          {"frame_time_ns", touch.frame_time_ns},
          {"frame", touch.frame_sequence},
          {"contact", contact.id},
          {"phase", name_of(contact.phase)},
          {"gesture", name_of(contact.gesture)},
          {"box", contact.box},
          {"columns", contact.grid.columns},
          {"rows", contact.grid.rows},
          {"x_mm", contact.screen.x_mm},
          {"y_mm", contact.screen.y_mm},
          {"x_fh", contact.body.x_fh},
          {"y_fh", contact.body.y_fh},
          {"speed_mm_s", contact.speed_mm_s}};
}

Json felt_json(const Felt& felt) {
  Json actuators = Json::array();
  for (const std::uint8_t id : felt.actuators)
    actuators.push_back(id);
  return {{"event", "felt"},
          {"side", "active"},
          {"event_sequence", felt.touch_sequence},
          {"contact", felt.contact_id},
          {"phase", name_of(felt.phase)},
          {"box", felt.box},
          {"outcome", name_of(felt.outcome)},
          {"actuators", actuators}};
}

// Why the camera's pictures are not looked at; torn ones are single ones, which are only counted.
Json picture_problem(FrameVerdict verdict) {
  switch (verdict) {
    case FrameVerdict::good:
    case FrameVerdict::torn:
      return {};
    case FrameVerdict::other_size:
      return problem_json("the camera's pictures have another size than those it was calibrated with",
                          "set [camera] width_px and height_px as they were, or calibrate again");
    case FrameVerdict::blank:
      return problem_json("the camera sees nothing but black, white or one colour",
                          "uncover it, turn on a light, or run `telehug-active camera tune`");
    case FrameVerdict::frozen:
      return problem_json("the camera delivers the same picture again and again", "unplug it and plug it in again");
    case FrameVerdict::turned:
      return problem_json("the camera's picture is upside down or mirrored",
                          "turn it back as it was, or calibrate again");
  }
  return {};
}

Json touch_screen_json(const TouchThreadState& state) {
  Json screen = {{"width_mm", state.screen->width_mm},
                 {"height_mm", state.screen->height_mm},
                 {"width_px", state.screen->width_px},
                 {"height_px", state.screen->height_px},
                 {"calibrated", state.calibrated}};
  if (!state.reach) return screen;
  // To a tenth, since it is told four times a second.
  Json outline = Json::array();
  for (const ScreenPoint& corner : *state.reach)
    outline.push_back({std::round(corner.x_mm * 10) / 10, std::round(corner.y_mm * 10) / 10});
  screen["reach_mm"] = std::move(outline);
  return screen;
}

// What keeps fingers from being seen.
Json camera_problems(const TouchThreadState& state) {
  Json list = Json::array();
  if (state.camera_lost) list.push_back(problem_json(state.camera_problem, "plug the camera in, or correct [camera]"));
  if (state.camera_drift == DriftState::moved || state.camera_drift == DriftState::unseen) {
    list.push_back(
        problem_json(drift_text(state.camera_drift), "set it up again on the page that `telehug open` shows"));
  }
  if (state.camera_open && !state.knows_background) {
    list.push_back(problem_json("telehug learns how bezel and desk look with nobody there; no touch begins meanwhile",
                                "keep your hands away from the screen for a second"));
  }
  if (const Json picture = picture_problem(state.picture); !picture.is_null()) list.push_back(picture);
  return list;
}

Json wearer_problem(const ConnectionStatus& wearer, bool stopped_here) {
  if (wearer.stopped_by_peer) return peer_stop_problem_json(wearer);
  if (!wearer.peer.alive || !wearer.told) return {};
  const SideStatus& told = *wearer.told;
  if (told.stopped && !stopped_here) {
    return problem_json(
        wearer.name() + " is stopped: " + told.reason,
        "whoever stopped it runs `telehug resume`; this side, too, may have, before it was started anew");
  }
  if (told.ready || told.stopped) return {};
  return problem_json(wearer.name() + " is not ready: " + told.reason, "see `telehug status` on the other PC");
}

// A face that is held for a moment is no problem yet.
bool no_face(const FaceState& face) {
  return face.map.version == 0 && !face.problem.empty();
}

}  // namespace

void ActiveDaemon::answer_commands() {
  control_->on("status", [this](const Json&) { return status(); });
  control_->on("metrics", [this](const Json&) { return Json{{"openmetrics", open_metrics(status(), metrics_)}}; });
  control_->on("face", [this](const Json& request) { return order_face(request); });
  control_->on("hug", [this](const Json& request) { return order_hug(request); });
  stop_.serve(*control_);
  sending_switch_.serve(*control_);
}

Json ActiveDaemon::order_face(const Json& request) {
  const auto given = request.find("order");
  const std::string name = given != request.end() && given->is_string() ? given->get<std::string>() : "";
  const auto order = name == "next"    ? std::optional(FaceOrder::next)
                     : name == "pin"   ? std::optional(FaceOrder::pin)
                     : name == "unpin" ? std::optional(FaceOrder::unpin)
                                       : std::nullopt;
  if (!order) return {{"error", "\"order\" is one of next, pin, unpin"}};
  std::shared_ptr<FaceWorker> worker;
  {
    const std::lock_guard lock(state_mutex_);
    worker = state_.face;
  }
  if (!worker) return {{"error", "there is no calibration, so the screen is not looked at"}};
  const FaceState face = worker->state();
  if (!face.open) return {{"error", "the screen is looked at only while a peer is connected and touches may go out"}};
  const bool seen = face.map.version != 0;
  if (order == FaceOrder::next && face.others == 0) return {{"error", "no other face is seen"}};
  if (order == FaceOrder::pin && !seen) return {{"error", "no face is followed that could be pinned"}};
  worker->order(*order);
  return {{"face", name}};
}

Json ActiveDaemon::sending_json(const TouchThreadState& state) const {
  if (!state.face) return {{"name", name_of(sending_switch_.mode())}, {"on", false}, {"why", "not calibrated"}};
  const SendingVerdict verdict = sending_switch_.judge(state.face->view(), used_by_page());
  Json sending = {{"name", name_of(sending_switch_.mode())}, {"on", verdict == SendingVerdict::sends}};
  switch (verdict) {
    case SendingVerdict::sends:
      break;
    case SendingVerdict::switched_off:
      sending["why"] = "switched off";
      break;
    case SendingVerdict::used_here:
      sending["why"] = "a page uses the fingers";
      break;
    case SendingVerdict::not_seen:
      sending["why"] = "the pinned window is not seen";
      break;
    case SendingVerdict::covered:
      sending["why"] = "another window covers the pinned one";
      break;
    case SendingVerdict::never_pinned:
      sending["why"] = "no window is pinned";
      break;
  }
  return sending;
}

Json ActiveDaemon::problems(const TouchThreadState& state, const FaceState& face,
                            const std::vector<ConnectionStatus>& connections) const {
  Json list = Json::array();
  {
    const std::lock_guard lock(words_mutex_);
    if (!rig_problem_.empty())
      list.push_back(
          problem_json(rig_problem_, "set it up on the page that `telehug open` shows, or correct the file"));
    if (!setup_problem_.empty())
      list.push_back(problem_json(setup_problem_, "set up another camera, or start telehug-active again"));
    if (!face_note_.empty()) list.push_back(problem_json(face_note_, "telehug works, but not as well as it could"));
    if (!desktop_problem_.empty())
      list.push_back(problem_json(desktop_problem_, "or turn off [overlay] show and [sending] hotkey"));
  }
  reload_notes_.add_problems(list);
  if (!face.remark.empty()) list.push_back(problem_json(face.remark, "nothing needs to be done: all works"));
  if (stop_.stopped()) list.push_back(problem_json("stopped here: " + stop_.reason(), "run `telehug resume`"));
  if (const Json problem = stop_.problem(); !problem.is_null()) list.push_back(problem);
  for (const std::string& pair : left_out_)
    list.push_back(problem_json(pair, "the other pairs work; start telehug-active again when it is mended"));
  add_pair_ends(list, connections);
  for (const ConnectionStatus& wearer : connections)
    if (const Json problem = wearer_problem(wearer, stop_.stopped()); !problem.is_null()) list.push_back(problem);
  add_absences(list, Side::active, connections);
  for (const Json& problem : camera_problems(state))
    list.push_back(problem);
  if (setup_->camera_hangs()) {
    list.push_back(problem_json("the camera does not answer, and the set-up waits for it",
                                "unplug it and plug it in again; if that does not help, start telehug-active again"));
  }
  if (feedback_) {
    if (const std::string problem = feedback_->problem(); !problem.empty())
      list.push_back(problem_json("the actuator at the toucher's finger: " + problem,
                                  "check its cable, or turn it off in [feedback]; it is tried again by itself"));
  }
  for (const LocalTouchState& output : local_touch_.states()) {
    if (output.problem.empty()) continue;
    list.push_back(problem_json(output.problem, "or turn it off in [local_touch]; it is tried again by itself"));
  }
  if (state.recording_over) list.push_back(problem_json("the recording is over", "start again to replay it"));
  if (no_face(face)) {
    list.push_back(problem_json(face.problem, "touches are not sent until a face is found; check [body_map]"));
  } else if (face.open && sending_switch_.judge(state.face->view(), used_by_page()) == SendingVerdict::never_pinned) {
    list.push_back(problem_json("touches don't go out: it is not known whether the video chat is in front",
                                "run `telehug send on`; on X11 [body_map] window pins the window of the chat"));
  }
  return list;
}

Json ActiveDaemon::status() const {
  TouchThreadState state;
  {
    const std::lock_guard lock(state_mutex_);
    state = state_;
  }
  const FaceState face = state.face ? state.face->state() : FaceState{};
  const auto connected = connections();
  const bool stopped = !why_stopped().empty();
  const bool alive = any_alive(connected);
  const bool fault = state.camera_lost || state.camera_drift == DriftState::moved ||
                     !picture_problem(state.picture).is_null() || !state.face || no_face(face);

  Json counters = metrics_.counters_json();
  counters["touches_without_face"] = state.nobody.no_face;
  counters["touches_with_old_map"] = state.nobody.map_too_old;
  counters["touches_outside_grid"] = state.nobody.outside_grid;
  counters["touches_withheld"] = state.withheld;
  count_connections(counters, connected);
  std::uint64_t hugs_received = 0;
  std::uint64_t hugs_not_shown = 0;
  for (const auto& wearer : wearers_.all()) {
    hugs_received += wearer->connection.beside().hugs().received();
    hugs_not_shown += wearer->connection.beside().hugs().not_shown();
  }
  counters["hugs_received"] = hugs_received;
  counters["hugs_not_shown"] = hugs_not_shown;

  const bool setting_up = setup_->camera().wanted();
  const char* open_why = state.camera_open      ? alive ? "a peer is connected" : "this PC uses the touches"
                         : setting_up           ? "a set-up uses it"
                         : state.recording_over ? "the recording is over"
                         : state.camera_lost    ? "it can't be used"
                         : stopped              ? "stopped"
                         : !state.face          ? "not calibrated"
                                                : "nobody needs it";
  std::string camera_name;
  {
    const std::lock_guard lock(words_mutex_);
    camera_name = camera_name_;
  }
  Json answer = {
      {"side", "active"},
      {"version", version},
      {"session", session_},
      {"uptime_s", std::chrono::duration<double>(clock_.now() - started_).count()},
      {"state", stopped  ? "stopped"
                : fault  ? "fault"
                : !alive ? "waiting"
                         : "ok"},
      {"problems", problems(state, face, connected)},
      {"camera",
       {{"name", camera_name}, {"open", state.camera_open}, {"why", open_why}, {"problems", camera_problems(state)}}},
      {"screen", {{"name", face.screen}, {"open", face.open}}},
      {"face",
       {{"found", face.map.version != 0},
        {"held", face.map.version != 0 && !face.problem.empty()},
        {"map_version", face.map.version},
        {"finder", face.finder},
        {"others", face.others},
        {"pinned", face.pinned}}},
      {"sending", sending_json(state)},
      {"detector", {{"name", state.detector}, {"model", state.model}}},
      {"counters", counters},
      {"latency_ms", metrics_.latencies_json()}};
  add_connections(answer, connected);
  if (Json hug = last_hug_json(); !hug.is_null()) answer["last_hug"] = std::move(hug);
  if (!state.camera_setup.empty()) answer["camera"]["setup"] = state.camera_setup;
  if (face.map.version != 0 && face.scale) answer["face"]["places_px"] = body_map_json(face.map, *face.scale);
  for (const LocalTouchState& output : local_touch_.states())
    answer["local_touch"][output.name] = output.open ? "on" : output.problem.empty() ? "waits for the camera" : "fails";
  if (state.screen) answer["touch_screen"] = touch_screen_json(state);
  if (state.last_touch) answer["last_touch"] = touch_json(*state.last_touch);
  {
    const std::lock_guard lock(words_mutex_);
    answer["calibrated"] = rig_problem_.empty();
  }
  pages_.add_status(answer);
  return answer;
}

void ActiveDaemon::tell_watchers() {
  SentTouch touch;
  while (sent_touches_.pop(touch)) {
    touched_box_.sent(touch.contact);
    live_touches_.sent(touch.contact, clock_.now());
    log_touch("sent", touch.contact.phase, touch.contact.id, touch.contact.box, "");
    if (!control_->has_watchers()) continue;
    Json event = touch_json(touch);
    event["event"] = "touch";
    event["side"] = "active";
    control_->broadcast(std::move(event));
  }
  for (const auto& wearer : wearers_.all()) {
    Felt felt;
    while (wearer->felt.pop(felt)) {
      touched_box_.felt(felt);
      live_touches_.felt(felt, wearer->membership().pair ? wearer->name() : "");
      if (feedback_) feedback_->felt(felt);
      log_touch(name_of(felt.outcome), felt.phase, felt.contact_id, felt.box, wearer->name());
      Json event = felt_json(felt);
      if (wearer->membership().pair) event["wearer"] = wearer->name();
      control_->broadcast(std::move(event));
    }
  }

  if (feedback_) {
    feedback_->set_stopped(stop_.stopped());
    const std::string problem = feedback_->problem();
    say_feedback_.say(problem.empty() ? spdlog::level::info : spdlog::level::warn,
                      problem.empty() ? "the actuator at the toucher's finger is ready"
                                      : "the actuator at the toucher's finger: " + problem,
                      {.stage = "feedback"});
  }

  TouchThreadState state;
  {
    const std::lock_guard lock(state_mutex_);
    state = state_;
  }
  if (state.recording_over && !told_recording_over_) {
    control_->broadcast({{"event", "recording_over"}, {"side", "active"}});
  }
  told_recording_over_ = state.recording_over;
  const FaceState face = state.face ? state.face->state() : FaceState{};
  show_touched_box(face, state.face.get());
  if (state.camera_lost) {
    say_camera_.say(spdlog::level::warn, state.camera_problem,
                    {.stage = "camera", .message_id = message_id::camera_lost});
  } else if (state.camera_open) {
    say_camera_.say(spdlog::level::info, "camera open", {.stage = "camera", .message_id = message_id::camera_open});
  } else {
    say_camera_.say(spdlog::level::info, "camera closed", {.stage = "camera"});
  }
  if (face.open || no_face(face)) {
    say_face_.say(no_face(face) ? spdlog::level::warn : spdlog::level::info,
                  no_face(face) ? face.problem : "face found", {.stage = "face"});
  }
}

}  // namespace telehug
