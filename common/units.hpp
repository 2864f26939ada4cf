// SPDX-License-Identifier: Apache-2.0
//
// Points and sizes in the frames that telehug uses. A name carries its unit; these types carry the frame.
#pragma once

namespace telehug {

// Image frame: pixels of the webcam picture, u to the right, v down, (0, 0) the centre of the top-left pixel.
struct ImagePoint {
  double u_px = 0;
  double v_px = 0;
};

// Screen frame: origin at the top-left corner of the visible screen, x right and y down as the user sees it.
struct ScreenPoint {
  double x_mm = 0;
  double y_mm = 0;

  constexpr bool operator==(const ScreenPoint&) const = default;
};

// A place on the remote person's body, in heights of their face (fh): x from the midline, positive towards their own
// left, which is the right edge of the screen unless the picture is mirrored; y from the chin, positive downwards.
struct BodyPoint {
  double x_fh = 0;
  double y_fh = 0;
};

struct ImageSize {
  int width_px = 0;
  int height_px = 0;
};

// The visible area of a monitor and how many pixels of the desktop it shows.
struct ScreenSize {
  double width_mm = 0;
  double height_mm = 0;
  int width_px = 0;
  int height_px = 0;
};

// Screen frame rectangle; x_mm, y_mm is its top-left corner.
struct ScreenRect {
  double x_mm = 0;
  double y_mm = 0;
  double width_mm = 0;
  double height_mm = 0;
};

}  // namespace telehug
