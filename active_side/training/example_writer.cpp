// SPDX-License-Identifier: Apache-2.0
#include "example_writer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/virtual_rig/random_numbers.hpp"
#include "finger/picture_scale.hpp"
#include "finger/tip_patch.hpp"

namespace telehug {
namespace {

constexpr std::size_t overview_channels = 5;
constexpr std::uint32_t magic = 0x54485543;
constexpr double least_logit_of_a_mistake = -3;
constexpr int most_mistakes = 3;  // of a frame

std::uint8_t byte_of(float value, float scale, float offset) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value * scale + offset), 0L, 255L));
}

template <typename T>
void put(std::ofstream& file, const T& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void put_floats(std::ofstream& file, std::initializer_list<double> values) {
  for (const double value : values)
    put(file, static_cast<float>(value));
}

BorderStrip sampled(const cv::Mat& bgr, const BorderStrip::Layout& layout) {
  BorderStrip strip(layout);
  strip.sample(bgr, layout);
  return strip;
}

double distance_px(const ImagePoint& a, const ImagePoint& b) {
  return std::hypot(a.u_px - b.u_px, a.v_px - b.v_px);
}

double px_per_mm_of_edge(const RigCamera& camera, const ScreenSize& screen) {
  const auto middle = camera.project(ScreenPoint{screen.width_mm / 2, screen.height_mm});
  return middle ? px_per_mm_at(camera, *middle).value_or(1) : 1;
}

}  // namespace

ExampleWriter::ExampleWriter(std::ofstream& file, std::uint32_t rig, const RigCamera& camera, const ScreenSize& screen,
                             const cv::Mat& empty)
    : file_(file),
      rig_(rig),
      camera_(camera),
      border_(camera, screen),
      layout_(border_, camera.image()),
      strip_(layout_),
      background_(layout_, sampled(empty, layout_)),
      overview_(border_, layout_, px_per_mm_of_edge(camera, screen)),
      net_(overview_.rows(), overview_.columns()) {}

void ExampleWriter::write_patch(const RenderedFrame& frame, const ImagePoint& middle, const TipTruth* tip) {
  const double step_px = px_per_mm_at(camera_, middle).value_or(patch_px_per_mm) / patch_px_per_mm;
  const PatchPlace place{middle, step_px, step_px / patch_rows_per_column, example_patch_columns, example_patch_rows};
  std::vector<float> values(static_cast<std::size_t>(place.columns * place.rows) * 3);
  sample_patch(frame.bgr, place, values.data());
  const ImagePoint corner = place.picture_point(0, 0);
  const double half_width = 0.5 * frame.bgr.cols;
  const double u = (middle.u_px - half_width) / half_width;
  const double v = (middle.v_px - 0.5 * frame.bgr.rows) / half_width;
  if (tip != nullptr) {
    put_floats(file_,
               {(tip->place.u_px - corner.u_px) / place.step_px, (tip->place.v_px - corner.v_px) / place.row_step_px, 1,
                tip->touches ? 1.0 : 0.0, tip->hover_mm, tip->width_px / place.step_px, u, v});
  } else {
    put_floats(file_, {0, 0, 0, 0, 0, 0, u, v});
  }
  std::vector<std::uint8_t> bytes(values.size());
  std::transform(values.begin(), values.end(), bytes.begin(), [](float x) { return byte_of(x, 127.5F, 127.5F); });
  file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Each fingertip, and what a net that has learned this far takes for one: there the look at it has to tell them apart.
ExampleWriter::Places ExampleWriter::patch_places(const RenderedFrame& frame, RandomNumbers& random) {
  Places places;
  const OverviewNet::Tips found = net_.find(least_logit_of_a_mistake);
  const auto picture_place = [&](const OverviewNet::Tip& tip) { return overview_.picture_point(tip.column, tip.row); };
  for (const TipTruth& tip : frame.tips) {
    const bool inside =
        tip.crosses && tip.place.u_px > 0 && tip.place.u_px < frame.bgr.cols && tip.place.v_px < frame.bgr.rows;
    if (!inside) continue;
    const double spread_px = 5 * px_per_mm_at(camera_, tip.place).value_or(1);
    ImagePoint middle{tip.place.u_px + random.uniform(-spread_px, spread_px),
                      tip.place.v_px + random.uniform(-spread_px, spread_px)};
    for (const OverviewNet::Tip& seen : found) {
      if (random.chance(0.5) && distance_px(picture_place(seen), tip.place) < spread_px) middle = picture_place(seen);
    }
    places.push_back({middle, &tip});
  }
  const auto far_from_tips = [&](const ImagePoint& place) {
    return std::none_of(frame.tips.begin(), frame.tips.end(),
                        [&](const TipTruth& tip) { return distance_px(place, tip.place) < 0.75 * tip.width_px; });
  };
  int mistakes = 0;
  for (const OverviewNet::Tip& seen : found) {
    const ImagePoint place = picture_place(seen);
    if (mistakes == most_mistakes || !far_from_tips(place)) continue;
    places.push_back({place, nullptr});
    ++mistakes;
  }
  // One place more without a tip: on the screen, or along a finger.
  ImagePoint elsewhere{random.uniform(0.03, 0.97) * frame.bgr.cols, 0};
  if (!frame.tips.empty() && random.chance(0.7)) {
    const TipTruth& tip = frame.tips[random.index(frame.tips.size())];
    elsewhere.u_px = tip.place.u_px + random.uniform(-2.5, 2.5) * tip.width_px;
  }
  elsewhere.u_px = std::clamp(elsewhere.u_px, 0.0, frame.bgr.cols - 1.0);
  elsewhere.v_px = random.uniform(border_.v_at(elsewhere.u_px), frame.bgr.rows);
  if (far_from_tips(elsewhere)) places.push_back({elsewhere, nullptr});
  return places;
}

void ExampleWriter::write(const RenderedFrame& frame, std::uint64_t seed) {
  RandomNumbers random(seed);
  strip_.sample(frame.bgr, layout_);
  // Whole rows, of which training takes the parts that it wants.
  (void)overview_.tiles(background_.distance(strip_));
  std::vector<float> values(static_cast<std::size_t>(overview_.rows() * overview_.columns()) * overview_channels);
  overview_.sample(frame.bgr, 0, overview_.columns(), values.data());
  std::copy(values.begin(), values.end(), net_.cells());
  const Places places = patch_places(frame, random);

  put(file_, magic);
  put(file_, rig_);
  const auto put_count = [&](std::size_t count) { put(file_, static_cast<std::uint16_t>(count)); };
  put_count(static_cast<std::size_t>(overview_.columns()));
  put_count(static_cast<std::size_t>(overview_.rows()));
  put_count(frame.tips.size());
  put_count(places.size());

  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < values.size(); i += overview_channels) {
    for (std::size_t k = 0; k < 3; ++k)
      bytes.push_back(byte_of(values[i + k], 127.5F, 127.5F));
    bytes.push_back(byte_of(values[i + 3], 255, 0));
  }
  file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  for (int column = 0; column < overview_.columns(); ++column) {
    const double u = overview_.picture_point(column, 0).u_px;
    put_floats(file_, {overview_.cell_of({u, border_.v_at(u)}).v_px});
  }
  for (const TipTruth& tip : frame.tips) {
    const ImagePoint cell = overview_.cell_of(tip.place);
    put_floats(file_, {cell.u_px, cell.v_px, tip.crosses ? 1.0 : 0.0, tip.touches ? 1.0 : 0.0, tip.hover_mm,
                       tip.width_px / overview_.cell_px()});
  }
  for (const auto& [middle, tip] : places)
    write_patch(frame, middle, tip);
}

}  // namespace telehug
