// SPDX-License-Identifier: Apache-2.0
#include "config/locator.hpp"

#include <fmt/core.h>

#include <optional>

namespace telehug {
namespace {

// What follows "scheme:" if the text begins so and anything follows.
std::optional<std::string> after(std::string_view scheme, std::string_view text) {
  if (!text.starts_with(scheme) || text.size() == scheme.size()) return std::nullopt;
  return std::string(text.substr(scheme.size()));
}

}  // namespace

Result<CameraSource> parse_camera_source(std::string_view text) {
  if (text == "webcam") return CameraSource{CameraSourceKind::webcam, {}};
  if (text == "virtual") return CameraSource{CameraSourceKind::virtual_rig, {}};
  if (const auto seed = after("virtual:", text);
      seed && seed->size() <= 9 && seed->find_first_not_of("0123456789") == std::string::npos) {
    return CameraSource{CameraSourceKind::virtual_rig, {}};
  }
  if (auto folder = after("replay:", text)) return CameraSource{CameraSourceKind::recording, *folder};
  return Error{fmt::format(
      "\"{}\" is not a camera source: it is \"webcam\", \"replay:DIR\", \"virtual\" or \"virtual:SEED\"", text)};
}

Result<JacketLinkChoice> parse_jacket_link(std::string_view text) {
  if (text == "simulated") return JacketLinkChoice{JacketLinkKind::simulated, {}};
  if (auto path = after("serial:", text)) return JacketLinkChoice{JacketLinkKind::serial, *path};
  if (auto path = after("record:", text)) return JacketLinkChoice{JacketLinkKind::recorded, *path};
  return Error{
      fmt::format("\"{}\" is not a jacket link: it is \"serial:PATH\", \"simulated\" or \"record:FILE\"", text)};
}

}  // namespace telehug
