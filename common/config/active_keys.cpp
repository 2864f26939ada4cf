// SPDX-License-Identifier: Apache-2.0
//
// After a change here: cmake --build --preset release --target config_files
#include <fmt/core.h>

#include "config/key_rows.hpp"
#include "config/locator.hpp"

namespace telehug {
namespace {

constexpr Range any_length_px{0, 16384};
constexpr Range any_length_mm{0, 5000};
// A heartbeat comes every 100 ms: less than 150 would lose the peer whenever one is late.
constexpr Range heartbeat_timeout{150, 1000};

}  // namespace

std::vector<Key> keys_of(ActiveConfig& c) {
  Rows rows{
      {"camera", "source", &c.camera.source, "", parsed_by(parse_camera_source),
       "\"webcam\", \"replay:DIR\" (a recording), \"virtual\" (a simulated rig) or \"virtual:SEED\" (one drawn at "
       "random); with ?DIR behind it, what is on the rig's screen and what its user does is read from that folder."},
      {"camera",
       "device",
       &c.camera.device,
       "",
       {},
       "The webcam, best by its /dev/v4l/by-id/ path; empty: the first by name; with two cameras say which."},
      {"camera", "width_px", &c.camera.width_px, "px", Range{160, 7680}, "Width of the camera's frames."},
      {"camera", "height_px", &c.camera.height_px, "px", Range{120, 4320}, "Height of the camera's frames."},
      {"camera", "fps", &c.camera.fps, "frames/s", Range{1, 240}, "Frame rate asked of the camera."},
      {"camera", "preset", &c.camera.preset, "", OneOf{{"auto", "thesis", "keep"}},
       "Settings of the camera while it is open. auto: what `telehug-active camera tune` found, if anything; thesis: "
       "exposure, white balance and focus fixed; keep: as they are."},
      {"camera", "power_line_hz", &c.camera.power_line_hz, "Hz", Range{0, 60},
       "What the light flickers with, so that pictures don't: 50 or 60; 0: as the camera is."},

      {"rig",
       "calibration_file",
       &c.rig.calibration_file,
       "",
       {},
       "Calibration of this monitor and camera; empty: rig.toml in the state folder of the service or user."},
      {"rig", "screen_width_mm", &c.rig.screen.width_mm, "mm", any_length_mm,
       "Visible width of the monitor: calibrated with, then compared; 0: as calibrated."},
      {"rig", "screen_height_mm", &c.rig.screen.height_mm, "mm", any_length_mm,
       "Visible height of the monitor: calibrated with, then compared; 0: as calibrated."},
      {"rig", "screen_width_px", &c.rig.screen.width_px, "px", any_length_px,
       "Width of the desktop, which a calibration notes; 0: unknown, or as calibrated."},
      {"rig", "screen_height_px", &c.rig.screen.height_px, "px", any_length_px,
       "Height of the desktop, which a calibration notes; 0: unknown, or as calibrated."},

      {"touch", "detector", &c.touch.detector, "", OneOf{{"default", "thesis"}},
       "How fingers are found; default: several, compared with how the rig looks with nobody there; thesis: one."},
      {"touch", "model", &c.touch.model, "", OneOf{{"default", "thesis"}},
       "How a finger in the image becomes a point on the screen; default: whatever the calibration holds; also what "
       "`calibrate` solves."},
      {"touch", "up_after_ms", &c.touch.up_after_ms, "ms", Range{0, 1000},
       "How long a finger must be unseen before its touch ends."},

      {"local_touch",
       "uinput",
       &c.local_touch.uinput,
       "",
       {},
       "true: the monitor is a touchscreen of this PC, too; needs the right to write /dev/uinput."},
      {"local_touch", "tuio", &c.local_touch.tuio, "", {}, "true: touches are sent as TUIO 1.1 cursors."},
      {"local_touch", "tuio_host", &c.local_touch.tuio_host, "", {}, "Where TUIO is sent to; it is not encrypted."},
      {"local_touch", "tuio_port", &c.local_touch.tuio_port, "", Range{1, 65535}, "And to which UDP port."},

      {"body_map", "source", &c.body_map.source, "", parsed_by(parse_screen_source),
       "Where the picture of the video chat comes from. \"auto\": `picture` if it is set, else this PC's screen; "
       "\"x11\" or \"portal\" (Wayland): the screen; \"picture\"; \"camera:DEVICE\": a capture card that shows the "
       "screen; \"replay:DIR\": a recording of the screen."},
      {"body_map",
       "picture",
       &c.body_map.picture,
       "",
       {},
       "Picture of the whole monitor with the remote person: a file, or a folder of them."},
      {"body_map",
       "monitor",
       &c.body_map.monitor,
       "",
       {},
       "x11: name of the monitor that the camera looks along, as `xrandr` tells it; empty: the primary one."},
      {"body_map",
       "window",
       &c.body_map.window,
       "",
       {},
       "x11: only this window is looked at: a part of its title or class; empty: the whole monitor."},
      {"body_map", "region", &c.body_map.region, "", parsed_by(parse_screen_region),
       "Only this part of the monitor is looked at: \"X,Y,WIDTH,HEIGHT\" in its pixels; empty: all of it."},
      {"body_map",
       "mirrored",
       &c.body_map.mirrored,
       "",
       {},
       "true: the chat shows the remote person as in a mirror, their left hand on the left."},
      {"body_map", "face", &c.body_map.face, "", OneOf{{"blaze", "haar"}},
       "Face finder: blaze, a small net, or haar, the thesis'."},
      {"body_map", "rate_hz", &c.body_map.rate_hz, "Hz", Range{2, 60}, "How often the face is looked for."},
      {"body_map", "hold_ms", &c.body_map.hold_ms, "ms", Range{0, 10000},
       "How long the last face found stays in use when none is found."},
      {"body_map", "max_age_ms", &c.body_map.max_age_ms, "ms", Range{100, 30000},
       "A body map older than this is refused: touches are counted, not sent."},

      {"sending", "at_start", &c.sending.at_start, "", OneOf{{"auto", "on", "off"}},
       "Whether touches go out before `telehug send` says so. auto: while the pinned window is in front; of a whole "
       "screen none."},
      {"sending",
       "only_in_front",
       &c.sending.only_in_front,
       "",
       {},
       "true: touches never go out while another window covers the pinned one."},
      {"sending",
       "hotkey",
       &c.sending.hotkey,
       "",
       {},
       "X11: keys that turn the sending off and on, such as \"Ctrl+Alt+H\"; empty: none."},

      {"overlay",
       "show",
       &c.overlay.show,
       "",
       {},
       "true: the touched box is outlined on the screen (X11), in red, and in green once the other side has felt it; "
       "the whole person in pink for a moment when they hug back."},

      {"hug",
       "notify",
       &c.hug.notify,
       "",
       {},
       "true: when the other side hugs back the desktop shows a notification, with a sound."},

      {"feedback", "link", &c.feedback.link, "", parsed_by(parse_optional_jacket_link),
       "A small actuator at the toucher's finger that answers when a touch was felt: as [jacket] link of the passive "
       "side; empty: none."},
      {"feedback",
       "profile",
       &c.feedback.profile,
       "",
       {},
       "File that describes it, as a jacket profile, or the name of an installed one."},
      {"feedback", "strength", &c.feedback.strength, "", Range{0.05, 1}, "How strong, of what its profile allows."},
  };
  append(rows, peer_rows(c.peer));
  append(rows, {{"peer", "heartbeat_timeout_ms", &c.heartbeat_timeout_ms, "ms", heartbeat_timeout,
                 "Without a heartbeat for so long the peer counts as absent."}});
  append(rows, common_rows(c.control, c.web, c.log));
  return rows;
}

std::vector<Fault> impossible_combinations(const ActiveConfig& c, const std::vector<Key>& keys) {
  std::vector<Fault> faults = impossible_peers(c.peer, keys);
  if ((c.rig.screen.width_mm > 0) != (c.rig.screen.height_mm > 0)) {
    faults.push_back({place_of(keys, {"rig.screen_width_mm", "rig.screen_height_mm"}),
                      "rig.screen_width_mm and rig.screen_height_mm must both be given, or both be 0"});
  }
  if ((c.rig.screen.width_px > 0) != (c.rig.screen.height_px > 0)) {
    faults.push_back({place_of(keys, {"rig.screen_width_px", "rig.screen_height_px"}),
                      "rig.screen_width_px and rig.screen_height_px must both be given, or both be 0"});
  }
  if (c.body_map.hold_ms > c.body_map.max_age_ms) {
    faults.push_back(
        {place_of(keys, {"body_map.hold_ms", "body_map.max_age_ms"}),
         fmt::format("body_map.hold_ms ({}) must not exceed body_map.max_age_ms ({}): a held face would be refused",
                     c.body_map.hold_ms, c.body_map.max_age_ms)});
  }
  if (c.camera.power_line_hz != 0 && c.camera.power_line_hz != 50 && c.camera.power_line_hz != 60) {
    faults.push_back({place_of(keys, {"camera.power_line_hz"}), "camera.power_line_hz must be 0, 50 or 60"});
  }
  // YUYV shares the colour of two neighbouring pixels.
  if (c.camera.width_px % 2 != 0) {
    faults.push_back({place_of(keys, {"camera.width_px"}), "camera.width_px must be even"});
  }
  return faults;
}

}  // namespace telehug
