// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mesh_raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace telehug {
namespace {

constexpr int block_px = 8;
constexpr float nothing_mm = std::numeric_limits<float>::max();

struct Span {
  float from = std::numeric_limits<float>::max();
  float to = std::numeric_limits<float>::lowest();
};

// Where a triangle's edge crosses a row; shared edges give the same number in both of their triangles.
void cross(const RasterVertex& p, const RasterVertex& q, float v, Span& span) {
  const bool p_above = p.v_px <= v;
  if (p_above == (q.v_px <= v)) return;
  const RasterVertex& upper = p_above ? p : q;
  const RasterVertex& lower = p_above ? q : p;
  const float u = upper.u_px + (v - upper.v_px) * (lower.u_px - upper.u_px) / (lower.v_px - upper.v_px);
  span.from = std::min(span.from, u);
  span.to = std::max(span.to, u);
}

Span span_of(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, float v) {
  Span span;
  cross(a, b, v, span);
  cross(b, c, v, span);
  cross(c, a, v, span);
  return span;
}

}  // namespace

MeshRaster::MeshRaster(cv::Size size)
    : size_(size),
      blocks_across_((size.width + block_px - 1) / block_px),
      block_coverage_(static_cast<std::size_t>(blocks_across_ * ((size.height + block_px - 1) / block_px)), 0),
      covered_(static_cast<std::size_t>(size.area()), 0),
      drawn_stride_(blocks_across_ * block_px),
      drawn_(static_cast<std::size_t>(drawn_stride_ * size.height), 0),
      depth_mm_(static_cast<std::size_t>(size.area()), nothing_mm),
      pixels_(static_cast<std::size_t>(size.area())) {}

void MeshRaster::begin(const cv::Rect& box) {
  box_ = box;
  for (int v = box.y; v < box.y + box.height; ++v) {
    const auto first = static_cast<std::ptrdiff_t>(v) * size_.width + box.x;
    std::fill_n(depth_mm_.begin() + first, box.width, nothing_mm);
    std::fill_n(drawn_.begin() + static_cast<std::ptrdiff_t>(v) * drawn_stride_, drawn_stride_, std::uint8_t{0});
  }
}

MeshRaster::Rows MeshRaster::rows_of(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const {
  const float top = std::min({a.v_px, b.v_px, c.v_px});
  const float bottom = std::max({a.v_px, b.v_px, c.v_px});
  const auto low = static_cast<float>(box_.y);
  const auto high = static_cast<float>(box_.y + box_.height - 1);
  if (!(bottom >= low - 0.5F) || !(top <= high + 0.5F)) return {};
  return {static_cast<int>(std::max(low, std::floor(top + 0.5F))),
          static_cast<int>(std::min(high, std::ceil(bottom - 0.5F)))};
}

void MeshRaster::draw(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
  const Rows rows = rows_of(a, b, c);
  for (int row = rows.first; row <= rows.last; ++row)
    colour(a, b, c, row);
}

// 0: nothing drawn in this block of 8 x 8 pixels and one pixel around it, 1: everything, 2: some.
int MeshRaster::coverage_of_block(int block_row, int block_column) const {
  std::uint64_t all = ~std::uint64_t{0};
  std::uint64_t any = 0;
  for (int row = -1; row <= block_px; ++row) {
    const int v = std::clamp(block_row * block_px + row, 0, size_.height - 1);
    for (const int shift : {-1, 1}) {
      const int u = std::clamp(block_column * block_px + shift, 0, drawn_stride_ - block_px);
      std::uint64_t eight = 0;
      std::memcpy(&eight, &drawn_[static_cast<std::size_t>(v * drawn_stride_ + u)], sizeof eight);
      all &= eight;
      any |= eight;
    }
  }
  return any == 0 ? 0 : ~all == 0 ? 1 : 2;
}

void MeshRaster::find_outlines() {
  const int first_row = box_.y / block_px;
  const int last_row = (box_.y + box_.height - 1) / block_px;
  const int first_column = box_.x / block_px;
  const int last_column = (box_.x + box_.width - 1) / block_px;
  const auto at = [&](int row, int column) { return static_cast<std::size_t>(row * blocks_across_ + column); };
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const int coverage = coverage_of_block(row, column);
      block_coverage_[at(row, column)] = static_cast<std::uint8_t>(coverage);
    }
  }
  // Elsewhere what was drawn is covered, and where nothing was drawn nothing is.
  for (int v = box_.y; v < box_.y + box_.height; ++v) {
    const auto line = static_cast<std::size_t>(v) * static_cast<std::size_t>(size_.width);
    for (int column = first_column; column <= last_column; ++column) {
      const std::size_t block = at(v / block_px, column);
      const std::uint32_t covered = block_coverage_[block] == 1 ? ~0U : 0U;
      const int from = std::max(box_.x, column * block_px);
      const int to = std::min(box_.x + box_.width, (column + 1) * block_px);
      for (int u = from; u < to; ++u)
        covered_[line + static_cast<std::size_t>(u)] = covered;
    }
  }
}

bool MeshRaster::near_outline(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const {
  const auto block = [](float px, int low, int high) {
    return std::clamp(static_cast<int>(std::clamp(px, -1e6F, 1e6F) + 0.5F), low, high) / block_px;
  };
  const int right = box_.x + box_.width - 1;
  const int bottom = box_.y + box_.height - 1;
  const int u0 = block(std::min({a.u_px, b.u_px, c.u_px}), box_.x, right);
  const int u1 = block(std::max({a.u_px, b.u_px, c.u_px}), box_.x, right);
  const int v0 = block(std::min({a.v_px, b.v_px, c.v_px}), box_.y, bottom);
  const int v1 = block(std::max({a.v_px, b.v_px, c.v_px}), box_.y, bottom);
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) {
      if (block_coverage_[static_cast<std::size_t>(v * blocks_across_ + u)] == 2) return true;
    }
  }
  return false;
}

void MeshRaster::cover_outlines(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
  if (!near_outline(a, b, c)) return;
  const Rows rows = rows_of(a, b, c);
  for (int row = rows.first; row <= rows.last; ++row)
    cover(a, b, c, row);
}

void MeshRaster::cover(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, int row) {
  std::uint32_t* line = covered_.data() + static_cast<std::ptrdiff_t>(row) * size_.width;
  const int left = box_.x * 8;
  const int right = (box_.x + box_.width) * 8;
  for (int part = 0; part < 4; ++part) {
    const Span span = span_of(a, b, c, static_cast<float>(row) + (static_cast<float>(part) - 1.5F) / 4);
    if (!(span.to > span.from)) continue;
    // Point k of a line lies at u = (k + 0.5) / 8 - 0.5.
    const auto point = [&](float u) {
      return static_cast<int>(
          std::ceil(std::clamp((u + 0.5F) * 8 - 0.5F, static_cast<float>(left), static_cast<float>(right))));
    };
    const int from = point(span.from);
    const int to = point(span.to);
    for (int k = from; k < to;) {
      const int pixel = k >> 3;
      const int end = std::min(to, (pixel + 1) * 8);
      const std::uint32_t bits = ((1U << (end - k)) - 1) << (k & 7);
      line[pixel] |= bits << (8 * part);
      k = end;
    }
  }
}

void MeshRaster::colour(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c, int row) {
  const auto v = static_cast<float>(row);
  const Span span = span_of(a, b, c, v);
  const int from = std::max(box_.x, static_cast<int>(std::ceil(std::max(span.from, -1e6F))));
  const int to = std::min(box_.x + box_.width, static_cast<int>(std::ceil(std::min(span.to, 1e6F))));
  if (from >= to) return;
  const float area = (b.u_px - a.u_px) * (c.v_px - a.v_px) - (c.u_px - a.u_px) * (b.v_px - a.v_px);
  if (area == 0) return;
  const float of_b_per_px = (c.v_px - a.v_px) / area;
  const float of_c_per_px = -(b.v_px - a.v_px) / area;
  const float du = static_cast<float>(from) - a.u_px;
  const float dv = v - a.v_px;
  float of_b = (du * (c.v_px - a.v_px) - dv * (c.u_px - a.u_px)) / area;
  float of_c = (dv * (b.u_px - a.u_px) - du * (b.v_px - a.v_px)) / area;
  const auto line = static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.width);
  const auto drawn_line = static_cast<std::size_t>(row * drawn_stride_);
  for (int u = from; u < to; ++u, of_b += of_b_per_px, of_c += of_c_per_px) {
    const std::size_t i = line + static_cast<std::size_t>(u);
    const float of_a = 1 - of_b - of_c;
    const float depth_mm = of_a * a.depth_mm + of_b * b.depth_mm + of_c * c.depth_mm;
    if (depth_mm >= depth_mm_[i]) continue;
    depth_mm_[i] = depth_mm;
    drawn_[drawn_line + static_cast<std::size_t>(u)] = 255;
    pixels_[i] = {a.light * of_a + b.light * of_b + c.light * of_c,
                  of_a * a.height_mm + of_b * b.height_mm + of_c * c.height_mm};
  }
}

void MeshRaster::finish(cv::Mat& image, cv::Mat& height_mm) const {
  image.create(box_.size(), CV_32FC4);
  height_mm.create(box_.size(), CV_32FC1);
  const auto width = static_cast<std::ptrdiff_t>(size_.width);
  for (int row = 0; row < box_.height; ++row) {
    auto* out = image.ptr<cv::Vec4f>(row);
    auto* out_height = height_mm.ptr<float>(row);
    const std::ptrdiff_t line = (box_.y + row) * width + box_.x;
    for (int column = 0; column < box_.width; ++column) {
      const auto i = static_cast<std::size_t>(line + column);
      out[column] = {};
      out_height[column] = 0;
      if (covered_[i] == 0) continue;
      const float share = static_cast<float>(std::popcount(covered_[i])) / 32;
      Pixel pixel = pixels_[i];
      if (depth_mm_[i] == nothing_mm) {
        pixel = {};
        float count = 0;
        for (int dv = -1; dv <= 1; ++dv) {
          for (int du = -1; du <= 1; ++du) {
            const int v = row + dv;
            const int u = column + du;
            if (v < 0 || u < 0 || v >= box_.height || u >= box_.width) continue;
            const auto j = static_cast<std::size_t>((box_.y + v) * width + box_.x + u);
            if (depth_mm_[j] == nothing_mm) continue;
            pixel.light += pixels_[j].light;
            pixel.height_mm += pixels_[j].height_mm;
            ++count;
          }
        }
        if (count == 0) continue;  // less than a pixel of it is seen
        pixel.light *= 1 / count;
        pixel.height_mm /= count;
      }
      out[column] = {pixel.light[0] * share, pixel.light[1] * share, pixel.light[2] * share, share};
      out_height[column] = pixel.height_mm;
    }
  }
}

}  // namespace telehug
