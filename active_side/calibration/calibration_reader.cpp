// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_reader.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "calibration/rig_residuals.hpp"

namespace telehug {
namespace {

constexpr std::int64_t max_picture_px = 8192;
constexpr std::int64_t max_desktop_px = 32'768;
constexpr double max_screen_mm = 10'000;
// A camera that is rolled more than this does not look along the screen.
constexpr double max_border_slope = 0.5;

constexpr CalibrationReader::Range any_number{-1e6, 1e6};
// Above 0, and more than rounding leaves of a length that is really 0.
constexpr double least_length = 1e-3;
constexpr double least_sigma_px = 1e-6;

// A touch that the parameters in the file place farther than this from where they place it when they are solved again
// was not made with them.
constexpr double largest_contradiction_mm = 0.5;

constexpr std::array<const char*, RigParameter::count> parameter_keys{
    "focal_px", "k1", "x0_mm", "y0_mm", "z0_mm", "pitch_deg", "yaw_deg", "roll_deg", "contact_radius_mm"};

std::size_t line_of(const toml::node* node, std::size_t otherwise) {
  return node != nullptr ? node->source().begin.line : otherwise;
}

}  // namespace

Result<Calibration> CalibrationReader::read() {
  const Section top{&table_, 1};
  const auto version = integer(top, "version", 1, std::numeric_limits<std::int32_t>::max());
  if (version > newest_version) {
    return Error{
        fmt::format("{}:{}: version {} of this file is newer than this program, which knows version {}; "
                    "update telehug or calibrate again",
                    file_.string(), line_of(table_["version"].node(), 1), version, newest_version)};
  }
  const std::string camera = text("camera");
  const std::string date = text("date");
  const std::string model = text("model");
  if (!model.empty() && model != "thesis" && model != "default") {
    fault(line_of(table_["model"].node(), 1),
          fmt::format("model \"{}\" is unknown; there are \"thesis\" and \"default\"", model));
  }
  const Section image_section = section("image");
  const ImageSize image{static_cast<int>(integer(image_section, "width_px", 1, max_picture_px)),
                        static_cast<int>(integer(image_section, "height_px", 1, max_picture_px))};
  const Section screen_section = section("screen");
  const Range size_mm{least_length, max_screen_mm};
  const ScreenSize screen{number(screen_section, "width_mm", size_mm), number(screen_section, "height_mm", size_mm),
                          static_cast<int>(integer(screen_section, "width_px", 0, max_desktop_px)),
                          static_cast<int>(integer(screen_section, "height_px", 0, max_desktop_px))};
  const Section border_section = section("border");
  const BorderLine border{number(border_section, "v0_px", any_number),
                          number(border_section, "slope", {-max_border_slope, max_border_slope})};
  const Common common{camera, date, image, screen, border};
  return model == "default" ? with_rig_model(common) : with_thesis_model(common);
}

Result<Calibration> CalibrationReader::with_thesis_model(const Common& c) {
  const auto touches = thesis_touches();
  if (!faults_.empty()) return Error{faults_};
  const auto model = ThesisTouchModel::solve(c.screen, touches[0], touches[1]);
  if (!model) return Error{fmt::format("{}: {}", file_.string(), model.error().message)};
  return Calibration{c.camera, c.date, c.image, c.screen, c.border, ThesisCalibration{touches, *model}};
}

Result<Calibration> CalibrationReader::with_rig_model(const Common& c) {
  const Section parameter_section = section("parameters");
  const RigParameters stored = parameters(parameter_section);
  const PictureOrientation picture = orientation(parameter_section);
  const RigObservations observations{c.screen, c.image, points("touch"), points("mark"), border_points()};
  if (!faults_.empty()) return Error{faults_};
  auto solution = solve_rig(observations, {std::nullopt, picture});
  if (!solution) return Error{fmt::format("{}: {}", file_.string(), solution.error().message)};
  const RigModel model = make_rig_model(stored, c.image, picture);
  for (std::size_t i = 0; i < observations.touches.size(); ++i) {
    if (observations.touches[i].left_out) continue;
    const auto here = touched_point(model, observations.touches[i]);
    const auto solved = touched_point(solution->model, observations.touches[i]);
    if (here && solved && std::hypot(here->x_mm - solved->x_mm, here->y_mm - solved->y_mm) < largest_contradiction_mm) {
      continue;
    }
    return Error{
        fmt::format("{}:{}: these parameters do not follow from the touches in this file, see touch {}: "
                    "calibrate again",
                    file_.string(), parameter_section.line, i + 1)};
  }
  return Calibration{c.camera, c.date, c.image, c.screen, c.border, RigCalibration{observations, *std::move(solution)}};
}

void CalibrationReader::fault(std::size_t line, std::string_view what) {
  if (!faults_.empty()) faults_ += '\n';
  faults_ += fmt::format("{}:{}: {}", file_.string(), line, what);
}

CalibrationReader::Section CalibrationReader::section(const char* name) {
  const toml::node* node = table_.get(name);
  const toml::table* found = node != nullptr ? node->as_table() : nullptr;
  if (found == nullptr) fault(line_of(node, 1), fmt::format("the section [{}] is missing", name));
  return {found, line_of(node, 1)};
}

std::string CalibrationReader::text(const char* key) {
  const toml::node* node = table_.get(key);
  const auto value = node != nullptr ? node->value<std::string>() : std::nullopt;
  if (!value || value->empty()) fault(line_of(node, 1), fmt::format("{} must be a text", key));
  return value.value_or("");
}

std::int64_t CalibrationReader::integer(const Section& from, const char* key, std::int64_t least, std::int64_t most) {
  if (from.table == nullptr) return 0;
  const toml::node* node = from.table->get(key);
  const auto value = node != nullptr && node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (value && *value >= least && *value <= most) return *value;
  fault(line_of(node, from.line), fmt::format("{} must be a whole number from {} to {}", key, least, most));
  return 0;
}

double CalibrationReader::number(const Section& from, const char* key, Range range) {
  if (from.table == nullptr) return 0;
  const toml::node* node = from.table->get(key);
  const auto value = node != nullptr ? node->value<double>() : std::nullopt;
  if (value && *value >= range.least && *value <= range.most) return *value;  // false for nan, too
  fault(line_of(node, from.line), fmt::format("{} must be a number from {} to {}", key, range.least, range.most));
  return 0;
}

// The tables of an array [[name]]; none if there is no such array.
std::vector<CalibrationReader::Section> CalibrationReader::sections(const char* name) {
  std::vector<Section> found;
  const toml::node* node = table_.get(name);
  if (node == nullptr) return found;
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous<toml::table>()) {
    fault(line_of(node, 1), fmt::format("{} must be sections [[{}]]", name, name));
    return found;
  }
  for (const toml::node& entry : *array)
    found.push_back({entry.as_table(), entry.source().begin.line});
  return found;
}

std::array<MeasuredTouch, 2> CalibrationReader::thesis_touches() {
  std::array<MeasuredTouch, 2> touches{};
  const auto found = sections("touch");
  if (found.size() != touches.size()) {
    fault(line_of(table_.get("touch"), 1), "there must be two [[touch]] sections, one a calibration touch");
    return touches;
  }
  const Range size{0, max_screen_mm};
  for (std::size_t i = 0; i < touches.size(); ++i) {
    touches[i] = {{number(found[i], "x_mm", size), number(found[i], "y_mm", size)},
                  number(found[i], "length_px", {least_length, static_cast<double>(max_picture_px)}),
                  number(found[i], "column_px", any_number)};
  }
  return touches;
}

std::vector<PointObservation> CalibrationReader::points(const char* name) {
  std::vector<PointObservation> found;
  for (const Section& point : sections(name)) {
    const Range size{0, max_screen_mm};
    found.push_back({{number(point, "x_mm", size), number(point, "y_mm", size)},
                     {number(point, "u_px", any_number), number(point, "v_px", any_number)},
                     number(point, "sigma_u_px", {least_sigma_px, 1000}),
                     number(point, "sigma_v_px", {least_sigma_px, 1000}),
                     evidence(point),
                     left_out(point)});
  }
  return found;
}

// Files without it are older than the dots' use.
TouchEvidence CalibrationReader::evidence(const Section& from) {
  const toml::node* node = from.table->get("seen");
  if (node == nullptr) return TouchEvidence::fingertip;
  const std::string what = node->value_or(std::string{});
  for (const TouchEvidence evidence : {TouchEvidence::dot, TouchEvidence::contact, TouchEvidence::fingertip}) {
    if (what == name_of(evidence)) return evidence;
  }
  fault(line_of(node, from.line), "seen must be \"fingertip\", \"dot\" or \"contact\"");
  return TouchEvidence::fingertip;
}

bool CalibrationReader::left_out(const Section& from) {
  const toml::node* node = from.table->get("left_out");
  const auto value = node != nullptr ? node->value<bool>() : std::optional(false);
  if (!value) fault(line_of(node, from.line), "left_out must be true or false");
  return value.value_or(false);
}

std::vector<BorderObservation> CalibrationReader::border_points() {
  std::vector<BorderObservation> found;
  for (const Section& point : sections("border_point")) {
    found.push_back({{number(point, "u_px", any_number), number(point, "v_px", any_number)},
                     number(point, "sigma_px", {least_sigma_px, 1000})});
  }
  return found;
}

RigParameters CalibrationReader::parameters(const Section& from) {
  RigParameters found{};
  for (std::size_t i = 0; i < found.size(); ++i)
    found[i] = number(from, parameter_keys[i], any_number);
  return found;
}

PictureOrientation CalibrationReader::orientation(const Section& from) {
  PictureOrientation found;
  if (from.table == nullptr) return found;
  const auto flag = [&](const char* key) {
    const toml::node* node = from.table->get(key);
    const auto value = node != nullptr && node->is_boolean() ? node->value<bool>() : std::nullopt;
    if (!value) fault(line_of(node, from.line), fmt::format("{} must be true or false", key));
    return value.value_or(false);
  };
  found.left_right_exchanged = flag("left_right_exchanged");
  found.top_bottom_exchanged = flag("top_bottom_exchanged");
  return found;
}

}  // namespace telehug
