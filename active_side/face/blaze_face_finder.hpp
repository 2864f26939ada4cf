// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "face/face_finder.hpp"

namespace telehug {

// Where the model may lie: installed, then in the sources that this program was built from.
std::vector<std::filesystem::path> known_blaze_models();

// BlazeFace "back" (Bazarevsky et al. 2019, as MediaPipe ships it; models/README.md), a small net that looks at the
// whole picture at once and finds profiles, tilted and dim faces, too: from about 75 px of height on in a picture
// 1,920 px wide. Scores are probabilities, from 0.5 on. Fails if the first of `paths` that exists is not that model,
// byte for byte, or if there is none.
Result<std::unique_ptr<FaceFinder>> make_blaze_face_finder(
    const std::vector<std::filesystem::path>& paths = known_blaze_models());

}  // namespace telehug
