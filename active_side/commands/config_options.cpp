// SPDX-License-Identifier: Apache-2.0
#include "commands/config_options.hpp"

#include <CLI/CLI.hpp>

#include "config/places.hpp"

namespace telehug {

void add_config_options(CLI::App& command, ConfigOptions& options) {
  command.add_option("--config", options.file, "Read only this file")->type_name("FILE");
  command.add_option("--set", options.overrides, "Override one key, as often as you like")
      ->type_name("SECTION.KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

ConfigSources config_sources(const ConfigOptions& options) {
  ConfigSources sources = usual_config_sources();
  if (!options.file.empty()) sources.only_file = options.file;
  sources.overrides = options.overrides;
  return sources;
}

Result<ActiveConfig> load_config(const ConfigOptions& options) {
  return load_active_config(config_sources(options));
}

CaptureSettings capture_settings(const ActiveConfig& config) {
  CaptureSettings settings;
  settings.device = config.camera.device;
  settings.webcam_size = {config.camera.width_px, config.camera.height_px};
  settings.webcam_fps = config.camera.fps;
  settings.webcam_setup = {config.camera.preset == "auto"     ? CameraPreset::tuned
                           : config.camera.preset == "thesis" ? CameraPreset::fixed
                                                              : CameraPreset::keep,
                           config.camera.power_line_hz, tuned_camera_file(config.rig), camera_before_file(config.rig)};
  return settings;
}

}  // namespace telehug
