// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/calibration.hpp"
#include "common/result.hpp"

namespace telehug {

// Reads the layout that calibration_file.hpp describes and collects every fault with its line.
class CalibrationReader {
 public:
  static constexpr std::int64_t newest_version = 2;

  struct Range {
    double least;
    double most;
  };

  // `table` outlives the reader.
  CalibrationReader(const toml::table& table, std::filesystem::path file) : file_(std::move(file)), table_(table) {}

  Result<Calibration> read();

 private:
  struct Section {
    const toml::table* table;  // nullptr if it is missing, which is a fault
    std::size_t line;
  };

  void fault(std::size_t line, std::string_view what);
  Section section(const char* name);
  // Each of these returns a value without meaning after a fault.
  std::string text(const char* key);
  std::int64_t integer(const Section& from, const char* key, std::int64_t least, std::int64_t most);
  double number(const Section& from, const char* key, Range range);
  std::vector<Section> sections(const char* name);
  std::array<MeasuredTouch, 2> thesis_touches();
  std::vector<PointObservation> points(const char* name);
  TouchEvidence evidence(const Section& from);
  bool left_out(const Section& from);
  std::vector<BorderObservation> border_points();
  RigParameters parameters(const Section& from);
  PictureOrientation orientation(const Section& from);

  // What both models have.
  struct Common {
    std::string camera;
    std::string date;
    ImageSize image;
    ScreenSize screen;
    BorderLine border;
  };
  Result<Calibration> with_thesis_model(const Common& common);
  Result<Calibration> with_rig_model(const Common& common);

  std::filesystem::path file_;
  const toml::table& table_;
  std::string faults_;
};

}  // namespace telehug
