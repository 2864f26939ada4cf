// SPDX-License-Identifier: Apache-2.0
#include "body_map/show_boxes.hpp"

#include <fmt/format.h>

#include "body_map/body_map_step.hpp"
#include "body_map/draw_body_map.hpp"
#include "body_map/vitruvian_grid.hpp"
#include "pictures/picture_file.hpp"
#include "screen/picture_grabber.hpp"

namespace telehug {

Result<ShownBoxes> show_boxes(const ShowBoxesOptions& options, FaceFinder& finder) {
  const auto picture = read_picture(options.picture);
  if (!picture) {
    return picture.error();
  }
  // A screen of 1 mm a pixel, so that the map's millimetres are the picture's pixels.
  const ScreenScale scale{.mm_per_px_x = 1, .mm_per_px_y = 1};
  const ScreenSize screen{.width_mm = static_cast<double>(picture->cols),
                          .height_mm = static_cast<double>(picture->rows),
                          .width_px = picture->cols,
                          .height_px = picture->rows};
  const SteadyClock clock;
  PictureGrabber grabber({.path = options.picture, .view = options.view}, clock);
  if (const Status opened = grabber.open(); !opened) {
    return opened.error();
  }
  BodyMapStep step(grabber, finder, {.screen = screen, .rules = {}, .tracker = {}, .mirrored = false});
  const BodyMap& map = step.run();
  if (map.version == 0) {
    return Error{fmt::format("{}: {}", options.picture.string(), step.problem())};
  }

  std::uint16_t touched = options.touched.value_or(0);
  const int boxes = map.shape.columns * map.shape.rows;
  if (options.touched && (touched < 1 || touched > boxes)) {
    return Error{
        fmt::format("There is no box {}; {} has the boxes 1 to {}.", touched, options.picture.string(), boxes)};
  }
  if (options.touched && !box_rect(map, touched)) {
    return Error{fmt::format("Box {} lies beside the picture {}.", touched, options.picture.string())};
  }
  if (!options.touched && options.touched_px) {
    if (const auto hit = box_at(map, scale.to_mm(*options.touched_px))) {
      touched = hit->box;
    }
  }
  if (const Status written = write_png(options.out, draw_body_map(*picture, map, scale, touched)); !written) {
    return written.error();
  }
  return ShownBoxes{.face = scale.to_px(map.face), .grid = map.shape, .touched = touched};
}

}  // namespace telehug
