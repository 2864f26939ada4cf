// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval_face/face_labels.hpp"
#include "face/face_finder.hpp"

namespace telehug {

// How finds compare with labels, over many pictures. A find fits a label when its centre is within 0.4 face heights of
// it in x and y and its height is 0.55 to 1.8 of it.
class FaceScores {
 public:
  void add(const LabelledPicture& label, const FoundFaces& found, const std::optional<cv::Rect2d>& picked);

  int pictures_with_remote = 0;
  int remote_found = 0;   // some find fits the remote face
  int remote_picked = 0;  // the picked face is the remote one, or another person inside the remote view
  int false_finds = 0;    // finds that fit no label, on pictures with a remote face
  int pictures_without_face = 0;
  int false_picks = 0;  // pictures without a face on which one was picked

  // Of right picks, against the label that they fit, without sign: a share of the height; the others in face heights.
  std::vector<double> height_errors, centre_x_errors, chin_errors;
};

// A table for a person.
std::string report(const FaceScores& scores);

}  // namespace telehug
