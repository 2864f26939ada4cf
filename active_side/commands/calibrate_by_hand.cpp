// SPDX-License-Identifier: Apache-2.0
#include "commands/calibrate_by_hand.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <istream>
#include <opencv2/imgproc.hpp>
#include <ostream>
#include <string>
#include <utility>

#include "calibration/border_choice.hpp"
#include "calibration/screen_border.hpp"
#include "finger/thesis_detector.hpp"
#include "pictures/median_picture.hpp"
#include "pictures/picture_file.hpp"
#include "touch/screen_points.hpp"

namespace telehug {
namespace {

constexpr int frames_measured = 15;
constexpr int least_frames_with_finger = 8;
constexpr int frames_of_a_second = 30;
constexpr int frames_per_picture = 2;  // of those that are kept in memory
constexpr const char* triangle_file = "telehug-triangle.png";
constexpr const char* dots_file = "telehug-dots.png";
constexpr double px_per_mm = 4;  // of the pictures, when the screen's pixels are not known

cv::Size picture_size(const ScreenSize& screen) {
  if (screen.width_px > 0 && screen.height_px > 0) return {screen.width_px, screen.height_px};
  return {static_cast<int>(std::lround(screen.width_mm * px_per_mm)),
          static_cast<int>(std::lround(screen.height_mm * px_per_mm))};
}

cv::Point to_px(const ScreenPoint& point, const ScreenSize& screen, cv::Size size) {
  return {static_cast<int>(std::lround(point.x_mm / screen.width_mm * size.width)),
          static_cast<int>(std::lround(point.y_mm / screen.height_mm * size.height))};
}

// Black on white, one vertex in the middle of the bottom edge: it tells the screen's own edge from the bezel's others.
cv::Mat triangle_picture(const ScreenSize& screen) {
  const cv::Size size = picture_size(screen);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(255));
  const std::array corners{cv::Point(size.width / 2, size.height - 1), cv::Point(size.width / 4, size.height / 3),
                           cv::Point(3 * size.width / 4, size.height / 3)};
  cv::fillConvexPoly(picture, corners.data(), static_cast<int>(corners.size()), cv::Scalar::all(0), cv::LINE_AA);
  return picture;
}

cv::Mat dots_picture(const ScreenSize& screen, const std::vector<ScreenPoint>& points) {
  constexpr double dot_radius_mm = 5;
  const cv::Size size = picture_size(screen);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(0));
  const int radius = static_cast<int>(std::lround(dot_radius_mm / screen.width_mm * size.width));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point centre = to_px(points[i], screen, size);
    cv::circle(picture, centre, radius, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA);
    cv::putText(picture, std::to_string(i + 1), centre + cv::Point(2 * radius, radius), cv::FONT_HERSHEY_SIMPLEX,
                radius / 12.0, cv::Scalar::all(255), 2, cv::LINE_AA);
  }
  return picture;
}

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

// What the camera sees in a second, without what moves or flickers.
Result<cv::Mat> picture_of_a_second(FrameSource& camera) {
  std::vector<cv::Mat> pictures;
  int taken = 0;
  const Status read = read_frames(camera, frames_of_a_second, [&](const cv::Mat& bgr) {
    if (taken++ % frames_per_picture == 0) pictures.push_back(bgr.clone());
  });
  if (!read) return read.error();
  return median_picture(pictures);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// One touch as both models see it.
struct HandTouch {
  MeasuredTouch thesis;
  ImagePoint tip;
};

Result<HandTouch> measure(FrameSource& camera, const BorderLine& border, const ScreenPoint& point) {
  ThesisDetector detector(border, camera.size());
  std::vector<double> lengths;
  std::vector<double> columns;
  std::vector<double> rows;
  const Status read = read_frames(camera, frames_measured, [&](const cv::Mat& bgr) {
    for (const Finger& finger : detector.detect(bgr)) {
      lengths.push_back(finger.length_px);
      columns.push_back(finger.tip.u_px);
      rows.push_back(finger.tip.v_px);
    }
  });
  if (!read) return read.error();
  if (lengths.size() < least_frames_with_finger) {
    return Error{
        fmt::format("a finger was seen in only {} of {} pictures: put it flat on the dot, from below, with the "
                    "other fingers folded away, and begin again",
                    lengths.size(), frames_measured)};
  }
  const ImagePoint tip{median(columns), median(rows)};
  return HandTouch{{point, median(lengths), column_from_centre_px(tip.u_px, camera.size())}, tip};
}

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
  if (const Status written = write_png(triangle_file, triangle_picture(screen)); !written) return written.error();
  if (const Status written = write_png(dots_file, dots_picture(screen, points)); !written) return written.error();

  if (auto ready =
          ask(fmt::format("Show {} on the whole screen, with any picture viewer. Take your hands, and all that "
                          "does not stay there, away from the screen and the desk before it.",
                          triangle_file),
              answers, instructions);
      !ready) {
    return ready.error();
  }
  const auto empty = picture_of_a_second(camera);
  if (!empty) return empty.error();
  const auto border = find_screen_border(*empty, BorderChoice::triangle);
  if (!border) return border.error();

  std::vector<HandTouch> touches;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string what =
        i == 0 ? fmt::format("Show {} on the whole screen and lay a finger on dot 1; leave it there.", dots_file)
               : fmt::format("Now lay it on dot {}; leave it there.", i + 1);
    if (auto ready = ask(what, answers, instructions); !ready) return ready.error();
    auto touch = measure(camera, border->line, points[i]);
    if (!touch) return Error{fmt::format("touch {}: {}", i + 1, touch.error().message)};
    touches.push_back(*touch);
  }
  if (thesis) {
    const auto model = ThesisTouchModel::solve(screen, touches[0].thesis, touches[1].thesis);
    if (!model) return model.error();
    const ThesisCalibration solved{{touches[0].thesis, touches[1].thesis}, *model};
    return CalibratedRig{{camera.name(), date, camera.size(), screen, border->line, solved}, *empty};
  }
  RigObservations seen{screen, camera.size(), {}, {}, {}};
  for (std::size_t i = 0; i < points.size(); ++i)
    seen.touches.push_back({points[i], touches[i].tip, thesis_tip_sigma_px, thesis_tip_sigma_px});
  if (const auto mark = triangle_mark(*border, screen)) seen.marks.push_back(*mark);
  auto solved = solve_with_border(seen, find_border_candidates(*empty, border->line));
  if (!solved) return solved.error();
  const BorderLine edge = border_line(solved->calibration.solution.model.camera, screen);
  return CalibratedRig{{camera.name(), date, camera.size(), screen, edge, std::move(solved->calibration)}, *empty};
}

}  // namespace telehug
