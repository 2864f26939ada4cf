// SPDX-License-Identifier: Apache-2.0
//
// What the active daemon does on the desktop that it runs on: the outline of the touched box, the hotkey, touches for
// this PC's own programs.
#include <string>
#include <utility>

#include "active_daemon.hpp"
#include "body_map/vitruvian_grid.hpp"

namespace telehug {
namespace {

constexpr Duration desktop_interval = 1s;

}  // namespace

void ActiveDaemon::tell_local_touch() {
  std::string works;
  std::string problems;
  for (const LocalTouchState& output : local_touch_.states()) {
    if (output.open) works += (works.empty() ? "" : ", ") + output.name;
    if (!output.problem.empty()) problems += (problems.empty() ? "" : "; ") + output.problem;
  }
  if (!works.empty() || !problems.empty()) {
    say_local_touch_.say(problems.empty() ? spdlog::level::info : spdlog::level::warn,
                         problems.empty() ? "touches are used on this PC: " + works : problems,
                         {.stage = "local_touch"});
  }
}

void ActiveDaemon::show_touched_box(const FaceState& face, FaceWorker* worker) {
  if (!overlay_) return;
  if (face.map.version == 0) touched_box_.clear();
  const auto& shown = touched_box_.shown();
  const auto box = shown ? box_rect(face.map, shown->box) : std::nullopt;
  if (clock_.now() < glows_until_ && face.map.version != 0 && face.scale) {
    const cv::Rect2d person_px = face.scale->to_px(face.map.face) | face.scale->to_px(face.map.visible);
    overlay_->show({cv::Point(person_px.tl()), cv::Point(person_px.br())}, OverlayState::hugged);
  } else if (box && face.scale) {
    const cv::Rect2d box_px = face.scale->to_px(*box);
    overlay_->show({cv::Point(box_px.tl()), cv::Point(box_px.br())},
                   shown->felt ? OverlayState::felt : OverlayState::touched);
  } else {
    overlay_->hide();
  }
  if (worker != nullptr) worker->leave_out(overlay_->areas());
}

// What this desktop does for us besides showing the chat; what is not there is looked for once a second.
void ActiveDaemon::serve_desktop() {
  if (hotkey_ && hotkey_->is_open() && hotkey_->pressed()) sending_switch_.toggle();
  const Timestamp now = clock_.now();
  if (now - desktop_served_ < desktop_interval) return;
  desktop_served_ = now;
  std::string problem;
  const auto note = [&problem](const Status& opened, const std::string& last_error) {
    if (problem.empty()) problem = opened ? last_error : opened.error().message;
  };
  if (overlay_) note(overlay_->open(), overlay_->last_error());
  if (hotkey_) note(hotkey_->open(), hotkey_->last_error());
  if (!problem.empty()) say_desktop_.say(spdlog::level::warn, problem, {.stage = "desktop"});
  const std::lock_guard lock(words_mutex_);
  desktop_problem_ = std::move(problem);
}

}  // namespace telehug
