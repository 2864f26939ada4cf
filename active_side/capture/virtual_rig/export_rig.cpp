// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/export_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/virtual_rig/mirror_contrast.hpp"
#include "capture/virtual_rig/random_frame.hpp"
#include "capture/virtual_rig/virtual_rig.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

// What `frames` holds, over and over.
constexpr std::array frame_kinds{FrameKind::touch, FrameKind::touch, FrameKind::hover, FrameKind::nohand,
                                 FrameKind::touch, FrameKind::touch, FrameKind::away,  FrameKind::touch,
                                 FrameKind::hover, FrameKind::touch, FrameKind::touch, FrameKind::touch,
                                 FrameKind::palm};
constexpr std::array hard_kinds{FrameKind::two_fingers, FrameKind::two_hands};
static_assert(frame_kinds.size() == frame_kinds_by_turns && hard_kinds.size() == hard_kinds_by_turns);
constexpr std::uint64_t hard_seed = 1000;  // frames count up from here, so that `frames` and `hard` differ

class RigExporter {
 public:
  RigExporter(RandomRig rig, fs::path path, const ExportSettings& settings)
      : path_(std::move(path)), settings_(settings), rig_(std::move(rig)) {
    rig_.settings.real_time = false;
  }

  Status write() {
    for (const auto& [folder, frames] : {std::pair{"calibration", settings_.calibration_touches},
                                         {"frames", settings_.single_frames},
                                         {"hard", settings_.hard_frames},
                                         {"sequence", settings_.sequence_frames}}) {
      if (frames == 0) continue;
      std::error_code code;
      fs::create_directories(path_ / folder, code);
      if (code) return Error{fmt::format("can't make the folder {}: {}", (path_ / folder).string(), code.message())};
    }
    for (const auto step : {&RigExporter::write_calibration, &RigExporter::write_sequence, &RigExporter::write_frames,
                            &RigExporter::write_hard}) {
      if (Status written = (this->*step)(); !written) return written;
    }
    return Done{};
  }

 private:
  Status write_setting(VirtualRig& rig) {
    const ScreenSize& screen = rig_.settings.screen;
    std::string toml = fmt::format("width_mm = {}\nheight_mm = {}\nresolution = [{}, {}]\n", screen.width_mm,
                                   screen.height_mm, screen.width_px, screen.height_px);
    for (const auto& [key, group] : {std::pair{"bezel", rig_.group.bezel},
                                     {"light", rig_.group.light},
                                     {"coat", rig_.group.coat},
                                     {"desk", rig_.group.desk}}) {
      if (!group.empty()) toml += fmt::format("{} = \"{}\"\n", key, group);
    }
    if (Status written = write_text("rig.toml", toml); !written) return written;
    if (Status background = write_jpeg(path_ / "background.jpg", rig.picture_of_background()); !background) {
      return background;
    }
    return write_jpeg(path_ / "triangle.jpg", rig.picture_of_triangle());
  }

  Status write_calibration() {
    VirtualRigSettings still = rig_.settings;
    still.disturbances.clear();
    VirtualRig rig(still, clock_);
    if (Status written = write_setting(rig); !written || settings_.calibration_touches == 0) return written;
    std::string csv = "frame,x_mm,y_mm\n";
    std::vector<ScreenPoint> points = calibration_points(rig_.settings);
    points.resize(std::min(points.size(), static_cast<std::size_t>(settings_.calibration_touches)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::string name = fmt::format("{:02}", i + 1);
      csv += fmt::format("{},{:.2f},{:.2f}\n", name, points[i].x_mm, points[i].y_mm);
      HandPose pose;
      if (rig_.random_poses) pose = random_pose(rig_.settings, rig_.settings.hand, {points[i], 0}, i + 1);
      const fs::path file = path_ / "calibration" / (name + ".jpg");
      if (Status written = write_jpeg(file, rig.picture_of_touch(points[i], pose)); !written) return written;
    }
    if (Status written = write_jpeg(path_ / "marks.jpg", rig.picture_of_marks()); !written) return written;
    return write_text("calibration.csv", csv);
  }

  Status write_frames() {
    return write_random(settings_.skipped_frames, settings_.single_frames, frame_kinds, "frames", "truth.csv", 0);
  }
  Status write_hard() {
    return write_random(settings_.skipped_hard_frames, settings_.hard_frames, hard_kinds, "hard", "hard/truth.csv",
                        hard_seed);
  }

  template <std::size_t n>
  Status write_random(int skipped, int count, const std::array<FrameKind, n>& kinds, const char* folder,
                      const char* csv, std::uint64_t first_seed) {
    if (count == 0) return Done{};
    RigRenderer renderer(rig_.settings);
    std::string truth(truth_csv_header);
    std::map<ScreenContent, std::shared_ptr<RigView>> views;
    for (int i = skipped; i < skipped + count; ++i) {
      const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
      const FrameKind kind = kinds[static_cast<std::size_t>(i) % n];
      const RandomFrame frame = random_frame(rig_, kind, rig_.settings.seed * 100'000 + seed);
      auto& view = views[frame.content];
      if (!view) {
        VirtualRigSettings showing = rig_.settings;
        showing.content = frame.content;
        view = renderer.view(showing);
      }
      renderer.show(view);
      renderer.draw(frame.hands, seed, frame_.bgr);
      const std::string name = fmt::format("{:03}", i + 1);
      const bool mirrored = kind == FrameKind::hover && mirror_contrast(renderer, frame.hands) >= least_mirror_contrast;
      for (TruthRow& row : truth_of(frame, name)) {
        if (!rig_.settings.screen_picture.empty()) row.screen_picture = "picture";
        if (mirrored) row.notes += " mirrored";
        truth += csv_line(row);
      }
      if (Status written = write_jpeg(path_ / folder / (name + ".jpg"), frame_.bgr); !written) return written;
    }
    return write_text(csv, truth);
  }

  Status write_sequence() {
    if (settings_.sequence_frames == 0) return Done{};
    VirtualRig rig(rig_.settings, clock_);
    if (Status opened = rig.open(); !opened) return opened;
    std::string truth(truth_csv_header);
    std::string times = "frame,monotonic_ns\n";
    for (int i = 0; i < settings_.sequence_frames; ++i) {
      const std::string name = fmt::format("{:05}", i + 1);
      if (rig.read(frame_, 0s) != ReadOutcome::frame) break;  // the script is over
      RandomFrame played{FrameKind::nohand, rig.hands(frame_.sequence), rig_.settings.content};
      for (HandPose& hand : played.hands) {
        if (!hand.looks) hand.looks = rig_.settings.hand;
        played.kind = hand.finger.hover_mm > 0 ? FrameKind::hover : FrameKind::touch;
      }
      for (const TruthRow& row : truth_of(played, name))
        truth += csv_line(row);
      times += fmt::format("{},{}\n", name, to_ns(frame_.time));
      if (Status written = write_jpeg(path_ / "sequence" / (name + ".jpg"), frame_.bgr); !written) return written;
    }
    if (Status written = write_text("sequence/truth.csv", truth); !written) return written;
    return write_text("sequence/times.csv", times);
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
  RandomRig rig_;
  SteadyClock clock_;
  Frame frame_;
};

}  // namespace

Status export_rig_directory(const VirtualRigSettings& rig, const fs::path& path, const ExportSettings& settings) {
  return export_rig_directory(rig_of(rig), path, settings);
}

Status export_rig_directory(const RandomRig& rig, const fs::path& path, const ExportSettings& settings) {
  if (settings.sequence_frames < 0 || settings.single_frames < 0 || settings.hard_frames < 0 ||
      settings.calibration_touches < 0 || settings.skipped_frames < 0 || settings.skipped_hard_frames < 0) {
    return Error{"virtual rig: the numbers of frames to export must not be negative"};
  }
  if (Status checked = check_virtual_rig(rig.settings); !checked) return checked;
  return RigExporter(rig, path, settings).write();
}

}  // namespace telehug
