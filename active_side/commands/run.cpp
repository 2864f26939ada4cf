// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "active_daemon.hpp"
#include "commands/config_options.hpp"
#include "config/places.hpp"
#include "service/control_socket.hpp"

namespace telehug {
namespace {

struct Options {
  ConfigOptions config;
  std::string source;
  bool loop = false;
};

SetupTools setup_tools(const Options& options, const ActiveConfig& config, const CaptureSettings& capture,
                       const Clock& clock) {
  return {.capture = capture,
          .calibration_file = rig_file(config.rig),
          .config = config_sources(options.config),
          .open = [&clock](const std::string& source,
                           const CaptureSettings& settings) { return make_frame_source(source, settings, clock); },
          .calls = kernel_v4l2_calls(),
          .clock = clock};
}

Result<ActiveConfig> configured(const Options& options) {
  auto config = load_config(options.config);
  if (config && !options.source.empty()) config->camera.source = options.source;
  return config;
}

ExitCode run(const Options& options) {
  Signals signals;
  const auto config = configured(options);
  if (!config) return fail(ExitCode::config, config.error());
  set_up_log(config->log.level);
  auto found = memberships(config->peer, Side::active, wall_time());
  if (!found) return fail(ExitCode::config, found.error());
  if (found->members.empty()) return fail(ExitCode::pair_ended, Error{why_none(*found)});

  const SteadyClock clock;
  CaptureSettings capture = capture_settings(*config);
  capture.loop = options.loop;
  // The camera may not be needed for long: what a killed program left changed is put back now.
  if (const auto put_back = put_back_camera(capture.webcam_setup.before_file, kernel_v4l2_calls()); !put_back) {
    spdlog::warn("settings of the camera are not put back: {}", put_back.error().message);
  } else if (*put_back > 0) {
    spdlog::info("put back {} settings of the camera that an earlier run had left", *put_back);
  }
  auto camera = make_frame_source(config->camera.source, capture, clock);
  if (!camera) return fail(ExitCode::config, camera.error());
  auto feedback = FeltFeedback::make(config->feedback, clock);
  if (!feedback) return fail(ExitCode::config, feedback.error());
  try {
    ActiveDaemon daemon(*config, *std::move(found), *std::move(camera), *std::move(feedback),
                        setup_tools(options, *config, capture, clock), clock);
    return daemon.run(signals, ConfigReload<ActiveConfig>([&options] { return configured(options); }));
  } catch (const AlreadyRunning& running) {
    return fail(ExitCode::already_running, Error{running.what()});
  } catch (const GroupUnusable& fault) {
    return fail(ExitCode::config, Error{fault.what()});
  } catch (const DdsError& error) {
    return fail(ExitCode::network, Error{error.what()});
  }
}

}  // namespace

void add_run(CLI::App& app, ExitCode& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "See touches and send them, until SIGTERM (this is the daemon)");
  add_config_options(*command, options->config);
  command->add_option("--source", options->source,
                      "Instead of the configured camera: webcam, replay:DIR, virtual or virtual:SEED");
  command->add_flag("--loop", options->loop, "Begin a recording again when it is over");
  command->callback([options, &result] { result = run(*options); });
}

}  // namespace telehug
