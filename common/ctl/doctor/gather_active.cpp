// SPDX-License-Identifier: Apache-2.0
//
// Of the active side: cameras, light, calibration, monitors, desktop.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <toml++/toml.h>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "bus/bus_connection.hpp"
#include "config/locator.hpp"
#include "config/places.hpp"
#include "ctl/doctor/gather.hpp"
#include "ctl/run_program.hpp"
#include "files/text_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

CalibrationFacts calibration_at(const fs::path& file) {
  CalibrationFacts facts;
  facts.file = file.string();
  std::error_code ignored;
  facts.there = fs::exists(file, ignored);
  if (!facts.there) return facts;
  auto text = read_text_file(file);
  if (!text) {
    facts.trouble = text.error().message;
    return facts;
  }
  try {
    const toml::table table = toml::parse(*text);
    facts.width_mm = table["screen"]["width_mm"].value_or(0.0);
    facts.height_mm = table["screen"]["height_mm"].value_or(0.0);
    facts.width_px = table["image"]["width_px"].value_or(0);
    facts.height_px = table["image"]["height_px"].value_or(0);
    if (facts.width_mm <= 0 || facts.height_mm <= 0) facts.trouble = "it has no size of the screen";
  } catch (const toml::parse_error& problem) {
    facts.trouble = problem.description();
  }
  return facts;
}

// VESA E-EDID 1.4, 3.10.2: the first detailed timing (byte 54) tells the picture's size in mm.
std::vector<MonitorSize> connected_monitors(const fs::path& root) {
  std::vector<MonitorSize> monitors;
  for (const fs::path& connector : entries(root / "sys/class/drm")) {
    const std::string edid = content_of(connector / "edid");
    if (edid.size() < 128 || !content_of(connector / "status").starts_with("connected")) continue;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(edid[at])); };
    const unsigned width = byte(66) | (byte(68) >> 4) << 8;
    const unsigned height = byte(67) | (byte(68) & 0xF) << 8;
    const std::string name = connector.filename().string();
    if (width > 0 && height > 0)
      monitors.push_back({name.substr(name.find('-') + 1), static_cast<double>(width), static_cast<double>(height)});
  }
  return monitors;
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// `name` may begin with a null byte: of Linux' abstract sockets.
bool somebody_listens(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.empty() || name.size() >= sizeof address.sun_path) return false;
  std::memcpy(address.sun_path, name.data(), name.size());
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  const bool answers = ::connect(fd, reinterpret_cast<const sockaddr*>(&address), length) == 0 || errno == EAGAIN;
  ::close(fd);
  return answers;
}

// X(7): host:display.screen. Only this PC's own are asked; another PC's screen is not what a camera looks along.
bool display_answers(const std::string& display) {
  const std::size_t colon = display.rfind(':');
  if (colon == std::string::npos) return false;
  const std::string host = display.substr(0, colon);
  if (!host.empty() && host != "unix") return true;
  const std::string number = display.substr(colon + 1, display.find('.', colon) - colon - 1);
  const std::string path = "/tmp/.X11-unix/X" + number;
  return somebody_listens(path) || somebody_listens(std::string(1, '\0') + path);
}

std::string wayland_socket(const std::string& display) {
  return display.starts_with('/') ? display : variable("XDG_RUNTIME_DIR") + "/" + display;
}

std::string portal_trouble() {
  auto bus = connect_to_bus("", "to ask for the desktop's portal");
  if (!bus) return "there is no session bus";
  sd_bus_error failure = SD_BUS_ERROR_NULL;
  sd_bus_message* made = nullptr;
  constexpr std::uint64_t patience_us = 5'000'000;  // it may have to be started
  sd_bus_message* call = nullptr;
  sd_bus_message_new_method_call(bus->get(), &call, "org.freedesktop.portal.Desktop", "/org/freedesktop/portal/desktop",
                                 "org.freedesktop.DBus.Properties", "Get");
  const BusMessage asking(call);
  sd_bus_message_append(call, "ss", "org.freedesktop.portal.ScreenCast", "version");
  const int code = sd_bus_call(bus->get(), call, patience_us, &failure, &made);
  const BusMessage answer(made);
  const bool unknown = failure.name != nullptr && (std::strstr(failure.name, "ServiceUnknown") != nullptr ||
                                                   std::strstr(failure.name, "NameHasNoOwner") != nullptr);
  sd_bus_error_free(&failure);
  if (code >= 0) return "";
  return unknown ? "there is no xdg-desktop-portal" : "its xdg-desktop-portal can't share screens";
}

void gather_desktop(DoctorFacts& facts) {
  facts.display = variable("DISPLAY");
  facts.wayland = variable("WAYLAND_DISPLAY");
  if (!facts.display.empty()) facts.display_answers = display_answers(facts.display);
  if (facts.wayland.empty()) return;
  facts.wayland_answers = somebody_listens(wayland_socket(facts.wayland));
  if (facts.wayland_answers) facts.portal_trouble = portal_trouble();
}

// The last line that is an object; what comes before are warnings.
std::optional<LightFacts> light_in(const std::string& output) {
  std::istringstream lines(output);
  nlohmann::json told;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('{')) told = nlohmann::json::parse(line, nullptr, false);
  if (!told.is_object()) return std::nullopt;
  LightFacts light;
  const auto number = [&](const char* key) {
    const auto found = told.find(key);
    return found != told.end() && found->is_number() ? found->get<double>() : 0.0;
  };
  if (const auto problem = told.find("problem"); problem != told.end() && problem->is_string())
    light.problem = problem->get<std::string>();
  light.mean = number("mean");
  light.dark_share = number("dark_share");
  light.blown_share = number("blown_share");
  light.flicker = number("flicker");
  light.rate_hz = number("rate_hz");
  light.asked_hz = number("asked_hz");
  return light;
}

// A daemon that uses the camera looks at its pictures itself.
bool daemon_has_camera(const DoctorFacts& facts) {
  for (const auto& status : facts.daemons) {
    const auto camera = status.value("camera", nlohmann::json::object());
    if (status.value("side", "") == "active" &&
        (camera.value("open", false) || camera.value("why", "") == "a set-up uses it"))
      return true;
  }
  return false;
}

std::optional<LightFacts> look_through_camera(const DoctorFacts& facts, const ConfigSources& sources) {
  const fs::path program = installed_program("telehug-active");
  if (program.empty() || daemon_has_camera(facts)) return std::nullopt;
  std::vector<std::string> command{program.string(), "camera", "check", "--json"};
  if (sources.only_file) command.insert(command.end(), {"--config", sources.only_file->string()});
  const auto run = run_program(command, 20s, "there is no telehug-active");
  return run ? light_in(run->output) : std::nullopt;
}

bool camera_is_usable(const DoctorFacts& facts) {
  const auto& wanted = facts.configured_camera;
  for (const DeviceNode& node : facts.cameras)
    if (node.usable && (wanted.empty() || node.path == wanted)) return true;
  return false;
}

}  // namespace

void gather_active(DoctorFacts& facts, const DoctorWishes& wishes, SideFacts& side) {
  const ActiveConfig config = readable_active_config(wishes.sources);
  gather_either(facts, side, config.peer, config.web);
  const auto source = parse_camera_source(config.camera.source);
  facts.wants_webcam = source && source->kind == CameraSourceKind::webcam;
  facts.configured_camera = config.camera.device;
  facts.picture_width_px = config.camera.width_px;
  facts.picture_height_px = config.camera.height_px;
  for (const fs::path& device : entries(wishes.root / "dev"))
    if (device.filename().string().starts_with("video"))
      facts.cameras.push_back(device_node(wishes.root, device, side.account));
  add_named(facts.cameras, wishes.root, config.camera.device, side.account);
  // Below another root there are no cameras to look through; a recording is one anywhere.
  const bool can_look = side.account.self && (facts.wants_webcam ? camera_is_usable(facts) && wishes.root == "/"
                                                                 : static_cast<bool>(source));
  if (side.config_faults.empty() && can_look) facts.light = look_through_camera(facts, wishes.sources);
  facts.calibration = calibration_at(rig_file(config.rig));
  facts.calibration.secret = side.pairs_secret && !facts.calibration.there;
  facts.configured_screen_width_mm = config.rig.screen.width_mm;
  facts.monitors = connected_monitors(wishes.root);
  const auto screen = parse_screen_source(config.body_map.source);
  facts.wants_screen = screen && config.body_map.picture.empty() &&
                       (screen->kind == ScreenSourceKind::automatic || screen->kind == ScreenSourceKind::x11 ||
                        screen->kind == ScreenSourceKind::portal);
  facts.pins_window = !config.body_map.window.empty();
  gather_desktop(facts);
}

}  // namespace telehug
