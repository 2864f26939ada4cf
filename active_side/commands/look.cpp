// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active look`: what telehug sees on the screen, without camera, peer or daemon.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "body_map/body_map_step.hpp"
#include "body_map_json.hpp"
#include "calibration/calibration_file.hpp"
#include "commands/config_options.hpp"
#include "commands/face_option.hpp"
#include "config/places.hpp"
#include "screen_source.hpp"
#include "service/log.hpp"
#include "service/signals.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigOptions config;
  double seconds = 0;
};

// Where nobody has measured the screen a pixel is taken for a millimetre: only pixels are printed.
std::optional<ScreenSize> measured_screen(const RigConfig& config) {
  const auto calibration = read_calibration(rig_file(config));
  return calibration ? std::optional(calibration->screen) : std::nullopt;
}

nlohmann::json look_json(const BodyMapStep& step, Timestamp looked, const std::string& problem) {
  const BodyMap& map = step.map();
  nlohmann::json look = {{"time_ns", to_ns(looked)},
                         {"version", map.version},
                         {"monitor", {{"width_px", step.monitor().width_px}, {"height_px", step.monitor().height_px}}},
                         {"problem", problem}};
  if (const auto in_front = step.in_front()) look["in_front"] = *in_front;
  if (const auto scale = step.scale(); map.version != 0 && scale) {
    look["seen_ns"] = to_ns(map.seen);
    look.update(body_map_json(map, *scale));
  }
  return look;
}

ExitCode look(const Options& options) {
  Signals signals;
  const auto config = load_config(options.config);
  if (!config) return fail(ExitCode::config, config.error());
  set_up_log(config->log.level);
  const SteadyClock clock;
  auto grabber = make_screen_grabber(*config, clock);
  if (!grabber) return fail(ExitCode::config, grabber.error());
  const auto finder = chosen_face_finder(config->body_map.face);
  if (!finder) return fail(ExitCode::device, finder.error());
  if (const std::string ignored = ignored_screen_keys(config->body_map); !ignored.empty()) {
    fmt::print(stderr, "telehug-active: {}\n", ignored);
  }

  BodyMapStep step(**grabber, **finder, body_map_step_config(config->body_map, measured_screen(config->rig)));
  const auto period = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / config->body_map.rate_hz));
  const Timestamp begun = clock.now();
  const auto end = begun + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.seconds));
  while (options.seconds <= 0 || clock.now() < end) {
    const Timestamp looked = clock.now();
    const Status opened = (*grabber)->open();
    step.run();
    const std::string problem = opened ? step.problem() : opened.error().message;
    fmt::print("{}\n", look_json(step, looked, problem).dump());
    if (std::fflush(stdout) != 0) return ExitCode::ok;  // nobody reads any more
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(looked + period - clock.now());
    if (signals.wait(std::max(rest, std::chrono::milliseconds(0))) == SignalRequest::stop) break;
  }
  return ExitCode::ok;
}

}  // namespace

void add_look(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("look", "Print what is seen of the remote person on the screen: a line of JSON a look");
  add_config_options(*command, options->config);
  command->add_option("--seconds", options->seconds, "How long; 0: until it is ended")->check(CLI::Range(0.0, 1e6));
  command->callback([options, &result] { result = look(*options); });
}

}  // namespace telehug
