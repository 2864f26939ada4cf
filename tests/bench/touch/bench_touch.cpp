// SPDX-License-Identifier: Apache-2.0
//
// How long a 1280x720 frame takes on the touch path, stage by stage, and what it takes from the heap:
//   bench_touch [--json FILE]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "body_map/vitruvian_grid.hpp"
#include "boxes_under.hpp"
#include "capture/frame_check.hpp"
#include "capture/rig_directory.hpp"
#include "doubles/allocation_counter.hpp"
#include "eval/rig_calibration.hpp"
#include "finger/aligned_patch.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/jpeg_decoder.hpp"
#include "pictures/picture_file.hpp"
#include "publish/touch_event_builder.hpp"
#include "touch/contact_tracker.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

constexpr int rounds = 3000;
constexpr int warm_up_rounds = 100;

struct Figure {
  std::string name;
  std::string unit;
  std::vector<double> samples;

  [[nodiscard]] double percentile(double part) const {
    std::vector<double> sorted = samples;
    std::sort(sorted.begin(), sorted.end());
    return sorted.at(static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1)));
  }
};

class Stopwatch {
 public:
  // Milliseconds since the last call.
  double lap_ms() {
    const Timestamp now = std::chrono::steady_clock::now();
    const double ms = to_ms(now - start_);
    start_ = std::chrono::steady_clock::now();
    return ms;
  }

 private:
  Timestamp start_ = std::chrono::steady_clock::now();
};

struct Recording {
  Calibration calibration;
  std::vector<cv::Mat> pictures;
};

Recording load(const std::filesystem::path& folder) {
  const auto rig = open_rig_directory(folder);
  if (!rig) throw std::runtime_error(rig.error().message);
  auto calibration = calibrate_from_recording(*rig, "thesis", {}, "");
  if (!calibration) throw std::runtime_error(calibration.error().message);
  Recording recording{*std::move(calibration), {}};
  const RigPart* const part = rig->part("sequence");
  if (part == nullptr) throw std::runtime_error(folder.string() + " has no sequence");
  for (const RigFrame& frame : part->frames) {
    auto picture = read_picture(frame.picture);
    if (!picture) throw std::runtime_error(picture.error().message);
    recording.pictures.push_back(*std::move(picture));
  }
  return recording;
}

// A face in the upper middle of the screen: the grid covers what the finger of the recording touches.
BodyMap body_map(const ScreenSize& screen) {
  const double height_mm = screen.height_mm / 4;
  auto map = make_body_map({(screen.width_mm - height_mm) / 2, height_mm / 2, height_mm, height_mm}, screen.height_mm);
  if (!map) throw std::runtime_error("no grid fits the screen");
  map->version = 1;
  return *map;
}

// The whole path, from a decoded frame to the event that is sent.
std::vector<Figure> measure_path(const Recording& recording, bool continuity) {
  const Calibration& calibration = recording.calibration;
  ThesisDetector detector(calibration.border, calibration.image, {.continuity = continuity});
  ContactTracker tracker({.every_finger_touches = true});
  TouchEventBuilder builder("0123456789abcdef0123456789abcdef");
  const BodyMap map = body_map(calibration.screen);
  NobodyTouched nobody;
  const std::string suffix = continuity ? "" : ".without_continuity";
  std::vector<Figure> figures{
      {"touch.frame_1280x720" + suffix, "ms", {}}, {"touch.detect_1280x720" + suffix, "ms", {}},
      {"touch.model" + suffix, "ms", {}},          {"touch.track" + suffix, "ms", {}},
      {"touch.box_and_event" + suffix, "ms", {}},  {"touch.allocations_per_frame" + suffix, "allocations", {}}};
  for (Figure& figure : figures)
    figure.samples.reserve(rounds);
  for (int i = 0; i < warm_up_rounds + rounds; ++i) {
    const cv::Mat& picture = recording.pictures[static_cast<std::size_t>(i) % recording.pictures.size()];
    const auto allocated = allocation_count();
    Stopwatch watch;
    const Fingers& fingers = detector.detect(picture);
    const double detect_ms = watch.lap_ms();
    const TouchedPoints touched = screen_points(fingers, calibration.model(), calibration.screen, calibration.image);
    const double model_ms = watch.lap_ms();
    const Timestamp time = Timestamp{} + i * 33ms;
    const ContactStates& contacts = tracker.update(touched.fingers, time);
    const double track_ms = watch.lap_ms();
    const BoxedContacts boxed = boxes_under(contacts, map, Duration::max(), time, nobody);
    builder.build(boxed, map.shape, map.version, time, time);
    const double event_ms = watch.lap_ms();
    if (i < warm_up_rounds) continue;
    const auto allocations = static_cast<double>(allocation_count() - allocated);
    const double frame_ms = detect_ms + model_ms + track_ms + event_ms;
    const std::vector<double> values{frame_ms, detect_ms, model_ms, track_ms, event_ms, allocations};
    for (std::size_t f = 0; f < figures.size(); ++f)
      figures[f].samples.push_back(values[f]);
  }
  return figures;
}

// Whether a picture can be believed, before anything is looked for in it.
Figure measure_frame_check(const Recording& recording) {
  const Calibration& calibration = recording.calibration;
  FrameCheck check(calibration.image, {calibration.border.v0_px, calibration.border.slope});
  Figure figure{"touch.frame_check_1280x720", "ms", {}};
  double most_change = 0;
  for (int i = 0; i < warm_up_rounds + rounds; ++i) {
    // A picture that lies in no cache, as one that was just decoded beside others does at worst.
    const cv::Mat& picture = recording.pictures[static_cast<std::size_t>(i) % recording.pictures.size()];
    Stopwatch watch;
    most_change = std::max(most_change, check.check(picture).desk_change);
    const double ms = watch.lap_ms();
    if (i >= warm_up_rounds) figure.samples.push_back(ms);
  }
  fmt::print("{:.2f} of the desk's samples change at most from frame to frame\n", most_change);
  return figure;
}

// The part of `detect` that cuts and filters: along the whole border, and the finger down to the picture's bottom.
Figure measure_preprocessing(const Recording& recording) {
  const Calibration& calibration = recording.calibration;
  constexpr int margin_px = AlignedPatch::margin_px;
  const ThesisOptions options;
  const int columns = calibration.image.width_px + 2 * margin_px;
  const int rows = calibration.image.height_px + options.border_offset_px + 4 * margin_px;
  AlignedPatch patch({columns, rows});
  ThesisDetector detector(calibration.border, calibration.image, options);
  Figure figure{"touch.preprocess_1280x720", "ms", {}};
  figure.samples.reserve(rounds);
  for (int i = 0; i < warm_up_rounds + rounds; ++i) {
    const cv::Mat& picture = recording.pictures[static_cast<std::size_t>(i) % recording.pictures.size()];
    const Fingers& fingers = detector.detect(picture);
    const int first_row = -options.border_offset_px - 1 - margin_px;
    Stopwatch watch;
    patch.cut(picture, calibration.border, first_row, 3 + 2 * margin_px, -margin_px, columns);
    patch.erode_dilate_smooth();
    if (!fingers.empty()) {
      const int first = static_cast<int>(std::lround(fingers[0].left_px + 0.5));
      const int width = static_cast<int>(fingers[0].right_px - fingers[0].left_px);
      const int last_row = calibration.image.height_px - static_cast<int>(calibration.border.v_at(first));
      patch.cut(picture, calibration.border, first_row, last_row - first_row + margin_px, first - margin_px,
                width + 2 * margin_px);
      patch.erode_dilate_smooth();
    }
    const double ms = watch.lap_ms();
    if (i >= warm_up_rounds) figure.samples.push_back(ms);
  }
  return figure;
}

// The whole JPEG of a frame, as the webcam and the recording decode it before the touch path.
Figure measure_jpeg(const std::filesystem::path& picture) {
  constexpr int jpeg_rounds = 300;
  std::ifstream file(picture, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  JpegDecoder decoder;
  cv::Mat bgr;
  Figure figure{"camera.jpeg_1280x720", "ms", {}};
  for (int i = 0; i < jpeg_rounds; ++i) {
    Stopwatch watch;
    if (const Status decoded = decoder.decode(bytes, bgr); !decoded) throw std::runtime_error(decoded.error().message);
    figure.samples.push_back(watch.lap_ms());
  }
  return figure;
}

void print_and_write(const std::vector<Figure>& figures, const std::string& json_file) {
  nlohmann::json json;
  fmt::print("{:<44}{:>12}{:>12}\n", "", "p50", "p99");
  for (const Figure& figure : figures) {
    const double p50 = figure.percentile(0.5);
    const double p99 = figure.percentile(0.99);
    fmt::print("{:<44}{:>12.4f}{:>12.4f} {}\n", figure.name, p50, p99, figure.unit);
    json[figure.name] = {{"p50", p50}, {"p99", p99}, {"unit", figure.unit}};
  }
  if (json_file.empty()) return;
  std::ofstream out(json_file);
  out << json.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error("can't write " + json_file);
}

void run(const std::string& json_file) {
  cv::setNumThreads(1);
  const Recording recording = load(TELEHUG_FIXTURES "/rig2");
  std::vector<Figure> figures = measure_path(recording, true);
  const std::vector<Figure> without = measure_path(recording, false);
  figures.insert(figures.begin() + 1, measure_preprocessing(recording));
  figures.push_back(measure_frame_check(recording));
  figures.insert(figures.end(), without.begin(), without.end());
  figures.push_back(measure_jpeg(TELEHUG_FIXTURES "/rig2/background.jpg"));
  if (!allocations_are_counted()) {
    std::erase_if(figures, [](const Figure& figure) { return figure.unit == "allocations"; });
    fmt::print("allocations are not counted: the sanitizer has its own heap\n");
  }
  print_and_write(figures, json_file);
}

}  // namespace
}  // namespace telehug

int main(int count, char** arguments) {
  try {
    std::string json_file;
    if (count == 3 && std::string_view(arguments[1]) == "--json") {
      json_file = arguments[2];
    } else if (count != 1) {
      throw std::runtime_error("usage: bench_touch [--json FILE]");
    }
    telehug::run(json_file);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fputs((std::string(error.what()) + '\n').c_str(), stderr);
    return EXIT_FAILURE;
  }
}
