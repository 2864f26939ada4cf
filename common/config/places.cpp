// SPDX-License-Identifier: Apache-2.0
#include "config/places.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string>

#include "common/data_folder.hpp"

namespace telehug {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::filesystem::path state_folder() {
  // systemd lists several folders separated by colons; the first is the unit's main one.
  if (const std::string given = environment("STATE_DIRECTORY"); !given.empty()) return given.substr(0, given.find(':'));
  if (const std::string xdg = environment("XDG_STATE_HOME"); xdg.starts_with('/')) {
    return std::filesystem::path(xdg) / "telehug";
  }
  const std::string home = environment("HOME");
  if (geteuid() == 0 || home.empty()) return "/var/lib/telehug";
  return std::filesystem::path(home) / ".local/state/telehug";
}

}  // namespace

std::filesystem::path rig_file(const RigConfig& config) {
  return config.calibration_file.empty() ? state_folder() / "rig.toml" : std::filesystem::path(config.calibration_file);
}

std::filesystem::path tuned_camera_file(const RigConfig& config) {
  return rig_file(config).replace_filename("camera.toml");
}

std::filesystem::path camera_before_file(const RigConfig& config) {
  return rig_file(config).replace_filename("camera-before.toml");
}

std::filesystem::path screen_consent_file() {
  return state_folder() / "screen-consent";
}

std::filesystem::path pairs_folder(const PeerConfig& config, Side side) {
  if (!config.pairs_folder.empty()) return config.pairs_folder;
  return state_folder() / "pairs" / (side == Side::active ? "active" : "passive");
}

std::filesystem::path consent_file(const ConsentConfig& config) {
  return config.file.empty() ? state_folder() / "consent.json" : std::filesystem::path(config.file);
}

std::filesystem::path stop_file(const ControlConfig& config, Side side) {
  if (!config.stop_file.empty()) return config.stop_file;
  return state_folder() / (side == Side::active ? "stop-active.json" : "stop-passive.json");
}

std::filesystem::path installed_jacket_file(const std::filesystem::path& given) {
  const std::filesystem::path installed = data_folder() / "jackets";
  std::error_code ignored;
  if (given.is_absolute() || std::filesystem::exists(given, ignored)) return given;
  return std::filesystem::exists(installed / given, ignored) ? installed / given : given;
}

std::filesystem::path jacket_profile_file(const JacketConfig& config) {
  const std::filesystem::path installed = data_folder() / "jackets";
  return config.profile.empty() ? installed / "duemilanove-16.toml" : installed_jacket_file(config.profile);
}

}  // namespace telehug
