// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/result.hpp"

namespace telehug {

enum class FaceRole {
  remote,  // the face to pick
  self,    // the user's own small picture
  other,   // further people; inside the remote view as good as `remote`
};

struct LabelledFace {
  cv::Rect2d box;  // hairline to chin, px
  FaceRole role = FaceRole::remote;
};

struct LabelledPicture {
  std::vector<LabelledFace> faces;        // empty: the picture has no face
  std::optional<cv::Rect2d> remote_view;  // where the remote person's video lies, px
};

using FaceLabels = std::map<std::string, LabelledPicture>;  // by file name

// Reads `labels.csv` (image,face_x,face_y,face_w,face_h,role; role remote|self|other|none) and, if it is there,
// `views.csv` (image,view_x,view_y,view_w,view_h,role) of a folder. No labels.csv: no labels. Faults are told all at
// once, with file and line.
Result<std::optional<FaceLabels>> read_face_labels(const std::filesystem::path& folder);

}  // namespace telehug
