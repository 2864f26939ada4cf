// SPDX-License-Identifier: Apache-2.0
//
// Examples for the nets, one after the other in a binary file (numbers in this PC's byte order). A record:
//   magic u32, rig u32, columns u16, rows u16, tips u16, patches u16
//   the overview's blue, green, red (0..255) and distance (0..255) of every cell, u8
//   the edge of the screen in every column, in rows of the overview, f32
//   per tip: column, row (of the overview), crosses, touches, hover_mm, width in cells: 6 x f32
//   per patch: column, row of its tip in the patch, there is one, touches, hover_mm, its finger's width in patch
//   pixels,
//     the tip's place in the picture (from its centre, in halves of its width): 8 x f32; then blue, green, red, u8
#pragma once

#include <cstdint>
#include <fstream>
#include <utility>
#include <vector>

#include "capture/virtual_rig/random_numbers.hpp"
#include "finger/background_strip.hpp"
#include "finger/overview.hpp"
#include "net/overview_net.hpp"
#include "rendered_rig.hpp"

namespace telehug {

inline constexpr int example_patch_columns = 128;
inline constexpr int example_patch_rows = 184;

// Writes the frames of one rig.
class ExampleWriter {
 public:
  ExampleWriter(std::ofstream& file, std::uint32_t rig, const RigCamera& camera, const ScreenSize& screen,
                const cv::Mat& empty);

  void write(const RenderedFrame& frame, std::uint64_t seed);

 private:
  // Where a patch is laid, and the tip in it.
  using Places = std::vector<std::pair<ImagePoint, const TipTruth*>>;

  Places patch_places(const RenderedFrame& frame, RandomNumbers& random);
  void write_patch(const RenderedFrame& frame, const ImagePoint& middle, const TipTruth* tip);

  std::ofstream& file_;
  std::uint32_t rig_;
  RigCamera camera_;
  BorderCurve border_;
  BorderStrip::Layout layout_;
  BorderStrip strip_;
  BackgroundStrip background_;
  Overview overview_;
  OverviewNet net_;
};

}  // namespace telehug
