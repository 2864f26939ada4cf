// SPDX-License-Identifier: Apache-2.0
#include "eval_face/face_scores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace telehug {
namespace {

cv::Point2d centre(const cv::Rect2d& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

bool fits(const cv::Rect2d& found, const cv::Rect2d& label) {
  const cv::Point2d off = centre(found) - centre(label);
  const double ratio = found.height / label.height;
  return std::abs(off.x) <= 0.4 * label.height && std::abs(off.y) <= 0.4 * label.height && ratio >= 0.55 &&
         ratio <= 1.8;
}

bool as_good_as_remote(const LabelledFace& face, const LabelledPicture& picture) {
  return face.role == FaceRole::remote ||
         (face.role == FaceRole::other && picture.remote_view && picture.remote_view->contains(centre(face.box)));
}

// Nearest rank; `share` 0..1.
double percentile(std::vector<double> values, double share) {
  const auto count = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::max(1.0, std::ceil(share * count)));
  std::nth_element(values.begin(), values.begin() + rank - 1, values.end());
  return values[static_cast<std::size_t>(rank - 1)];
}

}  // namespace

void FaceScores::add(const LabelledPicture& label, const FoundFaces& found, const std::optional<cv::Rect2d>& picked) {
  if (label.faces.empty()) {
    ++pictures_without_face;
    false_picks += picked ? 1 : 0;
    return;
  }
  const bool has_remote = std::any_of(label.faces.begin(), label.faces.end(),
                                      [](const LabelledFace& face) { return face.role == FaceRole::remote; });
  if (!has_remote) {
    return;
  }
  ++pictures_with_remote;
  for (const LabelledFace& face : label.faces) {
    if (face.role == FaceRole::remote &&
        std::any_of(found.begin(), found.end(), [&face](const FoundFace& find) { return fits(find.box, face.box); })) {
      ++remote_found;
      break;
    }
  }
  false_finds += static_cast<int>(std::count_if(found.begin(), found.end(), [&label](const FoundFace& find) {
    return std::none_of(label.faces.begin(), label.faces.end(),
                        [&find](const LabelledFace& face) { return fits(find.box, face.box); });
  }));
  if (!picked) {
    return;
  }
  const auto right = std::find_if(label.faces.begin(), label.faces.end(), [&](const LabelledFace& face) {
    return as_good_as_remote(face, label) && fits(*picked, face.box);
  });
  if (right == label.faces.end()) {
    return;
  }
  ++remote_picked;
  const double height = right->box.height;
  height_errors.push_back(std::abs(picked->height - height) / height);
  centre_x_errors.push_back(std::abs(centre(*picked).x - centre(right->box).x) / height);
  chin_errors.push_back(std::abs(picked->br().y - right->box.br().y) / height);
}

std::string report(const FaceScores& scores) {
  std::string table;
  const auto count = [&table](const char* what, int part, int of) {
    table += fmt::format("{:<44}{:>4} of {}\n", what, part, of);
  };
  const auto error = [&table](const char* what, const std::vector<double>& values) {
    table += fmt::format("{:<44}{:>6.3f} {:>6.3f}\n", what, percentile(values, 0.5), percentile(values, 0.9));
  };
  count("remote face found", scores.remote_found, scores.pictures_with_remote);
  count("remote face picked", scores.remote_picked, scores.pictures_with_remote);
  table += fmt::format("{:<44}{:>4}\n", "false finds on these", scores.false_finds);
  count("a face picked where there is none", scores.false_picks, scores.pictures_without_face);
  if (!scores.height_errors.empty()) {
    table += fmt::format("{:<44}{:>6} {:>6}\n", "errors of right picks, in face heights", "median", "90 %");
    error("  height", scores.height_errors);
    error("  centre, sideways", scores.centre_x_errors);
    error("  chin", scores.chin_errors);
  }
  return table;
}

}  // namespace telehug
