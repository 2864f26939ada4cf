// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "calibration/calibration_file.hpp"
#include "capture/virtual_rig/export_rig.hpp"
#include "commands/config_options.hpp"
#include "config/places.hpp"
#include "pictures/jpeg_encoder.hpp"
#include "screen/screen_recording.hpp"
#include "screen_source.hpp"
#include "service/signals.hpp"

namespace telehug {
namespace {

constexpr int jpeg_quality = 92;

struct Options {
  ConfigOptions config;
  std::string source;
  std::string folder;
  bool screen = false;
  double seconds = 10;
  int frames = 25;  // of a virtual rig
  int hard = 6;
};

Status write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) return Done{};
  return Error{fmt::format("{} can't be written: is the disk full?", path.string())};
}

// The screen's size goes with the pictures, so that the recording can be evaluated.
Status write_rig_toml(const std::filesystem::path& folder, const ActiveConfig& config) {
  ScreenSize screen = config.rig.screen;
  if (const auto calibration = read_calibration(rig_file(config.rig)); calibration) screen = calibration->screen;
  if (!(screen.width_mm > 0) || !(screen.height_mm > 0)) {
    return Error{"how large is the screen? Calibrate first, or set rig.screen_width_mm and rig.screen_height_mm"};
  }
  if (screen.width_px <= 0 || screen.height_px <= 0) {
    return Error{"how many pixels has the screen? Set rig.screen_width_px and rig.screen_height_px"};
  }
  const std::string text = fmt::format("width_mm = {}\nheight_mm = {}\nresolution = [{}, {}]\n", screen.width_mm,
                                       screen.height_mm, screen.width_px, screen.height_px);
  return write_bytes(folder / "rig.toml", {text.begin(), text.end()});
}

// `screen`: what is recorded meanwhile, if anything.
Result<int> record(FrameSource& camera, const ScreenRecording* screen, const Options& options, Signals& signals,
                   const Clock& clock) {
  const std::filesystem::path pictures = std::filesystem::path(options.folder) / "sequence";
  std::ofstream times(std::filesystem::path(options.folder) / "times.csv");
  times << "frame,monotonic_ns\n";
  Frame frame;
  int count = 0;
  const Timestamp end =
      clock.now() + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.seconds));
  while (clock.now() < end && signals.take() != SignalRequest::stop) {
    if (screen != nullptr && screen->failed()) break;
    const ReadOutcome outcome = camera.read(frame, 200ms);
    if (outcome == ReadOutcome::ended) break;
    if (outcome == ReadOutcome::lost) return Error{camera.last_error()};
    if (outcome != ReadOutcome::frame) continue;
    const auto jpeg = encode_jpeg(frame.bgr, jpeg_quality);
    if (!jpeg) return jpeg.error();
    const std::string name = fmt::format("{:05}", ++count);
    if (auto written = write_bytes(pictures / (name + ".jpg"), *jpeg); !written) return written.error();
    times << name << ',' << to_ns(frame.time) << '\n';
  }
  times.close();
  if (!times) return Error{"times.csv can't be written: is the disk full?"};
  return count;
}

// Ready to be recorded, with what is about to be written said.
Result<std::unique_ptr<ScreenRecording>> open_screen(std::unique_ptr<ScreenGrabber> grabber, const Options& options,
                                                     double rate_hz, const Clock& clock) {
  auto screen = std::make_unique<ScreenRecording>(std::move(grabber), options.folder, rate_hz, clock);
  if (const Status opened = screen->open(); !opened) return opened.error();
  fmt::print("pictures of the screen ({}), and so of the person in it, are written to {}; only you can read them\n",
             screen->name(), (std::filesystem::path(options.folder) / "screen").string());
  return screen;
}

// A virtual rig knows the truth and need not wait for the clock: it is written with its calibration, single frames and
// a sequence of that many seconds.
ExitCode export_virtual_rig(const std::string& source, const Options& options) {
  const auto spec = virtual_rig_spec(source);
  if (!spec) return fail(ExitCode::config, Error{"\"" + source + "\" names no virtual rig"});
  RandomRig rig = spec->seed ? random_rig(*spec->seed) : rig_of(VirtualRigSettings{});
  const ExportSettings settings{.calibration_touches = 9,
                                .sequence_frames = static_cast<int>(options.seconds * rig.settings.fps),
                                .single_frames = options.frames,
                                .hard_frames = options.hard};
  if (const Status written = export_rig_directory(rig, options.folder, settings); !written) {
    return fail(ExitCode::device, written.error());
  }
  fmt::print("wrote {} with its truth to {}; measure with `telehug-active eval touch {} --out FILE.csv`\n", source,
             options.folder, options.folder);
  return ExitCode::ok;
}

ExitCode run(const Options& options) {
  Signals signals;
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  const std::string source = options.source.empty() ? config->camera.source : options.source;
  std::error_code problem;
  if (std::filesystem::exists(std::filesystem::path(options.folder) / "sequence")) {
    return fail(ExitCode::device, Error{options.folder + " holds a recording already; choose another folder"});
  }
  if (options.screen && source.starts_with("virtual")) {
    return fail(ExitCode::config, Error{"a virtual rig looks at no screen; leave out --screen, or record a camera"});
  }
  if (source.starts_with("virtual")) return export_virtual_rig(source, options);
  std::filesystem::create_directories(options.folder, problem);
  if (problem) return fail(ExitCode::device, Error{options.folder + ": " + problem.message()});
  if (auto written = write_rig_toml(options.folder, *config); !written) return fail(ExitCode::device, written.error());

  const SteadyClock clock;
  auto camera = make_frame_source(source, capture_settings(*config), clock);
  if (!camera) return fail(ExitCode::config, camera.error());
  if (const Status opened = (*camera)->open(); !opened) return fail(ExitCode::device, opened.error());
  fmt::print("recording {} to {} for {:.0f} s; these are pictures of your desk and hands\n", (*camera)->name(),
             options.folder, options.seconds);
  std::unique_ptr<ScreenRecording> screen;
  if (options.screen) {
    auto grabber = make_screen_grabber(*config, clock);
    if (!grabber) return fail(ExitCode::config, grabber.error());
    auto opened = open_screen(*std::move(grabber), options, config->body_map.rate_hz, clock);
    if (!opened) return fail(ExitCode::device, opened.error());
    screen = std::move(*opened);
  }
  // Only now: a folder that holds a sequence can't be recorded to again.
  std::filesystem::create_directory(std::filesystem::path(options.folder) / "sequence", problem);
  if (problem) return fail(ExitCode::device, Error{options.folder + ": " + problem.message()});
  std::fflush(stdout);  // whoever is recorded reads it before, not after
  if (screen) screen->start();
  const auto count = record(**camera, screen.get(), options, signals, clock);
  if (!count) return fail(ExitCode::device, count.error());
  if (screen) {
    const auto seen = screen->end();
    if (!seen) return fail(ExitCode::device, seen.error());
    fmt::print("{} pictures of the screen\n", *seen);
  }
  fmt::print("{} pictures; replay them with `telehug-active run --source replay:{}`\n", *count, options.folder);
  return *count > 0 ? ExitCode::ok : ExitCode::device;
}

}  // namespace

void add_record(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("record", "Keep what the camera sees, to be replayed or evaluated");
  command->add_option("folder", options->folder, "Where to")->required()->type_name("DIR");
  command->add_option("--source", options->source,
                      "Instead of the configured camera: webcam, replay:DIR, virtual or virtual:SEED");
  command->add_flag("--screen", options->screen,
                    "Also keep what the screen shows, and so the person in it; only you can read these pictures");
  command->add_option("--seconds", options->seconds, "How long; Ctrl-C ends it earlier")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command->add_option("--frames", options->frames, "Virtual rigs: how many single pictures")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("--hard", options->hard, "Virtual rigs: how many pictures with two fingers or two hands")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  add_config_options(*command, options->config);
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
