// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/shm.h>

#include <cstddef>
#include <opencv2/core/mat.hpp>

#include "common/result.hpp"
#include "screen_x11/x11_connection.hpp"

namespace telehug {

// Do pixels of this depth and visual lie in memory as B, G, R and a fourth byte? Says what to do if not.
Status check_x11_pixels(const X11Connection& connection, std::uint8_t depth, xcb_visualid_t visual);

// Reads pixels of windows and pixmaps: through memory shared with the server, or through the connection if it is
// on another machine or doesn't share.
class X11Pixels {
 public:
  explicit X11Pixels(const X11Connection& connection);  // which outlives this
  ~X11Pixels();
  X11Pixels(const X11Pixels&) = delete;
  X11Pixels& operator=(const X11Pixels&) = delete;

  // CV_8UC4, B G R and an undefined byte, of a drawable that check_x11_pixels() accepts; shares its pixels with this
  // object until the next call. Empty if `part_px` isn't within the drawable, or the drawable is gone or not shown.
  cv::Mat read(xcb_drawable_t drawable, const cv::Rect& part_px);

  [[nodiscard]] bool shares_memory() const noexcept { return shares_memory_; }

 private:
  bool make_room(std::size_t bytes);
  void let_go();

  const X11Connection& connection_;
  bool shares_memory_ = false;
  xcb_shm_seg_t segment_ = 0;
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
  XcbOwned<xcb_get_image_reply_t> sent_;  // holds the pixels where no memory is shared
};

}  // namespace telehug
