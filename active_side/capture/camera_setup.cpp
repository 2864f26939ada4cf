// SPDX-License-Identifier: Apache-2.0
#include "capture/camera_setup.hpp"

#include <fmt/core.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <array>

namespace telehug {
namespace {

// An automatic, its value while it is off, and the control that it rules (0: none).
struct Automatic {
  std::uint32_t id;
  std::int32_t off;
  std::uint32_t ruled;
};
constexpr std::array automatics{
    Automatic{V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, V4L2_CID_EXPOSURE_ABSOLUTE},
    Automatic{V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0, 0},  // may lower the frame rate
    Automatic{V4L2_CID_AUTOGAIN, 0, V4L2_CID_GAIN},
    Automatic{V4L2_CID_AUTO_WHITE_BALANCE, 0, V4L2_CID_WHITE_BALANCE_TEMPERATURE},
    Automatic{V4L2_CID_HUE_AUTO, 0, V4L2_CID_HUE},
    Automatic{V4L2_CID_FOCUS_AUTO, 0, V4L2_CID_FOCUS_ABSOLUTE},
};

bool is_automatic(std::uint32_t id) {
  return std::ranges::find(automatics, id, &Automatic::id) != automatics.end();
}

const char* name_of(CameraPreset preset) {
  constexpr const char* names[] = {"keep", "thesis", "auto"};
  return names[static_cast<std::size_t>(preset)];
}

}  // namespace

ControlValues planned_controls(const CameraSetupSettings& settings, const std::vector<CameraControl>& controls,
                               const ControlValues& tuned) {
  const auto of = [&](std::uint32_t id) { return std::ranges::find(controls, id, &CameraControl::id); };
  ControlValues planned;
  const bool lock =
      settings.preset == CameraPreset::fixed || (settings.preset == CameraPreset::tuned && !tuned.empty());
  for (const Automatic& automatic : automatics) {
    if (lock && of(automatic.id) != controls.end()) planned.push_back({automatic.id, automatic.off});
  }
  const auto is_tuned = [&](std::uint32_t id) {
    return settings.preset == CameraPreset::tuned && std::ranges::find(tuned, id, &ControlValue::id) != tuned.end();
  };
  for (const Automatic& automatic : automatics) {
    const auto ruled = of(automatic.ruled);
    if (lock && of(automatic.id) != controls.end() && ruled != controls.end() && !is_tuned(automatic.ruled))
      planned.push_back({ruled->id, ruled->value});
  }
  for (const ControlValue& value : tuned) {
    if (is_tuned(value.id) && of(value.id) != controls.end()) planned.push_back(value);
  }
  if (settings.power_line_hz > 0 && of(V4L2_CID_POWER_LINE_FREQUENCY) != controls.end()) {
    planned.push_back({V4L2_CID_POWER_LINE_FREQUENCY, settings.power_line_hz == 50
                                                          ? V4L2_CID_POWER_LINE_FREQUENCY_50HZ
                                                          : V4L2_CID_POWER_LINE_FREQUENCY_60HZ});
  }
  return planned;
}

ControlValues controls_before(const ControlValues& planned, const std::vector<CameraControl>& controls) {
  ControlValues before;
  for (const bool automatic : {false, true}) {
    for (const ControlValue& change : planned) {
      const auto control = std::ranges::find(controls, change.id, &CameraControl::id);
      if (control != controls.end() && is_automatic(change.id) == automatic)
        before.push_back({control->id, control->value});
    }
  }
  return before;
}

void CameraSetup::apply(const std::string& device) {
  summary_.clear();
  changed_ = false;
  if (settings_.before_file.empty()) return;
  if (const auto left = put_back_camera(settings_.before_file, calls_); !left) complain(left.error());
  ControlValues tuned;
  if (settings_.preset == CameraPreset::tuned) {
    auto memory = read_camera_memory(settings_.tuned_file);
    if (!memory) complain(memory.error());
    if (memory && *memory && (*memory)->device == device) tuned = (*memory)->controls;
  }
  // Asking a USB camera costs a transfer for each setting.
  if (settings_.preset != CameraPreset::fixed && tuned.empty() && settings_.power_line_hz == 0) return;
  CameraControls controls(calls_);
  if (const Status opened = controls.open(device); !opened) return complain(opened.error());
  const auto known = controls.list();
  const ControlValues planned = planned_controls(settings_, known, tuned);
  if (planned.empty()) return;
  const Status remembered = write_camera_memory(settings_.before_file, {device, controls_before(planned, known)});
  if (!remembered) return complain(remembered.error());
  changed_ = true;
  std::size_t done = 0;
  for (const ControlValue& value : planned) {
    const Status set = controls.set(value);
    if (!set) complain(set.error());
    done += set ? 1U : 0U;
  }
  summary_ =
      fmt::format("{}: {} settings{}{}", name_of(settings_.preset), done, summary_.empty() ? "" : "; ", summary_);
}

void CameraSetup::put_back() {
  if (!changed_) return;
  changed_ = false;
  // A camera that is gone is put back when it is opened again: the file stays.
  (void)put_back_camera(settings_.before_file, calls_);
}

void CameraSetup::complain(const Error& error) {
  summary_ += (summary_.empty() ? "" : "; ") + error.message;
}

Result<int> put_back_camera(const std::filesystem::path& before_file, V4l2Calls& calls) {
  auto memory = read_camera_memory(before_file);
  if (!memory) return memory.error();
  if (!*memory) return 0;
  CameraControls controls(calls);
  if (const Status opened = controls.open((*memory)->device); !opened) return opened.error();
  int count = 0;
  for (const ControlValue& value : (*memory)->controls)
    count += controls.set(value) ? 1 : 0;
  if (count == 0 && !(*memory)->controls.empty()) return Error{(*memory)->device + " took none of its settings back"};
  std::error_code ignored;
  std::filesystem::remove(before_file, ignored);
  return count;
}

}  // namespace telehug
