// SPDX-License-Identifier: Apache-2.0
//
// Of the active side: camera, light, monitor, calibration, desktop.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "ctl/doctor/checks.hpp"
#include "ctl/doctor/device_finding.hpp"

namespace telehug {
namespace {

// Of a picture in which a finger can be told from the screen's border; the recordings in tests/fixtures lie far inside.
constexpr double darkest_mean = 0.12;
constexpr double most_blown = 0.35;
constexpr double most_flicker = 0.08;
constexpr double least_rate = 0.7;  // of what is asked for

bool about(double a, double b) {
  return std::abs(a - b) <= 0.03 * std::max(a, b);  // EDID rounds; a border's width is more
}

std::string calibrate_command(const DoctorFacts& facts) {
  const Account& account = find_side(facts, Side::active)->account;
  const std::string program =
      account.self
          ? "telehug-active calibrate"
          : fmt::format("sudo -u {} env STATE_DIRECTORY=/var/lib/telehug telehug-active calibrate", account.name);
  if (facts.monitors.empty()) {
    return "measure the visible picture with a ruler, then: " + program + " --width-mm WIDTH --height-mm HEIGHT";
  }
  return fmt::format("{} --width-mm {:.0f} --height-mm {:.0f}", program, facts.monitors.front().width_mm,
                     facts.monitors.front().height_mm);
}

Finding calibrated_for_monitor(const DoctorFacts& facts) {
  const CalibrationFacts& rig = facts.calibration;
  if (facts.monitors.empty())
    return {"calibration", Level::ok, "there is one; no monitor tells its size, to compare with", {}};
  for (const MonitorSize& monitor : facts.monitors)
    if (about(monitor.width_mm, rig.width_mm) && about(monitor.height_mm, rig.height_mm))
      return {"calibration", Level::ok, fmt::format("fits the monitor {}", monitor.name), {}};
  const MonitorSize& monitor = facts.monitors.front();
  return {"calibration", Level::warn,
          fmt::format("it is of a screen of {:.0f} x {:.0f} mm; the monitor {} has {:.0f} x {:.0f} mm", rig.width_mm,
                      rig.height_mm, monitor.name, monitor.width_mm, monitor.height_mm),
          "measure the visible picture; if the monitor is another one: " + calibrate_command(facts)};
}

}  // namespace

Findings check_camera(const DoctorFacts& facts) {
  const SideFacts* side = find_side(facts, Side::active);
  if (side == nullptr || !facts.wants_webcam) return {};
  return {device_finding("camera", "webcam", facts.configured_camera, facts.cameras, "video", *side,
                         talks(facts, Side::active))};
}

Findings check_light(const DoctorFacts& facts) {
  if (!facts.light) return {};
  const LightFacts& light = *facts.light;
  const char* tune = "telehug-active camera tune";
  if (!light.problem.empty())
    return {{"light", Level::fail, "the camera shows nothing: " + light.problem,
             "close what else uses it, unplug it and plug it in again; then telehug-active camera check"}};
  Findings findings;
  const auto warn = [&](const std::string& what, const std::string& fix) {
    findings.push_back({"light", Level::warn, what, fix});
  };
  if (light.mean < darkest_mean)
    warn(fmt::format("the camera's picture is dark: {:.0f} % of white on the average", 100 * light.mean),
         fmt::format("uncover the camera, turn on a light; then {}", tune));
  if (light.blown_share > most_blown)
    warn(fmt::format("{:.0f} % of the camera's picture are blown out", 100 * light.blown_share),
         fmt::format("turn lamp or window away from it, or choose a shorter exposure: {}", tune));
  if (light.flicker > most_flicker)
    warn(fmt::format("the camera's picture flickers by {:.0f} %", 100 * light.flicker),
         "set camera.power_line_hz to 50 or 60, as the mains have it");
  if (light.asked_hz > 0 && light.rate_hz < least_rate * light.asked_hz)
    warn(fmt::format("the camera takes {:.1f} pictures a second instead of {:.0f}: it exposes each for long, or its "
                     "USB port is slow",
                     light.rate_hz, light.asked_hz),
         fmt::format("turn on a light, or {}; plug it into a USB port of its own", tune));
  if (findings.empty())
    findings.push_back({"light",
                        Level::ok,
                        fmt::format("picture at {:.0f} % of white, {:.0f} % blown out, {:.1f} pictures a second",
                                    100 * light.mean, 100 * light.blown_share, light.rate_hz),
                        {}});
  return findings;
}

Findings check_monitor(const DoctorFacts& facts) {
  if (find_side(facts, Side::active) == nullptr) return {};
  if (!facts.monitors.empty()) {
    const MonitorSize& monitor = facts.monitors.front();
    return {{"monitor",
             Level::ok,
             fmt::format("{} tells {:.0f} x {:.0f} mm", monitor.name, monitor.width_mm, monitor.height_mm),
             {}}};
  }
  if (facts.configured_screen_width_mm > 0 || (facts.calibration.there && facts.calibration.width_mm > 0))
    return {{"monitor", Level::ok, "none tells its size; it was measured by hand", {}}};
  return {{"monitor", Level::warn, "no monitor tells its size",
           "measure the visible picture with a ruler, and set rig.screen_width_mm and rig.screen_height_mm"}};
}

Findings check_calibration(const DoctorFacts& facts) {
  if (find_side(facts, Side::active) == nullptr) return {};
  const CalibrationFacts& rig = facts.calibration;
  if (rig.secret)
    return {{"calibration", Level::warn, fmt::format("{} is not for this user to look for", rig.file),
             "sudo telehug doctor --system"}};
  if (!rig.there)
    return {{"calibration", Level::fail, fmt::format("there is no calibration at {}", rig.file),
             "on the page that `telehug open` shows, or: " + calibrate_command(facts)}};
  if (!rig.trouble.empty())
    return {{"calibration", Level::fail, fmt::format("{}: {}", rig.file, rig.trouble), calibrate_command(facts)}};
  if (facts.wants_webcam && rig.width_px > 0 &&
      (rig.width_px != facts.picture_width_px || rig.height_px != facts.picture_height_px))
    return {{"calibration", Level::fail,
             fmt::format("it is of pictures of {} x {} px; the camera is asked for {} x {}", rig.width_px,
                         rig.height_px, facts.picture_width_px, facts.picture_height_px),
             fmt::format("set camera.width_px = {} and camera.height_px = {}, or calibrate again", rig.width_px,
                         rig.height_px)}};
  return {calibrated_for_monitor(facts)};
}

Findings check_session(const DoctorFacts& facts) {
  if (find_side(facts, Side::active) == nullptr || !facts.wants_screen) return {};
  const auto fail = [](const std::string& what, const std::string& fix) {
    return Findings{{"screen", Level::fail, what, fix}};
  };
  // Its drop-in names the X server, and this shell's is another one.
  if (!find_side(facts, Side::active)->account.self)
    return {{"screen", Level::ok, fmt::format("as {}.service has it", system_unit(Side::active)), {}}};
  if (facts.display.empty() && facts.wayland.empty()) {
    // The unit of a user, or somebody at another terminal, has the desktop that this shell lacks.
    if (talks(facts, Side::active)) return {{"screen", Level::ok, "the daemon's; this shell has none", {}}};
    if (facts.through_sudo)
      return {{"screen", Level::ok, "not looked at: sudo hides the desktop, telehug doctor without it does not", {}}};
    return fail("there is no desktop to look at in this session",
                "run telehug-active in the session of the person at the monitor");
  }
  if (!facts.wayland.empty()) {
    if (!facts.wayland_answers)
      return fail(fmt::format("the Wayland desktop {} does not answer", facts.wayland),
                  "log in again, and run it as the person who is logged in there");
    if (!facts.portal_trouble.empty())
      return fail("this Wayland desktop shares no screen: " + facts.portal_trouble,
                  "sudo apt install pipewire wireplumber xdg-desktop-portal and the desktop's own: "
                  "xdg-desktop-portal-gnome, -kde or -wlr; then log in again");
    if (facts.pins_window)
      return {{"screen", Level::warn, "on a Wayland desktop no window can be pinned (body_map.window)",
               "share the monitor when the desktop asks, and use `telehug send on`; or log in to an X11 session"}};
    return {{"screen", Level::ok, "a Wayland desktop; touches go out after `telehug send on`", {}}};
  }
  if (!facts.display_answers)
    return fail(fmt::format("no X server answers as DISPLAY={}", facts.display),
                "correct DISPLAY: `echo $DISPLAY` in a terminal of that desktop tells it");
  return {{"screen", Level::ok, "an X11 desktop", {}}};
}

}  // namespace telehug
