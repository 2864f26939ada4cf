// SPDX-License-Identifier: Apache-2.0
#include "eval_face/eval_face.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "face/remote_face_follower.hpp"
#include "pictures/picture_file.hpp"
#include "screen/picture_files.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

// The remote face of a picture by itself.
std::optional<cv::Rect2d> pick(const cv::Mat& picture, const FoundFaces& faces) {
  RemoteFaceFollower follower({}, false);
  const auto& followed = follower.look(Timestamp{1ns}, picture, faces);
  return followed ? std::optional(followed->box) : std::nullopt;
}

std::string csv_row(const std::string& image, const std::optional<cv::Rect2d>& face) {
  if (!face) {
    return fmt::format("{},,,,\n", image);
  }
  return fmt::format("{},{:.1f},{:.1f},{:.1f},{:.1f}\n", image, face->x, face->y, face->width, face->height);
}

}  // namespace

Result<FaceEvaluation> eval_face(const fs::path& folder, const fs::path& out, FaceFinder& finder) {
  const auto files = list_pictures(folder);
  if (!files) {
    return files.error();
  }
  const auto labels = read_face_labels(folder);
  if (!labels) {
    return labels.error();
  }

  FaceEvaluation evaluation;
  if (*labels) {
    evaluation.scores.emplace();
  }
  std::string rows = "image,face_x,face_y,face_w,face_h\n";
  for (const fs::path& file : *files) {
    const auto picture = read_picture(file);
    if (!picture) {
      return picture.error();
    }
    const auto found = finder.find(*picture);
    if (!found) {
      return Error{fmt::format("{}: {}", file.string(), found.error().message)};
    }
    const auto picked = pick(*picture, *found);
    const std::string image = file.filename().string();
    rows += csv_row(image, picked);
    ++evaluation.pictures;
    evaluation.picked += picked ? 1 : 0;
    if (evaluation.scores) {
      if (const auto label = (*labels)->find(image); label != (*labels)->end()) {
        evaluation.scores->add(label->second, *found, picked);
      }
    }
  }

  std::ofstream csv(out, std::ios::trunc);
  csv << rows << std::flush;
  if (!csv) {
    return Error{fmt::format("{} can't be written; check that its folder exists and is writable.", out.string())};
  }
  return evaluation;
}

}  // namespace telehug
