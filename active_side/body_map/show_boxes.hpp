// SPDX-License-Identifier: Apache-2.0
//
// `telehug-active show-boxes PICTURE --out PNG`: the thesis' picture of face and boxes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>

#include "common/messages.hpp"
#include "common/result.hpp"
#include "face/face_finder.hpp"

namespace telehug {

struct ShowBoxesOptions {
  std::filesystem::path picture;          // of a whole desktop, JPEG or PNG
  std::filesystem::path out;              // PNG
  std::optional<cv::Rect> view;           // the video chat's part of the picture, px; none: all of it
  std::optional<std::uint16_t> touched;   // the box to highlight, or ...
  std::optional<cv::Point2d> touched_px;  // ... the point whose box to highlight (`touched` goes first)
};

struct ShownBoxes {
  cv::Rect2d face;  // hairline to chin, px of the picture
  GridShape grid;
  std::uint16_t touched = 0;  // the highlighted box; 0: none, or touched_px lies outside of the grid
};

// Fails if the picture can't be read, shows no remote face, has no box `touched`, or `out` can't be written.
Result<ShownBoxes> show_boxes(const ShowBoxesOptions& options, FaceFinder& finder);

}  // namespace telehug
