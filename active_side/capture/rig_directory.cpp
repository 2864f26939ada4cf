// SPDX-License-Identifier: Apache-2.0
#include "capture/rig_directory.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <sstream>

#include "capture/csv_table.hpp"
#include "files/text_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

using Faults = std::vector<std::string>;

constexpr double max_screen_mm = 10'000;
constexpr std::int64_t max_screen_px = 32'768;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<fs::path> picture_named(const fs::path& folder, const std::string& name) {
  for (const char* extension : {".jpg", ".jpeg", ".png"}) {
    fs::path path = folder / (name + extension);
    std::error_code code;
    if (fs::is_regular_file(path, code)) return path;
  }
  return std::nullopt;
}

const RigFrame* frame_named(const std::vector<RigFrame>& frames, std::string_view name) {
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const RigFrame& f) { return f.name == name; });
  return found == frames.end() ? nullptr : &*found;
}

class RigReader {
 public:
  RigReader(const fs::path& path, Faults& faults) : faults_(faults) { rig_.path = path; }

  RigDirectory read() {
    read_screen();
    rig_.background = picture_named(rig_.path, "background");
    rig_.triangle = picture_named(rig_.path, "triangle");
    rig_.marks = picture_named(rig_.path, "marks");
    read_calibration();
    for (const char* name : {"frames", "hard", "sequence"})
      read_part(name);
    return std::move(rig_);
  }

 private:
  void read_screen() {
    const fs::path file = rig_.path / "rig.toml";
    const auto text = read_text_file(file);
    if (!text) {
      fault(
          file, 1,
          fmt::format("the file {}; it holds width_mm, height_mm and resolution of the screen", text.error().message));
      return;
    }
    try {
      const toml::table table = toml::parse(*text, file.string());
      rig_.screen.width_mm = length_mm(table, file, "width_mm");
      rig_.screen.height_mm = length_mm(table, file, "height_mm");
      read_resolution(table, file);
    } catch (const toml::parse_error& error) {
      fault(file, error.source().begin.line, error.description());
    }
  }

  double length_mm(const toml::table& table, const fs::path& file, const char* key) {
    const toml::node* node = table.get(key);
    const auto value = node != nullptr ? node->value<double>() : std::nullopt;
    if (value && *value > 0 && *value <= max_screen_mm) return *value;
    fault(file, line_of(node), fmt::format("{} must be a length above 0 and up to {} mm", key, max_screen_mm));
    return 0;
  }

  void read_resolution(const toml::table& table, const fs::path& file) {
    const toml::node* node = table.get("resolution");
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    std::array<std::int64_t, 2> sides{};
    bool good = array != nullptr && array->size() == 2;
    for (std::size_t i = 0; good && i < 2; ++i) {
      sides[i] = array->get(i)->value<std::int64_t>().value_or(0);
      good = sides[i] > 0 && sides[i] <= max_screen_px;
    }
    if (!good) {
      fault(file, line_of(node), "resolution must be [width, height] in pixels, e.g. [1280, 1024]");
      return;
    }
    rig_.screen.width_px = static_cast<int>(sides[0]);
    rig_.screen.height_px = static_cast<int>(sides[1]);
  }

  void read_calibration() {
    const fs::path file = rig_.path / "calibration.csv";
    if (!fs::exists(file)) return;
    const std::vector<RigFrame> pictures = pictures_in(rig_.path / "calibration");
    CsvTable table(file, {"frame", "x_mm", "y_mm"}, faults_);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const RigFrame* frame = frame_named(pictures, table.text(row, 0));
      if (frame == nullptr) {
        table.add_fault(row, fmt::format("there is no picture calibration/{}.jpg", table.text(row, 0)));
      }
      const auto x_mm = table.number(row, 1);
      const auto y_mm = table.number(row, 2);
      if (frame == nullptr || !x_mm || !y_mm) continue;
      if (rig_.screen.width_mm > 0 && rig_.screen.height_mm > 0 &&
          (*x_mm < 0 || *x_mm > rig_.screen.width_mm || *y_mm < 0 || *y_mm > rig_.screen.height_mm)) {
        table.add_fault(row, fmt::format("the point ({}, {}) mm is not on the screen of {} x {} mm", *x_mm, *y_mm,
                                         rig_.screen.width_mm, rig_.screen.height_mm));
        continue;
      }
      rig_.calibration.push_back({*frame, {*x_mm, *y_mm}});
    }
  }

  void read_part(const std::string& name) {
    const fs::path folder = rig_.path / name;
    if (!fs::is_directory(folder)) return;
    RigPart part{name, pictures_in(folder), {}, {}};
    if (part.frames.empty()) fault(folder, 1, "the folder holds no .jpg or .png picture");
    const fs::path truth = (name == "frames" ? rig_.path : folder) / "truth.csv";
    if (fs::exists(truth)) read_truth(truth, part);
    if (name == "sequence") {
      for (const fs::path& times : {folder / "times.csv", rig_.path / "times.csv"}) {
        if (!fs::exists(times)) continue;
        part.times = read_times(times, part.frames, faults_);
        break;
      }
    }
    rig_.parts.push_back(std::move(part));
  }

  void read_truth(const fs::path& file, RigPart& part) {
    CsvTable table(file, {"frame", "contact", "x_mm", "y_mm", "hover_mm", "hand", "tone", "screen", "notes"}, faults_);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      TruthRow truth;
      truth.frame = table.text(row, 0);
      if (frame_named(part.frames, truth.frame) == nullptr) {
        table.add_fault(row, fmt::format("there is no picture {}/{}.jpg", part.name, truth.frame));
      }
      const std::string_view contact = table.text(row, 1);
      if (contact != "0" && contact != "1") table.add_fault(row, fmt::format("contact is '{}', not 0 or 1", contact));
      truth.contact = contact == "1";
      if (truth.contact || !table.text(row, 2).empty() || !table.text(row, 3).empty()) {
        const auto x_mm = table.number(row, 2);
        const auto y_mm = table.number(row, 3);
        if (x_mm && y_mm) truth.screen = ScreenPoint{*x_mm, *y_mm};
      }
      if (!table.text(row, 4).empty()) truth.hover_mm = table.number(row, 4);
      if (truth.hover_mm && *truth.hover_mm < 0) table.add_fault(row, "hover_mm is negative");
      truth.hand = table.text(row, 5);
      truth.tone = table.text(row, 6);
      truth.screen_picture = table.text(row, 7);
      truth.notes = table.text(row, 8);
      part.truth.push_back(std::move(truth));
    }
  }

  static std::uint32_t line_of(const toml::node* node) { return node != nullptr ? node->source().begin.line : 1; }

  void fault(const fs::path& file, std::uint32_t line, std::string_view what) {
    faults_.push_back(fmt::format("{}:{}: {}", file.string(), line, what));
  }

  RigDirectory rig_;
  Faults& faults_;
};

}  // namespace

const RigPart* RigDirectory::part(std::string_view name) const {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const RigPart& p) { return p.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

std::vector<RigFrame> pictures_in(const fs::path& folder) {
  std::vector<RigFrame> frames;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string extension = lower_case(entry.path().extension().string());
    if (extension != ".jpg" && extension != ".jpeg" && extension != ".png") continue;
    frames.push_back({entry.path().stem().string(), entry.path()});
  }
  std::sort(frames.begin(), frames.end(), [](const RigFrame& a, const RigFrame& b) { return a.name < b.name; });
  return frames;
}

std::vector<Timestamp> read_times(const fs::path& csv, const std::vector<RigFrame>& frames, Faults& faults) {
  const std::size_t faults_before = faults.size();
  CsvTable table(csv, {"frame", "monotonic_ns"}, faults);
  std::map<std::string, Timestamp, std::less<>> by_name;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (frame_named(frames, table.text(row, 0)) == nullptr) {
      table.add_fault(row, fmt::format("there is no picture called {}", table.text(row, 0)));
    }
    if (const auto ns = table.integer(row, 1)) by_name.emplace(table.text(row, 0), from_ns(*ns));
  }
  std::vector<Timestamp> times;
  for (const RigFrame& frame : frames) {
    const auto found = by_name.find(frame.name);
    if (found == by_name.end()) {
      faults.push_back(fmt::format("{}:1: no line tells the time of picture {}", csv.string(), frame.name));
    } else if (!times.empty() && found->second <= times.back()) {
      faults.push_back(fmt::format("{}:1: picture {} is not later than the one before it", csv.string(), frame.name));
    } else {
      times.push_back(found->second);
    }
  }
  if (faults.size() != faults_before) times.clear();
  return times;
}

Result<RigDirectory> open_rig_directory(const fs::path& path) {
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    return Error{
        fmt::format("{}:1: there is no such folder; a recording is a folder with rig.toml in it", path.string())};
  }
  Faults faults;
  RigDirectory rig;
  try {
    rig = RigReader(path, faults).read();
  } catch (const fs::filesystem_error& error) {
    faults.push_back(fmt::format("{}:1: {}", error.path1().string(), error.code().message()));
  }
  if (!faults.empty()) return Error{fmt::format("{}", fmt::join(faults, "\n"))};
  return rig;
}

}  // namespace telehug
