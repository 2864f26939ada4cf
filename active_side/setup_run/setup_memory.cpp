// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_memory.hpp"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace telehug {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view webcam_prefix = "webcam:";
constexpr const char* file_name = "50-setup.toml";

struct CameraKeys {
  std::string source;
  std::string device;
};

CameraKeys keys_of(const std::string& camera) {
  if (camera.starts_with(webcam_prefix)) return {"webcam", camera.substr(webcam_prefix.size())};
  return {camera, ""};
}

// The configuration has millimetres to a tenth: nobody measures a screen better.
double tenth(double mm) {
  return std::round(mm * 10) / 10;
}

// With its quotation marks.
std::string in_toml(const std::string& text) {
  std::ostringstream written;
  written << toml::value<std::string>(text);
  return written.str();
}

Status write_whole(const fs::path& path, const std::string& text) {
  std::error_code problem;
  fs::create_directories(path.parent_path(), problem);
  const fs::path unfinished = path.string() + ".new";
  std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (file) fs::rename(unfinished, path, problem);
  if (file && !problem) return Done{};
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return Error{fmt::format("{} can't be written; is the folder writable and the disk not full?", path.string())};
}

// What has the last word on a key ("[section] name"): the flags, or the last file after `path` that sets it.
std::string later_layer(std::string_view key, const ConfigSources& sources, const fs::path& path) {
  const std::string section(key.substr(1, key.find(']') - 1));
  const std::string name(key.substr(key.find(' ') + 1));
  for (const std::string& flag : sources.overrides)
    if (flag.starts_with(section + "." + name + "=")) return "--set " + flag;
  auto files = config_files(sources, Side::active);
  for (auto file = files.rbegin(); file != files.rend() && *file != path; ++file) {
    const auto read = toml::parse_file(file->string());
    if (read.at_path(section + "." + name)) return file->string();
  }
  return "another file";
}

// Whether a later start will do what was chosen.
Status check_that_it_counts(const SetupChoice& choice, const ConfigSources& sources, const fs::path& path) {
  const auto config = load_active_config(sources);
  if (!config)
    return Error{
        fmt::format("{} was written, but the configuration has faults: {}", path.string(), config.error().message)};
  const CameraKeys camera = keys_of(choice.camera);
  const std::string_view other =
      config->camera.source != camera.source                                           ? "[camera] source"
      : config->camera.device != camera.device                                         ? "[camera] device"
      : std::abs(config->rig.screen.width_mm - tenth(choice.screen.width_mm)) > 0.01   ? "[rig] screen_width_mm"
      : std::abs(config->rig.screen.height_mm - tenth(choice.screen.height_mm)) > 0.01 ? "[rig] screen_height_mm"
      : !choice.monitor.empty() && config->body_map.monitor != choice.monitor          ? "[body_map] monitor"
                                                                                       : "";
  if (other.empty()) return Done{};
  return Error{fmt::format("{} was written, but {} is set in {}, too, and that counts for more: take it out there",
                           path.string(), other, later_layer(other, sources, path))};
}

}  // namespace

std::string setup_fragment(const SetupChoice& choice) {
  const CameraKeys camera = keys_of(choice.camera);
  const ScreenSize& screen = choice.screen;
  return fmt::format(
      "# Written by the set-up page, which writes it anew each time.\n"
      "[camera]\nsource = {}\ndevice = {}\n{}"
      "[rig]\nscreen_width_mm = {:.1f}\nscreen_height_mm = {:.1f}\nscreen_width_px = {}\nscreen_height_px = {}\n{}",
      in_toml(camera.source), in_toml(camera.device), choice.tuned ? "preset = \"auto\"\n" : "", screen.width_mm,
      screen.height_mm, screen.width_px, screen.height_px,
      choice.monitor.empty() ? "" : fmt::format("[body_map]\nmonitor = {}\n", in_toml(choice.monitor)));
}

Result<fs::path> remember_setup(const SetupChoice& choice, const ConfigSources& sources) {
  if (sources.only_file) {
    return Error{fmt::format("telehug-active was started with --config {}, and reads nothing else: write into it\n{}",
                             sources.only_file->string(), setup_fragment(choice))};
  }
  const fs::path folder = sources.user_folder.empty() ? sources.system_folder : sources.user_folder;
  if (folder.empty()) return Error{"there is no folder of configurations: set HOME or XDG_CONFIG_HOME"};
  const fs::path path = folder / "active.d" / file_name;
  if (const Status written = write_whole(path, setup_fragment(choice)); !written) return written.error();
  if (const Status counts = check_that_it_counts(choice, sources, path); !counts) return counts.error();
  return path;
}

}  // namespace telehug
