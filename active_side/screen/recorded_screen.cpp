// SPDX-License-Identifier: Apache-2.0
#include "screen/recorded_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>
#include <map>
#include <string>

#include "capture/csv_table.hpp"
#include "capture/rig_directory.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t first_place_column = 2;
constexpr std::int64_t max_monitor_px = 32'768;

// Reads where on the monitor the picture lies, if the row tells it.
void read_place(CsvTable& table, std::size_t row, RecordedScreenPicture& picture) {
  std::array<std::string_view, 4> texts;
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i] = table.text(row, first_place_column + i);
  if (texts == std::array<std::string_view, 4>{}) return;
  std::array<std::int64_t, 4> px{};
  for (std::size_t i = 0; i < px.size(); ++i) {
    const auto value = table.integer(row, first_place_column + i);
    if (!value) return;
    px[i] = *value;
  }
  const auto [x, y, width, height] = px;
  if (width < 1 || height < 1 || width > max_monitor_px || height > max_monitor_px) {
    table.add_fault(row, fmt::format("a monitor of {}x{} px; both must be 1 to {}", width, height, max_monitor_px));
  } else if (x < 0 || y < 0 || x >= width || y >= height) {
    table.add_fault(row, fmt::format("{},{} px is no place on a monitor of {}x{} px", x, y, width, height));
  } else {
    picture.origin_px = {static_cast<int>(x), static_cast<int>(y)};
    picture.monitor = {.width_px = static_cast<int>(width), .height_px = static_cast<int>(height)};
  }
}

}  // namespace

Result<std::vector<RecordedScreenPicture>> read_recorded_screen(const fs::path& recording) {
  std::map<std::string, fs::path, std::less<>> files;
  for (const RigFrame& frame : pictures_in(recording / "screen"))
    files.emplace(frame.name, frame.picture);

  const fs::path csv = recording / "screen_times.csv";
  std::vector<std::string> faults;
  CsvTable table(csv, {"frame", "monotonic_ns"}, faults, {"x_px", "y_px", "monitor_width_px", "monitor_height_px"});
  std::vector<RecordedScreenPicture> pictures;
  std::optional<std::int64_t> first_ns;
  std::optional<std::int64_t> last_ns;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    RecordedScreenPicture picture;
    if (const auto file = files.find(table.text(row, 0)); file != files.end()) {
      picture.file = file->second;
    } else {
      table.add_fault(row, fmt::format("there is no picture screen/{}.jpg", table.text(row, 0)));
    }
    read_place(table, row, picture);
    const auto ns = table.integer(row, 1);
    if (!ns) continue;
    if (*ns < 0) {
      table.add_fault(row, fmt::format("the time {} lies before the PC was started", *ns));
      continue;
    }
    if (last_ns && *ns <= *last_ns) {
      table.add_fault(row, fmt::format("picture {} is not later than the one before it", table.text(row, 0)));
    }
    if (!first_ns) first_ns = ns;
    last_ns = ns;
    picture.shown_after = from_ns(*ns) - from_ns(*first_ns);
    pictures.push_back(std::move(picture));
  }
  if (faults.empty() && pictures.empty()) faults.push_back(fmt::format("{}:1: no picture is listed", csv.string()));
  if (!faults.empty()) return Error{fmt::format("{}", fmt::join(faults, "\n"))};
  return pictures;
}

}  // namespace telehug
