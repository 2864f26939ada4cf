// SPDX-License-Identifier: Apache-2.0
#include "calibration/dot_touches.hpp"

#include <algorithm>
#include <utility>

namespace telehug {

void find_dots(std::vector<DotPicture>& pictures, const BorderLine& border) {
  for (DotPicture& picture : pictures)
    picture.dot = find_calibration_dot(picture.bgr, border);
  const auto found = std::count_if(pictures.begin(), pictures.end(),
                                   [](const DotPicture& picture) { return picture.dot.has_value(); });
  if (2 * static_cast<std::size_t>(found) >= pictures.size()) return;
  for (DotPicture& picture : pictures)
    picture.dot.reset();
}

std::vector<PointObservation> dot_touches(const std::vector<DotPicture>& pictures) {
  std::vector<PointObservation> touches;
  for (const DotPicture& picture : pictures) {
    if (!picture.dot) continue;
    touches.push_back(
        {picture.screen, picture.dot->centre, picture.dot->sigma_u_px, picture.dot->sigma_v_px, TouchEvidence::dot});
  }
  return touches;
}

Result<BorderChosen> solve_with_dots(RigObservations observations, std::vector<DotPicture>& pictures,
                                     const std::vector<BorderCandidate>& candidates) {
  // The shapes after the first solution are exact to some percent, and nothing changes any more after the second.
  constexpr int refinements = 2;
  observations.touches = dot_touches(pictures);
  auto solved = solve_with_border(observations, candidates);
  for (int i = 0; i < refinements && solved; ++i) {
    const RigCamera& camera = solved->calibration.solution.model.camera;
    for (DotPicture& picture : pictures) {
      if (!picture.dot) continue;
      if (auto refined = refine_calibration_dot(picture.bgr, camera, picture.dot->centre)) picture.dot = refined;
    }
    observations.touches = dot_touches(pictures);
    solved = solve_with_border(observations, candidates);
  }
  return solved;
}

}  // namespace telehug
