// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/export_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "capture/virtual_rig/screen_content.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr const char* truth_columns = "frame,contact,x_mm,y_mm,hover_mm,hand,tone,screen,notes\n";

class RigExporter {
 public:
  RigExporter(const VirtualRigSettings& rig, fs::path path, const ExportSettings& settings)
      : path_(std::move(path)), settings_(settings), rig_settings_(rig) {
    rig_settings_.real_time = false;
  }

  Status write() {
    for (const char* folder : {"calibration", "frames", "sequence"}) {
      std::error_code code;
      fs::create_directories(path_ / folder, code);
      if (code) return Error{fmt::format("can't make the folder {}: {}", (path_ / folder).string(), code.message())};
    }
    VirtualRig rig(rig_settings_, clock_);
    for (const auto step : {&RigExporter::write_setting, &RigExporter::write_calibration, &RigExporter::write_frames,
                            &RigExporter::write_sequence}) {
      if (Status written = (this->*step)(rig); !written) return written;
    }
    return Done{};
  }

 private:
  Status write_setting(VirtualRig& rig) {
    const ScreenSize& screen = rig_settings_.screen;
    Status written =
        write_text("rig.toml", fmt::format("width_mm = {}\nheight_mm = {}\nresolution = [{}, {}]\n", screen.width_mm,
                                           screen.height_mm, screen.width_px, screen.height_px));
    if (!written) return written;
    if (Status background = write_jpeg(path_ / "background.jpg", rig.picture_of_background()); !background) {
      return background;
    }
    return write_jpeg(path_ / "triangle.jpg", rig.picture_of_triangle());
  }

  Status write_calibration(VirtualRig& rig) {
    std::string csv = "frame,x_mm,y_mm\n";
    int number = 0;
    std::vector<ScreenPoint> points = calibration_points(rig_settings_);
    points.resize(std::min(points.size(), static_cast<std::size_t>(std::max(settings_.calibration_touches, 0))));
    for (const ScreenPoint& point : points) {
      const std::string name = fmt::format("{:02}", ++number);
      csv += fmt::format("{},{:.2f},{:.2f}\n", name, point.x_mm, point.y_mm);
      const fs::path file = path_ / "calibration" / (name + ".jpg");
      if (Status written = write_jpeg(file, rig.picture_of_touch(point)); !written) return written;
    }
    return write_text("calibration.csv", csv);
  }

  // Moments of a random script: in the middle of a touch, while the finger comes, between two touches.
  Status write_frames(VirtualRig& /*rig*/) {
    if (settings_.single_frames == 0) return remove_if_empty("frames");
    VirtualRigSettings random = rig_settings_;
    random.script = random_script(random.screen, settings_.single_frames, random.seed);
    RigRenderer renderer(random);
    std::string truth = truth_columns;
    for (int i = 0; i < settings_.single_frames; ++i) {
      const ScriptedTouch& touch = random.script.touches[static_cast<std::size_t>(i)];
      double time_s = (touch.begin_s + touch.end_s) / 2;
      if (i % 4 == 2) time_s = touch.begin_s - 0.2 * approach_s;
      if (i % 4 == 3) time_s = touch.begin_s - 1.01 * approach_s;
      const auto finger = finger_at(random.script, time_s);
      renderer.draw(finger, static_cast<std::uint64_t>(i), frame_.bgr);
      const std::string name = fmt::format("{:03}", i + 1);
      truth += truth_row(name, finger);
      if (Status written = write_jpeg(path_ / "frames" / (name + ".jpg"), frame_.bgr); !written) return written;
    }
    return write_text("truth.csv", truth);
  }

  Status write_sequence(VirtualRig& rig) {
    if (settings_.sequence_frames == 0) return remove_if_empty("sequence");
    if (Status opened = rig.open(); !opened) return opened;
    std::string truth = truth_columns;
    std::string times = "frame,monotonic_ns\n";
    for (int i = 0; i < settings_.sequence_frames; ++i) {
      const std::string name = fmt::format("{:05}", i + 1);
      if (rig.read(frame_, 0s) != ReadOutcome::frame) break;  // the script is over
      const VirtualTruth t = rig.truth(frame_.sequence);
      truth += truth_row(name, t.screen ? std::optional(FingerPlace{*t.screen, t.hover_mm.value_or(0)}) : std::nullopt);
      times += fmt::format("{},{}\n", name, to_ns(frame_.time));
      if (Status written = write_jpeg(path_ / "sequence" / (name + ".jpg"), frame_.bgr); !written) return written;
    }
    if (Status written = write_text("sequence/truth.csv", truth); !written) return written;
    return write_text("sequence/times.csv", times);
  }

  [[nodiscard]] std::string truth_row(const std::string& name, const std::optional<FingerPlace>& finger) const {
    static constexpr std::array tones{"I", "II", "III", "IV", "V", "VI"};
    const std::string_view screen = rig_settings_.screen_picture.empty() ? name_of(rig_settings_.content) : "picture";
    if (!finger) return fmt::format("{},0,,,,,,{},nohand\n", name, screen);
    const char* tone = tones[static_cast<std::size_t>(rig_settings_.hand.skin_tone - 1)];
    const bool contact = finger->hover_mm <= 0;
    return fmt::format("{},{},{:.2f},{:.2f},{},right,{},{},{}\n", name, contact ? 1 : 0, finger->foot.x_mm,
                       finger->foot.y_mm, contact ? std::string{} : fmt::format("{:.1f}", finger->hover_mm), tone,
                       screen, contact ? "touch" : "hover");
  }

  Status remove_if_empty(const char* folder) {
    std::error_code ignored;
    fs::remove(path_ / folder, ignored);
    return Done{};
  }

  Status write_text(const char* name, std::string_view text) {
    std::ofstream file(path_ / name);
    file << text;
    file.close();
    if (file.good()) return Done{};
    return Error{fmt::format("can't write {}", (path_ / name).string())};
  }

  fs::path path_;
  ExportSettings settings_;
  VirtualRigSettings rig_settings_;
  SteadyClock clock_;
  Frame frame_;
};

}  // namespace

Status export_rig_directory(const VirtualRigSettings& rig, const fs::path& path, const ExportSettings& settings) {
  if (settings.sequence_frames < 0 || settings.single_frames < 0) {
    return Error{"virtual rig: the numbers of frames to export must not be negative"};
  }
  if (Status checked = check_virtual_rig(rig); !checked) return checked;
  return RigExporter(rig, path, settings).write();
}

}  // namespace telehug
