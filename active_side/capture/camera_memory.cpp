// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_memory.hpp"

#include <fmt/core.h>

#include <toml++/toml.h>
#include <fstream>
#include <limits>

#include "files/text_file.hpp"

namespace telehug {
namespace {

std::optional<ControlValue> control_value(const toml::node& node) {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) return std::nullopt;
  const auto id = (*pair)[0].value<std::int64_t>();
  const auto value = (*pair)[1].value<std::int64_t>();
  using Id = std::numeric_limits<std::uint32_t>;
  using Value = std::numeric_limits<std::int32_t>;
  if (!id || !value || *id < 0 || *id > Id::max() || *value < Value::min() || *value > Value::max())
    return std::nullopt;
  return ControlValue{static_cast<std::uint32_t>(*id), static_cast<std::int32_t>(*value)};
}

}  // namespace

Result<std::optional<CameraMemory>> read_camera_memory(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::optional<CameraMemory>{};
  const Error unreadable{path.string() + " holds no settings of a camera; delete it"};
  try {
    const auto text = read_text_file(path);
    if (!text) return unreadable;
    const toml::table table = toml::parse(*text, path.string());
    CameraMemory memory;
    const auto device = table["device"].value<std::string>();
    const toml::array* controls = table["controls"].as_array();
    if (!device || controls == nullptr) return unreadable;
    memory.device = *device;
    for (const toml::node& node : *controls) {
      const auto value = control_value(node);
      if (!value) return unreadable;
      memory.controls.push_back(*value);
    }
    return std::optional(std::move(memory));
  } catch (const toml::parse_error&) {
    return unreadable;
  }
}

Status write_camera_memory(const std::filesystem::path& path, const CameraMemory& memory) {
  std::error_code problem;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), problem);
  toml::array controls;
  for (const ControlValue& control : memory.controls)
    controls.push_back(toml::array{static_cast<std::int64_t>(control.id), static_cast<std::int64_t>(control.value)});
  const std::filesystem::path unfinished = path.string() + ".new";
  std::ofstream file(unfinished);
  file << toml::table{{"device", memory.device}, {"controls", controls}} << '\n';
  file.close();
  if (file) std::filesystem::rename(unfinished, path, problem);
  if (file && !problem) return Done{};
  return Error{fmt::format("{} can't be written; is the folder writable and the disk not full?", path.string())};
}

}  // namespace telehug
