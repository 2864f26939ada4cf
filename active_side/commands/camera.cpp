// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "capture/webcam.hpp"
#include "capture/webcam_device.hpp"
#include "commands/camera_check.hpp"
#include "commands/config_options.hpp"
#include "config/places.hpp"
#include "setup_run/tuning_with_finger.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigOptions config;
  double seconds = 60;
};

std::string device_of(const ActiveConfig& config) {
  return config.camera.device.empty() ? first_webcam_device() : config.camera.device;
}

ExitCode list(const Options& options) {
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  CameraControls controls(kernel_v4l2_calls());
  const std::string device = device_of(*config);
  if (const Status opened = controls.open(device); !opened) return fail(ExitCode::device, opened.error());
  fmt::print("{}\n{:<12}{:<36}{:>8}{:>8}{:>8}{:>9}\n", device, "id", "setting", "least", "most", "now", "default");
  for (const CameraControl& control : controls.list()) {
    fmt::print("0x{:08x}  {:<36}{:>8}{:>8}{:>8}{:>9}{}\n", control.id, control.name, control.minimum, control.maximum,
               control.value, control.default_value, control.inactive ? "  (an automatic rules it)" : "");
  }
  return ExitCode::ok;
}

ExitCode restore(const Options& options) {
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  const auto count = put_back_camera(camera_before_file(config->rig), kernel_v4l2_calls());
  if (!count) return fail(ExitCode::device, count.error());
  fmt::print("{}\n", *count > 0 ? fmt::format("{} settings of the camera are as they were before telehug", *count)
                                : "telehug has left nothing changed");
  return ExitCode::ok;
}

Result<cv::Mat> asked_picture(FrameSource& camera, const char* request) {
  fmt::print("{}, then press Enter. ", request);
  (void)std::fflush(stdout);
  std::string line;
  if (!std::getline(std::cin, line)) return Error{"nobody answered: `camera tune` needs somebody at this terminal"};
  return fresh_picture(camera);
}

Result<Tuning> tune_at(FrameSource& camera, const std::string& device, const ActiveConfig& config, double seconds) {
  auto without = asked_picture(camera, "Take your hands away from the screen");
  if (!without) return without.error();
  const cv::Mat empty = without->clone();
  auto with = asked_picture(camera, "Lay one finger on the lower part of the screen, from below, and keep it there");
  if (!with) return with.error();
  fmt::print("Trying settings for at most {:.0f} s; keep the finger where it is.\n", seconds);
  const SteadyClock clock;
  TuningOptions tuning;
  tuning.longest = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  const TunedWebcam webcam{device, static_cast<double>(config.camera.fps), rig_file(config.rig),
                           tuned_camera_file(config.rig)};
  return tune_with_finger(camera, empty, *with, webcam, tuning, kernel_v4l2_calls(), clock);
}

ExitCode tune(const Options& options) {
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  const std::string device = device_of(*config);
  // The automatics are off while it is tuned, and everything is put back at the end.
  CaptureSettings capture = capture_settings(*config);
  capture.webcam_setup.preset = CameraPreset::fixed;
  const SteadyClock clock;
  Webcam camera({device, capture.webcam_size, capture.webcam_fps, capture.webcam_setup}, clock);
  if (const Status opened = camera.open(); !opened) return fail(ExitCode::device, opened.error());
  const auto tuned = tune_at(camera, device, *config, options.seconds);
  if (!tuned) return fail(ExitCode::device, tuned.error());
  fmt::print("separation of finger and border: {:.1f} before, {:.1f} now ({} measurements{})\n{}\n", tuned->before,
             tuned->after, tuned->measurements, tuned->complete ? "" : ", not all: the time was over",
             tuned_camera_file(config->rig).string());
  return ExitCode::ok;
}

}  // namespace

void add_camera(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* camera = app.add_subcommand("camera", "The camera's settings: show, choose, put back");
  camera->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, ExitCode (*command)(const Options&)) {
    CLI::App* added = camera->add_subcommand(name, help);
    add_config_options(*added, options->config);
    added->callback([options, command, &result] { result = command(*options); });
    return added;
  };
  add("list", "Show what can be set and how it is", &list);
  add("tune", "Find the settings that tell a finger from the screen's border best, for camera.preset = \"auto\"", &tune)
      ->add_option("--seconds", options->seconds, "How long it may take")
      ->check(CLI::Range(5.0, 600.0))
      ->capture_default_str();
  add_camera_check(*camera, result);
  add("restore", "Put back what a telehug that was killed has left changed", &restore);
}

}  // namespace telehug
