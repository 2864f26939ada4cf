// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_desk.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "service/log.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_orders = 16;

std::string text_in(const Json& request, const char* key) {
  const auto given = request.find(key);
  return given != request.end() && given->is_string() ? given->get<std::string>() : "";
}

Json refused(std::string why) {
  return {{"error", std::move(why)}};
}

bool is_order(const std::string& order) {
  return std::ranges::find(setup_orders, order) != std::end(setup_orders);
}

SetupChoice chosen_before(const SetupDeskSettings& settings) {
  SetupChoice choice;
  if (const auto cameras = settings.cameras(); !cameras.empty()) choice.camera = cameras.front().source;
  choice.screen = settings.config.rig.screen;
  choice.monitor = settings.config.body_map.monitor;
  if (settings.config.touch.model == "thesis") choice.mode = SetupMode::thesis;
  return choice;
}

Json choice_json(const SetupChoice& choice) {
  return {{"camera", choice.camera},
          {"width_mm", choice.screen.width_mm},
          {"height_mm", choice.screen.height_mm},
          {"monitor", choice.monitor},
          {"mode", name_of(choice.mode)}};
}

}  // namespace

SetupDesk::SetupDesk(SetupDeskSettings settings, ControlServer& control)
    : settings_(std::move(settings)),
      clock_(settings_.tools.clock),
      handover_(clock_),
      picture_(clock_),
      monitors_(settings_.monitors),
      usual_(chosen_before(settings_)),
      followed_(clock_.now()),
      went_on_(followed_) {
  control.on("setup", [this](const Json& request) { return obey(request); });
}

SetupDesk::~SetupDesk() {
  {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;
  }
  if (worker_.joinable()) worker_.join();
}

std::optional<Json> SetupDesk::news() {
  const std::lock_guard lock(mutex_);
  const bool hangs = silent();
  if (!std::exchange(changed_, false) && hangs == told_hanging_) return std::nullopt;
  told_hanging_ = hangs;
  Json news = state_;
  if (hangs) news["hangs"] = true;
  return news;
}

bool SetupDesk::camera_hangs() const {
  const std::lock_guard lock(mutex_);
  return silent();
}

bool SetupDesk::silent() const {
  return runs_ && clock_.now() - alive_ > longest_silence;
}

void SetupDesk::followed() {
  const std::lock_guard lock(mutex_);
  followed_ = clock_.now();
}

Result<std::unique_ptr<FrameSource>> SetupDesk::open(const SetupChoice& choice) const {
  CaptureSettings capture = settings_.tools.capture;
  if (choice.tuned) capture.webcam_setup.preset = CameraPreset::tuned;
  return settings_.tools.open(choice.camera, capture);
}

std::optional<SetupChoice> SetupDesk::take_saved() {
  const std::lock_guard lock(mutex_);
  return std::exchange(saved_, std::nullopt);
}

// --- the control server's thread ---

Json SetupDesk::obey(const Json& request) {
  const std::string order = text_in(request, "order");
  if (order == "list") return list();
  if (order == "start") return start(request);
  if (order == "cancel") {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;
    if (!runs_) {
      state_ = {{"stage", "idle"}};
      changed_ = true;
    }
    return {{"side", "active"}, {"setup", "cancel"}};
  }
  if (is_order(order)) return pass_on(order, request);
  return refused(fmt::format("\"order\" is one of list, start, cancel, {}", fmt::join(setup_orders, ", ")));
}

Json SetupDesk::list() {
  Json answer = offers_json(settings_.cameras(), monitors_.newest());
  const std::lock_guard lock(mutex_);
  answer["side"] = "active";
  answer["chosen"] = choice_json(usual_);
  return answer;
}

Json SetupDesk::start(const Json& request) {
  if (std::string stopped = settings_.why_stopped(); !stopped.empty()) return refused(std::move(stopped));
  SetupChoice choice;
  {
    const std::lock_guard lock(mutex_);
    if (silent()) return refused("the camera hangs: unplug it, and plug it in again");
    if (runs_) return refused("a set-up runs already, perhaps on another page: end it there first");
    choice = usual_;
  }
  if (request.contains("camera")) choice.camera = text_in(request, "camera");
  const auto cameras = settings_.cameras();
  if (std::ranges::find(cameras, choice.camera, &OfferedCamera::source) == cameras.end())
    return refused("that camera is not there any more: plug it in, or choose another one");
  if (const Status read = read_choice(request, choice); !read) return refused(read.error().message);

  if (worker_.joinable()) worker_.join();  // it has ended
  {
    const std::lock_guard lock(mutex_);
    runs_ = true;
    cancelled_ = false;
    orders_.clear();
    followed_ = went_on_ = alive_ = clock_.now();
  }
  tell("waiting", Json::object());
  worker_ = std::thread([this, choice] { work(choice); });
  return {{"side", "active"}, {"setup", "start"}};
}

Json SetupDesk::pass_on(const std::string& what, const Json& request) {
  SetupOrder order{what, 0, {}};
  const std::lock_guard lock(mutex_);
  if (!runs_) return refused("no set-up runs: begin one");
  if (orders_.size() >= most_orders) return refused("not so fast");
  if (what == "repeat") {
    const auto dot = request.find("dot");
    if (dot == request.end() || !dot->is_number_unsigned()) return refused("\"dot\" is the number of a dot, from 0");
    order.dot = dot->get<std::size_t>();
  }
  if (what == "begin") {
    order.choice = usual_;
    if (const Status read = read_choice(request, order.choice); !read) return refused(read.error().message);
    const ScreenSize& screen = order.choice.screen;
    if (!(screen.width_mm > 0) || !(screen.height_mm > 0))
      return refused("how large is the visible screen? \"width_mm\" and \"height_mm\" say it");
    if (settings_.config.touch.model == "thesis" && order.choice.mode != SetupMode::thesis)
      return refused(
          "[touch] model of the configuration wants the thesis' model: choose its two dots, or set it to "
          "\"default\" and start anew");
  }
  orders_.push_back(std::move(order));
  went_on_ = clock_.now();
  return {{"side", "active"}, {"setup", what}};
}

// --- the set-up's thread ---

void SetupDesk::work(const SetupChoice& choice) {
  Json end;
  try {
    end = carry_out(choice);
  } catch (const std::exception& problem) {
    end = {{"why", "failed"}, {"problem", problem.what()}};
  }
  handover_.give_back();
  if (end["why"] == "failed")
    log_about({.stage = "setup"}, spdlog::level::warn, "setting up: " + end["problem"].get<std::string>());
  tell_end(std::move(end));
}

// Who is told of the end can begin anew.
void SetupDesk::tell_end(Json end) {
  end["stage"] = "ended";
  const std::lock_guard lock(mutex_);
  state_ = std::move(end);
  changed_ = true;
  runs_ = false;
}

Json SetupDesk::carry_out(const SetupChoice& choice) {
  if (!handover_.take(longest_handover, [this] { return reason_to_end() == nullptr; })) {
    if (const char* why = reason_to_end()) return {{"why", why}, {"problem", ""}};
    return {{"why", "failed"}, {"problem", "telehug still uses the camera: start telehug-active again"}};
  }
  auto camera = settings_.tools.open(choice.camera, settings_.tools.capture);
  if (!camera) return {{"why", "failed"}, {"problem", camera.error().message}};

  const SetupRun* running = nullptr;
  SetupRun run(choice, *std::move(camera), settings_.tools, picture_,
               [this, &running] { return goes_on(running->state()); });
  running = &run;
  const char* why = nullptr;
  Json place;  // in the set-up
  while (why == nullptr) {
    for (const SetupOrder& order : take_orders())
      run.obey(order);
    if (!run.over()) run.turn();
    Json state = run.state();
    if (Json now = {state["step"], state["dot"]}; now != place) {
      place = std::move(now);
      const std::lock_guard lock(mutex_);
      went_on_ = clock_.now();
    }
    tell("running", std::move(state));
    why = run.saved() ? "saved" : run.over() ? "idle" : reason_to_end();
  }
  Json end = run.state();
  end["why"] = why;
  end["problem"] = "";
  const std::lock_guard lock(mutex_);
  if (run.saved()) saved_ = usual_ = *run.saved();
  return end;
}

const char* SetupDesk::reason_to_end() {
  if (!settings_.why_stopped().empty()) return "stopped";
  const std::lock_guard lock(mutex_);
  if (cancelled_) return "cancelled";
  if (clock_.now() - followed_ > longest_unfollowed) return "unfollowed";
  return clock_.now() - went_on_ > longest_idle ? "idle" : nullptr;
}

bool SetupDesk::goes_on(const Json& state) {
  tell("running", state);
  if (reason_to_end() != nullptr) return false;
  const std::lock_guard lock(mutex_);
  return std::ranges::find(orders_, "tune_end", &SetupOrder::what) == orders_.end();
}

std::vector<SetupOrder> SetupDesk::take_orders() {
  const std::lock_guard lock(mutex_);
  return std::exchange(orders_, {});
}

void SetupDesk::tell(const char* stage, Json state) {
  state["stage"] = stage;
  const std::lock_guard lock(mutex_);
  alive_ = clock_.now();
  if (state == state_) return;
  state_ = std::move(state);
  changed_ = true;
}

}  // namespace telehug
