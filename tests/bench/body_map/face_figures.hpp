// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "bench/touch/figure.hpp"

namespace telehug {

// The chat picture of the fixtures as high as a screen of that size, between black bars. CV_8UC4.
cv::Mat chat_on_screen(cv::Size size);

// From the changed picture of a screen in memory to the body map, with each finder; with a picture that stands still;
// and what any finder pays that looks at every pixel once.
Figures measure_face_step(cv::Size size);

Figures measure_box_at();

// On an X server of 1920x1080 with a moving chat: one look from grab to map, and what looking 8 times a second takes of
// one core, while the screen moves and while it stands still.
Figures measure_looking_at_a_screen();

// The touch path on 1280x720 while nobody and while the face worker looks at such a screen, in turns.
Figures measure_touch_beside_face();

}  // namespace telehug
