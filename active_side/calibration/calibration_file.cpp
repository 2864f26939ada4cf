// SPDX-License-Identifier: Apache-2.0
#include "calibration/calibration_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t layout_version = 1;
constexpr std::int64_t max_picture_px = 8192;
constexpr std::int64_t max_desktop_px = 32'768;
constexpr double max_screen_mm = 10'000;
// A camera that is rolled more than this does not look along the screen.
constexpr double max_border_slope = 0.5;

struct Range {
  double least;
  double most;
};
constexpr Range any_number{-1e6, 1e6};
// Above 0, and more than rounding leaves of a length that is really 0.
constexpr double least_length = 1e-3;

class CalibrationReader {
 public:
  CalibrationReader(const toml::table& table, const fs::path& file) : file_(file), table_(table) {}

  Result<Calibration> read() {
    if (const auto version = integer(&table_, 1, "version", 1, std::numeric_limits<std::int32_t>::max());
        version > layout_version) {
      return Error{
          fmt::format("{}:{}: version {} of this file is newer than this program, which knows version {}; "
                      "update telehug or calibrate again",
                      file_.string(), line_of(table_["version"].node(), 1), version, layout_version)};
    }
    const std::string camera = text("camera");
    const std::string date = text("date");
    if (const std::string model = text("model"); !model.empty() && model != "thesis") {
      fault(line_of(table_["model"].node(), 1), fmt::format("model \"{}\" is unknown; there is \"thesis\"", model));
    }
    const auto [image_table, image_line] = section("image");
    const ImageSize image{static_cast<int>(integer(image_table, image_line, "width_px", 1, max_picture_px)),
                          static_cast<int>(integer(image_table, image_line, "height_px", 1, max_picture_px))};
    const auto [screen_table, screen_line] = section("screen");
    const Range size_mm{least_length, max_screen_mm};
    const ScreenSize screen{number(screen_table, screen_line, "width_mm", size_mm),
                            number(screen_table, screen_line, "height_mm", size_mm),
                            static_cast<int>(integer(screen_table, screen_line, "width_px", 0, max_desktop_px)),
                            static_cast<int>(integer(screen_table, screen_line, "height_px", 0, max_desktop_px))};
    const auto [border_table, border_line] = section("border");
    const BorderLine border{number(border_table, border_line, "v0_px", any_number),
                            number(border_table, border_line, "slope", {-max_border_slope, max_border_slope})};
    const auto touches = read_touches();
    if (!faults_.empty()) return Error{faults_};
    auto model = ThesisTouchModel::solve(screen, touches[0], touches[1]);
    if (!model) return Error{fmt::format("{}: {}", file_.string(), model.error().message)};
    return Calibration{camera, date, image, screen, border, touches, *model};
  }

 private:
  void fault(std::size_t line, std::string_view what) {
    if (!faults_.empty()) faults_ += '\n';
    faults_ += fmt::format("{}:{}: {}", file_.string(), line, what);
  }

  static std::size_t line_of(const toml::node* node, std::size_t otherwise) {
    return node != nullptr ? node->source().begin.line : otherwise;
  }

  std::pair<const toml::table*, std::size_t> section(const char* name) {
    const toml::node* node = table_.get(name);
    const toml::table* found = node != nullptr ? node->as_table() : nullptr;
    if (found == nullptr) fault(line_of(node, 1), fmt::format("the section [{}] is missing", name));
    return {found, line_of(node, 1)};
  }

  // Each of these returns a value without meaning after a fault.
  std::string text(const char* key) {
    const toml::node* node = table_.get(key);
    const auto value = node != nullptr ? node->value<std::string>() : std::nullopt;
    if (!value || value->empty()) fault(line_of(node, 1), fmt::format("{} must be a text", key));
    return value.value_or("");
  }

  std::int64_t integer(const toml::table* from, std::size_t line, const char* key, std::int64_t least,
                       std::int64_t most) {
    if (from == nullptr) return 0;
    const toml::node* node = from->get(key);
    const auto value = node != nullptr && node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (value && *value >= least && *value <= most) return *value;
    fault(line_of(node, line), fmt::format("{} must be a whole number from {} to {}", key, least, most));
    return 0;
  }

  double number(const toml::table* from, std::size_t line, const char* key, Range range) {
    if (from == nullptr) return 0;
    const toml::node* node = from->get(key);
    const auto value = node != nullptr ? node->value<double>() : std::nullopt;
    if (value && *value >= range.least && *value <= range.most) return *value;  // false for nan, too
    fault(line_of(node, line), fmt::format("{} must be a number from {} to {}", key, range.least, range.most));
    return 0;
  }

  std::array<MeasuredTouch, 2> read_touches() {
    std::array<MeasuredTouch, 2> touches{};
    const toml::node* node = table_.get("touch");
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    if (array == nullptr || array->size() != touches.size() || !array->is_homogeneous<toml::table>()) {
      fault(line_of(node, 1), "there must be two [[touch]] sections, one a calibration touch");
      return touches;
    }
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const toml::table* touch = array->get(i)->as_table();
      const std::size_t line = touch->source().begin.line;
      touches[i] = {{number(touch, line, "x_mm", {0, max_screen_mm}), number(touch, line, "y_mm", {0, max_screen_mm})},
                    number(touch, line, "length_px", {least_length, static_cast<double>(max_picture_px)}),
                    number(touch, line, "column_px", any_number)};
    }
    return touches;
  }

  fs::path file_;
  const toml::table& table_;
  std::string faults_;
};

std::string to_toml(const Calibration& c) {
  toml::array touches;
  for (const MeasuredTouch& touch : c.touches) {
    touches.push_back(toml::table{{"x_mm", touch.screen.x_mm},
                                  {"y_mm", touch.screen.y_mm},
                                  {"length_px", touch.length_px},
                                  {"column_px", touch.column_px}});
  }
  const toml::table table{
      {"version", layout_version},
      {"camera", c.camera},
      {"date", c.date},
      {"model", "thesis"},
      {"image", toml::table{{"width_px", c.image.width_px}, {"height_px", c.image.height_px}}},
      {"screen", toml::table{{"width_mm", c.screen.width_mm},
                             {"height_mm", c.screen.height_mm},
                             {"width_px", c.screen.width_px},
                             {"height_px", c.screen.height_px}}},
      {"border", toml::table{{"v0_px", c.border.v0_px}, {"slope", c.border.slope}}},
      {"touch", std::move(touches)},
  };
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
    const toml::table table = toml::parse_file(path.string());
    return CalibrationReader(table, path).read();
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) {
      return Error{fmt::format("{}: the calibration can't be read; calibrate, or name another file", path.string())};
    }
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
