// SPDX-License-Identifier: Apache-2.0
#include "detection/touch_calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <utility>

#include "calibration/border_choice.hpp"
#include "calibration/calibration_dot.hpp"
#include "calibration/consistent_touches.hpp"
#include "calibration/mark_search.hpp"
#include "calibration/screen_border.hpp"
#include "detection/make_detector.hpp"
#include "finger/finger_detector.hpp"

namespace telehug {
namespace {

// How well the nets see a contact on a lit dot, in pictures 1280 px wide: one and a half millimetres.
constexpr double contact_sigma_u_px = 4;
constexpr double contact_sigma_v_px = 1.5;
// A dot farther than this from where the finger touches is none.
constexpr double dot_at_finger_mm = 9;
constexpr std::size_t least_touches = 2;
constexpr std::size_t enough_dots = 4;
constexpr std::size_t most_lines = 8;        // that are taken for the screen's edge
constexpr double least_part_of_width = 0.4;  // of such a line
constexpr int refinements = 2;               // more change nothing

// What was seen of a touch.
struct Sighting {
  std::optional<CalibrationDot> dot;
  std::optional<ImagePoint> contact;
  bool left_out = false;  // contradicts the others
};
using Sightings = std::vector<Sighting>;

cv::Mat upside_down(const cv::Mat& bgr) {
  constexpr int about_the_middle_row = 0;
  cv::Mat turned;
  cv::flip(bgr, turned, about_the_middle_row);
  return turned;
}

double distance_px(const ImagePoint& a, const ImagePoint& b) {
  return std::hypot(a.u_px - b.u_px, a.v_px - b.v_px);
}

class TouchCalibration {
 public:
  explicit TouchCalibration(const CalibrationPictures& pictures)
      : pictures_(pictures),
        image_{pictures.empty.cols, pictures.empty.rows},
        scale_(image_.width_px / 1280.0),
        seen_{pictures.screen, image_, {}, {}, {}} {
    if (pictures.marks) spots_ = lit_spots(*pictures.marks, pictures.empty);
  }

  Result<RigCalibration> solve() {
    const BorderLine edge = look_at_edge();
    Sightings seen = dots_below(edge);
    mark_contradicting(seen);
    if (count(seen) < std::min(enough_dots, pictures_.touches.size())) seen = best_sightings(edge, seen);
    if (count(seen) < least_touches) {
      return Error{fmt::format(
          "a touched dot or a finger was found in {} of {} calibration pictures, and {} are needed: take them again",
          count(seen), pictures_.touches.size(), least_touches)};
    }
    auto solved = solve_with(seen, edge);
    for (int i = 0; i < refinements && solved; ++i) {
      const RigCalibration known = look_at_marks(seen, solved->calibration);
      look_again(seen, known);
      mark_contradicting(seen);
      if (count(seen) < (marks_.empty() ? least_touches : 1)) break;
      auto better = solve_with(seen, border_line(known.solution.model.camera, pictures_.screen));
      if (!better) break;
      solved = std::move(better);
    }
    if (!solved) return solved.error();
    return std::move(solved->calibration);
  }

 private:
  // The edge that the triangle tells, else the longest line, else where it usually is.
  BorderLine look_at_edge() {
    if (pictures_.triangle) {
      if (const auto border = find_screen_border(*pictures_.triangle, BorderChoice::triangle)) {
        if (const auto mark = triangle_mark(*border, pictures_.screen)) seen_.marks.push_back(*mark);
        return border->line;
      }
    }
    if (const auto border = find_screen_border(pictures_.empty, BorderChoice::longest)) return border->line;
    return border_line(make_rig_model(usual_rigs(pictures_.screen, image_).mean, image_, {}).camera, pictures_.screen);
  }

  [[nodiscard]] Sightings dots_below(const BorderLine& edge) const {
    Sightings seen;
    for (const CalibrationPictures::Touch& touch : pictures_.touches)
      seen.push_back({find_calibration_dot(touch.bgr, edge), std::nullopt, false});
    return seen;
  }

  static std::size_t count(const Sightings& seen) {
    return static_cast<std::size_t>(
        std::count_if(seen.begin(), seen.end(), [](const Sighting& s) { return (s.dot || s.contact) && !s.left_out; }));
  }

  [[nodiscard]] std::vector<PointObservation> touches(const Sightings& seen) const {
    std::vector<PointObservation> found;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const ScreenPoint& screen = pictures_.touches[i].screen;
      const bool left_out = seen[i].left_out;
      if (const auto& dot = seen[i].dot) {
        found.push_back({screen, dot->centre, dot->sigma_u_px, dot->sigma_v_px, TouchEvidence::dot, left_out});
      } else if (seen[i].contact) {
        found.push_back({screen, *seen[i].contact, contact_sigma_u_px * scale_, contact_sigma_v_px * scale_,
                         TouchEvidence::contact, left_out});
      }
    }
    return found;
  }

  [[nodiscard]] RigObservations observations(const Sightings& seen) const {
    RigObservations all = seen_;
    all.touches = touches(seen);
    all.marks.insert(all.marks.end(), marks_.begin(), marks_.end());
    return all;
  }

  void mark_contradicting(Sightings& seen) const {
    const std::vector<std::size_t> kept = consistent_touches(observations(seen));
    std::size_t index = 0;
    for (Sighting& sighting : seen) {
      if (!sighting.dot && !sighting.contact) continue;
      sighting.left_out = !std::binary_search(kept.begin(), kept.end(), index++);
    }
  }

  // None if there are marks: they tell more than the edge, and are never taken for another.
  [[nodiscard]] std::vector<BorderCandidate> edges_near(const BorderLine& line) const {
    if (!marks_.empty()) return {};
    std::vector<BorderCandidate> found = find_border_candidates(pictures_.empty, line);
    if (pictures_.triangle) {
      for (BorderCandidate& candidate : find_border_candidates(*pictures_.triangle, line))
        found.push_back(std::move(candidate));
    }
    return found;
  }

  [[nodiscard]] Result<BorderChosen> solve_with(const Sightings& seen, const BorderLine& edge) const {
    return solve_with_border(observations(seen), edges_near(edge));
  }

  // Each long line may be the screen's edge, and the picture upside down: what agrees in most touches is right.
  [[nodiscard]] Sightings best_sightings(const BorderLine& edge, const Sightings& dots) const {
    Sightings best = dots;
    for (const bool flipped : {false, true}) {
      std::vector<BorderLine> lines;
      if (!flipped) lines.push_back(edge);
      const cv::Mat empty = flipped ? upside_down(pictures_.empty) : pictures_.empty;
      for (const LevelLine& line : find_level_lines(empty)) {
        if (lines.size() < most_lines && line.length_px >= least_part_of_width * image_.width_px)
          lines.push_back(line.line);
      }
      for (const BorderLine& line : lines) {
        Sightings seen = fingers_across(line, empty, flipped);
        for (std::size_t i = 0; i < seen.size() && !flipped; ++i)
          seen[i].dot = dots[i].dot;
        drop_dots_elsewhere(seen);
        mark_contradicting(seen);
        if (count(seen) > count(best)) best = std::move(seen);
      }
      if (2 * count(best) > pictures_.touches.size()) break;
    }
    return best;
  }

  [[nodiscard]] Sightings fingers_across(const BorderLine& line, const cv::Mat& empty, bool flipped) const {
    return contacts(BorderCurve(line, image_), std::nullopt, empty, flipped);
  }

  // Of the finger that reaches farthest, in each picture; none if no finger could be seen with this edge.
  [[nodiscard]] Sightings contacts(const BorderCurve& edge, const std::optional<RigCamera>& camera,
                                   const cv::Mat& empty, bool flipped) const {
    Sightings seen(pictures_.touches.size());
    try {
      const BorderStrip::Layout layout(edge, image_);
      BorderStrip strip(layout);
      strip.sample(empty, layout);
      FingerDetector detector(edge, image_, strip, camera);
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const cv::Mat& bgr = pictures_.touches[i].bgr;
        const Fingers& fingers = detector.detect(flipped ? upside_down(bgr) : bgr);
        const auto farthest = std::max_element(
            fingers.begin(), fingers.end(), [](const Finger& a, const Finger& b) { return a.length_px < b.length_px; });
        if (farthest == fingers.end()) continue;
        ImagePoint contact = farthest->contact.value_or(farthest->tip);
        if (flipped) contact.v_px = image_.height_px - 1 - contact.v_px;
        seen[i].contact = contact;
      }
    } catch (const std::invalid_argument&) {
      return Sightings(pictures_.touches.size());
    }
    return seen;
  }

  // The camera that the page of marks tells, if that is found where `known` sees it. Spots alone tell it better than
  // few touches do, and then how a dot looks.
  [[nodiscard]] RigCalibration look_at_marks(Sightings& seen, const RigCalibration& known) {
    if (!pictures_.marks) return known;
    const auto near = [&](const RigCamera& camera) { return marks_at(spots_, pictures_.screen, camera); };
    const RigCalibration rough = marks_.empty() ? with_marks(near(known.solution.model.camera), seen, known) : known;
    if (marks_.empty()) return known;
    const RigCamera& camera = rough.solution.model.camera;
    const RigCalibration exact =
        with_marks(measured_marks(*pictures_.marks, near(camera), pictures_.screen, camera), seen, rough);
    return marks_.empty() ? known : exact;
  }

  // Marks that contradict most touches are not used: perhaps they were not shown on the whole screen.
  [[nodiscard]] RigCalibration with_marks(std::vector<PointObservation> marks, Sightings& seen,
                                          const RigCalibration& known) {
    marks_ = std::move(marks);
    mark_contradicting(seen);
    if (2 * count(seen) < touches(seen).size()) {
      marks_.clear();
      mark_contradicting(seen);
    }
    if (marks_.empty()) return known;
    auto solved = solve_rig(observations(seen));
    return solved ? RigCalibration{observations(seen), *std::move(solved)} : known;
  }

  void drop_dots_elsewhere(Sightings& seen) const {
    constexpr double usual_px_per_mm = 3.3;
    for (Sighting& sighting : seen) {
      if (sighting.dot && sighting.contact &&
          distance_px(sighting.dot->centre, *sighting.contact) > dot_at_finger_mm * usual_px_per_mm * scale_)
        sighting.dot.reset();
    }
  }

  // With the camera known so far: the dots' outlines, also where none was found, and fingers where there is no dot.
  void look_again(Sightings& seen, const RigCalibration& known) const {
    const RigCamera& camera = known.solution.model.camera;
    const Calibration calibration{"", "", image_, pictures_.screen, border_line(camera, pictures_.screen), known};
    const bool flipped = is_upside_down(calibration);
    const Calibration turned = upright(calibration);
    const RigCamera& turned_camera = std::get<RigCalibration>(turned.solved).solution.model.camera;
    const Sightings fingers = contacts(border_curve(turned), turned_camera,
                                       flipped ? upside_down(pictures_.empty) : pictures_.empty, flipped);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const CalibrationPictures::Touch& touch = pictures_.touches[i];
      const bool known_dot = seen[i].dot && !seen[i].left_out;
      const auto expected = known_dot ? std::optional(seen[i].dot->centre) : camera.project(touch.screen);
      seen[i].contact = fingers[i].contact;
      const auto refined = expected ? refine_calibration_dot(touch.bgr, camera, *expected) : std::nullopt;
      if (refined || (!known_dot && seen[i].contact)) seen[i].dot = refined;
    }
  }

  const CalibrationPictures& pictures_;
  ImageSize image_;
  double scale_;
  RigObservations seen_;           // without touches and the page of marks
  std::vector<ImagePoint> spots_;  // on the page of marks
  std::vector<PointObservation> marks_;
};

}  // namespace

Result<RigCalibration> calibrate_with_pictures(const CalibrationPictures& pictures) {
  return TouchCalibration(pictures).solve();
}

}  // namespace telehug
