// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active camera check`: is there light enough? Looks through the camera for a moment and keeps nothing.
#include "commands/camera_check.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "capture/light_meter.hpp"
#include "capture/measure_scene.hpp"
#include "commands/config_options.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigOptions config;
  double seconds = 1.5;
  bool json = false;
};

constexpr Duration patience = 500ms;

// The error is why no picture came.
Result<Light> measure(FrameSource& camera, int settling, double seconds) {
  if (const Status opened = camera.open(); !opened) return opened.error();
  const SteadyClock clock;
  const auto longest = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
  const Timestamp end = clock.now() + longest + patience;
  LightMeter meter;
  Frame frame;
  std::optional<Timestamp> first;
  for (int seen = 0; clock.now() < end && (!first || clock.now() < *first + longest);) {
    const ReadOutcome outcome = camera.read(frame, patience);
    if (outcome == ReadOutcome::lost || outcome == ReadOutcome::ended) break;
    if (outcome != ReadOutcome::frame || ++seen <= settling) continue;
    if (!first) first = clock.now();
    meter.add(frame.bgr, frame.time);
  }
  const Light light = meter.light();
  if (light.pictures > 0) return light;
  return Error{camera.last_error().empty() ? "no picture came" : camera.last_error()};
}

ExitCode check(const Options& options) {
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  const SteadyClock clock;
  const auto camera = make_frame_source(config->camera.source, capture_settings(*config), clock);
  if (!camera) return fail(ExitCode::config, camera.error());
  const bool live = config->camera.source == "webcam";
  const auto light = measure(**camera, live ? settle_frames : 0, options.seconds);
  if (options.json) {
    nlohmann::json told{{"camera", (*camera)->name()}, {"problem", light ? "" : light.error().message}};
    if (light)
      told.update({{"pictures", light->pictures},
                   {"mean", light->mean},
                   {"dark_share", light->dark_share},
                   {"blown_share", light->blown_share},
                   {"flicker", light->flicker},
                   {"rate_hz", light->rate_hz},
                   {"asked_hz", live ? config->camera.fps : 0}});
    fmt::print("{}\n", told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } else if (light) {
    fmt::print(
        "{}: {:.0f} % of white on the average, {:.0f} % of the picture blown out, {:.0f} % black, "
        "flickers by {:.1f} %, {:.1f} pictures a second\n",
        (*camera)->name(), 100 * light->mean, 100 * light->blown_share, 100 * light->dark_share, 100 * light->flicker,
        light->rate_hz);
  }
  return light ? ExitCode::ok : fail(ExitCode::device, light.error());
}

}  // namespace

void add_camera_check(CLI::App& camera, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = camera.add_subcommand("check", "Tell whether there is light enough; no picture is kept");
  add_config_options(*command, options->config);
  command->add_option("--seconds", options->seconds, "How long it looks")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options, &result] { result = check(*options); });
}

}  // namespace telehug
