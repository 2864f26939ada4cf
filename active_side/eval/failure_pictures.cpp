// SPDX-License-Identifier: Apache-2.0
#include "eval/failure_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <tuple>
#include <utility>

#include "eval/place_in_picture.hpp"
#include "pictures/jpeg_encoder.hpp"
#include "pictures/picture_file.hpp"

namespace telehug {
namespace {

constexpr int jpeg_quality = 80;
constexpr double width_share = 0.3;  // of a frame, that is shown at least
constexpr double margin_px = 40;     // around both points

bool within(const ImagePoint& point, const cv::Mat& picture) {
  return point.u_px >= 0 && point.v_px >= 0 && point.u_px < picture.cols && point.v_px < picture.rows;
}

// As wide as high as the frame is, around all points; without any the whole frame.
cv::Rect surroundings(const std::vector<ImagePoint>& points, const cv::Mat& picture) {
  if (points.empty()) return {0, 0, picture.cols, picture.rows};
  double left = points.front().u_px, right = left, top = points.front().v_px, bottom = top;
  for (const ImagePoint& point : points) {
    left = std::min(left, point.u_px);
    right = std::max(right, point.u_px);
    top = std::min(top, point.v_px);
    bottom = std::max(bottom, point.v_px);
  }
  const double share =
      std::clamp(std::max((right - left + 2 * margin_px) / picture.cols, (bottom - top + 2 * margin_px) / picture.rows),
                 width_share, 1.0);
  const int width = static_cast<int>(share * picture.cols);
  const int height = static_cast<int>(share * picture.rows);
  const auto begin = [](double low, double high, int length, int whole) {
    return std::clamp(static_cast<int>((low + high - length) / 2), 0, whole - length);
  };
  return {begin(left, right, width, picture.cols), begin(top, bottom, height, picture.rows), width, height};
}

std::optional<FailurePicture> picture_of(const Failure& failure, const Calibration& calibration, const RigPart& part) {
  const auto frame = std::find_if(part.frames.begin(), part.frames.end(),
                                  [&](const RigFrame& one) { return one.name == failure.frame; });
  if (frame == part.frames.end()) return std::nullopt;
  const auto picture = read_picture(frame->picture);
  if (!picture) return std::nullopt;
  std::vector<ImagePoint> points;
  const auto seen = [&](const std::optional<ScreenPoint>& place) {
    auto point = place ? place_in_picture(calibration, *place) : std::nullopt;
    if (point && !within(*point, *picture)) point.reset();
    if (point) points.push_back(*point);
    return point;
  };
  const auto place = seen(failure.place);
  const auto found = seen(failure.found);
  const cv::Rect part_shown = surroundings(points, *picture);
  auto jpeg = encode_jpeg((*picture)(part_shown).clone(), jpeg_quality);
  if (!jpeg) return std::nullopt;
  const auto moved = [&](std::optional<ImagePoint> point) {
    if (point) point = ImagePoint{point->u_px - part_shown.x, point->v_px - part_shown.y};
    return point;
  };
  return FailurePicture{failure, *std::move(jpeg), {part_shown.width, part_shown.height}, moved(place), moved(found)};
}

bool bigger(const FailurePicture& a, const FailurePicture& b) {
  const auto order = [](const FailurePicture& picture) {
    const Failure& failure = picture.failure;
    const double x_mm = failure.found ? failure.found->x_mm : 0;
    return std::tuple(failure.kind, -failure.size_mm, failure.frame, x_mm);
  };
  return order(a) < order(b);
}

}  // namespace

std::vector<FailurePicture> picture_failures(const std::vector<Failure>& failures, const Calibration& calibration,
                                             const RigPart& part) {
  std::vector<FailurePicture> pictures;
  for (const Failure& failure : failures) {
    if (auto picture = picture_of(failure, calibration, part)) pictures.push_back(*std::move(picture));
  }
  return pictures;
}

std::vector<FailurePicture> biggest(std::vector<FailurePicture> failures, std::size_t per_kind) {
  std::sort(failures.begin(), failures.end(), bigger);
  std::array<std::size_t, 3> kept{};
  std::erase_if(failures, [&](const FailurePicture& picture) {
    return ++kept.at(static_cast<std::size_t>(picture.failure.kind)) > per_kind;
  });
  return failures;
}

std::vector<FailurePicture> share_out(const std::vector<FailurePicture>& failures, std::size_t most) {
  std::vector<FailurePicture> shared;
  for (std::size_t per_kind = 1; per_kind <= most; ++per_kind) {
    auto more = biggest(failures, per_kind);
    if (more.size() > most) break;
    shared = std::move(more);
  }
  return shared;
}

}  // namespace telehug
