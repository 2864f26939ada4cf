// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <cerrno>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "calibration/calibration_reader.hpp"
#include "files/text_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

toml::table to_table(const PointObservation& point) {
  return toml::table{{"x_mm", point.screen.x_mm}, {"y_mm", point.screen.y_mm},      {"u_px", point.image.u_px},
                     {"v_px", point.image.v_px},  {"sigma_u_px", point.sigma_u_px}, {"sigma_v_px", point.sigma_v_px}};
}

void add(toml::table& table, const ThesisCalibration& thesis) {
  toml::array touches;
  for (const MeasuredTouch& touch : thesis.touches) {
    touches.push_back(toml::table{{"x_mm", touch.screen.x_mm},
                                  {"y_mm", touch.screen.y_mm},
                                  {"length_px", touch.length_px},
                                  {"column_px", touch.column_px}});
  }
  table.insert("touch", std::move(touches));
}

void add(toml::table& table, const RigCalibration& rig) {
  const RigCameraParameters& camera = rig.solution.model.camera.parameters();
  const PictureOrientation picture = rig.solution.model.camera.orientation();
  table.insert("parameters", toml::table{{"focal_px", camera.focal_px},
                                         {"k1", camera.k1},
                                         {"x0_mm", camera.position_mm.x_mm},
                                         {"y0_mm", camera.position_mm.y_mm},
                                         {"z0_mm", camera.position_mm.z_mm},
                                         {"pitch_deg", camera.pitch_deg},
                                         {"yaw_deg", camera.yaw_deg},
                                         {"roll_deg", camera.roll_deg},
                                         {"contact_radius_mm", rig.solution.model.contact_radius_mm},
                                         {"left_right_exchanged", picture.left_right_exchanged},
                                         {"top_bottom_exchanged", picture.top_bottom_exchanged}});
  toml::array touches;
  for (std::size_t i = 0; i < rig.observations.touches.size(); ++i) {
    toml::table touch = to_table(rig.observations.touches[i]);
    touch.insert("seen", name_of(rig.observations.touches[i].evidence));
    if (rig.observations.touches[i].left_out) touch.insert("left_out", true);
    touch.insert("error_x_mm", rig.solution.touches[i].error_mm.x_mm);
    touch.insert("error_y_mm", rig.solution.touches[i].error_mm.y_mm);
    touches.push_back(std::move(touch));
  }
  toml::array marks;
  for (const PointObservation& mark : rig.observations.marks)
    marks.push_back(to_table(mark));
  toml::array border;
  for (const BorderObservation& point : rig.observations.border) {
    border.push_back(toml::table{{"u_px", point.image.u_px}, {"v_px", point.image.v_px}, {"sigma_px", point.sigma_px}});
  }
  table.insert("touch", std::move(touches));
  if (!marks.empty()) table.insert("mark", std::move(marks));
  if (!border.empty()) table.insert("border_point", std::move(border));
}

std::string to_toml(const Calibration& c) {
  toml::table table{
      {"version", std::holds_alternative<RigCalibration>(c.solved) ? 2 : 1},
      {"camera", c.camera},
      {"date", c.date},
      {"model", c.model_name()},
      {"image", toml::table{{"width_px", c.image.width_px}, {"height_px", c.image.height_px}}},
      {"screen", toml::table{{"width_mm", c.screen.width_mm},
                             {"height_mm", c.screen.height_mm},
                             {"width_px", c.screen.width_px},
                             {"height_px", c.screen.height_px}}},
      {"border", toml::table{{"v0_px", c.border.v0_px}, {"slope", c.border.slope}}},
  };
  std::visit([&](const auto& solved) { add(table, solved); }, c.solved);
  std::ostringstream out;
  out << "# How telehug sees touches on this screen; written by the calibration.\n" << table << '\n';
  return out.str();
}

Status write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) return Error{std::generic_category().message(errno)};
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor) != 0) return Error{std::generic_category().message(errno)};
  return Done{};
}

}  // namespace

Result<Calibration> read_calibration(const fs::path& path) {
  try {
    const auto text = read_text_file(path);
    if (!text) {
      return Error{fmt::format("{}: {}; calibrate, or name another file", path.string(), text.error().message)};
    }
    const toml::table table = toml::parse(*text, path.string());
    return CalibrationReader(table, path).read();
  } catch (const toml::parse_error& error) {
    return Error{fmt::format("{}:{}: {}", path.string(), error.source().begin.line, error.description())};
  }
}

Status write_calibration(const fs::path& path, const Calibration& calibration) {
  std::error_code code;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
  if (code) return Error{fmt::format("can't make the folder {}: {}", path.parent_path().string(), code.message())};
  const std::string unfinished = path.string() + fmt::format(".{}.part", ::getpid());
  const int descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Error{fmt::format("can't write {}: {}", path.string(), std::generic_category().message(errno))};
  }
  Status written = write_whole(descriptor, to_toml(calibration));
  ::close(descriptor);
  if (written) fs::rename(unfinished, path, code);
  if (written && !code) return Done{};
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return Error{fmt::format("can't write {}: {}", path.string(), code ? code.message() : written.error().message)};
}

}  // namespace telehug
