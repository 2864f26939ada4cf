// SPDX-License-Identifier: Apache-2.0
//
// A recording on disk, the layout that `record`, `eval touch` and `replay:` share:
//
//   rig.toml                width_mm, height_mm (visible screen), resolution = [w, h]
//   background.jpg          nobody there, black screen (optional)
//   triangle.jpg            the black triangle that points at the screen's bottom line (optional)
//   marks.jpg               nobody there, the page of marks (calibration/calibration_page.hpp) on the screen (optional)
//   calibration/NAME.jpg    touches of known points, with calibration.csv: frame,x_mm,y_mm (optional)
//   frames/NAME.jpg         single pictures in no order, with truth.csv (optional)
//   hard/, sequence/        as frames/, but truth.csv lies beside the pictures; `sequence` is in order
//   times.csv               frame,monotonic_ns: when each picture of `sequence` was taken (optional)
//   screen/, screen_times.csv   what the screen showed meanwhile, see screen/recorded_screen.hpp (optional)
//
// Pictures may be JPEG (.jpg, .jpeg) or PNG; a frame is called what its file is called, without the extension.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/clock.hpp"
#include "common/result.hpp"
#include "common/units.hpp"

namespace telehug {

struct RigFrame {
  std::string name;
  std::filesystem::path picture;
};

struct CalibrationTouch {
  RigFrame frame;
  ScreenPoint screen;  // the point that was touched; within the screen
};

// What really happened in a frame; a frame with two touches has two rows.
struct TruthRow {
  std::string frame;
  bool contact = false;
  std::optional<ScreenPoint> screen;  // contact: middle of the contact patch; else the foremost point's foot, if any
  std::optional<double> hover_mm;     // distance of the hand's foremost point from the screen, if it does not touch
  std::string hand;                   // "left", "right" or empty
  std::string tone;                   // Fitzpatrick "I".."VI" or empty
  std::string screen_picture;         // what the screen showed
  std::string notes;
};

struct RigPart {
  std::string name;              // "frames", "hard" or "sequence"
  std::vector<RigFrame> frames;  // sorted by name; `sequence`: in order of time
  std::vector<TruthRow> truth;   // in the file's order; empty if there is no truth.csv
  std::vector<Timestamp> times;  // one for each of `frames`, rising; empty if there is no times.csv
};

struct RigDirectory {
  std::filesystem::path path;
  ScreenSize screen;
  std::optional<std::filesystem::path> background;
  std::optional<std::filesystem::path> triangle;
  std::optional<std::filesystem::path> marks;
  std::vector<CalibrationTouch> calibration;  // in the order of calibration.csv: 01 first
  std::vector<RigPart> parts;                 // those that are there

  // nullptr if the recording has no such part.
  [[nodiscard]] const RigPart* part(std::string_view name) const;
};

// Reads everything but the pictures. The error tells all faults at once, one a line, each as "file:line: what".
Result<RigDirectory> open_rig_directory(const std::filesystem::path& path);

// The pictures of one folder, sorted by name.
std::vector<RigFrame> pictures_in(const std::filesystem::path& folder);

// Reads a times.csv for these frames, or adds to `faults`.
std::vector<Timestamp> read_times(const std::filesystem::path& csv, const std::vector<RigFrame>& frames,
                                  std::vector<std::string>& faults);

}  // namespace telehug
