// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_run.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>

#include "setup/setup_json.hpp"
#include "setup_run/setup_memory.hpp"
#include "setup_run/tuning_with_finger.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr Duration longest_wait = 100ms;
constexpr Duration rest_without_camera = 50ms;
constexpr std::string_view webcam_prefix = "webcam:";
// A usual 24" monitor, for the green band while nobody has said how large the screen is.
constexpr ScreenSize usual_screen{530, 300, 0, 0};

bool is_webcam(const std::string& source) {
  return source.starts_with(webcam_prefix);
}

ScreenSize known_or_usual(ScreenSize screen) {
  return screen.width_mm > 0 && screen.height_mm > 0 ? screen : usual_screen;
}

SetupAdvice advice_of(const SetupState& seen, const ScreenSize& screen) {
  switch (seen.advice) {
    case SetupAdvice::no_picture:
    case SetupAdvice::too_dark:
    case SetupAdvice::no_border:
      return seen.advice;
    default:
      break;
  }
  if (!seen.border || !seen.green_band) return SetupAdvice::none;
  const ImagePoint& first = seen.border->points_px.front();
  const ImagePoint& last = seen.border->points_px.back();
  const double slope = (last.v_px - first.v_px) / (last.u_px - first.u_px);
  const BorderLine line{first.v_px - slope * first.u_px, slope};
  const bool upside_down = seen.green_band->top_px == green_band(screen, seen.image, true).top_px;
  const SetupAdvice advice = advice_of(turn_wanted(line, *seen.green_band, seen.image, upside_down));
  return advice == SetupAdvice::none ? SetupAdvice::good : advice;
}

}  // namespace

std::string setup_date() {
  return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)));
}

struct SetupRun::TuneState {
  enum class Phase { empty, finger, search, done, failed };
  Phase phase = Phase::empty;
  cv::Mat without;
  double progress = 0;
  Tuning found;
  std::string problem;
  bool ended = false;
};

SetupRun::SetupRun(SetupChoice choice, std::unique_ptr<FrameSource> camera, SetupTools tools, LiveJpeg& picture,
                   Tell tell)
    : choice_(std::move(choice)),
      camera_(std::move(camera)),
      tools_(std::move(tools)),
      picture_(picture),
      tell_(std::move(tell)),
      session_(new_session(choice_)) {
  (void)camera_->open();  // read() says why it could not
}

SetupRun::~SetupRun() {
  camera_->close();
  picture_.forget();
}

CalibrationSession SetupRun::new_session(const SetupChoice& choice) const {
  SessionSettings settings;
  settings.screen = known_or_usual(choice.screen);
  settings.thesis = choice.mode == SetupMode::thesis;
  settings.quick = choice.mode == SetupMode::quick;
  settings.camera = camera_->name();
  settings.date = setup_date();
  return CalibrationSession(std::move(settings));
}

void SetupRun::turn() {
  if (tune_ && tune_->phase == TuneState::Phase::search) {
    search_settings();
    return;
  }
  const ReadOutcome outcome = camera_->read(frame_, longest_wait);
  const Timestamp now = tools_.clock.now();
  if (outcome == ReadOutcome::frame) {
    camera_problem_.clear();
    count_picture(now);
    picture_.look(frame_.bgr);
    look(frame_.bgr, now);
    return;
  }
  if (outcome == ReadOutcome::lost || outcome == ReadOutcome::broken) camera_problem_ = camera_->last_error();
  if (outcome == ReadOutcome::ended) camera_problem_ = "the recording is over";
  session_.no_picture(now);
  if (!begun_)
    seen_.advice = session_.state().advice == SetupAdvice::no_picture ? SetupAdvice::no_picture : seen_.advice;
  if (outcome == ReadOutcome::lost || outcome == ReadOutcome::ended) std::this_thread::sleep_for(rest_without_camera);
}

void SetupRun::look(const cv::Mat& bgr, Timestamp now) {
  if (begun_) {
    session_.look(bgr, now);
  } else {
    look_for_border(bgr, now);
  }
}

// The session's first step is all that is of use here; once it has the edge it looks for it anew, since the camera may
// still be turned.
void SetupRun::look_for_border(const cv::Mat& bgr, Timestamp now) {
  session_.look(bgr, now);
  seen_ = session_.state();
  seen_.advice = advice_of(seen_, session_.screen());
  if (seen_.step != SetupStep::bright) session_ = new_session(choice_);
}

void SetupRun::count_picture(Timestamp now) {
  pictures_.push_back(now);
  while (now - pictures_.front() > 1s)
    pictures_.pop_front();
}

void SetupRun::begin(const SetupChoice& choice) {
  end_tuning();
  SetupChoice wanted = choice;
  wanted.camera = choice_.camera;
  wanted.tuned = choice_.tuned;
  session_ = new_session(wanted);
  choice_ = std::move(wanted);
  begun_ = true;
}

void SetupRun::look_at_camera() {
  session_ = new_session(choice_);
  seen_ = {};
  begun_ = false;
}

void SetupRun::obey(const SetupOrder& order) {
  refusal_.clear();
  bool done = true;
  if (order.what == "begin") {
    begin(order.choice);
  } else if (order.what == "camera") {
    look_at_camera();
  } else if (order.what == "tune") {
    begin_tuning();
  } else if (order.what == "tune_next") {
    go_on_tuning();
  } else if (order.what == "tune_end") {
    end_tuning();
  } else if (!begun_) {
    done = false;
  } else if (order.what == "confirm") {
    done = session_.confirm_border();
  } else if (order.what == "look_again") {
    done = session_.look_again();
  } else if (order.what == "back") {
    done = session_.back();
  } else if (order.what == "skip") {
    done = session_.skip_dot();
  } else if (order.what == "repeat") {
    done = session_.repeat(order.dot);
  } else if (order.what == "save") {
    save();
  }
  if (!done) refusal_ = "that can't be done now";
}

void SetupRun::save() {
  if (const Status written = session_.save(tools_.calibration_file); !written) {
    refusal_ = written.error().message;
    return;
  }
  const auto remembered = remember_setup(choice_, tools_.config);
  saved_files_ = {{"calibration", tools_.calibration_file.string()},
                  {"settings", remembered ? remembered->string() : ""},
                  {"problem", remembered ? "" : remembered.error().message}};
  saved_ = choice_;
}

bool SetupRun::over() const {
  const SetupStep step = session_.state().step;
  return step == SetupStep::saved || (begun_ && step == SetupStep::cancelled);
}

// --- the camera's settings ---

Status SetupRun::reopen(CameraPreset preset) {
  CaptureSettings settings = tools_.capture;
  settings.webcam_setup.preset = preset;
  camera_->close();
  auto camera = tools_.open(choice_.camera, settings);
  if (!camera) return camera.error();
  camera_ = *std::move(camera);
  (void)camera_->open();
  return Done{};
}

void SetupRun::begin_tuning() {
  if (begun_) {
    refusal_ = "that can't be done now";
  } else if (!is_webcam(choice_.camera)) {
    refusal_ = camera_->name() + " is no webcam: it has no settings that could be tuned";
  } else if (const Status reopened = reopen(CameraPreset::fixed); !reopened) {
    refusal_ = reopened.error().message;
  } else {
    tune_ = std::make_unique<TuneState>();
  }
}

void SetupRun::go_on_tuning() {
  const auto seen = [this](const cv::Mat& bgr) { picture_.look(bgr); };
  if (!tune_ || tune_->phase > TuneState::Phase::finger) return;
  if (tune_->phase == TuneState::Phase::finger) {
    tune_->phase = TuneState::Phase::search;  // turn() searches
    return;
  }
  auto picture = fresh_picture(*camera_, seen, tell_);
  if (picture) {
    tune_->without = picture->clone();
    tune_->phase = TuneState::Phase::finger;
  } else {
    tune_->problem = picture.error().message;
    tune_->phase = TuneState::Phase::failed;
  }
}

void SetupRun::search_settings() {
  const auto seen = [this](const cv::Mat& bgr) { picture_.look(bgr); };
  TuningOptions options;
  options.progress = [this](double done) {
    tune_->progress = done;
    tune_->ended = tune_->ended || !tell_();
    return !tune_->ended;
  };
  Result<Tuning> found = Error{};
  if (auto with = fresh_picture(*camera_, seen, tell_)) {
    found = tune_with_finger(*camera_, tune_->without, *with,
                             {choice_.camera.substr(webcam_prefix.size()), tools_.capture.webcam_fps,
                              tools_.calibration_file, tools_.capture.webcam_setup.tuned_file},
                             options, tools_.calls, tools_.clock, seen);
  } else {
    found = with.error();
  }
  if (found) {
    tune_->found = *found;
    choice_.tuned = choice_.tuned || !found->ended;
  } else {
    tune_->problem = found.error().message;
  }
  tune_->phase = found ? TuneState::Phase::done : TuneState::Phase::failed;
  if (const Status reopened = reopen(choice_.tuned ? CameraPreset::tuned : tools_.capture.webcam_setup.preset);
      !reopened)
    camera_problem_ = reopened.error().message;
}

void SetupRun::end_tuning() {
  if (!tune_) return;
  const bool automatics_off =
      tune_->phase <= TuneState::Phase::finger || (tune_->phase == TuneState::Phase::failed && tune_->without.empty());
  tune_.reset();
  if (!automatics_off) return;
  if (const Status reopened = reopen(choice_.tuned ? CameraPreset::tuned : tools_.capture.webcam_setup.preset);
      !reopened)
    camera_problem_ = reopened.error().message;
}

// --- what is told ---

Json SetupRun::tune_json() const {
  if (!tune_) return {};
  constexpr const char* phases[] = {"empty", "finger", "search", "done", "failed"};
  return {{"phase", phases[static_cast<int>(tune_->phase)]},
          {"progress", tune_->progress},
          {"before", tune_->found.before},
          {"after", tune_->found.after},
          {"complete", tune_->found.complete},
          {"problem", tune_->problem}};
}

Json SetupRun::state() const {
  Json state = setup_json(begun_ ? session_.state() : seen_, session_.screen());
  if (!begun_) {
    state["step"] = "camera";
    state["show"]["page"] = "none";
    for (auto& [what, can] : state["can"].items())
      can = false;
  }
  const ScreenSize& screen = choice_.screen;
  state["run"] = {{"camera",
                   {{"source", choice_.camera},
                    {"name", camera_->name()},
                    {"fps", pictures_.size()},
                    {"problem", camera_problem_},
                    {"has_settings", is_webcam(choice_.camera)}}},
                  {"chosen",
                   {{"width_mm", screen.width_mm},
                    {"height_mm", screen.height_mm},
                    {"width_px", screen.width_px},
                    {"height_px", screen.height_px},
                    {"monitor", choice_.monitor},
                    {"mode", name_of(choice_.mode)}}},
                  {"refusal", refusal_},
                  {"tune", tune_json()},
                  {"saved", saved_files_}};
  return state;
}

}  // namespace telehug
