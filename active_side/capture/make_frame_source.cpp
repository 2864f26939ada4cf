// SPDX-License-Identifier: Apache-2.0
#include "capture/make_frame_source.hpp"

#include <fmt/format.h>

#include <charconv>

#include "capture/recording.hpp"
#include "capture/virtual_rig/directed_rig.hpp"
#include "capture/virtual_rig/random_rig.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "capture/webcam.hpp"
#include "capture/webcam_device.hpp"

namespace telehug {
namespace {

std::unique_ptr<FrameSource> webcam(std::string device, const CaptureSettings& settings, const Clock& clock) {
  if (device.empty()) device = settings.device.empty() ? first_webcam_device() : settings.device;
  return std::make_unique<Webcam>(
      WebcamSettings{device, settings.webcam_size, settings.webcam_fps, settings.webcam_setup}, clock);
}

std::unique_ptr<FrameSource> recording(std::string_view place, const CaptureSettings& settings, const Clock& clock) {
  RecordingSettings recorded;
  const auto question = place.rfind('?');
  recorded.folder = place.substr(0, question);
  if (question != std::string_view::npos) recorded.part = place.substr(question + 1);
  recorded.real_time = settings.real_time;
  recorded.loop = settings.loop;
  return std::make_unique<Recording>(std::move(recorded), clock);
}

Result<std::unique_ptr<FrameSource>> virtual_rig(const VirtualRigSpec& spec, const CaptureSettings& settings,
                                                 const Clock& clock) {
  VirtualRigSettings rig = spec.seed ? random_rig(*spec.seed).settings : settings.virtual_rig;
  rig.real_time = settings.real_time;
  if (const Status checked = check_virtual_rig(rig); !checked) return checked.error();
  if (spec.directed_from.empty()) return std::unique_ptr<FrameSource>(std::make_unique<VirtualRig>(rig, clock));
  return std::unique_ptr<FrameSource>(std::make_unique<DirectedRig>(rig, spec.directed_from, clock));
}

}  // namespace

std::optional<VirtualRigSpec> virtual_rig_spec(std::string_view spec) {
  VirtualRigSpec rig;
  if (const auto question = spec.find('?'); question != std::string_view::npos) {
    rig.directed_from = spec.substr(question + 1);
    if (rig.directed_from.empty()) return std::nullopt;
    spec = spec.substr(0, question);
  }
  if (spec == "virtual") return rig;
  constexpr std::string_view prefix = "virtual:";
  if (!spec.starts_with(prefix)) return std::nullopt;
  spec.remove_prefix(prefix.size());
  std::uint32_t seed = 0;
  const auto [end, error] = std::from_chars(spec.data(), spec.data() + spec.size(), seed);
  if (error != std::errc() || end != spec.data() + spec.size()) return std::nullopt;
  rig.seed = seed;
  return rig;
}

Result<std::unique_ptr<FrameSource>> make_frame_source(std::string_view spec, const CaptureSettings& settings,
                                                       const Clock& clock) {
  const auto colon = spec.find(':');
  const std::string_view kind = spec.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : spec.substr(colon + 1);
  if (kind == "webcam") return webcam(std::string(rest), settings, clock);
  if (kind == "replay" && !rest.empty()) return recording(rest, settings, clock);
  if (const auto rig = virtual_rig_spec(spec)) return virtual_rig(*rig, settings, clock);
  return Error{fmt::format(
      "'{}' is no source of pictures; sources are webcam, webcam:DEVICE, replay:DIR, "
      "replay:DIR?PART (frames, hard or sequence), virtual and virtual:SEED (a whole number), both also with ?DIR",
      spec)};
}

}  // namespace telehug
