// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "capture/virtual_rig/hand_pose.hpp"
#include "capture/virtual_rig/rig_renderer.hpp"

namespace telehug {

// How much the mirror image of the (first) hand's fingertip stands out from what is on the screen: the mean difference
// over it between the renderer's picture and the same one without mirror images of hands, in grey levels, of the colour
// in which it is largest. Glass in front of a white screen mirrors as well, but nobody sees it. 0 without hands and
// where the mirror image would lie beyond the picture.
[[nodiscard]] double mirror_contrast(RigRenderer& renderer, const std::vector<HandPose>& hands);

// From here on it can be seen: more than noise and JPEG change so large an area.
inline constexpr double least_mirror_contrast = 5;

}  // namespace telehug
