// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/mesh_raster.hpp"

#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

namespace telehug {
namespace {

// Without a call of the library, which SSE2 has no instruction for.
int ceiled(float x) {
  const int towards_zero = static_cast<int>(x);
  return towards_zero + (static_cast<float>(towards_zero) < x ? 1 : 0);
}

// A triangle's edges from above to below; shared edges cross a row at the same place in both of their triangles.
class Edges {
 public:
  Edges(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) : top_(&a), middle_(&b), bottom_(&c) {
    if (middle_->v_px < top_->v_px) std::swap(middle_, top_);
    if (bottom_->v_px < middle_->v_px) std::swap(bottom_, middle_);
    if (middle_->v_px < top_->v_px) std::swap(middle_, top_);
    long_ = slope(*top_, *bottom_);
    upper_ = slope(*top_, *middle_);
    lower_ = slope(*middle_, *bottom_);
  }

  struct Span {
    float from = 0;
    float to = 0;
  };

  // Only for rows that it crosses: top() <= v < bottom().
  [[nodiscard]] Span at(float v) const {
    const float u = top_->u_px + (v - top_->v_px) * long_;
    const bool above = v < middle_->v_px;
    const RasterVertex& begin = above ? *top_ : *middle_;
    const float other = begin.u_px + (v - begin.v_px) * (above ? upper_ : lower_);
    return {std::min(u, other), std::max(u, other)};
  }
  [[nodiscard]] float top() const { return top_->v_px; }
  [[nodiscard]] float bottom() const { return bottom_->v_px; }

 private:
  static float slope(const RasterVertex& from, const RasterVertex& to) {
    const float rows = to.v_px - from.v_px;
    return rows > 0 ? (to.u_px - from.u_px) / rows : 0;
  }

  const RasterVertex* top_;
  const RasterVertex* middle_;
  const RasterVertex* bottom_;
  float long_ = 0;
  float upper_ = 0;
  float lower_ = 0;
};

}  // namespace

cv::Range joined(const cv::Range& a, const cv::Range& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.start, b.start), std::max(a.end, b.end)};
}

MeshRaster::MeshRaster(cv::Size size)
    : size_(size),
      blocks_across_((size.width + block_px - 1) / block_px),
      block_coverage_(static_cast<std::size_t>(blocks_across_ * ((size.height + block_px - 1) / block_px)), 0),
      columns_(static_cast<std::size_t>((size.height + block_px - 1) / block_px)),
      covered_(static_cast<std::size_t>(size.area()), 0),
      drawn_stride_(blocks_across_ * block_px),
      drawn_(static_cast<std::size_t>(drawn_stride_ * size.height), 0),
      depth_mm_(static_cast<std::size_t>(size.area()), nothing_mm),
      pixels_(static_cast<std::size_t>(size.area())) {}

cv::Range MeshRaster::columns_within(const cv::Range& v) const {
  cv::Range all(0, 0);
  for (int row = std::max(v.start, box_.y); row < std::min(v.end, box_.y + box_.height); ++row)
    all = joined(all, columns(row));
  return all;
}

void MeshRaster::begin(const cv::Rect& box) {
  box_ = box;
  for (int v = box.y; v < box.y + box.height; ++v) {
    const auto first = static_cast<std::ptrdiff_t>(v) * size_.width + box.x;
    std::fill_n(depth_mm_.begin() + first, box.width, nothing_mm);
    std::fill_n(drawn_.begin() + static_cast<std::ptrdiff_t>(v) * drawn_stride_, drawn_stride_, std::uint8_t{0});
  }
}

bool MeshRaster::beside_box(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) const {
  const auto left = static_cast<float>(box_.x - 1);
  const auto right = static_cast<float>(box_.x + box_.width);
  return std::max({a.u_px, b.u_px, c.u_px}) < left || std::min({a.u_px, b.u_px, c.u_px}) > right;
}

void MeshRaster::draw(const RasterVertex& a, const RasterVertex& b, const RasterVertex& c) {
  const float area = (b.u_px - a.u_px) * (c.v_px - a.v_px) - (c.u_px - a.u_px) * (b.v_px - a.v_px);
  if (area == 0 || beside_box(a, b, c)) return;
  const Edges edges(a, b, c);
  const int first = ceiled(std::max(edges.top(), static_cast<float>(box_.y)));
  const int end = ceiled(std::min(edges.bottom(), static_cast<float>(box_.y + box_.height)));
  if (first >= end) return;

  // Light, height and depth are linear in u and v.
  const float per_area = 1 / area;
  const cv::v_float32x4 of_a(a.light[0], a.light[1], a.light[2], a.height_mm);
  const cv::v_float32x4 to_b = cv::v_float32x4(b.light[0], b.light[1], b.light[2], b.height_mm) - of_a;
  const cv::v_float32x4 to_c = cv::v_float32x4(c.light[0], c.light[1], c.light[2], c.height_mm) - of_a;
  const float b_per_u = (c.v_px - a.v_px) * per_area;
  const float c_per_u = (a.v_px - b.v_px) * per_area;
  const float b_per_v = (a.u_px - c.u_px) * per_area;
  const float c_per_v = (b.u_px - a.u_px) * per_area;
  const cv::v_float32x4 per_u = to_b * cv::v_setall_f32(b_per_u) + to_c * cv::v_setall_f32(c_per_u);
  const float depth_per_u = (b.depth_mm - a.depth_mm) * b_per_u + (c.depth_mm - a.depth_mm) * c_per_u;

  const auto left = static_cast<float>(box_.x);
  const auto right = static_cast<float>(box_.x + box_.width);
  for (int row = first; row < end; ++row) {
    const auto v = static_cast<float>(row);
    const Edges::Span span = edges.at(v);
    const int from = ceiled(std::max(span.from, left));
    const int to = ceiled(std::min(span.to, right));
    if (from >= to) continue;
    const float du = static_cast<float>(from) - a.u_px;
    const float dv = v - a.v_px;
    const float of_b = du * b_per_u + dv * b_per_v;
    const float of_c = du * c_per_u + dv * c_per_v;
    cv::v_float32x4 value = of_a + to_b * cv::v_setall_f32(of_b) + to_c * cv::v_setall_f32(of_c);
    float depth_mm = a.depth_mm + (b.depth_mm - a.depth_mm) * of_b + (c.depth_mm - a.depth_mm) * of_c;
    const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.width);
    std::uint8_t* drawn = &drawn_[static_cast<std::size_t>(row * drawn_stride_)];
    for (int u = from; u < to; ++u, value += per_u, depth_mm += depth_per_u) {
      const std::size_t i = line + static_cast<std::size_t>(u);
      if (depth_mm >= depth_mm_[i]) continue;
      depth_mm_[i] = depth_mm;
      drawn[u] = 255;
      static_assert(sizeof(Pixel) == 4 * sizeof(float));
      cv::v_store(pixels_[i].light.val, value);
    }
  }
}

// 0: nothing drawn in this block and one pixel around it, 1: everything, 2: some.
int MeshRaster::coverage_of_block(int block_row, int block_column) const {
  std::uint32_t all = ~std::uint32_t{0};
  std::uint32_t any = 0;
  for (int row = -1; row <= block_px; ++row) {
    const int v = std::clamp(block_row * block_px + row, 0, size_.height - 1);
    for (const int shift : {-1, 1}) {
      const int u = std::clamp(block_column * block_px + shift, 0, drawn_stride_ - block_px);
      std::uint32_t four = 0;
      std::memcpy(&four, &drawn_[static_cast<std::size_t>(v * drawn_stride_ + u)], sizeof four);
      all &= four;
      any |= four;
    }
  }
  return any == 0 ? 0 : ~all == 0 ? 1 : 2;
}

void MeshRaster::find_outlines(bool exactly) {
  exactly_ = exactly;
  const int first_column = box_.x / block_px;
  const int last_column = (box_.x + box_.width - 1) / block_px;
  for (int row = box_.y / block_px; row <= (box_.y + box_.height - 1) / block_px; ++row) {
    cv::Range& within = columns_[static_cast<std::size_t>(row)];
    within = {0, 0};
    for (int column = first_column; column <= last_column; ++column) {
      const int coverage = coverage_of_block(row, column);
      block_coverage_[static_cast<std::size_t>(row * blocks_across_ + column)] = static_cast<std::uint8_t>(coverage);
      if (coverage == 0) continue;
      const int from = std::max(box_.x, column * block_px);
      const int to = std::min(box_.x + box_.width, (column + 1) * block_px);
      within = {within.empty() ? from : within.start, to};
      if (coverage == 1) continue;
      for (int v = std::max(box_.y, row * block_px); v < std::min(box_.y + box_.height, (row + 1) * block_px); ++v)
        cover_drawn(v, from, to);
    }
  }
}

// What cover_outlines() begins with.
void MeshRaster::cover_drawn(int v, int from, int to) {
  std::uint32_t* covered = covered_.data() + static_cast<std::ptrdiff_t>(v) * size_.width;
  const std::uint8_t* drawn = drawn_.data() + static_cast<std::ptrdiff_t>(v) * drawn_stride_;
  for (int u = from; u < to; ++u)
    covered[u] = !exactly_ && drawn[u] != 0 ? ~0U : 0U;
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
  if (!exactly_ || !near_outline(a, b, c)) return;
  // Line k of four a row lies at v = (k - 1.5) / 4 of it.
  const Edges edges(a, b, c);
  const auto line = [&](float v) {
    const auto low = static_cast<float>(box_.y);
    const auto high = static_cast<float>(box_.y + box_.height);
    return ceiled(std::clamp(v + 0.5F, low, high) * 4 - 0.5F);
  };
  for (int k = line(edges.top()); k < line(edges.bottom()); ++k) {
    const Edges::Span span = edges.at((static_cast<float>(k) + 0.5F) / 4 - 0.5F);
    cover(k / 4, k % 4, span.from, span.to);
  }
}

void MeshRaster::cover(int row, int part, float from_px, float to_px) {
  std::uint32_t* line = covered_.data() + static_cast<std::ptrdiff_t>(row) * size_.width;
  const auto left = static_cast<float>(box_.x * 8);
  const auto right = static_cast<float>((box_.x + box_.width) * 8);
  // Point k of a line lies at u = (k + 0.5) / 8 - 0.5.
  const auto point = [&](float u) { return ceiled(std::clamp((u + 0.5F) * 8 - 0.5F, left, right)); };
  const int to = point(to_px);
  for (int k = point(from_px); k < to;) {
    const int pixel = k >> 3;
    const int end = std::min(to, (pixel + 1) * 8);
    const std::uint32_t bits = ((1U << (end - k)) - 1) << (k & 7);
    line[pixel] |= bits << (8 * part);
    k = end;
  }
}

// The mean of what was drawn around; false if nothing was: less than a pixel of it is seen.
bool MeshRaster::take_from_neighbours(int u, int v, Pixel& pixel) const {
  pixel = {};
  float count = 0;
  for (int y = std::max(box_.y, v - 1); y <= std::min(box_.y + box_.height - 1, v + 1); ++y) {
    for (int x = std::max(box_.x, u - 1); x <= std::min(box_.x + box_.width - 1, u + 1); ++x) {
      const auto i = static_cast<std::size_t>(y * size_.width + x);
      if (depth_mm_[i] == nothing_mm) continue;
      pixel.light += pixels_[i].light;
      pixel.height_mm += pixels_[i].height_mm;
      ++count;
    }
  }
  if (count == 0) return false;
  pixel.light *= 1 / count;
  pixel.height_mm /= count;
  return true;
}

}  // namespace telehug
