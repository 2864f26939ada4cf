// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active eval face DIR --out FILE.csv`: the remote face of every picture of a folder.
#pragma once

#include <filesystem>
#include <optional>

#include "common/result.hpp"
#include "eval_face/face_scores.hpp"
#include "face/face_finder.hpp"

namespace telehug {

struct FaceEvaluation {
  int pictures = 0;
  int picked = 0;                    // pictures with a remote face
  std::optional<FaceScores> scores;  // if the folder has a labels.csv
};

// Takes every picture of `folder` alone, as a whole desktop, and writes to `out` one row each, in order of the names:
// image,face_x,face_y,face_w,face_h (px, hairline to chin), empty fields if no remote face was found. Fails, and writes
// nothing, if a picture or a label can't be read.
Result<FaceEvaluation> eval_face(const std::filesystem::path& folder, const std::filesystem::path& out,
                                 FaceFinder& finder);

}  // namespace telehug
