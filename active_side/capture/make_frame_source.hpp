// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "capture/camera_setup.hpp"
#include "capture/frame_source.hpp"
#include "capture/virtual_rig/settings.hpp"

namespace telehug {

struct CaptureSettings {
  // Webcam: path of the device, best one under /dev/v4l/by-id; empty: the first webcam there, else /dev/video0.
  std::string device;
  ImageSize webcam_size{1280, 720};  // the nearest size that the webcam offers is taken
  double webcam_fps = 30;
  CameraSetupSettings webcam_setup;

  // Recording and virtual rig.
  bool real_time = true;           // false: as fast as pictures are read
  bool loop = false;               // recording: begin again after the last picture
  VirtualRigSettings virtual_rig;  // its real_time is overridden by the one above
};

// A virtual rig that a source names, see below.
struct VirtualRigSpec {
  std::optional<std::uint64_t> seed;
  std::filesystem::path directed_from;  // empty: it plays its own script
};
std::optional<VirtualRigSpec> virtual_rig_spec(std::string_view spec);

// The source that `spec` names:
//   webcam               settings.device
//   webcam:DEVICE        e.g. webcam:/dev/v4l/by-id/usb-...-video-index0
//   replay:DIR           a recording (see rig_directory.hpp) or a folder of pictures
//   replay:DIR?PART      its part "frames", "hard" or "sequence"
//   virtual              the virtual rig
//   virtual:SEED         another one, drawn at random; the same for the same number (0 to 4294967295)
//   virtual?DIR          either of them, but DIR/screen.png is on its screen and DIR/hand.csv tells what its user does
//   virtual:SEED?DIR     (virtual_rig/directed_rig.hpp)
// It is not open yet. Only a spec or settings that make no sense are errors here. `clock` must outlive the source.
Result<std::unique_ptr<FrameSource>> make_frame_source(std::string_view spec, const CaptureSettings& settings,
                                                       const Clock& clock);

}  // namespace telehug
