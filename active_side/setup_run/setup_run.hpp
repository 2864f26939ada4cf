// SPDX-License-Identifier: Apache-2.0
//
// One set-up from the camera's first picture to the saved calibration: the camera looked at while it is turned and
// tuned, then a CalibrationSession. It has no thread: SetupDesk gives it one.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "capture/make_frame_source.hpp"
#include "common/clock.hpp"
#include "config/load.hpp"
#include "setup/calibration_session.hpp"
#include "setup_run/live_jpeg.hpp"
#include "setup_run/setup_choice.hpp"

namespace telehug {

// What a set-up uses. Clock and calls outlive it.
struct SetupTools {
  CaptureSettings capture;
  std::filesystem::path calibration_file;
  ConfigSources config;  // of this start, see remember_setup()
  std::function<Result<std::unique_ptr<FrameSource>>(const std::string& source, const CaptureSettings& settings)> open;
  V4l2Calls& calls;
  const Clock& clock;
};

struct SetupOrder {
  std::string what;     // one of setup_orders
  std::size_t dot = 0;  // repeat
  SetupChoice choice;   // begin
};

// confirm ... save: see CalibrationSession. begin: the screen's size is chosen, the pages are shown from now on; again:
// from the beginning. camera: back to looking at the camera. tune: search for the camera's settings; tune_next: what
// was asked for is done (hands away, then a finger on the screen); tune_end: no more.
inline constexpr std::string_view setup_orders[] = {"begin",  "camera", "confirm", "look_again", "back",    "skip",
                                                    "repeat", "save",   "tune",    "tune_next",  "tune_end"};

class SetupRun {
 public:
  // Told the state() whenever something takes long; false: that must end.
  using Tell = std::function<bool()>;

  // `choice.screen`: as far as it is known; the green band is that of a usual one otherwise. `picture` outlives it.
  SetupRun(SetupChoice choice, std::unique_ptr<FrameSource> camera, SetupTools tools, LiveJpeg& picture, Tell tell);
  ~SetupRun();
  SetupRun(const SetupRun&) = delete;
  SetupRun& operator=(const SetupRun&) = delete;

  // Looks at the next picture, waiting for it 100 ms at most; longer where a page of marks is looked at, where the
  // calibration is solved, and while settings are searched for.
  void turn();
  void obey(const SetupOrder& order);

  // Saved, cancelled by the session (nobody came), or the camera can't be used any more.
  [[nodiscard]] bool over() const;
  // What was saved.
  [[nodiscard]] const std::optional<SetupChoice>& saved() const noexcept { return saved_; }

  // setup_json() with the step "camera" before the session begins, and
  //   run   {camera: {source, name, fps, problem, has_settings}, chosen: {width_mm, height_mm, width_px, height_px,
  //         monitor, mode}, refusal: why the last order was not carried out, or "",
  //         tune: null or {phase: "empty", "finger", "search", "done" or "failed", progress, before, after, complete,
  //         problem}, saved: null or {calibration, settings, problem}: files; settings are not kept if there is a
  //         problem}
  [[nodiscard]] nlohmann::json state() const;

 private:
  struct TuneState;

  void begin(const SetupChoice& choice);
  void look_at_camera();
  void look(const cv::Mat& bgr, Timestamp now);
  void look_for_border(const cv::Mat& bgr, Timestamp now);
  void count_picture(Timestamp now);
  void save();
  void begin_tuning();
  void go_on_tuning();
  void search_settings();
  void end_tuning();
  [[nodiscard]] Status reopen(CameraPreset preset);
  [[nodiscard]] CalibrationSession new_session(const SetupChoice& choice) const;
  [[nodiscard]] nlohmann::json tune_json() const;

  SetupChoice choice_;
  std::unique_ptr<FrameSource> camera_;
  const SetupTools tools_;
  LiveJpeg& picture_;
  const Tell tell_;

  CalibrationSession session_;
  bool begun_ = false;  // false: the camera is looked at, and the session only looks for the screen's edge
  SetupState seen_;     // while the camera is looked at
  Frame frame_;
  std::string camera_problem_;
  std::deque<Timestamp> pictures_;  // of the last second
  std::string refusal_;
  std::unique_ptr<TuneState> tune_;
  nlohmann::json saved_files_;
  std::optional<SetupChoice> saved_;
};

// "2026-01-01T00:00:00Z"
[[nodiscard]] std::string setup_date();

}  // namespace telehug
