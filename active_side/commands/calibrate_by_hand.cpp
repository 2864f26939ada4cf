// SPDX-License-Identifier: Apache-2.0
#include "commands/calibrate_by_hand.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <istream>
#include <ostream>
#include <string>
#include <utility>

#include "calibration/calibration_policy.hpp"
#include "calibration/screen_border.hpp"
#include "commands/calibration_pages.hpp"
#include "detection/touch_calibration.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/median_picture.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

constexpr int frames_measured = 15;
constexpr int least_frames_with_finger = 8;
constexpr int frames_of_a_second = 30;
constexpr int frames_per_picture = 2;  // of those that are kept in memory

Status ask(const std::string& what, std::istream& answers, std::ostream& instructions) {
  instructions << what << "\nThen press Enter. " << std::flush;
  std::string line;
  if (std::getline(answers, line)) return Done{};
  return Error{"calibrating the webcam asks for touches: run it in a terminal"};
}

// The next pictures, so that what the person has just done is on them.
template <typename Use>
Status read_frames(FrameSource& camera, int count, Use use) {
  Frame frame;
  int misses = 0;
  for (int taken = 0; taken < count;) {
    if (camera.read(frame, 500ms) == ReadOutcome::frame) {
      use(frame.bgr);
      ++taken;
    } else if (++misses > count) {
      const std::string why = camera.last_error();
      return Error{fmt::format("{} delivers no pictures: {}", camera.name(), why.empty() ? "it is silent" : why)};
    }
  }
  return Done{};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Result<MeasuredTouch> measure(FrameSource& camera, const BorderLine& border, const ScreenPoint& point) {
  ThesisDetector detector(border, camera.size());
  std::vector<double> lengths;
  std::vector<double> columns;
  const Status read = read_frames(camera, frames_measured, [&](const cv::Mat& bgr) {
    for (const Finger& finger : detector.detect(bgr)) {
      lengths.push_back(finger.length_px);
      columns.push_back(finger.tip.u_px);
    }
  });
  if (!read) return read.error();
  if (lengths.size() < least_frames_with_finger) {
    return Error{
        fmt::format("a finger was seen in only {} of {} pictures: put it flat on the dot, from below, with the "
                    "other fingers folded away, and begin again",
                    lengths.size(), frames_measured)};
  }
  return MeasuredTouch{point, median(lengths), column_from_centre_px(median(columns), camera.size())};
}

// The conversation with the person at the screen.
class HandCalibrator {
 public:
  HandCalibrator(FrameSource& camera, const ScreenSize& screen, CalibrationPages pages, std::vector<ScreenPoint> points,
                 std::istream& answers, std::ostream& instructions)
      : camera_(camera), pages_(pages), points_(std::move(points)), answers_(answers), instructions_(instructions) {
    seen_.screen = screen;
  }

  Status look_at_empty_rig() {
    auto triangle = picture_when(
        fmt::format("Show {} on the whole screen, with any picture viewer. Take your hands, and all that does not stay "
                    "there, away from the screen and the desk before it.",
                    CalibrationPages::triangle()));
    if (!triangle) return triangle.error();
    seen_.triangle = *std::move(triangle);
    auto empty =
        picture_when(fmt::format("Show the next one, {}: all black. Hands still away.", CalibrationPages::black()));
    if (!empty) return empty.error();
    seen_.empty = *std::move(empty);
    if (!pages_.with_marks) return Done{};
    auto marks =
        picture_when(fmt::format("Show the next one, {}: many dots. Hands still away.", CalibrationPages::marks()));
    if (!marks) return marks.error();
    seen_.marks = *std::move(marks);
    return Done{};
  }
  [[nodiscard]] const CalibrationPictures& seen() const noexcept { return seen_; }

  Status ask_for_touch(std::size_t i) {
    return ask(fmt::format("Show {} and lay a finger on the dot, from below; leave it there.", pages_.dot(i)), answers_,
               instructions_);
  }

  Result<ThesisCalibration> thesis(const BorderLine& border) {
    std::array<MeasuredTouch, 2> touches;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (auto ready = ask_for_touch(i); !ready) return ready.error();
      auto touch = measure(camera_, border, points_[i]);
      if (!touch) return Error{fmt::format("touch {}: {}", i + 1, touch.error().message)};
      touches[i] = *touch;
    }
    const auto model = ThesisTouchModel::solve(seen_.screen, touches[0], touches[1]);
    if (!model) return model.error();
    return ThesisCalibration{touches, *model};
  }

  // Touches that do not fit are asked for again, once each; what then is still wrong is for the caller to judge.
  Result<RigCalibration> rig() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      seen_.touches.push_back({{}, points_[i]});
      if (Status taken = take_touch(i); !taken) return taken.error();
    }
    for (std::vector<bool> repeated(points_.size());;) {
      auto solved = calibrate_with_pictures(seen_);
      const auto again = solved ? touch_to_repeat(*solved, repeated) : std::nullopt;
      if (!again) return solved;
      repeated[*again] = true;
      instructions_ << fmt::format("The touch of dot {} was not seen, or does not fit the others. ", *again + 1);
      if (Status taken = take_touch(*again); !taken) return taken.error();
    }
  }

 private:
  // The first that was not used and not repeated yet, else the one that a bad calibration suffers from most.
  [[nodiscard]] std::optional<std::size_t> touch_to_repeat(const RigCalibration& solved,
                                                           const std::vector<bool>& repeated) const {
    const std::vector<PointObservation>& seen = solved.observations.touches;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool used = std::any_of(seen.begin(), seen.end(), [&](const PointObservation& touch) {
        return touch.screen == points_[i] && !touch.left_out;
      });
      if (!used && !repeated[i]) return i;
    }
    const CalibrationVerdict verdict = judge_calibration(solved, points_);
    if (verdict.good() || !verdict.repeat || seen.size() != points_.size() || repeated[*verdict.repeat])
      return std::nullopt;
    return verdict.repeat;
  }

  Status take_touch(std::size_t i) {
    if (Status ready = ask_for_touch(i); !ready) return ready;
    auto picture = picture_of_a_second();
    if (!picture) return picture.error();
    seen_.touches[i].bgr = *std::move(picture);
    return Done{};
  }

  Result<cv::Mat> picture_when(const std::string& what) {
    if (Status ready = ask(what, answers_, instructions_); !ready) return ready.error();
    return picture_of_a_second();
  }

  // What the camera sees in a second, without what moves or flickers.
  Result<cv::Mat> picture_of_a_second() {
    std::vector<cv::Mat> pictures;
    int taken = 0;
    const Status read = read_frames(camera_, frames_of_a_second, [&](const cv::Mat& bgr) {
      if (taken++ % frames_per_picture == 0) pictures.push_back(bgr.clone());
    });
    if (!read) return read.error();
    return median_picture(pictures);
  }

  FrameSource& camera_;
  CalibrationPages pages_;
  std::vector<ScreenPoint> points_;
  std::istream& answers_;
  std::ostream& instructions_;
  CalibrationPictures seen_;
};

}  // namespace

Result<std::vector<ScreenPoint>> parse_points(const std::vector<std::string>& texts) {
  std::vector<ScreenPoint> points;
  for (const std::string& text : texts) {
    ScreenPoint point;
    int end = 0;
    const int read = std::sscanf(text.c_str(), "%lf,%lf%n", &point.x_mm, &point.y_mm, &end);
    if (read != 2 || text.c_str()[end] != '\0' || !std::isfinite(point.x_mm) || !std::isfinite(point.y_mm)) {
      return Error{fmt::format("--point {} is not X,Y in mm, such as 190,100", text)};
    }
    points.push_back(point);
  }
  if (points.size() == 1) return Error{"give two --point or more, or none"};
  return points;
}

std::vector<ScreenPoint> thesis_points(const ScreenSize& screen) {
  const double middle = screen.width_mm / 2;
  return {{middle, screen.height_mm * 100 / 300}, {middle + 30, screen.height_mm * 220 / 300}};
}

std::vector<ScreenPoint> default_points(const ScreenSize& screen) {
  std::vector<ScreenPoint> points;
  for (const auto& [x, y] : {std::pair{0.5, 0.66}, {0.58, 0.86}, {0.22, 0.75}, {0.78, 0.75}, {0.34, 0.93}})
    points.push_back({x * screen.width_mm, y * screen.height_mm});
  return points;
}

Result<CalibratedRig> calibrate_by_hand(FrameSource& camera, const HandCalibration& wanted, const std::string& date,
                                        std::istream& answers, std::ostream& instructions) {
  const ScreenSize& screen = wanted.screen;
  const bool thesis = wanted.model == "thesis";
  if (!(screen.width_mm > 0) || !(screen.height_mm > 0)) {
    return Error{"say how large the visible screen is: --width-mm and --height-mm, or [rig] in the configuration"};
  }
  std::vector<ScreenPoint> points = wanted.points;
  if (points.empty()) points = thesis ? thesis_points(screen) : default_points(screen);
  if (thesis && points.size() != 2) return Error{"the thesis' model is calibrated with two touches: give two --point"};
  if (const Status opened = camera.open(); !opened) return opened.error();
  const CalibrationPages pages{!thesis};
  if (const Status written = pages.write(screen, points); !written) return written.error();

  HandCalibrator calibrator(camera, screen, pages, points, answers, instructions);
  if (const Status looked = calibrator.look_at_empty_rig(); !looked) return looked.error();
  const CalibrationPictures& seen = calibrator.seen();
  if (thesis) {
    const auto border = find_screen_border(*seen.triangle, BorderChoice::triangle);
    if (!border) return border.error();
    const auto solved = calibrator.thesis(border->line);
    if (!solved) return solved.error();
    return CalibratedRig{{camera.name(), date, camera.size(), screen, border->line, *solved}, seen.empty};
  }
  const auto solved = calibrator.rig();
  if (!solved) return solved.error();
  const BorderLine edge = border_line(solved->solution.model.camera, screen);
  return CalibratedRig{{camera.name(), date, camera.size(), screen, edge, *solved}, seen.empty};
}

}  // namespace telehug
