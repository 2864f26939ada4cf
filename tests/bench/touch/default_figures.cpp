// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/default_figures.hpp"

#include <utility>

#include "bench/touch/detector_stages.hpp"
#include "bench/touch/drawn_touches.hpp"
#include "bench/touch/mjpeg_figures.hpp"
#include "detection/rows_needed.hpp"
#include "finger/picture_scale.hpp"

namespace telehug {

Figures measure_default(ImageSize image, int fingers, const std::string& suffix) {
  DrawnTouches drawn(image, fingers);
  const RowRange rows = rows_needed(drawn.border, image, px_per_mm_at_border(drawn.camera, drawn.border, image));
  Figures figures = measure_path(drawn.detector, drawn.touched, "", suffix);
  for (Figure& figure : measure_stages(drawn.border, drawn.camera, drawn.empty, drawn.touched.pictures, suffix))
    figures.push_back(std::move(figure));
  for (Figure& figure : measure_mjpeg(drawn.detector, rows, drawn.touched, suffix))
    figures.push_back(std::move(figure));
  return figures;
}

}  // namespace telehug
