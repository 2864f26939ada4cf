// SPDX-License-Identifier: Apache-2.0
#include "setup_run/setup_choice.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <utility>

namespace telehug {
namespace {

using Json = nlohmann::json;

constexpr double least_mm = 100;
constexpr double most_mm = 3000;
constexpr int most_px = 16384;
constexpr std::size_t longest_name = 64;

Status read_mm(const Json& request, const char* key, double& mm) {
  const auto given = request.find(key);
  if (given == request.end()) return Done{};
  const double value = given->is_number() ? given->get<double>() : 0;
  if (!(value >= least_mm && value <= most_mm))
    return Error{fmt::format("\"{}\" is the size of the visible screen: {:.0f} to {:.0f} mm", key, least_mm, most_mm)};
  mm = value;
  return Done{};
}

Status read_px(const Json& request, const char* key, int& px) {
  const auto given = request.find(key);
  if (given == request.end()) return Done{};
  const double value = given->is_number() ? given->get<double>() : -1;
  if (!(value >= 0 && value <= most_px)) return Error{fmt::format("\"{}\" is 0 to {} pixels", key, most_px)};
  px = static_cast<int>(std::lround(value));
  return Done{};
}

// Such as RandR tells: printable, and no long one.
bool is_name(const std::string& name) {
  if (name.size() > longest_name) return false;
  for (const char letter : name)
    if (letter < ' ' || letter > '~') return false;
  return true;
}

std::optional<SetupMode> mode_named(const Json& name) {
  for (const SetupMode mode : {SetupMode::full, SetupMode::quick, SetupMode::thesis})
    if (name == name_of(mode)) return mode;
  return std::nullopt;
}

}  // namespace

const char* name_of(SetupMode mode) noexcept {
  switch (mode) {
    case SetupMode::full:
      return "full";
    case SetupMode::quick:
      return "quick";
    case SetupMode::thesis:
      break;
  }
  return "thesis";
}

Status read_choice(const Json& request, SetupChoice& choice) {
  SetupChoice read = choice;
  for (const Status& status :
       {read_mm(request, "width_mm", read.screen.width_mm), read_mm(request, "height_mm", read.screen.height_mm),
        read_px(request, "width_px", read.screen.width_px), read_px(request, "height_px", read.screen.height_px)})
    if (!status) return status;
  if (const auto monitor = request.find("monitor"); monitor != request.end()) {
    if (!monitor->is_string() || !is_name(monitor->get_ref<const std::string&>()))
      return Error{"\"monitor\" is the name of a monitor, as the list tells it"};
    read.monitor = monitor->get<std::string>();
  }
  if (const auto mode = request.find("mode"); mode != request.end()) {
    const auto named = mode_named(*mode);
    if (!named) return Error{"\"mode\" is one of full, quick, thesis"};
    read.mode = *named;
  }
  choice = std::move(read);
  return Done{};
}

}  // namespace telehug
