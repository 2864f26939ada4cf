// SPDX-License-Identifier: Apache-2.0
//
// The file of a rig's calibration. It is TOML:
//
//   version = 2                          # of this layout
//   camera = "webcam /dev/v4l/by-id/..." # as FrameSource::name() says
//   date = "2026-11-22T05:30:00Z"
//   model = "default"                    # or "thesis"
//   [image]                              # the camera's pictures, px
//   width_px = 1280
//   height_px = 720
//   [screen]                             # the visible area
//   width_mm = 380.0
//   height_mm = 300.0
//   width_px = 1280
//   height_px = 1024
//   [border]                             # image of the screen's bottom edge: v = v0_px + slope * u
//   v0_px = 512.5
//   slope = 0.004
//   [parameters]                         # of the camera (rig_camera.hpp) and the finger (rig_model.hpp)
//   focal_px = 960.0
//   k1 = -0.03
//   x0_mm = 192.0
//   y0_mm = -14.0
//   z0_mm = 46.0
//   pitch_deg = 1.5
//   yaw_deg = 0.2
//   roll_deg = -0.4
//   contact_radius_mm = 13.0
//   left_right_exchanged = false         # is the picture mirrored, is it upside down (then both are true)
//   top_bottom_exchanged = false
//   [[touch]]                            # of known points
//   x_mm = 190.0
//   y_mm = 100.0
//   u_px = 645.3
//   v_px = 588.1
//   seen = "dot"                         # what is there: the dot's centre, the "contact" of a finger, or (and without
//                                        # it) the finger's foremost point, "fingertip"
//   sigma_u_px = 0.5
//   sigma_v_px = 0.5
//   left_out = true                      # only if it contradicted the others and was not used
//   error_x_mm = 0.1                     # where the model places it, minus where it was; for people to read
//   error_y_mm = -0.3
//   [[mark]]                             # flat on the screen, as a touch; none, if none was seen
//   [[border_point]]                     # on the image of the screen's bottom edge; none, if none was seen
//   u_px = 20.0
//   v_px = 511.9
//   sigma_px = 0.5
//
// The parameters are solved again from the touches when the file is read, and must agree. With model = "thesis", which
// version 1 knew, there are no parameters, marks and border points, and there are two touches:
//
//   [[touch]]                            # the first is the reference point
//   x_mm = 190.0
//   y_mm = 100.0
//   length_px = 118.0                    # finger past the border
//   column_px = -3.5                     # tip, signed, from the image centre
#pragma once

#include <filesystem>

#include "calibration/calibration.hpp"
#include "common/result.hpp"

namespace telehug {

// The error holds every fault, one a line, each as "file:line: what is wrong"; or why the touches do not solve.
Result<Calibration> read_calibration(const std::filesystem::path& path);

// Makes the folder if need be. The file appears under its name when it is complete; an older one stays until then.
Status write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace telehug
